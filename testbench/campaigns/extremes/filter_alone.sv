// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The velocity estimator alone, whose low-pass is that of every filter, with its coefficient at a
// port. docs/extremes.md

`default_nettype none

module filter_alone (
    input  logic                              clk_i,
    input  logic                              rst_ni,
    input  logic                              sample_i,
    input  logic signed [              15:0]  travel_i,
    input  logic        [              16:0]  a1_i,
    output logic signed [cfg::VELOCITY_W-1:0] velocity_o
);
  cfg::params_t p;
  logic unused_saturated, unused_valid;
  always_comb begin
    p             = cfg::PARAMS_RESET;
    p.velocity_a1 = a1_i;
  end
  velocity_estimator u_velocity_estimator (
      .clk_i(clk_i), .rst_ni(rst_ni), .p(p), .sample_i(sample_i), .travel_i(travel_i), .velocity_o(velocity_o),
      .saturated_o(unused_saturated), .valid_o(unused_valid)
  );
endmodule

`default_nettype wire
