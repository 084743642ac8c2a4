// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The observed torque from its filter's state and the inertia's torque, for any products.
`default_nettype none

module torque_proof (
    input logic                                             clk_i,
    input logic                                             rst_ni,
    input logic        [                               8:0] start_i,  // where in a tick a reset ends
    input logic                                             armed_i,
    input logic signed [     feltgate_pkg::PRODUCT_BITS-1:0] product_i
);
  localparam int F = feltgate_pkg::OBSERVER_F;
  localparam int TorqueW = feltgate_pkg::TORQUE_W;
  localparam int Drop = F - feltgate_pkg::TORQUE_F;
  localparam int ObservedW = feltgate_pkg::OBSERVED_W;
  localparam int InertiaW = feltgate_pkg::INERTIA_TORQUE_W;
  localparam int InertiaDrop = feltgate_pkg::VELOCITY_F + feltgate_pkg::P_INERTIA_GAIN_F - F;

  `include "wave.svh"
  logic armed_q;
  always_ff @(posedge clk_i) armed_q <= armed_i;
  always_comb assume (tick_q || !rst_ni || armed_i == armed_q);
  // Nothing is multiplied for these clocks.
  always_comb assume (product_i == '0 || !(wave[feltgate_map_pkg::EVENT_AT_OBSERVED] || wave[feltgate_map_pkg::EVENT_AT_OBSERVED_ROUNDED]));

  logic signed [feltgate_pkg::OBSERVER_DIFFERENCE_W-1:0] operand;
  logic signed [TorqueW-1:0] tau_hat;
  logic saturated;
  dob u_dut (
      .*,
      .at_drive_torque_i(wave[feltgate_map_pkg::EVENT_AT_DRIVE_TORQUE]),
      .at_observer_input_i(wave[feltgate_map_pkg::EVENT_AT_OBSERVER_INPUT]),
      .at_observer_difference_i(wave[feltgate_map_pkg::EVENT_AT_OBSERVER_DIFFERENCE]),
      .at_observer_state_i(wave[feltgate_map_pkg::EVENT_AT_OBSERVER_STATE]),
      .at_observed_i(wave[feltgate_map_pkg::EVENT_AT_OBSERVED]),
      .at_observed_rounded_i(wave[feltgate_map_pkg::EVENT_AT_OBSERVED_ROUNDED]),
      .at_tau_hat_i(wave[feltgate_map_pkg::EVENT_AT_TAU_HAT]),
      .operand_o(operand),
      .tau_hat_o(tau_hat),
      .saturated_o(saturated)
  );
  (* hierconn *) wire signed [ObservedW-1:0] \u_dut.filter_q ;
  wire signed [ObservedW-1:0] state = \u_dut.filter_q ;
  (* hierconn *) wire signed [InertiaW-1:0] \u_dut.inertia_q ;

  // What this tick brought, from the observer's input on, without a reset.
  logic began_q, new_q, after_q, saturated_q;
  logic signed [InertiaW-1:0] inertia_q;
  logic signed [ObservedW-1:0] observed_q;
  logic signed [TorqueW-1:0] tau_hat_q;
  logic signed [ObservedW-1:0] state_q, begin_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      began_q <= 1'b0;
      new_q   <= 1'b0;
      after_q <= 1'b0;
    end else begin
      after_q <= 1'b1;
      if (wave[feltgate_map_pkg::EVENT_AT_DRIVE_TORQUE]) began_q <= 1'b1;
      else if (tick) began_q <= 1'b0;
      new_q <= began_q && wave[feltgate_map_pkg::EVENT_AT_TAU_HAT];
    end
  end
  always_ff @(posedge clk_i) begin
    if (wave[feltgate_map_pkg::EVENT_AT_OBSERVER_INPUT]) inertia_q <= InertiaW'(product_i >>> InertiaDrop);
    if (wave[feltgate_map_pkg::EVENT_AT_OBSERVER_INPUT]) begin_q <= state;
    if (wave[feltgate_map_pkg::EVENT_AT_OBSERVED]) observed_q <= state;
    tau_hat_q   <= tau_hat;
    saturated_q <= saturated;
    state_q     <= state;
  end
  logic due_q, state_due_q;
  always_ff @(posedge clk_i) begin
    due_q       <= wave[feltgate_map_pkg::EVENT_AT_TAU_HAT];
    state_due_q <= wave[feltgate_map_pkg::EVENT_AT_OBSERVER_INPUT] || wave[feltgate_map_pkg::EVENT_AT_OBSERVER_STATE] ||
                   wave[feltgate_map_pkg::EVENT_AT_OBSERVED_ROUNDED];
  end
  localparam logic signed [TorqueW-1:0] Most = {1'b0, {(TorqueW - 1) {1'b1}}};
  localparam int ErrorW = ObservedW + 3;
  logic signed [ErrorW-1:0] error;  // of tau_hat, in the observer's bits
  assign error = (ErrorW'(tau_hat) <<< Drop) - ErrorW'(observed_q);

  always_comb begin
    if (past_ok_q && rst_ni && after_q) begin
      changes_in_its_clock: assert (due_q || (tau_hat == tau_hat_q && saturated == saturated_q));
      filter_in_its_clock: assert (state_due_q || state == state_q);
      if (new_q) begin
        error_is_half_a_bit: assert (saturated || (error <= (ErrorW'(1) << (Drop - 1)) &&
            error >= -(ErrorW'(1) << (Drop - 1))));
        saturates_at_its_end: assert (!saturated || (tau_hat == Most && error < -(ErrorW'(1) << (Drop - 1)) + 1) ||
                                      (tau_hat == ~Most && error > (ErrorW'(1) << (Drop - 1))));
        disarmed_is_0: assert (armed_q || (tau_hat == '0 && !saturated));
        observes: cover (tau_hat < 0 && !saturated);
        saturates: cover (saturated && tau_hat > 0);
      end
      if (wave[feltgate_map_pkg::EVENT_AT_OBSERVER_DIFFERENCE] && began_q) begin
        input_is_the_sum: assert (state == ObservedW'(begin_q) - ObservedW'(inertia_q));
      end
      operand_in_its_clock: assert (wave[feltgate_map_pkg::PARAM_AT_OBSERVER_A1] || operand == '0);
      inside_inertia: assert (!began_q || phase_q <= 9'(feltgate_map_pkg::EVENT_AT_OBSERVER_INPUT) ||
          \u_dut.inertia_q == inertia_q);
    end
  end
endmodule

`default_nettype wire
