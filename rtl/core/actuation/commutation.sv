// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Three on-times for a motor with three phases: angle = gain * position + offset, and along it a voltage of the
// amplitude, by space vectors or plain sines. Serial arithmetic without a multiplier, a table of a twelfth of a turn.
// Latency: sample_i to valid_o 85 clocks (Modulation 0: 108); a sample_i in between is ignored.
// Formats: angle 2^-32 electrical turn; amplitude [1,12,0] and on-times [0,12,0] clocks of the PWM.
// docs/blocks/three_phase.md

`default_nettype none

module commutation #(
    parameter int Period     = 1000,  // clocks of a PWM period, even, 4 to 4094
    parameter int Modulation = 1      // 0: sines, 1: space vectors
) (
    input  logic               clk_i,
    input  logic               rst_ni,
    input  logic               sample_i,     // one clock: takes all inputs
    input  logic signed [31:0] position_i,   // counts; wraps
    input  logic        [31:0] gain_i,       // 2^-32 electrical turn per count
    input  logic        [31:0] offset_i,     // 2^-32 electrical turn
    input  logic signed [12:0] amplitude_i,  // clocks; saturates at +-Period
    input  logic               polarity_i,   // 1: legs B and C change places
    output logic        [11:0] on_a_o,       // clocks of the high switch in a period
    output logic        [11:0] on_b_o,
    output logic        [11:0] on_c_o,
    output logic               valid_o       // one clock: the on-times are new
);
  generate
  if (!(Period >= 4 && Period <= 4094 && Period % 2 == 0 && (Modulation == 0 || Modulation == 1))) begin : g_check
    PERIOD_must_be_even_and_4_to_4094_and_MODULATION_0_or_1 missing ();
  end
  endgenerate

  localparam bit Sines = Modulation == 0;
  localparam logic [11:0] Half = 12'(Period / 2);
  // Sines: (Period/2 - 1) sqrt 3, so that a rounded leg stays within the period.
  localparam int Limit = Sines ? (Period - 2) * 56755 / 65536 : Period;
  localparam logic signed [12:0] Most = 13'(Limit);

  // Steps. Turn: 32 bits of the position, then two registers. Product: a table's word between two nodes, one bit of the
  // angle in each of 8 clocks, then its product with the amplitude, 13 bits. Legs: one leg in each clock.
  typedef enum logic [1:0] {
    Rest    = 2'd0,
    Turn    = 2'd1,
    Product = 2'd2,
    Legs    = 2'd3
  } state_e;
  localparam logic [5:0] TurnEnds = 6'd34;
  localparam logic [5:0] Move = 6'd9;    // the word is there and becomes the factor
  localparam logic [5:0] Sign = 6'd22;   // the amplitude's sign bit: subtracts
  localparam logic [5:0] LegsEnd = 6'd2;
  localparam logic [1:0] Cosine = 2'd0;  // passes: half the difference of the outer legs
  localparam logic [1:0] Third = 2'd1;   // sines alone: a third of the next
  localparam logic [1:0] Sine = 2'd2;    // the middle leg, from the middle of the outer ones

  state_e     state_q;
  logic [5:0] step_q;
  logic [1:0] pass_q;
  logic       take, ends, takes_word, takes_bit;
  assign take       = state_q == Rest && sample_i;
  assign ends       = step_q == (state_q == Turn ? TurnEnds : state_q == Product ? Sign : LegsEnd);
  assign takes_word = state_q == Product && step_q <= Move;
  assign takes_bit  = state_q == Product && step_q > Move;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      state_q <= Rest;
      step_q  <= '0;
      pass_q  <= Cosine;
    end else begin
      step_q <= state_q == Rest || ends ? '0 : step_q + 1'b1;
      if (take) state_q <= Turn;
      else if (state_q == Turn && ends) state_q <= Product;
      else if (state_q == Product && ends && pass_q == Sine) state_q <= Legs;
      else if (state_q == Legs && ends) state_q <= Rest;
      if (state_q == Turn) pass_q <= Cosine;
      else if (state_q == Product && ends) pass_q <= Sines && pass_q == Cosine ? Third : Sine;
    end
  end

  // The angle, from the position's highest bit on: modulo a turn.
  logic [31:0] position_q, gain_q, offset_q, added_q, angle_q, turn;
  logic [17:0] turn_q;
  logic [19:0] thrice;    // a third of a turn is 2^18
  logic        unused_turn;
  assign turn        = angle_q + offset_q;
  assign thrice      = 20'(turn_q) + {1'b0, turn_q, 1'b0};
  assign unused_turn = ^{turn[13:0], thrice[3:0]};
  always_ff @(posedge clk_i) begin
    if (take) begin
      gain_q   <= gain_i;
      offset_q <= offset_i;
    end
    position_q <= take ? position_i : position_q << 1;
    if (state_q == Turn) begin
      added_q <= position_q[31] ? gain_q : '0;
      angle_q <= (angle_q << 1) + added_q;
      turn_q  <= turn[31:14];
    end else begin
      added_q <= '0;
      angle_q <= '0;
    end
  end

  // Its sector, a sixth of a turn: third and half of it. In a sector one leg is the highest, one the lowest; the angle
  // from the sector's middle, -30 to 30 degrees, has the sign below_q, and as size a segment of the table and a part of it.
  logic [1:0] third_q;
  logic       half_q, below_q, backward_q;
  logic [3:0] segment_q;
  logic [7:0] part_q;
  always_ff @(posedge clk_i) begin
    if (take) backward_q <= polarity_i;
    if (state_q == Turn) begin
      third_q   <= thrice[19:18];
      half_q    <= thrice[17];
      below_q   <= !thrice[16];
      segment_q <= thrice[15:12] ^ {4{!thrice[16]}};
      part_q    <= thrice[11:4] ^ {8{!thrice[16]}};
    end else if (state_q == Product) begin
      if (step_q[5:3] == '0) part_q <= {part_q[0], part_q[7:1]};
    end else if (backward_q) begin
      third_q <= third_q == 2'd2 ? 2'd0 : third_q + 1'b1;  // of the next leg
    end else begin
      third_q <= third_q == 2'd0 ? 2'd2 : third_q - 1'b1;
    end
  end

  // Nodes 30/16 degrees apart, in 2^-17 of the amplitude: f(angle) * 2^17 * (1 + h^2/16) * 256/255 + 1/2, rounded, with
  // h = 30/16 degrees. The chords between them are as far above the curve as below it, and eight bits weigh 255/256.
  function automatic logic [16:0] cosine(input logic [4:0] at);  // cos/2
    case (at)
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
  function automatic logic [16:0] sine(input logic [4:0] at);  // sin * sqrt(3)/2
    case (at)
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
  function automatic logic [16:0] third(input logic [4:0] at);  // sin / (2 sqrt(3))
    case (at)
      5'd0:    third = 17'd1;
      5'd1:    third = 17'd1243;
      5'd2:    third = 17'd2485;
      5'd3:    third = 17'd3724;
      5'd4:    third = 17'd4959;
      5'd5:    third = 17'd6189;
      5'd6:    third = 17'd7412;
      5'd7:    third = 17'd8627;
      5'd8:    third = 17'd9833;
      5'd9:    third = 17'd11028;
      5'd10:   third = 17'd12211;
      5'd11:   third = 17'd13382;
      5'd12:   third = 17'd14538;
      5'd13:   third = 17'd15678;
      5'd14:   third = 17'd16802;
      5'd15:   third = 17'd17908;
      default: third = 17'd18995;
    endcase
  endfunction
  logic  [4:0] node;
  logic [16:0] word;
  assign node = {1'b0, segment_q} + {4'd0, part_q[0]};
  assign word = pass_q == Cosine ? cosine(node) : Sines && pass_q == Third ? third(node) : sine(node);

  // The amplitude, limited; its bits go round. Of a negative one the complement is compared.
  logic signed [12:0] amplitude_q, limited;
  logic               beyond;
  assign beyond  = (amplitude_i[11:0] ^ {12{amplitude_i[12]}}) >= 12'(Limit);
  assign limited = !beyond ? amplitude_i : amplitude_i[12] ? -Most : Most;
  always_ff @(posedge clk_i) begin
    if (take) amplitude_q <= limited;
    else if (takes_bit) amplitude_q <= {amplitude_q[0], amplitude_q[12:1]};
  end

  // One adder, whose sum moves down by a bit in each clock: of eight nodes, then of the factor where the amplitude has a
  // one. The bits that leave are dropped, so each ends as one floor of an exact sum. A product begins with a half.
  logic        [16:0] factor_q;
  logic signed [17:0] sum_q, sum;  // 2^-3 of the outer legs' difference, 2^-4 of other clocks
  logic        [18:0] addend;
  logic        [ 1:0] unused_bits;
  logic               minus, odd;
  logic signed [12:0] difference_q;  // of the outer legs
  assign minus  = takes_bit && step_q == Sign;
  assign addend = {2'd0, factor_q & {17{takes_word || amplitude_q[0]}}} ^ {19{minus}};
  // One carry chain: the bit below the operands carries the increment in.
  assign {sum, unused_bits} = {sum_q[17], sum_q, 1'b1} + {addend, minus};
  assign odd = difference_q[0];
  always_ff @(posedge clk_i) begin
    if (takes_word) factor_q <= step_q == Move ? sum_q[16:0] : word;
    if (state_q == Product) begin
      if (step_q == '0) sum_q <= '0;
      else if (step_q == Move) sum_q <= pass_q == Cosine ? 18'sd32768 : pass_q == Sine && odd ? '0 : 18'sd65536;
      else sum_q <= sum;
    end
    if (state_q == Product && step_q == '0 && pass_q != Cosine && (!Sines || pass_q == Third))
      difference_q <= 13'(sum_q >>> 3);
  end

  // A leg. The outer legs are apart by the whole difference, so it is rounded to one clock, not to two; if it is odd, their
  // middle is half a clock off, away from the middle leg's sign, and the middle leg is rounded towards it.
  logic               is_middle, is_lowest, falls, negates, adds_one, unused_leg;
  logic        [11:0] base, outer, product, value, leg, leg_q, leg_q2;
  assign is_lowest = third_q == 2'd1;
  assign is_middle = !is_lowest && (third_q == 2'd0) == half_q;
  assign falls     = half_q != below_q;  // the middle leg's part is negative
  assign outer     = difference_q[12:1];
  assign product   = 12'(sum_q >>> 4);
  always_comb begin
    value    = is_middle ? product : outer;
    negates  = is_middle ? falls : is_lowest;
    adds_one = is_middle ? falls : is_lowest ? !odd || falls : odd && falls;
    if (Sines && state_q == Product) begin
      value    = product;
      negates  = !falls;
      adds_one = !falls;
    end
  end
  assign {leg, unused_leg} = {base, 1'b1} + {value ^ {12{negates}}, adds_one};
  generate
  if (Sines) begin : g_sines
    // Where the middle of a plain sine's legs is: a third of the middle leg's part on the other side.
    logic [11:0] middle_q;
    assign base = state_q == Legs ? middle_q : Half;
    always_ff @(posedge clk_i) if (state_q == Product && step_q == '0 && pass_q == Sine) middle_q <= leg;
  end else begin : g_space_vectors
    assign base = Half;
  end
  endgenerate

  always_ff @(posedge clk_i) begin
    leg_q  <= leg;
    leg_q2 <= leg_q;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      on_a_o  <= Half;
      on_b_o  <= Half;
      on_c_o  <= Half;
      valid_o <= 1'b0;
    end else begin
      valid_o <= state_q == Legs && ends;
      if (state_q == Legs && ends) begin
        on_a_o <= leg_q2;
        on_b_o <= leg_q;
        on_c_o <= leg;
      end
    end
  end
endmodule

`default_nettype wire
