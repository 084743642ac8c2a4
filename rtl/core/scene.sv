// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The torque of the scene, not yet limited. One product for each term, one rounding. A scene that
// the design does not build gives 0. valid_o 4 clocks after velocity_valid_i, of a charge 26 after start_i.
//   set-point   tau = torque
//   membrane    tau = +-torque between two faces, back to the side of entry
//   spring      tau = k * (rest - position), on both sides or below the rest alone
//   damper      tau = -b * velocity
//   charge      tau = -+strength / x^2, within the core -+slope * x
//   wall        tau = k * (contact - position) - b * velocity above the contact, never pulling
// docs/blocks/scene.md

`default_nettype none

module scene (
    input  logic                                  clk_i,
    input  logic                                  rst_ni,
    input  cfg::params_t                          p,
    input  logic                                  armed_i,      // 0: torque 0
    input  logic        [                    3:0] scene_i,
    input  logic                                  start_i,      // one clock a tick: the position is new; all inputs hold
    input  logic                                  velocity_valid_i,  // later: the velocity is new
    input  logic signed [                   17:0] position_i,   // counts
    input  logic signed [    cfg::VELOCITY_W-1:0] velocity_i,   // rad/s
    input  cfg::law_t                             law_i,        // torque of a program
    output logic signed [cfg::SCENE_TORQUE_W-1:0] torque_o,     // Nm, held
    output logic                                  valid_o
);
  localparam int TorqueW = cfg::SCENE_TORQUE_W;
  localparam int PartW = cfg::SCENE_PART_W;
  localparam int PartF = cfg::SCENE_PART_F;
  localparam int Guard = cfg::SCENE_GUARD_BITS;
  localparam int DistanceF = cfg::SCENE_DISTANCE_F;
  localparam int Operand = cfg::VELOCITY_W > cfg::SCENE_DISTANCE_W ? cfg::VELOCITY_W : cfg::SCENE_DISTANCE_W;

  logic setpoint, membrane, compression, tension, damper, attract, repel, wall, law, charge;
  assign setpoint    = cfg::SCENE_MASK[map::SCENE_SETPOINT] && scene_i == map::SCENE_SETPOINT;
  assign membrane    = cfg::SCENE_MASK[map::SCENE_MEMBRANE] && scene_i == map::SCENE_MEMBRANE;
  assign compression = cfg::SCENE_MASK[map::SCENE_SPRING_COMPRESSION] && scene_i == map::SCENE_SPRING_COMPRESSION;
  assign tension     = cfg::SCENE_MASK[map::SCENE_SPRING_TENSION] && scene_i == map::SCENE_SPRING_TENSION;
  assign damper      = cfg::SCENE_MASK[map::SCENE_DAMPER] && scene_i == map::SCENE_DAMPER;
  assign attract     = cfg::SCENE_MASK[map::SCENE_CHARGE_ATTRACT] && scene_i == map::SCENE_CHARGE_ATTRACT;
  assign repel       = cfg::SCENE_MASK[map::SCENE_CHARGE_REPEL] && scene_i == map::SCENE_CHARGE_REPEL;
  assign wall        = cfg::SCENE_MASK[map::SCENE_WALL] && scene_i == map::SCENE_WALL;
  assign law         = cfg::SCENE_MASK[map::SCENE_LAW] && scene_i == map::SCENE_LAW;
  assign charge      = attract || repel;

  // The words of the scene. Those of one place in the bank share a register.
  logic signed [25:0] first, second;  // [1,17,8] counts: contact, rest, centre, lower face; upper face
  logic        [16:0] stiffness, slope, damping;
  logic        [31:0] strength;
  logic signed [cfg::TORQUE_W-1:0] torque;
  logic        [17:0] core;  // counts
  assign first     = p.scene_1;
  assign second    = p.scene_2[25:0];
  assign stiffness = p.scene_2[16:0];
  assign strength  = p.scene_2;
  assign slope     = p.scene_3;
  assign core      = p.scene_6;
  assign damping   = p.scene_10[16:0];
  assign torque    = p.scene_10[cfg::TORQUE_W-1:0];

  // Reference minus position. Of a charge's centre the fraction is ignored.
  logic signed [18:0] whole, upper;
  logic        [ 7:0] fraction;
  logic signed [26:0] distance;
  logic behind, ahead;  // the position is above the reference, below it
  assign whole    = 19'($signed(first[25:8])) - 19'(position_i);
  assign upper    = 19'($signed(second[25:8])) - 19'(position_i);
  assign fraction = charge ? 8'd0 : first[7:0];
  assign distance = {whole, fraction};
  assign behind   = whole[18];
  assign ahead    = !behind && distance != '0;

  // Products: stiffness, slope and square of a charge; when the velocity is new, damping.
  logic [5:0] at;  // clocks since start_i; the words are there in the first
  logic [1:0] after;  // clocks since velocity_valid_i
  logic signed [Operand-1:0] operand_q;
  logic signed [17:0] factor_q;
  logic signed [Operand+17:0] product_q;
  logic signed [63:0] product;
  always_ff @(posedge clk_i) begin
    operand_q <= velocity_valid_i ? Operand'(velocity_i) : Operand'(distance);
    if (at[0])                 factor_q <= {1'b0, stiffness};
    else if (at[1])            factor_q <= {1'b0, slope};
    else if (velocity_valid_i) factor_q <= {1'b0, damping};
    else                       factor_q <= whole[17:0];
    product_q <= operand_q * factor_q;
  end
  assign product = 64'(product_q);

  // A term with its guard bits. With ROUNDING 2 a term that is not added to
  // another keeps a sticky bit: whether any dropped bit was 1. Rounding to even needs it.
  function automatic logic signed [63:0] single(input logic signed [63:0] x, input int fraction_bits);
    single = cfg::ROUNDING == 2 ? fx::scale_sticky(x, fraction_bits - PartF) : fx::scale(x, PartF - fraction_bits);
  endfunction
  logic signed [63:0] push, pull, spring, slant;
  logic signed [PartW-1:0] spring_q;
  assign push   = fx::saturate(fx::scale(product, PartF - DistanceF - cfg::P_WALL_STIFFNESS_F), PartW);
  assign pull   = damper ? single(product, cfg::VELOCITY_F + cfg::P_DAMPER_DAMPING_F)
                         : fx::scale(product, PartF - cfg::VELOCITY_F - cfg::P_WALL_DAMPING_F);
  assign spring = single(product, DistanceF + cfg::P_COMPRESSION_STIFFNESS_F);
  assign slant  = single(product, DistanceF + cfg::P_ATTRACT_CORE_SLOPE_F);  // the repelling charge has the same format

  // Outside of its core a charge divides by the square of the distance. The force is 0 where the square
  // has more than 32 bits. It is also 0 where the distance has more than 18 bits: only the low bits are
  // a factor then, and the product is negative.
  logic [31:0] square_q;
  logic [15:0] quotient;
  logic divided, far_q, inside_core;
  assign inside_core = core != '0 && !fx::beyond(64'(whole), 32'(core));
  generate
  if (cfg::SCENE_MASK[map::SCENE_CHARGE_ATTRACT] || cfg::SCENE_MASK[map::SCENE_CHARGE_REPEL]) begin : g_charge
    divider u_divider (
        .clk_i(clk_i), .rst_ni(rst_ni), .start_i(at[5] && charge),
        .dividend_i(strength), .divisor_i(square_q), .quotient_o(quotient), .valid_o(divided)
    );
  end else begin : g_no_charge
    assign {divided, quotient} = '0;
  end
  endgenerate

  // The side from which a lever came into the membrane.
  logic above, outside, seen_q, from_above_q;
  assign above   = upper[18];
  assign outside = ahead || above;

  // The torque's size and sign.
  logic signed [PartW:0] sum_q, sum;
  logic signed [63:0] rounded;
  logic negative_q, ready_q;
  always_comb begin
    sum = '0;
    if (wall && behind)                               sum = (PartW + 1)'(spring_q) - (PartW + 1)'(pull);
    if (damper)                                       sum = (PartW + 1)'(pull);
    if (tension || (compression && !behind) || charge) sum = (PartW + 1)'(spring_q);
    if (setpoint || (membrane && seen_q && !outside)) sum = (PartW + 1)'(torque) <<< Guard;
    if (law && !law_i.late)                           sum = (PartW + 1)'($signed(law_i.torque)) <<< Guard;
  end
  assign rounded = fx::add_rounded('0, 64'(sum_q), Guard);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {at, after, ready_q, valid_o, spring_q, sum_q, negative_q, square_q, far_q, seen_q, from_above_q, torque_o} <= '0;
    end else begin
      at      <= {at[4:0], start_i};
      after   <= {after[0], velocity_valid_i};
      ready_q <= charge ? divided : after[1];
      valid_o <= ready_q;
      if (at[0]) begin
        seen_q <= membrane && (seen_q || outside);
        if (outside) from_above_q <= above && !ahead;
      end
      if (at[2]) spring_q           <= PartW'(wall ? push : spring);
      if (at[3] && charge) spring_q <= PartW'(slant);
      if (at[4]) {far_q, square_q}  <= {product[63:DistanceF+32] != '0, product[DistanceF+:32]};
      if (after[1]) begin
        sum_q      <= sum;
        negative_q <= damper || repel || (membrane && !from_above_q);
      end
      if (divided && !inside_core) begin
        sum_q      <= far_q ? '0 : (PartW + 1)'(fx::scale(64'(quotient), PartF - cfg::CHARGE_F));
        negative_q <= attract != ahead;
      end
      if (ready_q) torque_o <= !armed_i || (wall && !sum_q[PartW]) ? '0 : TorqueW'(negative_q ? -rounded : rounded);
    end
  end
endmodule

`default_nettype wire
