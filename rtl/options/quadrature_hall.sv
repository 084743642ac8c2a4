// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Encoder socket: an incremental encoder with index, and three Hall lines of the motor, which say where its electrical
// angle begins and check the encoder. docs/blocks/three_phase.md

`default_nettype none

module quadrature_hall (
    input  logic           clk_i,
    input  logic           rst_ni,
    input  cfg::params_t   p,
    input  logic           a_i,        // asynchronous pins
    input  logic           b_i,
    input  logic           z_i,
    input  logic     [2:0] hall_i,
    input  cfg::encoder_t  encoder_i,
    output cfg::position_t position_o,
    output logic    [31:0] angle_o     // electrical, 2^-32 turn, 0 where line 0 rises
);
  cfg::position_t edges;
  logic [2:0] faults;
  logic waits;
  quadrature u_quadrature (
      .clk_i(clk_i), .rst_ni(rst_ni), .a_i(a_i), .b_i(b_i), .z_i(z_i), .encoder_i(encoder_i), .position_o(edges)
  );
  hall_sensor u_hall_sensor (
      .clk_i(clk_i), .rst_ni(rst_ni), .hall_i(hall_i), .count_i(edges.count[1:0]), .gain_i(p.commutation_gain),
      .gates_enable_i(encoder_i.gates_enable), .clear_i(encoder_i.clear), .angle_o(angle_o), .faults_o(faults),
      .waits_o(waits)
  );
  always_comb begin
    position_o = edges;
    position_o.why = {waits, 1'b0, faults[2], 1'b0, faults[1:0]};  // as of an absolute encoder: jump, check, missing
  end
endmodule

`default_nettype wire
