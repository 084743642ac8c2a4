// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Pipelined requests, any of them in any clock, whatever the core does.
`default_nettype none

module pipelined_proof (
    input logic        clk_i,
    input logic        rst_ni,
    input logic        cyc_i,
    input logic        stb_i,
    input logic        we_i,
    input logic [11:0] adr_i,
    input logic [ 3:0] sel_i,
    input logic [31:0] dat_i,
    input logic [31:0] reg_rdata_i,
    input logic        reg_busy_i,
    input logic        pick_i        // this request is the one that is watched
);
  localparam int Pipelined = 1;
  `include "request.svh"

  logic takes;
  assign takes = cyc_i && stb_i && !stall;

  // Requests of this cycle that are owed an answer, and the one that is watched: how many are owed one before
  // it, for how many clocks it waits, and what it must come to.
  logic [1:0] owed_q, ahead_q, age_q;
  logic watched_q, fits_q, its_turn;
  assign its_turn = watched_q && ahead_q == 2'd0;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      owed_q    <= 2'd0;
      ahead_q   <= 2'd0;
      age_q     <= 2'd0;
      watched_q <= 1'b0;
      fits_q    <= 1'b0;
    end else if (!cyc_i) begin
      owed_q    <= 2'd0;
      watched_q <= 1'b0;
    end else begin
      owed_q <= owed_q + 2'(takes) - 2'(answer);
      if (watched_q) begin
        age_q <= age_q + 2'd1;
        if (answer && ahead_q == 2'd0) watched_q <= 1'b0;
        else if (answer) ahead_q <= ahead_q - 2'd1;
      end else if (takes && pick_i) begin
        watched_q <= 1'b1;
        fits_q    <= fits;
        age_q     <= 2'd1;
        ahead_q   <= owed_q - 2'(answer);
      end
    end
  end

  // The bits that stand left of the watched one are those that are owed an answer before it.
  logic [2:0] both, before;
  assign both   = \u_dut.good_q | \u_dut.bad_q ;
  assign before = age_q == 2'd3 ? 3'b000 : age_q == 2'd2 ? both & 3'b100 : both & 3'b110;

  always_comb begin
    if (past_ok_q && rst_ni) begin
      no_spurious_answer: assert (!answer || (cyc_i && owed_q != 2'd0));
      one_answer: assert (!(ack && err));
      answered_in_three: assert (!watched_q || age_q != 2'd3 || !cyc_i || (answer && its_turn));
      in_their_order: assert (!its_turn || !answer || age_q == 2'd3);
      error_where_it_does_not_fit: assert (!its_turn || !answer || ack == fits_q);
      word_of_the_port: assert (!ack || dat == reg_rdata_i);
      read_asks_at_once: assert (!takes || we_i || reg_addr == adr_i);
      write_lands: assert ((takes && we_i && fits) == (reg_write && !reg_busy_i));
      write_as_asked: assert (!reg_write || (cyc_i && stb_i && we_i && fits && reg_addr == adr_i && reg_wdata == dat_i));
      on_the_port_at_once: assert (reg_write == (cyc_i && stb_i && we_i && fits));
      stalls_for_the_tick_only: assert (!stall || (we_i && fits && reg_busy_i));
      inside_one: assert ((\u_dut.good_q & \u_dut.bad_q ) == 3'd0);
      inside_owed: assert (owed_q == 2'(both[0]) + 2'(both[1]) + 2'(both[2]));
      inside_watched: assert (!watched_q || (age_q != 2'd0 && both[age_q-2'd1] &&
                              \u_dut.good_q [age_q-2'd1] == fits_q));
      inside_ahead: assert (!watched_q || ahead_q == 2'(before[1]) + 2'(before[2]));
      full: cover (owed_q == 2'd3 && its_turn && ack);
      refuses: cover (err && its_turn);
      waits: cover (stall && stb_i && cyc_i);
    end
  end
endmodule

`default_nettype wire
