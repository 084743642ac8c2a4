// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Disturbance observer: x = Ktn * I + g Jn * w;  y += a1 * (x - y);  tau_hat = y - g Jn * w, the
// load torque; positive tau_hat opposes positive motor torque. Disarmed, the current counts as 0 and
// y follows x: tau_hat is 0, and arming in motion makes no jump. valid_o 8 clocks after start_i.
// docs/blocks/observer.md

`default_nettype none

module observer (
    input  logic                              clk_i,
    input  logic                              rst_ni,
    input  cfg::params_t                      p,
    input  logic                              armed_i,
    input  logic                              start_i,     // one clock a tick; the next two hold until valid_o
    input  logic signed [ cfg::CURRENT_W-1:0] current_i,   // A, of the tick before
    input  logic signed [cfg::VELOCITY_W-1:0] velocity_i,  // rad/s
    output logic signed [  cfg::TORQUE_W-1:0] tau_hat_o,   // Nm, held
    output logic                              saturated_o,
    output logic                              valid_o      // one clock: tau_hat_o is new
);
  localparam int F = cfg::OBSERVER_F;  // fraction bits of the torques inside
  localparam int W = cfg::OBSERVED_W;
  localparam int OffW = cfg::OBSERVER_DIFFERENCE_W;

  logic [6:0] at;  // clocks since start_i
  logic signed [W-1:0] x_q, y_q, inertia_q, off;
  assign off = x_q - y_q;

  logic signed [OffW-1:0] operand_q;
  logic        [16:0] factor_q;
  logic signed [OffW+16:0] product_q;
  always_ff @(posedge clk_i) begin
    if (start_i)    {operand_q, factor_q} <= {OffW'(current_i), p.torque_constant};
    else if (at[0]) {operand_q, factor_q} <= {OffW'(velocity_i), p.inertia_gain};
    else            {operand_q, factor_q} <= {off[W-1-:OffW], p.observer_a1};
    product_q <= operand_q * $signed({1'b0, factor_q});
  end

  logic signed [63:0] product, tau_hat;
  logic signed [W-1:0] drive, inertia;
  assign product = 64'(product_q);
  assign drive   = W'(fx::scale(product, F - cfg::CURRENT_F - cfg::P_TORQUE_CONSTANT_F));
  assign inertia = W'(fx::scale(product, F - cfg::VELOCITY_F - cfg::P_INERTIA_GAIN_F));
  assign tau_hat = fx::add_rounded('0, 64'(y_q) - 64'(inertia_q), F - cfg::TORQUE_F);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {at, valid_o, x_q, y_q, inertia_q, tau_hat_o, saturated_o} <= '0;
    end else begin
      {valid_o, at} <= {at, start_i};
      if (at[1]) x_q         <= armed_i ? drive : '0;
      if (at[2]) x_q         <= x_q + inertia;
      if (at[2]) inertia_q   <= inertia;
      if (at[5]) y_q         <= armed_i ? W'(fx::add_rounded(64'(y_q), product, cfg::OBSERVER_DIFFERENCE_F + cfg::P_OBSERVER_A1_F - F)) : x_q;
      if (at[6]) tau_hat_o   <= cfg::TORQUE_W'(fx::saturate(tau_hat, cfg::TORQUE_W));
      if (at[6]) saturated_o <= fx::overflows(tau_hat, cfg::TORQUE_W);
    end
  end
endmodule

`default_nettype wire
