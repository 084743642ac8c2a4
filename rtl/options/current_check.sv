// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Compares the measured current with the current that the applied voltage should cause. The integrator of the current
// controller holds that current, as a voltage at the winding's resistance. missing_o: a sensor is broken or a phase is
// open, 19 clocks after valid_i. A valid_i within 18 clocks of the one before is ignored.
// Formats: voltages [1,1,17] of the supply, current [1,3,17] of full scale. docs/blocks/current.md

`default_nettype none

module current_check (
    input  logic               clk_i,
    input  logic               rst_ni,
    input  logic               armed_i,       // 0: nothing is missing, and the count of results begins anew
    input  logic               valid_i,       // one clock: takes current and voltages
    input  logic signed [18:0] resistive_i,   // voltage at the resistance, by the integrator
    input  logic signed [18:0] across_i,      // that across the axis of torque, where no current is wanted; else 0
    input  logic signed [20:0] current_i,     // measured
    input  logic        [16:0] resistance_i,  // [0,4,13], supply per full scale
    input  logic        [16:0] margin_i,      // [0,0,17]: how far the voltages may be from what the current needs
    output logic               missing_o      // for 16 results farther, or a voltage at four times the margin; held while armed
);
  localparam logic [4:0] Result = 5'd18;
  localparam int Drop = 13;    // fraction bits of the product below the voltage's
  localparam int Patience = 16;  // results

  logic [4:0] step_q;
  logic       take;
  assign take = step_q == 5'd0 && valid_i && armed_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) step_q <= 5'd0;
    else if (!armed_i || step_q == Result) step_q <= 5'd0;
    else if (take || step_q != 5'd0) step_q <= step_q + 5'd1;
  end

  logic signed [18:0] resistive_q, across_q;
  logic signed [37:0] product;
  serial_multiplier #(.FactorW(21), .WordW(17)) u_serial_multiplier (
      .clk_i(clk_i), .start_i(take), .factor_i(current_i), .word_i(resistance_i), .value_i(21'd0), .hold_i(1'b0),
      .product_o(product)
  );
  always_ff @(posedge clk_i) if (take) {resistive_q, across_q} <= {resistive_i, across_i};

  logic signed [25:0] apart;  // of voltage and current
  logic signed [17:0] margin;
  logic signed [18:0] far;
  logic               astray;
  logic        [ 3:0] count_q;  // results astray before this one
  assign apart   = 26'(resistive_q) - 26'(product >>> Drop);
  assign margin  = $signed({1'b0, margin_i});
  assign far     = $signed(margin_i[16] ? 19'h3ffff : {1'b0, margin_i[15:0], 2'b00});
  assign astray  = apart > 26'(margin) || apart < -(26'(margin)) || across_q > 19'(margin) || across_q < -(19'(margin));
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      count_q   <= '0;
      missing_o <= 1'b0;
    end else if (!armed_i) begin
      count_q   <= '0;
      missing_o <= 1'b0;
    end else if (step_q == Result) begin
      count_q <= !astray ? 4'd0 : (count_q == 4'(Patience - 1)) ? count_q : count_q + 4'd1;
      if ((astray && count_q == 4'(Patience - 1)) || resistive_q > far || resistive_q < -far ||
          across_q > far || across_q < -far)
        missing_o <= 1'b1;
    end
  end
endmodule

`default_nettype wire
