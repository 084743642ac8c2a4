// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The clocks of a result, the factors of its products, the integrators, and the watch for an open phase. The vectors the
// turns give are as they are: turns.sv.
`default_nettype none

module field_proof (
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
  localparam int Period = 1000;
  localparam int Latency = 261;
  localparam int Busy = 349;
  localparam int Bits = 17;  // of a factor

  `include "reset.svh"

  logic valid, open, saturated;
  logic signed [20:0] current_q;
  logic signed [18:0] resistive, across;
  logic [11:0] on_a, on_b, on_c;
  field_oriented #(
      .Period(Period)
  ) u_dut (
      .*,
      .current_q_o(current_q),
      .resistive_o(resistive),
      .across_o(across),
      .open_o(open),
      .saturated_o(saturated),
      .on_a_o(on_a),
      .on_b_o(on_b),
      .on_c_o(on_c),
      .valid_o(valid)
  );
  (* hierconn *) wire [3:0] \u_dut.op_q ;
  (* hierconn *) wire [5:0] \u_dut.step_q ;
  (* hierconn *) wire \u_dut.direct_q , \u_dut.mirror_q , \u_dut.saturated_q , \u_dut.high_q ;
  (* hierconn *) wire [18:0] \u_dut.reference_q ;
  (* hierconn *) wire [17:0] \u_dut.emf_q ;
  (* hierconn *) wire [20:0] \u_dut.beta_q ;
  (* hierconn *) wire [31:0] \u_dut.position_q , \u_dut.gain_q , \u_dut.added_q , \u_dut.angle_q ;
  (* hierconn *) wire [19:0] \u_dut.theta_q , \u_dut.offset_q ;
  (* hierconn *) wire [2:0] \u_dut.low_q , \u_dut.quiet_q ;
  (* hierconn *) wire [7:0] \u_dut.start_q ;
  (* hierconn *) wire [23:0] \u_dut.factor_q , \u_dut.upper_q , \u_dut.x_q , \u_dut.y_q ;
  (* hierconn *) wire [16:0] \u_dut.word_q , \u_dut.length_q ;
  (* hierconn *) wire [21:0] \u_dut.wanted_q2 ;
  (* hierconn *) wire [35:0] \u_dut.own_q , \u_dut.other_q ;

  // The operation of a clock: its name, the clock of its first step, and its last step.
  localparam logic [3:0] Alpha = 4'd0, Beta = 4'd1, Park = 4'd2, AcrossP = 4'd3, AlongP = 4'd4, Polar = 4'd5, Length = 4'd6,
                         Radius = 4'd7, Turned = 4'd8, LegsX = 4'd9, LegsY = 4'd10, Again = 4'd11, Applied = 4'd12,
                         AcrossI = 4'd13, AlongI = 4'd14;
  wire [3:0] op = \u_dut.op_q ;
  wire [5:0] step = \u_dut.step_q ;
  logic [8:0] begins;
  logic turns, first, last, integrates, along;
  always_comb begin
    case (op)
      Alpha:   begins = 9'd0;
      Beta:    begins = 9'd19;
      Park:    begins = 9'd38;
      AcrossP: begins = 9'd73;
      AlongP:  begins = 9'd92;
      Polar:   begins = 9'd111;
      Length:  begins = 9'd146;
      Radius:  begins = 9'd165;
      Turned:  begins = 9'd184;
      LegsX:   begins = 9'd219;
      LegsY:   begins = 9'd238;
      Again:   begins = 9'd257;
      Applied: begins = 9'd276;
      AcrossI: begins = 9'd311;
      default: begins = 9'd330;
    endcase
  end
  assign turns      = op == Park || op == Polar || op == Turned || op == Applied;
  assign first      = step == 6'd0;
  assign last       = step == (turns ? 6'd34 : 6'd18);
  assign integrates = op == AcrossI || op == AlongI;
  assign along      = op == AlongP || op == AlongI;

  // The clocks since currents were taken, 0: none are.
  logic [8:0] place;
  logic take, due_q, armed_q;
  assign take = armed_i && valid_i && place == '0;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      place   <= '0;
      due_q   <= 1'b0;
      armed_q <= 1'b0;
    end else begin
      place   <= !armed_i || place == 9'(Busy - 1) ? '0 : place != '0 || take ? place + 9'd1 : '0;
      due_q   <= armed_i && place == 9'(Latency - 1);
      armed_q <= armed_i;
    end
  end

  // What was taken. The angle: the gain's multiples by 2^k where bit k of the position is 1, from the last one on.
  logic direct_q, mirror_q, high_q;
  logic [2:0] low_q;
  logic signed [31:0] reference_q, emf_q, a_q, b_q;
  logic [31:0] position_q, gain_q, turn_q;
  logic [19:0] offset_q, theta;
  logic [5:0] turn_bits_q;  // of the position, that are summed
  assign theta = turn_q[31:12] + offset_q;
  function automatic logic within(input logic signed [31:0] value, input logic signed [31:0] end_);
    within = value >= -end_ && value < end_;
  endfunction
  always_ff @(posedge clk_i) begin
    if (take) begin
      direct_q    <= direct_i;
      mirror_q    <= polarity_i;
      reference_q <= 32'(reference_i);
      emf_q       <= 32'(emf_i);
      a_q         <= 32'(current_a_i);
      b_q         <= 32'(current_b_i);
      position_q  <= position_i;
      gain_q      <= gain_i;
      offset_q    <= offset_i[31:12];
      turn_q      <= '0;
      turn_bits_q <= '0;
    end else if (turn_bits_q != 6'd32) begin
      if (position_q[6'd31 - turn_bits_q]) turn_q <= turn_q + (gain_q << (6'd31 - turn_bits_q));
      turn_bits_q <= turn_bits_q + 6'd1;
    end
  end
  assign low_q  = {within(a_q + b_q, 32'sd256), within(b_q, 32'sd256), within(a_q, 32'sd256)};
  assign high_q = !(within(a_q + b_q, 32'sd4096) && within(b_q, 32'sd4096) && within(a_q, 32'sd4096));

  // x and y, in LSB of the turns.
  wire signed [31:0] x = 32'($signed(\u_dut.x_q ));
  wire signed [31:0] y = 32'($signed(\u_dut.y_q ));

  // Both integrators; by the law that is next, they stand in one word or in the other.
  wire signed [39:0] own = 40'($signed(\u_dut.own_q ));
  wire signed [39:0] other = 40'($signed(\u_dut.other_q ));
  logic signed [39:0] along_now, across_now, along_then_q, across_then_q;
  assign along_now  = along ? own : other;
  assign across_now = along ? other : own;

  // A product's factors, of the vectors, the length and the wanted voltage that there are.
  wire [40:0] product = {\u_dut.upper_q , \u_dut.word_q };
  logic signed [31:0] operand, operand_q, applied, base;
  logic [Bits-1:0] word, word_q;
  assign base    = 32'(own >>> Bits) + (along ? emf_q : '0);
  assign applied = !\u_dut.saturated_q ? 32'($signed(\u_dut.wanted_q2 )) : along ? x >>> 3 : y >>> 3;
  always_comb begin
    case (op)
      Alpha:           operand = 32'(current_a_i);
      Beta:            operand = mirror_q ? -(a_q + 2 * b_q) : a_q + 2 * b_q;
      AcrossP:         operand = -(y >>> 3);
      AlongP:          operand = reference_q - (x >>> 3);
      Radius, Again:   operand = $signed({15'd0, \u_dut.length_q });
      LegsY:           operand = y;
      AcrossI, AlongI: operand = applied - base;
      default:         operand = x;
    endcase
    case (op)
      Beta:            word = 17'd45954;  // 2^17 / (1.64676 sqrt(3))
      AcrossP, AlongP: word = direct_q ? '0 : proportional_i;
      LegsX:           word = 17'd27713;  // 2^6 Period sqrt(3)/4
      LegsY:           word = 17'd16000;  // 2^6 Period/4
      AcrossI, AlongI: word = direct_q ? '0 : integral_i;
      default:         word = 17'd79594;  // 2^17 / 1.64676
    endcase
  end
  always_ff @(posedge clk_i) begin
    if (first) begin
      operand_q <= operand;
      word_q    <= word;
    end
  end

  // The watch for an open phase.
  logic [2:0] quiet_q, quiet;
  logic [7:0] start_q, moved;
  logic open_q;
  assign quiet = quiet_q & low_q;
  assign moved = theta[19:12] - start_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      quiet_q <= '0;
      start_q <= '0;
      open_q  <= 1'b0;
    end else if (!armed_i) begin
      quiet_q <= '0;
      open_q  <= 1'b0;
    end else if (op == Park && first) begin
      quiet_q <= high_q && quiet != '0 ? quiet : 3'd7;
      if (!high_q || quiet == '0) start_q <= theta[19:12];
      else if ($signed(moved) > 8'sd7 || $signed(moved) < -8'sd8) open_q <= 1'b1;
    end
  end

  // What was there before, and the current along the axis of the last turn.
  logic signed [31:0] shown_q;
  logic [36:0] legs_q;
  logic signed [39:0] added_q;
  logic done_along_q, done_across_q, cleared_q;
  always_ff @(posedge clk_i) begin
    along_then_q  <= along_now;
    across_then_q <= across_now;
    added_q       <= 40'($signed(product));
    legs_q        <= {on_a, on_b, on_c, saturated};
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {done_along_q, done_across_q, cleared_q} <= '0;
      shown_q <= '0;
    end else begin
      {done_along_q, done_across_q, cleared_q} <= {armed_i && last && op == AlongI, armed_i && last && op == AcrossI, take && direct_i};
      if (!armed_i) shown_q <= '0;
      else if (last && op == Park) shown_q <= x >>> 3;
    end
  end

  always_comb begin
    if (past_ok_q && rst_ni) begin
      result_in_its_clock: assert (valid == due_q);
      disarmed_is_zero: assert (armed_q || ({on_a, on_b, on_c} == {3{12'(Period / 2)}} && !valid && !saturated && !open &&
                                            current_q == '0 && resistive == '0 && across == '0 && along_now == '0 && across_now == '0));
      legs_are_held: assert (valid || !armed_q || {on_a, on_b, on_c, saturated} == legs_q);
      angle_of_the_position: assert (op < Park || \u_dut.theta_q == theta);
      operands_of_the_law: assert (step != 6'd1 || turns || (32'($signed(\u_dut.factor_q )) == operand_q && \u_dut.word_q == word_q));
      current_is_shown: assert (32'(current_q) == shown_q);
      integrators_are_held: assert (!armed_q || cleared_q || ((done_along_q || along_now == along_then_q) &&
                                                              (done_across_q || across_now == across_then_q)));
      integrators_add: assert (done_along_q ? along_now[35:0] == 36'(along_then_q + added_q) :
                              !done_across_q || across_now[35:0] == 36'(across_then_q + added_q));
      direct_is_zero: assert (place == '0 || !direct_q || (along_now == '0 && across_now == '0));
      whole_parts_are_shown: assert (40'(resistive) == along_now >>> Bits && 40'(across) == across_now >>> Bits);
      open_by_the_law: assert (open == open_q);
      one_is_low: cover (place == 9'd2 && high_q && low_q == 3'd1);
    end
  end

  // Inside: where a clock's operation is, and that the block holds what is taken.
  always_comb begin
    if (past_ok_q && rst_ni) begin
      inside_place: assert (place == '0 ? op == Alpha && first : place == begins + 9'(step) && place < 9'(Busy));
      inside_step: assert (op <= AlongI && step <= (turns ? 6'd34 : 6'd18) && (!due_q || place == 9'(Latency)));
      inside_taken: assert (place == '0 || (\u_dut.direct_q == direct_q && \u_dut.mirror_q == mirror_q &&
          32'($signed(\u_dut.reference_q )) == reference_q && 32'($signed(\u_dut.emf_q )) == emf_q &&
          32'($signed(\u_dut.beta_q )) == a_q + 2 * b_q && within(a_q, 32'sd262144) && within(b_q, 32'sd262144) &&
          \u_dut.low_q == low_q && \u_dut.high_q == high_q && \u_dut.gain_q == gain_q && \u_dut.offset_q == offset_q));
      inside_bits: assert (place == '0 || turn_bits_q == (place <= 9'd32 ? 6'(place - 9'd1) : 6'd32));
      inside_position: assert (place == '0 || op > Beta || \u_dut.position_q == position_q << (place - 9'd1));
      inside_angle: assert (place == '0 || op > Beta || (place <= 9'd33
          ? turn_q == ((\u_dut.angle_q << 1) + \u_dut.added_q ) << (9'd33 - place) : turn_q == \u_dut.angle_q ));
      inside_direct: assert (!(direct_q && integrates) || first || product == '0);
      inside_watch: assert (\u_dut.quiet_q == quiet_q && \u_dut.start_q == start_q);
    end
  end
endmodule

`default_nettype wire
