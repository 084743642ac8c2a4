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
  localparam int SumW = ObservedW + 1;  // rounding up may need one more bit
  localparam int TorqueW = feltgate_pkg::TORQUE_W;
  localparam int DriveDrop = feltgate_pkg::CURRENT_F + feltgate_pkg::P_TORQUE_CONSTANT_F - F;
  localparam int InertiaDrop = feltgate_pkg::VELOCITY_F + feltgate_pkg::P_INERTIA_GAIN_F - F;
  localparam int TorqueDrop = F - feltgate_pkg::TORQUE_F;
  localparam int RoundedW = SumW - TorqueDrop;

  localparam int FilterDrop = feltgate_pkg::OBSERVER_DIFFERENCE_F + feltgate_pkg::P_OBSERVER_A1_F - F;
  localparam logic [feltgate_pkg::PRODUCT_BITS-1:0] BelowFilterHalf =
      (feltgate_pkg::PRODUCT_BITS'(1) << (FilterDrop - 1)) - feltgate_pkg::PRODUCT_BITS'(1);
  localparam logic [SumW-1:0] Half = SumW'(1) << (TorqueDrop - 1);
  localparam logic [ObservedW-1:0] BelowHalf = ObservedW'(Half) - ObservedW'(1);

  generate
  if (!(feltgate_pkg::OBSERVER_DIFFERENCE_W <= W + 1 && FilterDrop >= 1 && feltgate_pkg::PRODUCT_BITS > FilterDrop))
  begin : g_check_widths
    the_widths_of_a_lowpass_must_nest missing ();
  end
  endgenerate

  // The filter y += round(a1 * (x - y)) of x = drive + inertia. One register and one adder go round:
  //   EVENT_AT_OBSERVER_INPUT    lag = y - inertia; then x - y is drive - lag
  //   EVENT_AT_OBSERVER_STATE    observed = lag + round(a1 * (drive - lag)), which is the new y less inertia
  //   EVENT_AT_OBSERVED          observed rounded to a torque; the register stays
  //   EVENT_AT_OBSERVED_ROUNDED  y = observed + inertia
  // Disarmed, y := x: observed is 0.
  logic signed [ RoundedW-1:0] rounded_q;
  logic signed [   DriveW-1:0] drive_q;
  logic signed [ InertiaW-1:0] inertia, inertia_q, return_q;
  logic signed [ObservedW-1:0] filter_q;
  logic signed [     SumW-1:0] term, sum;
  logic signed [          W:0] difference_q;
  logic                        state_odd_q, carry_in, carried, filter_up, up, unused_low;
  assign inertia   = InertiaW'(product_i >>> InertiaDrop);
  // The product is 0 in the two last of these clocks, return_q in all but the last. The bit below the operands
  // carries in: the complement's 1, or the rounding.
  assign filter_up = feltgate_pkg::ROUNDING == 0 ||
                     (feltgate_pkg::ROUNDING == 2 && ((product_i & BelowFilterHalf) != '0 ||
                                                      (state_odd_q ^ product_i[FilterDrop])));
  assign up        = feltgate_pkg::ROUNDING == 0 ||
                     (feltgate_pkg::ROUNDING == 2 && ((filter_q & BelowHalf) != '0 || filter_q[TorqueDrop]));
  assign term      = at_observer_input_i ? ~(SumW'(inertia))
                                         : SumW'(product_i >>> FilterDrop) | SumW'(return_q) |
                                           (at_observed_i && up ? Half : '0);
  assign carry_in  = at_observer_input_i || filter_up;
  assign carried   = at_observer_input_i || product_i[FilterDrop-1];
  assign {sum, unused_low} = {filter_q[ObservedW-1], filter_q, carry_in} + {term, carried};

  always_ff @(posedge clk_i) begin
    if (at_drive_torque_i) drive_q <= armed_i ? DriveW'(product_i >>> DriveDrop) : '0;
    if (at_observer_input_i) begin
      inertia_q   <= inertia;
      state_odd_q <= filter_q[0];
    end
    if (!at_observed_i) return_q <= '0;
    else return_q <= inertia_q;
    if (!at_observer_difference_i) difference_q <= '0;
    else difference_q <= (W + 1)'(drive_q) - (W + 1)'(filter_q);
    if (at_observed_i) rounded_q <= sum[SumW-1:TorqueDrop];
  end
  // No reset of the filter: until the first wave begins it is held at 0.
  logic begun_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begun_q <= 1'b0;
    else if (at_drive_torque_i) begun_q <= 1'b1;
  end
  always_ff @(posedge clk_i) begin
    if (!begun_q || (at_observer_state_i && !armed_i)) filter_q <= '0;
    else if (at_observer_input_i || at_observer_state_i || at_observed_rounded_i) filter_q <= sum[ObservedW-1:0];
  end
  assign operand_o = difference_q[W-:feltgate_pkg::OBSERVER_DIFFERENCE_W];
  logic unused;
  assign unused = ^{difference_q, unused_low};  // the difference loses its lowest bits

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
