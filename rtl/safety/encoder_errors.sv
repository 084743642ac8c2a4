// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cause of fault: too many illegal transitions of the encoder. ERRORS_BORNE are tolerated, the next
// one trips. Every 2^FORGIVE_BITS ticks one is forgiven. docs/blocks/safety.md

`default_nettype none

module encoder_errors (
    input  logic clk_i,
    input  logic rst_ni,
    input  logic tick_i,     // last clock of a tick
    input  logic illegal_i,  // both channels changed in one clock
    output logic trip_o
);
  localparam int W = $clog2(map::ERRORS_BORNE + 1);
  logic [W-1:0] errors_q;  // that still count
  logic [map::FORGIVE_BITS-1:0] ticks_q;
  assign trip_o = illegal_i && errors_q == W'(map::ERRORS_BORNE);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {errors_q, ticks_q} <= '0;
    end else begin
      if (tick_i) ticks_q <= ticks_q + 1'b1;
      if (trip_o)                                        errors_q <= '0;
      else if (illegal_i)                                errors_q <= errors_q + 1'b1;
      else if (tick_i && ticks_q == '1 && errors_q != '0) errors_q <= errors_q - 1'b1;
    end
  end
endmodule

`default_nettype wire
