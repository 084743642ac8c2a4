// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Disturbance observer: tau_hat = LPF(Ktn*I + g*Jn*w) - g*Jn*w, the load torque; positive tau_hat
// opposes positive motor torque. Disarmed, the current counts as 0 and the filter output follows
// its input: tau_hat is 0, and arming in motion makes no jump. Wave clocks: the block latches Ktn*I
// in EVENT_AT_DRIVE_TORQUE, g*Jn*w in EVENT_AT_OBSERVER_INPUT, the filter's product in
// EVENT_AT_OBSERVER_STATE, and tau_hat_o in EVENT_AT_TAU_HAT. docs/blocks/dob.md

`default_nettype none

module dob (
    input  logic                                                  clk_i,
    input  logic                                                  rst_ni,
    input  logic                                                  armed_i,
    input  logic                                                  at_drive_torque_i,
    input  logic                                                  at_observer_input_i,
    input  logic                                                  at_observer_difference_i,
    input  logic                                                  at_observer_state_i,
    input  logic                                                  at_observed_i,
    input  logic                                                  at_observed_rounded_i,
    input  logic                                                  at_tau_hat_i,
    input  logic signed [feltgate_pkg::PRODUCT_BITS-1:0]          product_i,
    output logic signed [feltgate_pkg::OBSERVER_DIFFERENCE_W-1:0] operand_o,
    output logic signed [feltgate_pkg::TORQUE_W-1:0]              tau_hat_o,   // Nm
    output logic                                                  saturated_o  // it saturated
);
  localparam int F = feltgate_pkg::OBSERVER_F;
  localparam int W = feltgate_pkg::OBSERVER_W;
  localparam int InertiaW = feltgate_pkg::INERTIA_TORQUE_W;
  localparam int DriveW = feltgate_pkg::DRIVE_TORQUE_W;
  localparam int ObservedW = feltgate_pkg::OBSERVED_W;
  localparam int TorqueW = feltgate_pkg::TORQUE_W;
  localparam int DriveDrop = feltgate_pkg::CURRENT_F + feltgate_pkg::P_TORQUE_CONSTANT_F - F;
  localparam int InertiaDrop = feltgate_pkg::VELOCITY_F + feltgate_pkg::P_INERTIA_GAIN_F - F;
  localparam int TorqueDrop = F - feltgate_pkg::TORQUE_F;
  localparam int RoundedW = ObservedW - TorqueDrop + 1;

  logic signed [   DriveW-1:0] drive_q;
  logic signed [ InertiaW-1:0] inertia, inertia_q;
  logic signed [        W-1:0] input_q, state;
  logic signed [ObservedW-1:0] observed_q;
  logic signed [ RoundedW-1:0] rounded_q;
  logic                        beyond_half, up;
  assign inertia = InertiaW'(product_i >>> InertiaDrop);
  localparam logic [ObservedW-1:0] Below = (ObservedW'(1) << (TorqueDrop - 1)) - ObservedW'(1);
  assign beyond_half = (observed_q & Below) != '0;
  assign up = feltgate_pkg::ROUNDING == 0 ||
              (feltgate_pkg::ROUNDING == 2 && (beyond_half || observed_q[TorqueDrop]));

  always_ff @(posedge clk_i) begin
    if (at_drive_torque_i) begin
      drive_q <= armed_i ? DriveW'(product_i >>> DriveDrop) : '0;
    end
    if (at_observer_input_i) begin
      inertia_q <= inertia;
      input_q   <= W'(drive_q) + W'(inertia);
    end
    if (at_observed_i) begin
      observed_q <= ObservedW'(state) - ObservedW'(inertia_q);
    end
    // The highest dropped bit is the carry in; up masks it as the design's rounding says.
    if (at_observed_rounded_i) begin
      rounded_q <= RoundedW'(observed_q >>> TorqueDrop) +
                   RoundedW'({1'b0, observed_q[TorqueDrop-1] && up});
    end
  end

  lowpass #(
      .Width(W),
      .OperandW(feltgate_pkg::OBSERVER_DIFFERENCE_W),
      .ProductDrop(feltgate_pkg::OBSERVER_DIFFERENCE_F + feltgate_pkg::P_OBSERVER_A1_F - F),
      .ProductW(feltgate_pkg::PRODUCT_BITS)
  ) u_lowpass (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .valid_i(at_observer_difference_i),
      .update_i(at_observer_state_i),
      .follow_i(!armed_i),
      .x_i(input_q),
      .operand_o(operand_o),
      .product_i(product_i),
      .y_o(state)
  );

  logic over;
  assign over = rounded_q[RoundedW-1:TorqueW-1] !=
                {(RoundedW - TorqueW + 1) {rounded_q[RoundedW-1]}};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      tau_hat_o   <= '0;
      saturated_o <= 1'b0;
    end else if (at_tau_hat_i) begin
      tau_hat_o   <= rounded_q[TorqueW-1:0];
      saturated_o <= 1'b0;
      if (over) begin
        tau_hat_o   <= {rounded_q[RoundedW-1], {(TorqueW - 1) {~rounded_q[RoundedW-1]}}};
        saturated_o <= 1'b1;
      end
    end
  end
endmodule

`default_nettype wire
