// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Room: travel to velocity, and velocity and current to the load torque tau_hat.
// Timing: velocity_o is new after EVENT_AT_VELOCITY, tau_hat_o after EVENT_AT_TAU_HAT.
// docs/architecture.md

`default_nettype none

module estimators (
    input  logic                                                  clk_i,
    input  logic                                                  rst_ni,
    input  logic        [      feltgate_map_pkg::WAVE_LENGTH-1:0] wave_i,
    input  logic                                                  armed_i,
    input  logic signed [          feltgate_pkg::TRAVEL_BITS-1:0] travel_i,               // counts, wraps
    output logic signed [feltgate_pkg::VELOCITY_DIFFERENCE_W-1:0] velocity_difference_o,  // to the multiplier
    input  logic signed [         feltgate_pkg::PRODUCT_BITS-1:0] velocity_product_i,
    output logic signed [feltgate_pkg::OBSERVER_DIFFERENCE_W-1:0] observer_difference_o,  // to the multiplier
    input  logic signed [         feltgate_pkg::PRODUCT_BITS-1:0] dob_product_i,
    output logic signed [           feltgate_pkg::VELOCITY_W-1:0] velocity_o,             // rad/s
    output logic signed [             feltgate_pkg::TORQUE_W-1:0] tau_hat_o,              // Nm
    output logic        [  feltgate_map_pkg::W_STATUS_LIMITS-1:0] limits_o,               // bit n: limit n acted
    output logic        [    feltgate_map_pkg::W_FAULTS_SEEN-1:0] trips_o                 // bit n: cause n, one clock
);
  localparam int LimitsW = feltgate_map_pkg::W_STATUS_LIMITS;
  localparam int FaultsW = feltgate_map_pkg::W_FAULTS_SEEN;

  logic velocity_saturated, velocity_jumped, tau_hat_saturated;

  generate
  if (feltgate_pkg::MT_COUNTS == 0) begin : g_n_method
    velocity_n u_velocity_n (
        .clk_i(clk_i), .rst_ni(rst_ni),
        .at_sample_i(wave_i[feltgate_map_pkg::EVENT_AT_SAMPLE]),
        .at_travel_i(wave_i[feltgate_map_pkg::EVENT_AT_TRAVEL]),
        .at_velocity_raw_i(wave_i[feltgate_map_pkg::EVENT_AT_VELOCITY_RAW]),
        .at_velocity_difference_i(wave_i[feltgate_map_pkg::EVENT_AT_VELOCITY_DIFFERENCE]),
        .at_velocity_i(wave_i[feltgate_map_pkg::EVENT_AT_VELOCITY]),
        .travel_i(travel_i), .operand_o(velocity_difference_o),
        .product_i(velocity_product_i),
        .velocity_o(velocity_o),
        .saturated_o(velocity_saturated)
    );
  end else begin : g_mt
    velocity_mt #(
        .Counts(feltgate_pkg::MT_COUNTS), .Window(feltgate_pkg::MT_WINDOW), .Doublings(feltgate_pkg::MT_DOUBLINGS)
    ) u_velocity_mt (
        .clk_i(clk_i), .rst_ni(rst_ni),
        .at_sample_i(wave_i[feltgate_map_pkg::EVENT_AT_SAMPLE]),
        .at_velocity_raw_i(wave_i[feltgate_map_pkg::EVENT_AT_VELOCITY_RAW]),
        .at_velocity_difference_i(wave_i[feltgate_map_pkg::EVENT_AT_VELOCITY_DIFFERENCE]),
        .at_velocity_i(wave_i[feltgate_map_pkg::EVENT_AT_VELOCITY]),
        .travel_i(travel_i), .operand_o(velocity_difference_o),
        .product_i(velocity_product_i),
        .velocity_o(velocity_o),
        .saturated_o(velocity_saturated)
    );
  end
  endgenerate

  velocity_jump u_velocity_jump (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .at_jump_i(wave_i[feltgate_map_pkg::EVENT_AT_JUMP]),
      .velocity_i(velocity_o),
      .trip_o(velocity_jumped)
  );

  dob u_dob (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .armed_i(armed_i),
      .at_drive_torque_i(wave_i[feltgate_map_pkg::EVENT_AT_DRIVE_TORQUE]),
      .at_observer_input_i(wave_i[feltgate_map_pkg::EVENT_AT_OBSERVER_INPUT]),
      .at_observer_difference_i(wave_i[feltgate_map_pkg::EVENT_AT_OBSERVER_DIFFERENCE]),
      .at_observer_state_i(wave_i[feltgate_map_pkg::EVENT_AT_OBSERVER_STATE]),
      .at_observed_i(wave_i[feltgate_map_pkg::EVENT_AT_OBSERVED]),
      .at_observed_rounded_i(wave_i[feltgate_map_pkg::EVENT_AT_OBSERVED_ROUNDED]),
      .at_tau_hat_i(wave_i[feltgate_map_pkg::EVENT_AT_TAU_HAT]),
      .product_i(dob_product_i),
      .operand_o(observer_difference_o),
      .tau_hat_o(tau_hat_o),
      .saturated_o(tau_hat_saturated)
  );

  assign limits_o = (LimitsW'(velocity_saturated) << feltgate_map_pkg::L_VELOCITY) |
                    (LimitsW'(tau_hat_saturated) << feltgate_map_pkg::L_TAU_HAT);
  assign trips_o  = FaultsW'(velocity_jumped) << feltgate_map_pkg::FAULT_JUMP;

  logic unused;
  assign unused = ^wave_i;  // a room takes its own clocks of the wave
endmodule

`default_nettype wire
