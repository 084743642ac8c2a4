// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// uart_tx beside a clock of its own: when which bit of which byte is on the line, by the nominal rate.
`default_nettype none

`ifdef MBAUD_6
`define RATE 6000000
`else
`define RATE feltgate_link_pkg::BAUD
`endif

module line_proof (
    input logic       clk_i,
    input logic       rst_ni,
    input logic [7:0] byte_i,
    input logic       valid_i
);
  localparam int Baud = `RATE;
  localparam int ClockHz = cfg::CLOCK_HZ;
  // In units of 1 / (Baud * ClockHz) a clock lasts Baud and a bit ClockHz.
  // An edge may be a clock off, and a quarter more, since the rate is one of whole steps.
  localparam logic [31:0] OFF = 32'(Baud + Baud / 4);
  localparam logic [31:0] BYTE = 32'(10 * ClockHz);
  // Of the rate that it makes, 2^16 are a bit: the nominal one, to the nearest step.
  localparam logic [31:0] STEP = 32'((64'(Baud) * 64'd131072 / 64'(ClockHz) + 64'd1) / 64'd2);

`include "reset.svh"

  logic ready, tx;
  uart_tx #(.ClockHz(ClockHz), .Baud(Baud)) u_dut (
      .clk_i(clk_i), .rst_ni(rst_ni), .byte_i(byte_i), .valid_i(valid_i), .ready_o(ready), .tx_o(tx)
  );
  (* hierconn *) wire [8:0] \u_dut.bits_q ;
  (* hierconn *) wire [3:0] \u_dut.left_q ;
  (* hierconn *) wire \u_dut.busy_q ;
  (* hierconn *) wire [15:0] \u_dut.phase_q ;

  // What was taken, and how long ago; age 0 is the first clock of its start bit.
  logic        sends_q, on_end_q, tx_q;
  logic [ 9:0] frame_q;
  logic [11:0] age_q;
  logic [31:0] now_q;    // in time
  logic [31:0] lag_q;    // of the byte's begin behind its time in a row of bytes, in 2^16ths of a bit
  logic [31:0] spent_q;  // time of the row since that time, so also
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      sends_q  <= 1'b0;
      on_end_q <= 1'b0;
      frame_q  <= '1;
      age_q    <= '0;
      now_q    <= '0;
      lag_q    <= '0;
      spent_q  <= '0;
    end else begin
      age_q   <= age_q + 12'd1;
      now_q   <= now_q + 32'(Baud);
      spent_q <= spent_q + STEP;
      if (ready) begin
        sends_q  <= valid_i;
        on_end_q <= sends_q;
        frame_q  <= {1'b1, byte_i, 1'b0};
        age_q    <= '0;
        now_q    <= '0;
        lag_q    <= sends_q ? spent_q + STEP - 32'd655360 : '0;
        spent_q  <= sends_q ? spent_q + STEP - 32'd655360 : '0;
      end
    end
  end

  // The bit that the clock is surely of, or the edge that it is at.
  logic [31:0] at_edge;
  logic [ 3:0] sure_bit, edge_bit;
  logic        sure, edges, edges_q;
  always_comb begin
    sure     = 1'b0;
    edges    = 1'b0;
    sure_bit = '0;
    edge_bit = '0;
    at_edge  = '0;
    for (int k = 0; k < 10; k++) begin
      at_edge = 32'(k * ClockHz);
      if ((k == 0 || now_q >= at_edge + OFF) && now_q + OFF <= at_edge + 32'(ClockHz)) begin
        sure     = 1'b1;
        sure_bit = 4'(k);
      end
      if (k != 0 && now_q < at_edge + OFF && now_q + OFF > at_edge) begin
        edges    = 1'b1;
        edge_bit = 4'(k);
      end
    end
  end
  always_ff @(posedge clk_i) begin
    tx_q    <= tx;
    edges_q <= edges;
  end

  logic [3:0] at;
  assign at = 4'd9 - \u_dut.left_q ;
  always_comb begin
    if (past_ok_q) begin
      high_in_a_reset: assert (rst_ni || tx);
      if (rst_ni) begin
        high_between_bytes: assert (sends_q || tx);
        ready_between_bytes: assert (sends_q || ready);
        bits_in_their_time: assert (!sends_q || !sure || tx == frame_q[sure_bit]);
        one_change_at_an_edge: assert (!sends_q || !edges || ((tx == frame_q[edge_bit] || tx == frame_q[edge_bit-4'd1]) &&
            (!edges_q || tx_q != frame_q[edge_bit] || tx == frame_q[edge_bit])));
        not_ready_in_a_byte: assert (!sends_q || !ready || now_q + 32'(Baud) + OFF >= BYTE);
        ready_after_ten_bits: assert (!sends_q || ready || now_q + 32'(Baud) < BYTE + OFF);
        nothing_adds_up: assert (!sends_q || lag_q < STEP);

        inside_busy: assert (\u_dut.busy_q == sends_q && (!sends_q || (frame_q[9] && !frame_q[0])));
        inside_idle: assert (sends_q || &\u_dut.bits_q );
        inside_time: assert (!sends_q || (spent_q == lag_q + 32'(age_q) * STEP && now_q == 32'(age_q) * 32'(Baud)));
        inside_phase: assert (!sends_q || (at <= 4'd9 && spent_q == {12'd0, at, \u_dut.phase_q }));
        inside_age: assert (!sends_q || age_q < 12'(10 * (ClockHz / Baud + 1) + 2));
        inside_bits: assert (!sends_q || at > 4'd9 || \u_dut.bits_q == 9'({9'h1ff, frame_q} >> at));
        starts: cover (sends_q && !tx && frame_q[8:1] == 8'ha6);
        waits: cover (sends_q && valid_i && !ready);
      end
    end
  end
endmodule

`default_nettype wire
