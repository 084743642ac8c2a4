// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Disturbance observer: tau_hat = LPF(Ktn*I + g*Jn*w) - g*Jn*w, the load that opposes positive
// motor torque. Disarmed, the current counts as 0 and the filter follows its input, so that tau_hat
// is 0 and arming in motion makes no jump.
// Latency: Ktn*I in clock 0 (valid_i), g*Jn*w in 1, operand in 3, product in 7, tau_hat in 11.
// docs/blocks/dob.md

`default_nettype none

module dob (
    input  logic                                                  clk_i,
    input  logic                                                  rst_ni,
    input  logic                                                  armed_i,
    input  logic                                                  valid_i,    // product_i is Ktn*I
    input  logic signed [feltgate_pkg::PRODUCT_BITS-1:0]          product_i,
    output logic signed [feltgate_pkg::OBSERVER_DIFFERENCE_W-1:0] operand_o,
    output logic signed [feltgate_pkg::TORQUE_W-1:0]              tau_hat_o,
    output logic                                                  saturated_o
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

  logic [9:0] stage_q;  // stage_q[k]: clock k + 1
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) stage_q <= '0;
    else stage_q <= {stage_q[8:0], valid_i};
  end

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
    if (valid_i) drive_q <= armed_i ? DriveW'(product_i >>> DriveDrop) : '0;
    if (stage_q[0]) begin
      inertia_q <= inertia;
      input_q   <= W'(drive_q) + W'(inertia);
    end
    if (stage_q[7]) observed_q <= ObservedW'(state) - ObservedW'(inertia_q);
    // The bit below the last one is the carry, as far as the design rounds up.
    if (stage_q[8]) begin
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
      .valid_i(stage_q[1]),
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
    end else if (stage_q[9]) begin
      tau_hat_o   <= over ? {rounded_q[RoundedW-1], {(TorqueW - 1) {~rounded_q[RoundedW-1]}}}
                          : rounded_q[TorqueW-1:0];
      saturated_o <= over;
    end
  end
endmodule

`default_nettype wire
