// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// UART transmitter, 8N1. A bit begins when the phase accumulator overflows. Bytes follow each other
// without a gap. Documentation: docs/link.md
`default_nettype none

module uart_tx #(
    parameter int ClockHz = cfg::CLOCK_HZ,
    parameter int Baud = feltgate_link_pkg::BAUD
) (
    input  logic       clk_i,
    input  logic       rst_ni,
    input  logic [7:0] byte_i,
    input  logic       valid_i,  // held with the byte until ready_o
    output logic       ready_o,  // a valid byte is taken in this clock
    output logic       tx_o
);
  // Phase step per clock; 2^16 is one bit.
  localparam int PhaseW = 16;
  localparam logic [63:0] CLOCK_64 = 64'(ClockHz);
  localparam logic [63:0] STEP_64 = (64'(Baud) * 64'd65536 + CLOCK_64 / 64'd2) / CLOCK_64;
  localparam logic [PhaseW-1:0] STEP = STEP_64[PhaseW-1:0];

  generate
  if (!(Baud > 0 && ClockHz / 8 >= Baud)) begin : g_check_baud
    a_bit_must_last_eight_clocks missing ();
  end
  if (!(STEP_64 >= 64'd100)) begin : g_check_step  // rounding: half a step in 100, 0.5 % of Baud
    the_baud_rate_is_too_low_for_the_phase missing ();
  end
  endgenerate

  logic [       8:0] bits_q;  // bit 0 is on the wire; ones are shifted in
  logic [       3:0] left_q;  // bits after the one on the wire
  logic              busy_q;
  logic [PhaseW-1:0] phase_q;
  logic [  PhaseW:0] next;
  logic              ends, over;
  assign next    = {1'b0, phase_q} + {1'b0, STEP};
  assign ends    = busy_q && next[PhaseW];
  assign over    = ends && left_q == 4'd0;
  assign ready_o = !busy_q || over;
  assign tx_o    = bits_q[0];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      bits_q  <= '1;
      left_q  <= 4'd0;
      busy_q  <= 1'b0;
      phase_q <= '0;
    end else begin
      phase_q <= busy_q ? next[PhaseW-1:0] : '0;
      if (ready_o) begin
        busy_q <= valid_i;
        left_q <= 4'd9;
        bits_q <= valid_i ? {byte_i, 1'b0} : '1;
      end else if (ends) begin
        left_q <= left_q - 4'd1;
        bits_q <= {1'b1, bits_q[8:1]};
      end
    end
  end
endmodule

`default_nettype wire
