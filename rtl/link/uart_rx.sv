// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// UART receiver, 8N1. A phase accumulator overflows in the middle of each bit, so any baud rate up
// to an eighth of the clock works. The line level is a majority of three consecutive clocks, so a
// pulse of one clock is ignored. Documentation: docs/link.md
`default_nettype none

module uart_rx #(
    parameter int ClockHz = cfg::CLOCK_HZ,
    parameter int Baud = feltgate_link_pkg::BAUD
) (
    input  logic       clk_i,
    input  logic       rst_ni,
    input  logic       rx_i,     // asynchronous; idle level is high
    output logic [7:0] byte_o,   // valid with valid_o
    output logic       valid_o,  // one clock
    output logic       error_o   // one clock: the stop bit was low
);
  // Phase step per clock; 2^16 is one bit.
  localparam int PhaseW = 16;
  localparam logic [63:0] CLOCK_64 = 64'(ClockHz);
  localparam logic [63:0] STEP_64 = (64'(Baud) * 64'd65536 + CLOCK_64 / 64'd2) / CLOCK_64;
  localparam logic [PhaseW-1:0] STEP = STEP_64[PhaseW-1:0];
  // The first overflow is half a bit after the edge. One step more centres the sampling error.
  localparam logic [PhaseW-1:0] BEGIN = 16'h8000 + STEP;

  generate
  if (!(Baud > 0 && ClockHz / 8 >= Baud)) begin : g_check_baud
    a_bit_must_last_eight_clocks missing ();
  end
  if (!(STEP_64 >= 64'd100)) begin : g_check_step  // rounding: half a step in 100, 0.5 % of Baud
    the_baud_rate_is_too_low_for_the_phase missing ();
  end
  endgenerate

  logic [2:0] seen_q;  // the first two are the synchroniser
  logic       late_q, line;
  assign line = (seen_q[1] && seen_q[2]) || (seen_q[1] && late_q) || (seen_q[2] && late_q);

  logic              busy_q, ready_q;  // ready_q: the line was high after the last byte
  logic [       3:0] bit_q;            // 0 start, 1 to 8 data, 9 stop
  logic [PhaseW-1:0] phase_q;
  logic [  PhaseW:0] next;
  logic              sample;
  assign next   = {1'b0, phase_q} + {1'b0, STEP};
  assign sample = busy_q && next[PhaseW];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      seen_q  <= 3'b111;
      late_q  <= 1'b1;
      busy_q  <= 1'b0;
      ready_q <= 1'b0;
      bit_q   <= 4'd0;
      phase_q <= '0;
      byte_o  <= 8'd0;
      valid_o <= 1'b0;
      error_o <= 1'b0;
    end else begin
      seen_q  <= {seen_q[1:0], rx_i};
      late_q  <= seen_q[2];
      phase_q <= busy_q ? next[PhaseW-1:0] : BEGIN;
      valid_o <= sample && bit_q == 4'd9 && line;
      error_o <= sample && bit_q == 4'd9 && !line;
      if (!busy_q) begin
        ready_q <= line;
        busy_q  <= ready_q && !line;
        bit_q   <= 4'd0;
      end else if (sample) begin
        ready_q <= line;
        bit_q   <= bit_q + 4'd1;
        if (bit_q == 4'd9 || (bit_q == 4'd0 && line)) busy_q <= 1'b0;
        if (bit_q != 4'd0 && bit_q != 4'd9) byte_o <= {line, byte_o[7:1]};
      end
    end
  end
endmodule

`default_nettype wire
