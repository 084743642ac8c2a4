// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A charge at its centre, where the law divides by 0, and what bounds its torque anywhere. From the start of
// a wave on, for any state before it.
`default_nettype none

module centre_proof (
    input logic                                            clk_i,
    input logic                                            rst_ni,
    input logic                                            armed_i,
    input logic                                            attract_i,
    input logic                                            repel_i,
    input logic                                            distance_positive_i,
    input logic        [                              31:0] param_i,
    input logic signed [    feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    input logic                                            over_limit_i
);
  localparam int TorqueW = feltgate_pkg::TORQUE_W;
  localparam int PartW = feltgate_pkg::SCENE_PART_W;
  localparam int Square = feltgate_map_pkg::PRODUCT_AT_CHARGE_SQUARE;
  localparam int DistanceF = feltgate_pkg::SCENE_DISTANCE_F;

  logic past_ok_q;
  logic [5:0] phase_q;  // of the wave; 63 before it
  logic [feltgate_map_pkg::WAVE_LENGTH-1:0] wave;
  initial begin
    past_ok_q = 1'b0;
    phase_q   = 6'd63;
  end
  always_ff @(posedge clk_i) begin
    past_ok_q <= 1'b1;
    phase_q   <= (phase_q == 6'd50) ? 6'd50 : phase_q + 6'd1;  // one wave
  end
  assign wave = (phase_q < 6'(feltgate_map_pkg::WAVE_LENGTH)) ? feltgate_map_pkg::WAVE_LENGTH'(1) << phase_q : '0;

  logic armed_q, attract_q, repel_q;
  always_ff @(posedge clk_i) begin
    armed_q   <= armed_i;
    attract_q <= attract_i;
    repel_q   <= repel_i;
  end
  always_comb begin
    assume (rst_ni == past_ok_q);
    assume (!(attract_i && repel_i));
    if (past_ok_q) assume (armed_i == armed_q && attract_i == attract_q && repel_i == repel_q);
    if (wave[Square]) assume (product_i[DistanceF+:32] == 32'd0 && product_i[DistanceF+34:DistanceF+32] == 3'd0);
    if (wave[feltgate_map_pkg::PARAM_AT_ATTRACT_STRENGTH]) assume (!distance_positive_i);
  end

  logic signed [PartW-1:0] plus, minus;
  logic signed [TorqueW-1:0] outside, size;
  logic negated, up;
  assign outside = (negated ? ~size : size) + TorqueW'({1'b0, up});  // as the limiter takes it
  scene_charge u_dut (
      .*,
      .division_i(wave[feltgate_map_pkg::PARAM_AT_TORQUE_LIMIT-1:feltgate_map_pkg::PRODUCT_AT_CHARGE_SQUARE]),
      .at_scene_distance_i(wave[feltgate_map_pkg::EVENT_AT_SCENE_DISTANCE]),
      .param_is_attract_strength_i(wave[feltgate_map_pkg::PARAM_AT_ATTRACT_STRENGTH]),
      .param_was_attract_strength_i(wave[feltgate_map_pkg::PARAM_AT_ATTRACT_STRENGTH+1]),
      .at_charge_width_limited_i(wave[feltgate_map_pkg::EVENT_AT_CHARGE_WIDTH_LIMITED]),
      .at_charge_core_i(wave[feltgate_map_pkg::EVENT_AT_CHARGE_CORE]),
      .product_is_attract_core_slope_i(wave[feltgate_map_pkg::PRODUCT_AT_ATTRACT_CORE_SLOPE]),
      .product_is_repel_core_slope_i(wave[feltgate_map_pkg::PRODUCT_AT_REPEL_CORE_SLOPE]),
      .after_charge_core_i(wave[feltgate_map_pkg::EVENT_AT_CHARGE_CORE+1]),
      .plus_o(plus),
      .minus_o(minus),
      .outside_o(size),
      .outside_not_o(negated),
      .outside_up_o(up)
  );
  (* hierconn *) wire \u_dut.near_q ;
  localparam int Up =
      (feltgate_pkg::TORQUE_F > feltgate_pkg::CHARGE_F) ? feltgate_pkg::TORQUE_F - feltgate_pkg::CHARGE_F : 0;
  localparam int Down =
      (feltgate_pkg::TORQUE_F < feltgate_pkg::CHARGE_F) ? feltgate_pkg::CHARGE_F - feltgate_pkg::TORQUE_F : 0;
  localparam logic signed [23:0] Most = ((24'sd65535 <<< Up) >>> Down);
  localparam logic signed [23:0] Least = ((-24'sd65535 <<< Up) >>> Down);

  logic near;  // within the core: its torque is the slope's product
  assign near = \u_dut.near_q ;
  always_comb begin
    if (past_ok_q && phase_q == 6'(feltgate_map_pkg::PARAM_AT_TORQUE_LIMIT)) begin
      centre_is_defined: assert (!armed_q || near || !(attract_i || repel_i) ||
                                 (attract_i ? 24'(outside) == Least : 24'(outside) == Most));
      core_is_its_product: assert (!near || outside == '0);
      silent_otherwise: assert ((armed_q && (attract_i || repel_i)) || outside == '0);
      centre: cover (outside < 0);
      core: cover (near && armed_q);
    end
    if (past_ok_q && phase_q > 6'd9 && phase_q < 6'd50) begin
      terms_are_the_scenes: assert ((attract_i || plus == '0) && (repel_i || minus == '0));
      one_or_the_other: assert (near || (plus == '0 && minus == '0));
    end
  end
endmodule

`default_nettype wire
