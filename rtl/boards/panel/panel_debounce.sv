// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Debounces a word: level_o follows level_i when no bit of it has changed for 2^HoldBits clocks.
// Documentation: docs/boards/panel.md
`default_nettype none

module panel_debounce #(
  parameter int Width      = 1,
  parameter int HoldBits   = 19,
  parameter int ResetValue = 0
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic [Width-1:0] level_i,  // synchronous to clk_i
  output logic [Width-1:0] level_o
);

  localparam logic [Width-1:0] RESET_LEVEL = ResetValue[Width-1:0];

  logic [Width-1:0]    seen_q, level_q;
  logic [HoldBits-1:0] rest_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      seen_q  <= RESET_LEVEL;
      level_q <= RESET_LEVEL;
      rest_q  <= '0;
    end else begin
      seen_q <= level_i;
      if (level_i != seen_q) rest_q <= '0;
      else if (&rest_q) level_q <= seen_q;
      else rest_q <= rest_q + 1'b1;
    end
  end

  assign level_o = level_q;
endmodule

`default_nettype wire
