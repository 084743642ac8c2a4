// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One wave of the observer against its law, for any products: the filter y += round(a1 * (x - y)) of x = drive +
// inertia, and tau_hat = y - inertia. Sums are as wide as the register: that they fit is a matter of the formats.
`default_nettype none

module torque_proof (
    input logic                                             clk_i,
    input logic                                             rst_ni,
    input logic        [                               8:0] start_i,  // where in a tick a reset ends
    input logic                                             armed_i,
    input logic signed [     feltgate_pkg::PRODUCT_BITS-1:0] product_i
);
  localparam int F = feltgate_pkg::OBSERVER_F;
  localparam int W = feltgate_pkg::OBSERVER_W;
  localparam int TorqueW = feltgate_pkg::TORQUE_W;
  localparam int Drop = F - feltgate_pkg::TORQUE_F;
  localparam int ObservedW = feltgate_pkg::OBSERVED_W;
  localparam int InertiaW = feltgate_pkg::INERTIA_TORQUE_W;
  localparam int InertiaDrop = feltgate_pkg::VELOCITY_F + feltgate_pkg::P_INERTIA_GAIN_F - F;
  localparam int DriveW = feltgate_pkg::DRIVE_TORQUE_W;
  localparam int DriveDrop = feltgate_pkg::CURRENT_F + feltgate_pkg::P_TORQUE_CONSTANT_F - F;
  localparam int ProductW = feltgate_pkg::PRODUCT_BITS;
  localparam int FilterDrop = feltgate_pkg::OBSERVER_DIFFERENCE_F + feltgate_pkg::P_OBSERVER_A1_F - F;

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
  (* hierconn *) wire signed [DriveW-1:0] \u_dut.drive_q ;

  // What this tick brought, from the drive torque on, without a reset.
  logic began_q, new_q, after_q, saturated_q;
  logic signed [TorqueW-1:0] tau_hat_q;
  logic signed [DriveW-1:0] drive_q;
  logic signed [InertiaW-1:0] inertia_q;
  logic signed [ObservedW-1:0] lag_q, observed_q, state_q;
  logic signed [ProductW-1:0] rounded;
  logic signed [W:0] difference;
  assign rounded    = (product_i >>> FilterDrop) + (product_i[FilterDrop-1] ? 1 : 0);  // half up
  assign difference = (W + 1)'(drive_q) - (W + 1)'(lag_q);
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
    if (wave[feltgate_map_pkg::EVENT_AT_DRIVE_TORQUE]) drive_q <= armed_i ? DriveW'(product_i >>> DriveDrop) : '0;
    if (wave[feltgate_map_pkg::EVENT_AT_OBSERVER_INPUT]) begin
      inertia_q <= InertiaW'(product_i >>> InertiaDrop);
      lag_q     <= state - ObservedW'(InertiaW'(product_i >>> InertiaDrop));
    end
    if (wave[feltgate_map_pkg::EVENT_AT_OBSERVER_STATE]) observed_q <= armed_i ? lag_q + ObservedW'(rounded) : '0;
    tau_hat_q   <= tau_hat;
    saturated_q <= saturated;
    state_q     <= state;
  end
  // From which clocks on the register holds the lag, the observed torque, and the state again.
  logic lags, filtered, back;
  assign lags     = began_q && phase_q > 9'(feltgate_map_pkg::EVENT_AT_OBSERVER_INPUT);
  assign filtered = began_q && phase_q > 9'(feltgate_map_pkg::EVENT_AT_OBSERVER_STATE);
  assign back     = began_q && phase_q > 9'(feltgate_map_pkg::EVENT_AT_OBSERVED_ROUNDED);

  logic due_q, state_due_q;
  always_ff @(posedge clk_i) begin
    due_q       <= wave[feltgate_map_pkg::EVENT_AT_TAU_HAT];
    state_due_q <= wave[feltgate_map_pkg::EVENT_AT_OBSERVER_INPUT] || wave[feltgate_map_pkg::EVENT_AT_OBSERVER_STATE] ||
                   wave[feltgate_map_pkg::EVENT_AT_OBSERVED_ROUNDED];
  end
  localparam logic signed [TorqueW-1:0] Most = {1'b0, {(TorqueW - 1) {1'b1}}};
  localparam int ErrorW = ObservedW + 3;
  localparam logic signed [ErrorW-1:0] Half = ErrorW'(1) <<< (Drop - 1);
  logic signed [ErrorW-1:0] error;  // of tau_hat, in the observer's bits
  assign error = (ErrorW'(tau_hat) <<< Drop) - ErrorW'(observed_q);

  always_comb begin
    if (past_ok_q && rst_ni && after_q) begin
      changes_in_its_clock: assert (due_q || (tau_hat == tau_hat_q && saturated == saturated_q));
      filter_in_its_clock: assert (state_due_q || state == state_q);
      if (new_q) begin
        error_is_half_a_bit: assert (saturated || (error <= Half && error >= -Half));
        saturates_at_its_end: assert (!saturated || (tau_hat == Most && error <= -Half) ||
                                      (tau_hat == ~Most && error > Half));
        disarmed_is_0: assert (armed_q || (tau_hat == '0 && !saturated));
        observes: cover (tau_hat < 0 && !saturated);
        saturates: cover (saturated && tau_hat > 0);
      end
      lag_is_state_less_inertia: assert (!lags || filtered || state == lag_q);
      operand_is_drive_less_lag: assert (!began_q || !wave[feltgate_map_pkg::PARAM_AT_OBSERVER_A1] ||
                                         operand == difference[W-:feltgate_pkg::OBSERVER_DIFFERENCE_W]);
      operand_in_its_clock: assert (wave[feltgate_map_pkg::PARAM_AT_OBSERVER_A1] || operand == '0);
      observed_is_filter_less_inertia: assert (!filtered || back || state == observed_q);
      state_comes_back: assert (!back || state == observed_q + ObservedW'(inertia_q));
      inside_drive: assert (!began_q || \u_dut.drive_q == drive_q);
      inside_inertia: assert (!lags || \u_dut.inertia_q == inertia_q);
    end
  end
endmodule

`default_nettype wire
