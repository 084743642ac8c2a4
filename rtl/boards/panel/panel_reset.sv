// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reset from a key: asserted asynchronously when the key closes; released synchronously when the
// key has been open for 2^HoldBits clocks. After power-up the reset acts in the same way.
// Documentation: docs/boards/panel.md
`default_nettype none

module panel_reset #(
  parameter int HoldBits = 19
) (
  input  logic clk_i,
  input  logic key_ni,  // asynchronous, low while pressed, bounces
  output logic rst_no
);

  // The FPGA's configuration loads these values; there is no other reset for them.
  logic                open_meta_q = 1'b0;
  logic                open_q      = 1'b0;
  logic [HoldBits-1:0] hold_q      = '0;
  logic                rst_n_q     = 1'b0;

  always_ff @(posedge clk_i or negedge key_ni) begin
    if (!key_ni) begin
      open_meta_q <= 1'b0;
      open_q      <= 1'b0;
    end else begin
      open_meta_q <= 1'b1;
      open_q      <= open_meta_q;
    end
  end

  always_ff @(posedge clk_i or negedge open_q) begin
    if (!open_q) begin
      hold_q  <= '0;
      rst_n_q <= 1'b0;
    end else if (&hold_q) begin
      rst_n_q <= 1'b1;
    end else begin
      hold_q <= hold_q + 1'b1;
    end
  end

  assign rst_no = rst_n_q;
endmodule

`default_nettype wire
