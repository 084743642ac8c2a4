// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The four turns of a result as one small rotation after another, and the limit of the voltage's length between two of
// them. That the rotations together are a turn is what the test compares with a law in double.
`default_nettype none

module turns_proof (
    input logic               clk_i,
    input logic               rst_ni,
    input logic               armed_i,
    input logic               valid_i,
    input logic               direct_i,
    input logic signed [18:0] reference_i,
    input logic signed [18:0] current_a_i,
    input logic signed [18:0] current_b_i,
    input logic signed [17:0] emf_i,
    input logic signed [31:0] position_i,
    input logic        [31:0] gain_i,
    input logic        [31:0] offset_i,
    input logic               polarity_i,
    input logic        [16:0] proportional_i,
    input logic        [16:0] integral_i,
    input logic        [16:0] limit_i
);

  `include "reset.svh"

  logic valid, saturated;
  field_oriented u_dut (
      .*,
      .current_q_o(), .resistive_o(), .across_o(), .open_o(), .on_a_o(), .on_b_o(), .on_c_o(),
      .saturated_o(saturated), .valid_o(valid)
  );
  (* hierconn *) wire [3:0] \u_dut.op_q ;
  (* hierconn *) wire [5:0] \u_dut.step_q ;
  (* hierconn *) wire \u_dut.saturated_q ;
  (* hierconn *) wire [20:0] \u_dut.beta_q ;
  (* hierconn *) wire [19:0] \u_dut.theta_q , \u_dut.z_q , \u_dut.angle_of_q ;
  (* hierconn *) wire [23:0] \u_dut.factor_q , \u_dut.upper_q , \u_dut.x_q , \u_dut.y_q , \u_dut.x_old_q ;
  (* hierconn *) wire [16:0] \u_dut.word_q , \u_dut.length_q ;
  (* hierconn *) wire [21:0] \u_dut.wanted_q , \u_dut.wanted_q2 ;
  wire signed [31:0] x = 32'($signed(\u_dut.x_q ));
  wire signed [31:0] y = 32'($signed(\u_dut.y_q ));
  wire [19:0] z = \u_dut.z_q ;
  wire signed [31:0] x_old = 32'($signed(\u_dut.x_old_q ));
  wire signed [31:0] factor = 32'($signed(\u_dut.factor_q ));
  wire signed [31:0] upper = 32'($signed(\u_dut.upper_q ));
  wire signed [40:0] product = $signed({\u_dut.upper_q , \u_dut.word_q });
  wire signed [31:0] along_wanted = 32'($signed(\u_dut.wanted_q ));
  wire signed [31:0] across_wanted = 32'($signed(\u_dut.wanted_q2 ));
  wire [19:0] theta = \u_dut.theta_q ;

  localparam logic [3:0] Alpha = 4'd0, Beta = 4'd1, Park = 4'd2, AcrossP = 4'd3, AlongP = 4'd4, Polar = 4'd5, Length = 4'd6,
                         Radius = 4'd7, Turned = 4'd8, LegsX = 4'd9, LegsY = 4'd10, Again = 4'd11, Applied = 4'd12,
                         AcrossI = 4'd13, AlongI = 4'd14;
  wire [3:0] op = \u_dut.op_q ;
  wire [5:0] step = \u_dut.step_q ;
  logic turns, first, last, feeds;
  assign turns = op == Park || op == Polar || op == Turned || op == Applied;
  assign feeds = op == Alpha || op == Beta || op == Length || op == Radius || op == Again;  // products of the turns
  assign first = step == 6'd0;
  assign last  = step == (turns ? 6'd34 : 6'd18);

  // Where a turn begins, by the products before it; the length of the voltage, and its limit.
  logic signed [31:0] start_x_q, start_y_q, length_q, most_q;
  logic limited_q;
  always_ff @(posedge clk_i) begin
    if (last) begin
      if (op == Alpha || op == Radius || op == Again) start_x_q <= 32'(product >>> 14);
      if (op == Beta) start_y_q <= 32'(product >>> 14);
      if (op == Length) begin
        most_q   <= $signed({15'd0, limit_i});
        length_q <= (product >>> 17) > $signed({24'd0, limit_i}) ? $signed({15'd0, limit_i}) : 32'(product >>> 17);
      end
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) limited_q <= 1'b0;
    else if (!armed_i) limited_q <= 1'b0;
    else if (last && op == Length) limited_q <= (product >>> 17) > $signed({24'd0, limit_i});
  end

  // A turn: half of one, or none, then sixteen small ones; that of the voltage to its axis gives its angle.
  logic signed [31:0] x_q, y_q, part_x, part_y, wide_x, wide_y;
  logic [19:0] z_q, angle_q, arc;
  logic [3:0] small;
  logic flips, falls, clockwise, even, second;
  assign second = step[0] && step >= 6'd3;
  assign even   = !step[0] && step >= 6'd4;
  assign small  = 4'((step - (second ? 6'd3 : 6'd4)) >> 1);
  always_comb begin
    case (small)  // 2^20 atan(2^-small) / (2 pi)
      4'd0:    arc = 20'd131072;
      4'd1:    arc = 20'd77376;
      4'd2:    arc = 20'd40884;
      4'd3:    arc = 20'd20753;
      4'd4:    arc = 20'd10417;
      4'd5:    arc = 20'd5213;
      4'd6:    arc = 20'd2607;
      4'd7:    arc = 20'd1304;
      default: arc = (20'd166886 + (20'd1 << (small - 4'd1))) >> small;  // 2^20 / (2 pi)
    endcase
  end
  assign flips     = op == Polar ? x_q < 0 : z_q[19] != z_q[18];
  assign falls     = op == Polar ? y_q < 0 : !z_q[19];
  assign clockwise = op == Park ? falls : !falls;
  assign part_x    = x_q >>> small;
  assign part_y    = y_q >>> small;
  assign wide_x    = clockwise ? x_q + part_y : x_q - part_y;
  assign wide_y    = clockwise ? y_q - part_x : y_q + part_x;
  always_ff @(posedge clk_i) begin
    if (!step[0] || step == 6'd1) begin
      x_q <= x;
      y_q <= y;
      z_q <= z;
    end
    if (last && op == Polar) angle_q <= z;
  end

  // Bounds of x and y before each small turn of the voltage that is not one to its axis.
  function automatic logic [17*24-1:0] reaches();
    logic [23:0] most;
    most = 24'd1048576;
    for (int k = 0; k <= 16; k++) begin
      reaches[24*k+:24] = most;
      most = most + (most >> k) + 24'd1;
    end
  endfunction
  localparam logic [17*24-1:0] Reaches = reaches();
  logic signed [31:0] reach, from_x, from_y;
  logic [4:0] turn;  // small turns that are done
  logic in_turn, forward;
  assign turn    = 5'((step - 6'd2) >> 1);
  assign in_turn = turns && step >= 6'd2;
  assign forward = op == Turned || op == Applied;
  assign reach   = $signed({8'd0, Reaches[24*turn+:24]});
  assign from_x  = second ? x_q : x;  // before the small turn
  assign from_y  = second ? y_q : y;
  always_comb begin
    if (past_ok_q && rst_ni) begin
      turns_begin: assert (!(turns && step == 6'd1) || (
          op == Park ? x == start_x_q && y == start_y_q && z == theta :
          op == Polar ? x == along_wanted && y == across_wanted && z == '0 :
          x == start_x_q && y == '0 && z == (op == Turned ? angle_q + theta : angle_q)));
      half_turn_first: assert (!(turns && step == 6'd2) || (x == (flips ? ~x_q : x_q) && y == (flips ? ~y_q : y_q) &&
          z == {z_q[19] != flips, z_q[18:0]} && (op == Polar ? x >= 0 : z[19] == z[18])));
      small_turns: assert (!(turns && even) || (z == (falls ? z_q - arc : z_q + arc) &&
          (op == Park ? {x[23:0], y[23:0]} == {wide_x[23:0], wide_y[23:0]} : x == wide_x && y == wide_y)));
      within_the_limit: assert (op <= Length || (32'(\u_dut.length_q ) == length_q && length_q >= 0 && length_q <= most_q));
      saturated_is_limited: assert (!valid || saturated == limited_q);
      in_motion: cover (op == Alpha && step == 6'd9 && upper == -32'sd5);
      inside_step: assert (op <= AlongI && step <= (turns ? 6'd34 : 6'd18));
      inside_valid: assert (!valid || (op == Again && step == 6'd4));
      inside_bound: assert (!feeds || first || (factor > 0 ? upper >= 0 && upper < factor :
                            factor < 0 ? upper <= 0 && upper >= factor : upper == 0));
      inside_operand: assert (!feeds || first || (
          op == Alpha ? factor >= -32'sd262144 && factor < 32'sd262144 : op == Beta ? factor >= -32'sd1048576 && factor <= 32'sd1048576 :
          op == Length ? factor >= 0 : factor >= 0 && factor <= 32'sd131071));
      inside_start_x: assert (!(op == Beta || (step <= 6'd1 && (op == Park || forward))) || x == start_x_q);
      inside_start_y: assert (!(op == Park && step <= 6'd1) || y == start_y_q);
      inside_length_x: assert (!(step <= 6'd1 && forward) || (x >= 0 && x < 32'sd1048576));
      inside_limited: assert (\u_dut.saturated_q == limited_q);
      inside_length: assert (op <= Length || 32'(\u_dut.length_q ) == length_q);
      inside_axis_angle: assert (!(op == Length || op == Radius || (op == Turned && first)) || z == angle_q);
      inside_angle_kept: assert (!((op == Turned && !first) || (op > Turned && op <= Applied)) || \u_dut.angle_of_q == angle_q);
      inside_second: assert (!(in_turn && second) || (x_old == x_q && y == y_q && z == z_q && x[23:0] == wide_x[23:0] &&
                                                     (op == Park || x == wide_x)));
      inside_polar: assert (!(in_turn && op == Polar) || (from_x >= 0 && from_x <= 32'sd6291456 - (32'sd4194304 >>> turn) &&
                                                         from_y <= 32'sd2097152 && from_y >= -32'sd2097152));
      inside_polar_end: assert (op != Length || (x >= 0 && x <= 32'sd6291456));
      inside_reach: assert (!(in_turn && forward) || (from_x <= reach && from_x >= -reach && from_y <= reach && from_y >= -reach));
    end
  end
endmodule

`default_nettype wire
