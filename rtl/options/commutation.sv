// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Three on-times for a motor with three phases: a voltage of the amplitude along angle = gain * count + offset. In a
// sixth of a turn the outer legs differ by amplitude * cos, the leg between is amplitude * sin * sqrt(3)/2 from the middle.
// Amplitude [1,12,0], on-times [0,12,0] clocks of the PWM. valid_o 42 clocks after sample_i. docs/blocks/three_phase.md

`default_nettype none

module commutation #(
    parameter int Period = 1000  // clocks of a PWM period, even, 4 to 4094
) (
    input  logic               clk_i,
    input  logic               rst_ni,
    input  logic               sample_i,     // one clock: takes all inputs; the next one comes after valid_o
    input  logic signed [31:0] count_i,      // wraps
    input  logic        [31:0] gain_i,       // 2^-32 electrical turn per count
    input  logic        [31:0] offset_i,     // 2^-32 electrical turn
    input  logic signed [12:0] amplitude_i,  // clocks; saturates at +-Period
    input  logic               polarity_i,   // 1: legs B and C change places
    output logic        [11:0] on_a_o,       // clocks of the high switch in a period
    output logic        [11:0] on_b_o,
    output logic        [11:0] on_c_o,
    output logic               valid_o       // one clock: the on-times are new
);
  logic [31:0] angle;
  logic angle_valid, mirror_q;
  logic signed [12:0] amplitude_q;
  electrical_angle u_electrical_angle (
      .clk_i(clk_i), .rst_ni(rst_ni), .start_i(sample_i), .count_i(count_i), .gain_i(gain_i), .offset_i(offset_i),
      .angle_o(angle), .valid_o(angle_valid)
  );
  always_ff @(posedge clk_i) begin
    if (sample_i) begin
      amplitude_q <= 13'(fx::limited(64'(amplitude_i), 32'(Period)));
      mirror_q    <= polarity_i;
    end
  end

  // Third and half of it say the sixth of a turn. The angle from its middle, -30 to 30 degrees, has a sign, and as size a
  // segment of the tables and a part of it.
  logic [19:0] thrice;
  logic [1:0] third_q;
  logic half_q, below_q, falls;
  logic [3:0] segment_q;
  logic [7:0] part_q;
  assign thrice = 20'(angle[31:14]) * 20'd3;
  assign falls  = half_q != below_q;  // the leg between is below the middle
  always_ff @(posedge clk_i) begin
    if (angle_valid) begin
      {third_q, half_q} <= thrice[19:17];
      below_q           <= !thrice[16];
      segment_q         <= thrice[15:12] ^ {4{!thrice[16]}};
      part_q            <= thrice[11:4] ^ {8{!thrice[16]}};
    end
  end

  // Nodes 30/16 degrees apart, in 2^-17 of the amplitude: f(angle) * 2^17 * (1 + h^2/16) * 256/255 + 1/2, rounded, with
  // h = 30/16 degrees. The chords between them are as far above the curve as below it, and eight bits weigh 255/256.
  function automatic logic [16:0] cosine(input logic [4:0] n);  // cos/2
    case (n)
      5'd0:    cosine = 17'd65798;
      5'd1:    cosine = 17'd65763;
      5'd2:    cosine = 17'd65657;
      5'd3:    cosine = 17'd65481;
      5'd4:    cosine = 17'd65235;
      5'd5:    cosine = 17'd64919;
      5'd6:    cosine = 17'd64534;
      5'd7:    cosine = 17'd64079;
      5'd8:    cosine = 17'd63556;
      5'd9:    cosine = 17'd62965;
      5'd10:   cosine = 17'd62306;
      5'd11:   cosine = 17'd61581;
      5'd12:   cosine = 17'd60789;
      5'd13:   cosine = 17'd59933;
      5'd14:   cosine = 17'd59012;
      5'd15:   cosine = 17'd58029;
      default: cosine = 17'd56983;
    endcase
  endfunction
  function automatic logic [16:0] sine(input logic [4:0] n);  // sin * sqrt(3)/2
    case (n)
      5'd0:    sine = 17'd1;
      5'd1:    sine = 17'd3729;
      5'd2:    sine = 17'd7454;
      5'd3:    sine = 17'd11171;
      5'd4:    sine = 17'd14876;
      5'd5:    sine = 17'd18565;
      5'd6:    sine = 17'd22234;
      5'd7:    sine = 17'd25879;
      5'd8:    sine = 17'd29497;
      5'd9:    sine = 17'd33083;
      5'd10:   sine = 17'd36633;
      5'd11:   sine = 17'd40144;
      5'd12:   sine = 17'd43613;
      5'd13:   sine = 17'd47034;
      5'd14:   sine = 17'd50406;
      5'd15:   sine = 17'd53723;
      default: sine = 17'd56983;
    endcase
  endfunction
  logic [4:0] node;
  logic signed [17:0] cos_begin, cos_end, sin_begin, sin_end;
  assign node      = {1'b0, segment_q};
  assign cos_begin = {1'b0, cosine(node)};
  assign cos_end   = {1'b0, cosine(node + 5'd1)};
  assign sin_begin = {1'b0, sine(node)};
  assign sin_end   = {1'b0, sine(node + 5'd1)};

  // One line is one product, or what becomes of it.
  logic [6:0] at;  // clocks since the angle
  logic signed [17:0] operand_q, factor_q, cos_q, sin_q;
  logic signed [35:0] product_q;
  logic signed [12:0] apart_q, middle_q;  // the outer legs; of the leg between, as size
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) at <= '0;
    else         at <= {at[5:0], angle_valid};
  end
  always_ff @(posedge clk_i) begin
    if (at[0]) {operand_q, factor_q} <= {cos_end - cos_begin, 10'd0, part_q};
    if (at[1]) {operand_q, factor_q} <= {sin_end - sin_begin, 10'd0, part_q};
    if (at[2]) cos_q <= 18'((36'(cos_begin) * 36'sd255 + product_q) >>> 8);
    if (at[3]) sin_q <= 18'((36'(sin_begin) * 36'sd255 + product_q) >>> 8);
    if (at[3]) {operand_q, factor_q} <= {18'(amplitude_q), cos_q};
    if (at[4]) {operand_q, factor_q} <= {18'(amplitude_q), sin_q};
    if (at[5]) apart_q  <= 13'((product_q + 36'sd32768) >>> 16);
    if (at[6]) middle_q <= 13'((product_q + (apart_q[0] ? 36'sd0 : 36'sd65536)) >>> 17);
    product_q <= operand_q * factor_q;
  end

  // The outer legs are apart by a whole number of clocks. If it is odd, their middle is half a clock off, away from the
  // leg between, which is rounded towards it.
  logic start_q, rises;  // of the outer legs the first in the order A, B, C is the highest
  logic [1:0] between;
  logic signed [17:0] outer, middle;
  always_comb begin
    case ({third_q, half_q})
      3'b000:  {rises, between} = {1'b1, 2'd1};
      3'b001:  {rises, between} = {1'b1, 2'd0};
      3'b010:  {rises, between} = {1'b0, 2'd2};
      3'b011:  {rises, between} = {1'b0, 2'd1};
      3'b100:  {rises, between} = {1'b0, 2'd0};
      default: {rises, between} = {1'b1, 2'd2};
    endcase
  end
  assign outer  = rises ? 18'(apart_q) <<< 3 : -(18'(apart_q) <<< 3);
  assign middle = falls ? -(18'(middle_q) <<< 4) : 18'(middle_q) <<< 4;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) start_q <= 1'b0;
    else         start_q <= at[6];
  end
  space_vector #(.Period(Period)) u_space_vector (
      .clk_i(clk_i), .rst_ni(rst_ni), .enable_i(1'b1), .start_i(start_q), .between_i(between), .outer_i(outer),
      .middle_i(middle), .half_down_i(!falls), .mirror_i(mirror_q), .on_a_o(on_a_o), .on_b_o(on_b_o), .on_c_o(on_c_o),
      .valid_o(valid_o)
  );
endmodule

`default_nettype wire
