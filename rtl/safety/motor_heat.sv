// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cause of fault: the motor gets too hot (I2t). Once a tick
//   I = V/R - Ke/R * w, with voltage and velocity of the tick before, or a measured one;
//   sum = max(sum - Inom^2, 0) + I^2, with I = 0 while disarmed.
// It trips one tick after sum >= budget. A reset does not clear the sum: the motor stays hot.
// trip_o 7 clocks after start_i. docs/blocks/safety.md

`default_nettype none

module motor_heat (
    input  logic                                       clk_i,
    input  logic                                       rst_ni,
    input  cfg::params_t                               p,
    input  logic                                       armed_i,
    input  logic                                       start_i,     // a tick begins; the next two hold for 2 clocks
    input  logic signed [         cfg::VOLTAGE_W-1:0] voltage_i,   // V, of the tick before
    input  logic signed [        cfg::VELOCITY_W-1:0] velocity_i,  // rad/s, of the tick before
    input  logic                                       measured_i,  // the heat is of a measured current
    input  logic signed [         cfg::CURRENT_W-1:0] measured_current_i,  // A
    output logic signed [cfg::CURRENT_ESTIMATE_W-1:0] current_o,   // A, estimated; held
    output logic                                       trip_o       // one clock
);
  localparam int EstimateW = cfg::CURRENT_ESTIMATE_W;
  localparam int PartW = cfg::CURRENT_ESTIMATE_PART_W;
  localparam int PartF = cfg::CURRENT_ESTIMATE_PART_F;
  localparam int SquaredDrop = 2 * cfg::CURRENT_ESTIMATE_F - cfg::CURRENT_SQUARED_F;
  localparam int SumW = cfg::I2T_W + 1;  // a sum at the budget can still grow by I^2

  logic [6:0] at;  // clocks since start_i
  localparam int Speed = cfg::VELOCITY_W > cfg::VOLTAGE_W ? cfg::VELOCITY_W : cfg::VOLTAGE_W;
  localparam int Operand = Speed > EstimateW ? Speed : EstimateW;  // the widest
  logic signed [Operand-1:0] operand_q;
  logic signed [17:0] factor_q;
  logic signed [Operand+17:0] product_q;
  logic signed [63:0] product;
  logic signed [EstimateW-1:0] heating;
  assign heating = !measured_i ? current_o : EstimateW'(fx::scale(64'(measured_current_i), cfg::CURRENT_ESTIMATE_F - cfg::CURRENT_F));
  always_ff @(posedge clk_i) begin
    if (start_i)    {operand_q, factor_q} <= {Operand'(voltage_i), 1'b0, p.inverse_resistance};
    else if (at[0]) {operand_q, factor_q} <= {Operand'(velocity_i), 1'b0, p.emf_over_resistance};
    else            {operand_q, factor_q} <= {Operand'(heating), 18'(heating)};
    product_q <= operand_q * factor_q;
  end
  assign product = 64'(product_q);

  logic signed [PartW-1:0] resistive_q, back;
  logic [SumW-1:0] sum_q = SumW'(cfg::I2T_START);
  logic [SumW-1:0] cooled_q;
  logic [SumW:0] cooled;
  logic [cfg::CURRENT_SQUARED_W-1:0] square_q;
  logic hot_q;
  assign cooled = {1'b0, sum_q} - (SumW + 1)'(p.nominal_current_squared);
  assign back   = PartW'(fx::scale(product, PartF - cfg::VELOCITY_F - cfg::P_EMF_OVER_RESISTANCE_F));
  assign trip_o = at[6] && hot_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {at, resistive_q, current_o, hot_q} <= '0;
    end else begin
      at <= {at[5:0], start_i};
      if (at[1]) resistive_q <= PartW'(fx::scale(product, PartF - cfg::VOLTAGE_F - cfg::P_INVERSE_RESISTANCE_F));
      if (at[2]) current_o   <= EstimateW'(resistive_q) - EstimateW'(back);
      if (at[5]) hot_q       <= sum_q >= SumW'(p.i2t_budget);
    end
  end
  always_ff @(posedge clk_i) begin
    if (at[5]) begin
      cooled_q <= cooled[SumW] ? '0 : cooled[SumW-1:0];
      square_q <= armed_i && !sum_q[SumW-1] ? cfg::CURRENT_SQUARED_W'(product >>> SquaredDrop) : '0;
    end
    if (at[6]) sum_q <= cooled_q + SumW'(square_q);
  end
endmodule

`default_nettype wire
