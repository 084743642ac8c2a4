// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// PI control of a motor current, a voltage for each result of current_sense. The integrator follows the applied
// voltage less the back-EMF, as the voltage at the winding's resistance does: limited, it does not wind up. Latency:
// valid_i to voltage_o 20 clocks; a valid_i within 38 clocks of a taken one is ignored.
// Formats: current [1,1,17] of full scale, voltage [1,0,17] of the supply, gains [0,4,13] and [0,0,17].
// docs/blocks/current.md

`default_nettype none

module current_control (
    input  logic               clk_i,
    input  logic               rst_ni,
    input  logic               armed_i,         // 0: voltage and integrator are 0
    input  logic               valid_i,         // one clock: current_i is new
    input  logic signed [18:0] reference_i,
    input  logic signed [18:0] current_i,
    input  logic signed [17:0] emf_i,           // voltage of the back-EMF
    input  logic        [16:0] proportional_i,
    input  logic        [16:0] integral_i,      // part of its way that the integrator goes
    input  logic        [16:0] limit_i,         // greatest |voltage|
    output logic signed [17:0] voltage_o,
    output logic signed [18:0] resistive_o      // [1,1,17]: whole part of the integrator
);
  // A current is taken in clock 0. Both multiplications are 17 clocks, one bit of the gain in each.
  localparam logic [5:0] Sum = 6'd18;    // the first is there
  localparam logic [5:0] Limit = 6'd19;
  localparam logic [5:0] Reload = 6'd20;
  localparam logic [5:0] Add = 6'd38;    // the second is there
  localparam int GainDrop = 13;          // fraction bits of the first product below the voltage's
  localparam int IntegratorF = 17;       // fraction bits of the integrator below the voltage's

  logic [5:0] step_q;
  logic       take;
  assign take = step_q == 6'd0 && valid_i && armed_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) step_q <= 6'd0;
    else if (!armed_i || step_q == Add) step_q <= 6'd0;
    else if (take || step_q != 6'd0) step_q <= step_q + 6'd1;
  end

  // A proportional part begins with half of its last bit that is kept, so it is rounded to the nearest.
  localparam logic signed [19:0] HalfBit = 20'sd1 <<< (GainDrop - 1);
  logic signed [19:0] error, rest;
  logic signed [36:0] product;
  serial_multiplier #(.FactorW(20), .WordW(17)) u_serial_multiplier (
      .clk_i(clk_i), .start_i(take || step_q == Reload), .factor_i(take ? error : rest),
      .word_i(take ? proportional_i : integral_i), .value_i(take ? HalfBit : '0), .hold_i(1'b0), .product_o(product)
  );

  // base: the voltage without the proportional part. rest: the applied voltage, after its limit, minus base; without a
  // limit this is the proportional part.
  logic signed [35:0] integrator_q;
  logic signed [19:0] base_q;
  logic signed [24:0] wanted_q;
  logic signed [17:0] most;
  logic               above, below;
  assign error = 20'(reference_i) - 20'(current_i);
  assign rest  = 20'(voltage_o) - base_q;
  assign most  = $signed({1'b0, limit_i});
  assign above = wanted_q > 25'(most);
  assign below = wanted_q < -(25'(most));
  assign resistive_o = 19'(integrator_q >>> IntegratorF);
  always_ff @(posedge clk_i) begin
    if (take) base_q <= 20'(resistive_o) + 20'(emf_i);
    if (step_q == Sum) wanted_q <= 25'(product >>> GainDrop) + 25'(base_q);
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      integrator_q <= '0;
      voltage_o    <= '0;
    end else if (!armed_i) begin
      integrator_q <= '0;
      voltage_o    <= '0;
    end else begin
      if (step_q == Limit) voltage_o <= above ? most : below ? -most : 18'(wanted_q);
      if (step_q == Add) integrator_q <= integrator_q + 36'(product);
    end
  end
endmodule

`default_nettype wire
