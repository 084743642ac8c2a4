// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The terms of spring, damper, wall and set-point from their products and words, for any clocks.
`default_nettype none

module terms_proof (
    input logic                                             clk_i,
    input logic        [feltgate_map_pkg::WAVE_LENGTH-1:0] wave_i,
    input logic        [                              31:0] param_i,
    input logic signed [    feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    input logic                                             select_i,
    input logic                                             tension_i,
    input logic                                             compression_i,
    input logic                                             behind_i
);
  localparam int W = feltgate_pkg::SCENE_PART_W;
  localparam int P = feltgate_pkg::PRODUCT_BITS;
  localparam int TorqueW = feltgate_pkg::TORQUE_W;
  localparam int SpringDrop =
      feltgate_pkg::SCENE_DISTANCE_F + feltgate_pkg::P_COMPRESSION_STIFFNESS_F - feltgate_pkg::SCENE_PART_F;
  localparam int DamperDrop = feltgate_pkg::VELOCITY_F + feltgate_pkg::P_DAMPER_DAMPING_F - feltgate_pkg::SCENE_PART_F;
  localparam int WallDrop =
      feltgate_pkg::SCENE_DISTANCE_F + feltgate_pkg::P_WALL_STIFFNESS_F - feltgate_pkg::SCENE_PART_F;
  localparam int BrakeDrop = feltgate_pkg::VELOCITY_F + feltgate_pkg::P_WALL_DAMPING_F - feltgate_pkg::SCENE_PART_F;

  logic signed [TorqueW-1:0] setpoint;
  logic signed [W-1:0] spring, damper, wall, brake;
  scene_setpoint u_setpoint (.clk_i(clk_i), .select_i(select_i), .param_is_setpoint_torque_i(wave_i[feltgate_map_pkg::PARAM_AT_SETPOINT_TORQUE]),
                            .param_i(param_i), .plus_o(setpoint));
  scene_spring u_spring (
      .*,
      .product_is_scene_stiffness_i(wave_i[feltgate_map_pkg::PRODUCT_AT_SCENE_STIFFNESS]),
      .plus_o(spring)
  );
  scene_damper u_damper (.clk_i(clk_i), .select_i(select_i), .product_is_damper_damping_i(wave_i[feltgate_map_pkg::PRODUCT_AT_DAMPER_DAMPING]),
                         .product_i(product_i), .minus_o(damper));
  scene_wall u_wall (
      .*,
      .product_is_wall_stiffness_i(wave_i[feltgate_map_pkg::PRODUCT_AT_WALL_STIFFNESS]),
      .product_is_wall_damping_i(wave_i[feltgate_map_pkg::PRODUCT_AT_WALL_DAMPING]),
      .plus_o(wall),
      .minus_o(brake)
  );

  // What each was, and what came by.
  logic past_ok_q, select_q, spring_on_q, wall_on_q, word_q, stiff_q, wall_stiff_q, damps_q, brakes_q;
  logic signed [P-1:0] product_q;
  logic signed [TorqueW-1:0] setpoint_q, param_q;
  logic signed [W-1:0] spring_q, damper_q, wall_q, brake_q;
  initial past_ok_q = 1'b0;
  always_ff @(posedge clk_i) begin
    past_ok_q    <= 1'b1;
    select_q     <= select_i;
    spring_on_q  <= tension_i || (compression_i && !behind_i);
    wall_on_q    <= select_i && behind_i;
    word_q       <= wave_i[feltgate_map_pkg::PARAM_AT_SETPOINT_TORQUE];
    stiff_q      <= wave_i[feltgate_map_pkg::PRODUCT_AT_SCENE_STIFFNESS];
    wall_stiff_q <= wave_i[feltgate_map_pkg::PRODUCT_AT_WALL_STIFFNESS];
    damps_q      <= wave_i[feltgate_map_pkg::PRODUCT_AT_DAMPER_DAMPING];
    brakes_q     <= wave_i[feltgate_map_pkg::PRODUCT_AT_WALL_DAMPING];
    product_q    <= product_i;
    param_q      <= param_i[TorqueW-1:0];
    setpoint_q   <= setpoint;
    spring_q     <= spring;
    damper_q     <= damper;
    wall_q       <= wall;
    brake_q      <= brake;
  end
  // A term is its product less what is below its last bit, where it fits.
  function automatic logic is_floor(input logic signed [W-1:0] term, input logic signed [P-1:0] product,
      input int drop);
    is_floor = term == W'(product >>> drop);
  endfunction
  logic signed [P-1:0] wall_whole;
  logic fits;
  localparam logic signed [W-1:0] Least = {1'b1, {(W - 1) {1'b0}}};
  assign wall_whole = product_q >>> WallDrop;
  assign fits       = wall_whole == P'($signed(wall_whole[W-1:0]));

  always_comb begin
    if (past_ok_q) begin
      unselected_is_0: assert ((select_q || (setpoint == 0 && damper == 0)) && (spring_on_q || spring == 0) &&
                               (wall_on_q || (wall == 0 && brake == 0)));
      held_between: assert ((!select_q || word_q || setpoint == setpoint_q) && (!spring_on_q || stiff_q ||
          spring == spring_q) &&
                            (!select_q || damps_q || damper == damper_q) && (!wall_on_q || wall_stiff_q ||
                                wall == wall_q) &&
                            (!wall_on_q || brakes_q || brake == brake_q));
      setpoint_is_the_word: assert (!(select_q && word_q) || setpoint == param_q);
      spring_is_its_product: assert (!(spring_on_q && stiff_q) || is_floor(spring, product_q, SpringDrop));
      damper_is_its_product: assert (!(select_q && damps_q) || is_floor(damper, product_q, DamperDrop));
      brake_is_its_product: assert (!(wall_on_q && brakes_q) || is_floor(brake, product_q, BrakeDrop));
      wall_is_its_product: assert (!(wall_on_q && wall_stiff_q) || product_q >= 0 ||
          (fits ? P'(wall) == wall_whole : wall == Least));
      saturates: cover (wall_on_q && wall_stiff_q && product_q < 0 && !fits);
      springs: cover (spring_on_q && stiff_q && spring < 0);
    end
  end
endmodule

`default_nettype wire
