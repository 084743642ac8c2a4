// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Classic cycles, any of them at any time, whatever the core does.
`default_nettype none

module classic_proof (
    input logic        clk_i,
    input logic        rst_ni,
    input logic        cyc_i,
    input logic        stb_i,
    input logic        we_i,
    input logic [11:0] adr_i,
    input logic [ 3:0] sel_i,
    input logic [31:0] dat_i,
    input logic [31:0] reg_rdata_i,
    input logic        reg_busy_i
);
  localparam int Pipelined = 0;
  `include "request.svh"

  // A request stands as its cycle began it; what it is owed was told to the port once.
  logic asks, standing_q, taken_q, we_q, fits_q;
  logic [11:0] adr_q;
  logic [3:0] sel_q;
  logic [31:0] dat_q;
  logic [1:0] age_q;  // clocks since it was taken
  assign asks = cyc_i && stb_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      standing_q <= 1'b0;
      taken_q    <= 1'b0;
      age_q      <= 2'd0;
      fits_q     <= 1'b0;
    end else begin
      standing_q <= asks && !answer;
      if (!asks || answer) taken_q <= 1'b0;
      else if (!taken_q && !(we_i && fits && reg_busy_i)) begin
        taken_q <= 1'b1;
        age_q   <= 2'd1;
        fits_q  <= fits;
      end else age_q <= age_q + 2'd1;
    end
  end
  always_ff @(posedge clk_i) begin
    we_q  <= we_i;
    adr_q <= adr_i;
    sel_q <= sel_i;
    dat_q <= dat_i;
  end

  always_comb begin
    // B4, rule 3.60: what qualifies a request stands with it.
    if (standing_q && asks) assume (we_i == we_q && adr_i == adr_q && sel_i == sel_q && dat_i == dat_q);
    if (past_ok_q && rst_ni) begin
      no_spurious_answer: assert (!answer || (asks && taken_q));
      one_answer: assert (!(ack && err));
      answered_in_three: assert (!asks || !taken_q || answer == (age_q == 2'd3));
      error_where_it_does_not_fit: assert (!answer || ack == fits_q);
      word_of_the_port: assert (!ack || dat == reg_rdata_i);
      write_lands_once: assert ((reg_write && !reg_busy_i) == (asks && !taken_q && we_i && fits && !reg_busy_i));
      write_as_asked: assert (!reg_write || (reg_addr == adr_i && reg_wdata == dat_i));
      on_the_port_at_once: assert (!(asks && !standing_q && we_i && fits) || reg_write);
      never_stalls: assert (!stall);
      inside_one: assert ((\u_dut.good_q & \u_dut.bad_q ) == 3'd0);
      inside_taken: assert ((\u_dut.good_q | \u_dut.bad_q ) == (taken_q ? 3'd1 << (age_q - 2'd1) : 3'd0));
      inside_age: assert (!taken_q || (age_q != 2'd0 && standing_q));
      inside_fits: assert (!taken_q || (\u_dut.good_q != 3'd0) == fits_q);
      writes: cover (ack && we_i);
      refuses: cover (err);
    end
  end
endmodule

`default_nettype wire
