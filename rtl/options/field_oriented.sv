// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Current control of a motor with three phases: two measured currents into the rotor's frame, a PI law along and one
// across the axis of torque, their voltage limited as a vector, and the on-times of three legs by space vectors. One
// CORDIC. Latency: valid_i to valid_o 261 clocks; a valid_i within 348 of a taken one is ignored.
// Formats: current [1,1,17] of full scale, voltage [1,0,17] of the supply over root 3, gains [0,4,13] and [0,0,17],
// angle 2^-32 electrical turn, on-times [0,12,0] clocks of the PWM. docs/blocks/three_phase.md

`default_nettype none

module field_oriented #(
    parameter int Period = 1000  // clocks of a PWM period, even, 4 to 4094
) (
    input  logic               clk_i,
    input  logic               rst_ni,
    input  logic               armed_i,         // 0: voltage and integrators are 0
    input  logic               valid_i,         // one clock: takes all inputs but gains and limit
    input  logic               direct_i,        // 1: emf_i alone is the voltage, the integrators are 0
    input  logic signed [18:0] reference_i,     // peak of a phase's current
    input  logic signed [18:0] current_a_i,
    input  logic signed [18:0] current_b_i,
    input  logic signed [17:0] emf_i,           // peak of a phase's back-EMF
    input  logic signed [31:0] count_i,         // wraps
    input  logic        [31:0] gain_i,          // 2^-32 electrical turn per count
    input  logic        [31:0] offset_i,        // 2^-32 electrical turn; the low 12 bits do not count
    input  logic               polarity_i,      // 1: the motor's phases B and C change places
    input  logic        [16:0] proportional_i,
    input  logic        [16:0] integral_i,      // part of its way that an integrator goes
    input  logic        [16:0] limit_i,         // greatest length of the voltage
    output logic signed [20:0] current_q_o,     // measured, along the axis of torque; [1,3,17]
    output logic signed [18:0] resistive_o,     // [1,1,17]: whole part of the integrator along that axis
    output logic signed [18:0] across_o,        // that across it
    output logic               open_o,          // a phase has no current; held while armed
    output logic        [11:0] on_a_o,          // clocks of the high switch in a period
    output logic        [11:0] on_b_o,
    output logic        [11:0] on_c_o,
    output logic               valid_o          // one clock: the on-times are new
);
  // Constants of the multiplier, in 2^-17: 1/K, 1/(K sqrt 3), K = 1.64676 the growth of a turn of the CORDIC; of the
  // legs in 2^-6: Period sqrt(3)/4 and Period/4.
  localparam logic [16:0] Shrink = 17'd79594;
  localparam logic [16:0] ShrinkBeta = 17'd45954;
  localparam logic [16:0] LegAlpha = 17'((Period * 454047 + 8192) / 16384);
  localparam logic [16:0] LegBeta = 17'(Period * 16);
  localparam int W = 24;       // of CORDIC and multiplier
  localparam int Guard = 3;    // of the CORDIC's fraction below that of current and voltage, where it turns
  localparam int F = 17;       // fraction bits of current and voltage; of a factor
  localparam int PF = 13;      // of the proportional gain
  localparam int LegF = 4;     // of the legs

  // Operations: Load takes the operands, Store the result. A product takes 18 clocks, the
  // CORDIC 34. Again: the limited voltage once more, in the rotor's frame.
  localparam logic [3:0] Alpha = 4'd0, Beta = 4'd1, Park = 4'd2, AcrossP = 4'd3, AlongP = 4'd4,
                         Polar = 4'd5, Length = 4'd6, Radius = 4'd7, Turned = 4'd8, LegsX = 4'd9,
                         LegsY = 4'd10, Again = 4'd11, Applied = 4'd12, AcrossI = 4'd13, AlongI = 4'd14;
  localparam logic [5:0] Load = 6'd0, Store = 6'd18, CordicStore = 6'd34;
  logic [3:0] op_q;
  logic [5:0] step_q;
  logic       take, loads, stores, turns, along, integrates;
  assign take       = op_q == Alpha && step_q == Load && valid_i && armed_i;
  assign loads      = step_q == Load;
  assign stores     = step_q == (turns ? CordicStore : Store);
  assign turns      = op_q == Park || op_q == Polar || op_q == Turned || op_q == Applied;
  assign integrates = op_q == AcrossI || op_q == AlongI;
  assign along      = op_q == AlongP || op_q == AlongI;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {op_q, step_q} <= '0;
    end else if (!armed_i) begin
      {op_q, step_q} <= '0;
    end else if (stores) begin
      op_q   <= op_q == AlongI ? Alpha : op_q + 4'd1;
      step_q <= Load;
    end else if (take || op_q != Alpha || step_q != Load) begin
      step_q <= step_q + 6'd1;
    end
  end

  // What is taken with the currents.
  logic               direct_q, mirror_q;
  logic signed [18:0] reference_q;
  logic signed [17:0] emf_q;
  logic signed [20:0] beta_q;  // sqrt(3) of it
  logic signed [19:0] both;
  assign both = 20'(current_a_i) + 20'(current_b_i);  // -C
  always_ff @(posedge clk_i) begin
    if (take) begin
      direct_q    <= direct_i;
      mirror_q    <= polarity_i;
      reference_q <= reference_i;
      emf_q       <= emf_i;
      beta_q      <= 21'(both) + 21'(current_b_i);
    end
  end

  // The rotor's angle is there when beta is.
  logic [31:0] angle;
  logic [19:0] theta_q;
  logic unused_valid;
  electrical_angle u_electrical_angle (
      .clk_i(clk_i), .rst_ni(rst_ni), .start_i(take), .count_i(count_i), .gain_i(gain_i),
      .offset_i({offset_i[31:12], 12'd0}), .angle_o(angle), .valid_o(unused_valid)
  );
  always_ff @(posedge clk_i) if (op_q == Beta && stores) theta_q <= angle[31:12];

  open_phase u_open_phase (
      .clk_i(clk_i), .rst_ni(rst_ni), .armed_i(armed_i), .valid_i(take), .current_a_i(current_a_i),
      .current_b_i(current_b_i), .judge_i(op_q == Park && loads), .angle_i(theta_q[19:12]), .open_o(open_o)
  );

  // Operands of the products. A proportional part begins with half of its last bit, so it is rounded to the nearest.
  logic signed [ W-1:0] minuend, subtrahend;
  logic        [  16:0] word;
  logic signed [W+16:0] product;
  logic                 saturated_q;
  logic        [  16:0] length_q;
  logic signed [ W-1:0] x_q, y_q;
  logic signed [  21:0] wanted_q, wanted_q2, applied;
  logic signed [  35:0] own_q, other_q;  // integrators: of the law that is next, and the other
  logic signed [  19:0] base;
  assign base    = 20'(own_q >>> F) + (along ? 20'(emf_q) : '0);
  assign applied = !saturated_q ? wanted_q2 : 22'((along ? x_q : y_q) >>> Guard);
  assign resistive_o = 19'((along ? own_q : other_q) >>> F);
  assign across_o    = 19'((along ? other_q : own_q) >>> F);
  always_comb begin
    case (op_q)
      Alpha:            minuend = W'(current_a_i);
      Beta:             minuend = mirror_q ? '0 : W'(beta_q);
      AcrossP:          minuend = '0;
      AlongP:           minuend = W'(reference_q);
      LegsY:            minuend = y_q;
      Radius, Again:    minuend = $signed({7'd0, length_q});
      AcrossI, AlongI:  minuend = W'(applied);
      default:          minuend = x_q;
    endcase
    case (op_q)
      Beta:             subtrahend = mirror_q ? W'(beta_q) : '0;
      AcrossP:          subtrahend = y_q >>> Guard;
      AlongP:           subtrahend = x_q >>> Guard;
      AcrossI, AlongI:  subtrahend = W'(base);
      default:          subtrahend = '0;
    endcase
    case (op_q)
      Beta:             word = ShrinkBeta;
      AcrossP, AlongP:  word = direct_q ? '0 : proportional_i;
      LegsX:            word = LegAlpha;
      LegsY:            word = LegBeta;
      AcrossI, AlongI:  word = direct_q ? '0 : integral_i;
      default:          word = Shrink;
    endcase
  end
  serial_multiplier #(.FactorW(W), .WordW(17)) u_serial_multiplier (
      .clk_i(clk_i), .start_i(loads), .factor_i(minuend - subtrahend), .word_i(word),
      .value_i(op_q == AcrossP || op_q == AlongP ? W'(1 << (PF - 1)) : '0), .hold_i(stores), .product_o(product)
  );

  // The two laws take turns with one adder for what is wanted and one for the integrators.
  logic signed [28:0] sought;
  logic               above;
  logic        [16:0] length;
  assign sought = 29'(product >>> PF) + 29'(base);
  assign above  = product[W+16:F] > W'(limit_i);
  assign length = above ? limit_i : product[33:F];
  always_ff @(posedge clk_i) begin
    if (stores && (op_q == AcrossP || op_q == AlongP || op_q == AcrossI)) begin
      wanted_q  <= sought[28:21] == {8{sought[28]}} ? 22'(sought) : {sought[28], {21{!sought[28]}}};
      wanted_q2 <= wanted_q;
    end
    if (stores && op_q == Length) length_q <= length;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {own_q, other_q, saturated_q, current_q_o} <= '0;
    end else if (!armed_i) begin
      {own_q, other_q, saturated_q, current_q_o} <= '0;
    end else begin
      if (take && direct_i) begin
        own_q   <= '0;
        other_q <= '0;
      end else if (stores && (op_q == AcrossP || op_q == AlongP || integrates)) begin
        own_q   <= other_q;
        other_q <= own_q + (integrates ? 36'(product) : '0);
      end
      if (stores && op_q == Length) saturated_q <= above;
      if (stores && op_q == Park) current_q_o <= 21'(x_q >>> Guard);
    end
  end

  // A vector and its angle. Products give alpha, beta and the limited length.
  logic signed [W-1:0] scaled_q, beta_scaled_q, start_x, start_y;
  logic [19:0] z, start_z, angle_of_q;
  always_comb begin
    case (op_q)
      Park:    {start_x, start_y, start_z} = {scaled_q, beta_scaled_q, theta_q};
      Polar:   {start_x, start_y, start_z} = {W'(wanted_q), W'(wanted_q2), 20'd0};
      Turned:  {start_x, start_y, start_z} = {scaled_q, {W{1'b0}}, z + theta_q};
      default: {start_x, start_y, start_z} = {scaled_q, {W{1'b0}}, angle_of_q};
    endcase
  end
  always_ff @(posedge clk_i) begin
    if (stores && (op_q == Alpha || op_q == Radius || op_q == Again)) scaled_q <= product[37:14];
    if (stores && op_q == Beta) beta_scaled_q <= product[37:14];
    if (loads && op_q == Turned) angle_of_q <= z;
  end
  cordic #(.W(W)) u_cordic (
      .clk_i(clk_i), .rst_ni(rst_ni), .start_i(turns && loads), .back_i(op_q == Park), .measure_i(op_q == Polar),
      .x_i(start_x), .y_i(start_y), .z_i(start_z), .x_o(x_q), .y_o(y_q), .z_o(z)
  );

  // The legs. With u = Period sqrt(3)/4 and v = Period/4 of the voltage's two parts, the outer legs are 2 v from the middle
  // of the period where |v| > |u| (A lies between), else |u| + |v|. The leg between is 2 u from it, or 4 |v| from an
  // outer one.
  localparam int LW = 18;
  logic signed [LW-1:0] u_q, v_q, u_and_v, u_less_v, outer, middle;
  logic [1:0] between;
  assign u_and_v  = u_q + v_q;
  assign u_less_v = u_q - v_q;
  always_comb begin
    if (u_and_v[LW-1] != u_less_v[LW-1]) begin
      between = 2'd0;
      outer   = v_q <<< 1;
      middle  = u_q <<< 1;
    end else if (u_q[LW-1] == v_q[LW-1]) begin
      between = 2'd1;
      outer   = u_and_v;
      middle  = (v_q <<< 2) - u_and_v;
    end else begin
      between = 2'd2;
      outer   = u_less_v;
      middle  = -(v_q <<< 2) - u_less_v;
    end
  end
  always_ff @(posedge clk_i) begin
    if (op_q == LegsX && stores) u_q <= LW'(product >>> (F + Guard + 6 - LegF));
    if (op_q == LegsY && stores) v_q <= LW'(product >>> (F + Guard + 6 - LegF));
  end
  space_vector #(.Period(Period)) u_space_vector (
      .clk_i(clk_i), .rst_ni(rst_ni), .enable_i(armed_i), .start_i(op_q == Again && step_q == 6'd3),
      .between_i(between), .outer_i(outer), .middle_i(middle), .half_down_i(1'b0), .mirror_i(mirror_q),
      .on_a_o(on_a_o), .on_b_o(on_b_o), .on_c_o(on_c_o), .valid_o(valid_o)
  );
endmodule

`default_nettype wire
