// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cover points of the chain from the encoder to the voltage: situations that the blocks' tests must reach.
// COVER_<block> is defined where the block is among the sources. docs/testing.md
`default_nettype none

`ifdef COVER_dob
// dob: ties of the observed torque, both ends of its format, the state that follows while disarmed.
module dob_cover #(
  parameter int ObservedW  = 24,
  parameter int TorqueDrop = 2
) (
  input logic clk_i,
  input logic rst_ni,
  input logic armed_i,
  input logic rounds,
  input logic shows,
  input logic over,
  input logic negative,
  input logic beyond_half,
  input logic signed [ObservedW-1:0] filter_q
);
  logic half;
  assign half = filter_q[TorqueDrop-1];
  for (genvar n = 0; n < 4; n++) begin : g_kind  // odd, negative
    logic here;
    assign here = rounds && {filter_q[TorqueDrop], filter_q[ObservedW-1]} == 2'(n);
    tie:        cover property (@(posedge clk_i) disable iff (!rst_ni) here && half && !beyond_half);
    above_half: cover property (@(posedge clk_i) disable iff (!rst_ni) here && half && beyond_half);
    below_half: cover property (@(posedge clk_i) disable iff (!rst_ni) here && !half && beyond_half);
  end
  over_above: cover property (@(posedge clk_i) disable iff (!rst_ni) shows && over && !negative);
  over_below: cover property (@(posedge clk_i) disable iff (!rst_ni) shows && over && negative);
  disarmed:   cover property (@(posedge clk_i) disable iff (!rst_ni) shows && !armed_i && !over);
endmodule

bind dob dob_cover #(.ObservedW(ObservedW), .TorqueDrop(TorqueDrop)) u_cover (
  .rounds(at_observed_i), .shows(at_tau_hat_i), .beyond_half((filter_q & BelowHalf) != '0),
  .negative(rounded_q[RoundedW-1]), .*);
`endif

`ifdef COVER_encoder_monitor
// encoder_monitor: each way to a trip, each way that a row of edges ends.
module encoder_monitor_cover (
  input logic clk_i,
  input logic rst_ni,
  input logic sample,
  input logic moved,
  input logic both,
  input logic of_row,
  input logic of_b_q,
  input logic late,
  input logic over,
  input logic dead,
  input logic edge_unit,
  input logic chatter_unit,
  input logic chatters_o,
  input logic index_wrong_i,
  input logic index_wrong_q
);
  for (genvar n = 0; n < 2; n++) begin : g_channel
    dead_by_edges:   cover property (@(posedge clk_i) disable iff (!rst_ni) sample && dead && !over && of_b_q == 1'(n));
    dead_by_time:    cover property (@(posedge clk_i) disable iff (!rst_ni) sample && dead && over && of_b_q == 1'(n));
    chatter_of:      cover property (@(posedge clk_i) disable iff (!rst_ni) sample && chatters_o && of_b_q == 1'(n));
  end
  time_over_but_late: cover property (@(posedge clk_i) disable iff (!rst_ni) sample && over && late);
  time_over_by_other: cover property (@(posedge clk_i) disable iff (!rst_ni) sample && over && moved && !of_row);
  shorted:            cover property (@(posedge clk_i) disable iff (!rst_ni) sample && both && of_row);
  row_ends_by_other:  cover property (@(posedge clk_i) disable iff (!rst_ni) sample && moved && !of_row && !late && chatters_o);
  row_ends_late:      cover property (@(posedge clk_i) disable iff (!rst_ni) sample && moved && late);
  edge_with_unit:     cover property (@(posedge clk_i) disable iff (!rst_ni) sample && moved && edge_unit);
  chatter_counts:     cover property (@(posedge clk_i) disable iff (!rst_ni) sample && chatters_o && !over && chatter_unit);
  index_trips:        cover property (@(posedge clk_i) disable iff (!rst_ni) sample && index_wrong_i && !index_wrong_q);
  index_right_again:  cover property (@(posedge clk_i) disable iff (!rst_ni) sample && !index_wrong_i && index_wrong_q);
endmodule

bind encoder_monitor encoder_monitor_cover u_cover (.*);
`endif

`ifdef COVER_limiter
// limiter: each kind of signal at, within and beyond its limit on both sides, and misfits.
module limiter_cover #(
  parameter int W = 24
) (
  input logic clk_i,
  input logic valid_i,
  input logic torque_i,
  input logic voltage_i,
  input logic duty_i,
  input logic valid_q,
  input logic over,
  input logic negative,
  input logic up,
  input logic misfit,
  input logic [W-1:0] limit,
  input logic [W-1:0] folded,
  input logic [W:0] room
);
  logic [1:0] kind_q;
  always_ff @(posedge clk_i) kind_q <= duty_i ? 2'd3 : voltage_i ? 2'd2 : torque_i ? 2'd1 : 2'd0;

  logic       good, outside, above, below;
  logic [W:0] size;  // |x|, where x is not over
  assign good    = valid_q && !misfit;
  assign outside = over || room[W];
  assign above   = outside && !negative;
  assign below   = outside && negative;
  assign size    = {1'b0, folded} + {{W{1'b0}}, negative ^ up};
  for (genvar n = 0; n < 4; n++) begin : g_kind  // current, torque, voltage, duty
    logic here;
    assign here = good && kind_q == 2'(n);
    allowed:        cover property (@(posedge clk_i) here && !outside && size != 0);
    beyond_above:   cover property (@(posedge clk_i) here && above && !over);
    beyond_below:   cover property (@(posedge clk_i) here && below && !over);
    far_above:      cover property (@(posedge clk_i) here && above && over);
    far_below:      cover property (@(posedge clk_i) here && below && over);
    at_limit:       cover property (@(posedge clk_i) here && !over && !negative && size == (W + 1)'(limit) && limit != 0);
    at_minus_limit: cover property (@(posedge clk_i) here && !over && negative && size == (W + 1)'(limit) && limit != 0);
    one_above:      cover property (@(posedge clk_i) here && !over && !negative && size == (W + 1)'(limit) + 1);
    one_below:      cover property (@(posedge clk_i) here && !over && negative && size == (W + 1)'(limit) + 1);
    limit_0:        cover property (@(posedge clk_i) here && limit == 0);
    refused:        cover property (@(posedge clk_i) valid_q && misfit && kind_q == 2'(n));
    refused_sign:   cover property (@(posedge clk_i) valid_q && limit[W-1] && kind_q == 2'(n));
  end
  border_only:  cover property (@(posedge clk_i) !valid_q && outside);
  back_to_back: cover property (@(posedge clk_i) valid_i && valid_q);
endmodule

bind limiter limiter_cover #(.W(W)) u_cover (.*);
`endif

`ifdef COVER_lowpass
// lowpass: ties of the product from odd and even states, the dead band, the ends of the state.
module lowpass_cover #(
  parameter int Width       = 32,
  parameter int ProductDrop = 27,
  parameter int ProductW    = 53
) (
  input logic                       clk_i,
  input logic                       rst_ni,
  input logic                       valid_i,
  input logic                       update_i,
  input logic                       follow_i,
  input logic signed [ProductW-1:0] product_i,
  input logic signed [   Width-1:0] x_i,
  input logic signed [   Width-1:0] y_q,
  input logic                       beyond_half
);
  logic half, sum_odd, tie;
  assign half    = product_i[ProductDrop-1];
  assign sum_odd = y_q[0] ^ product_i[ProductDrop];
  assign tie     = update_i && !follow_i && half && !beyond_half;
  for (genvar n = 0; n < 4; n++) begin : g_sign  // of the product, of the state
    logic here;
    assign here = {product_i[ProductW-1], y_q[Width-1]} == 2'(n);
    tie_to_odd:  cover property (@(posedge clk_i) disable iff (!rst_ni) tie && here && !sum_odd);
    tie_to_even: cover property (@(posedge clk_i) disable iff (!rst_ni) tie && here && sum_odd);
    above_half:  cover property (@(posedge clk_i) disable iff (!rst_ni)
                                 update_i && !follow_i && here && half && beyond_half);
    below_half:  cover property (@(posedge clk_i) disable iff (!rst_ni)
                                 update_i && !follow_i && here && !half && beyond_half);
  end
  both_bits_odd: cover property (@(posedge clk_i) disable iff (!rst_ni) tie && y_q[0] && product_i[ProductDrop]);
  dead_band:     cover property (@(posedge clk_i) disable iff (!rst_ni)
                                 update_i && !follow_i && product_i != '0 && product_i[ProductW-1:ProductDrop-1] == '0);
  follows:       cover property (@(posedge clk_i) disable iff (!rst_ni) update_i && follow_i && x_i != y_q);
  largest_step:  cover property (@(posedge clk_i) disable iff (!rst_ni)
                                 valid_i && x_i[Width-1] != y_q[Width-1] && x_i[Width-2] != x_i[Width-1] &&
                                 y_q[Width-2] != y_q[Width-1]);
endmodule

bind lowpass lowpass_cover #(.Width(Width), .ProductDrop(ProductDrop), .ProductW(ProductW)) u_cover (.*);
`endif

`ifdef COVER_quad_decoder
// quad_decoder: a reversal in each of the four phases, both ways; events that come together.
module quad_decoder_cover (
  input logic               clk_i,
  input logic               rst_ni,
  input logic        [3:0]  filter_i,
  input logic               polarity_i,
  input logic               set_zero_i,
  input logic               clear_error_i,
  input logic        [2:0]  level_q,
  input logic        [2:0]  rejected,
  input logic               moved,
  input logic               down,
  input logic               illegal,
  input logic               index_q,
  input logic               error_wait_q,
  input logic               rejected_wait_q,
  input logic signed [31:0] count_q,
  input logic        [15:0] error_count_o,
  input logic        [15:0] rejected_count_o
);
  // The direction of the last step since the reset.
  logic was_down_q, known_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      was_down_q <= 1'b0;
      known_q    <= 1'b0;
    end else if (moved) begin
      was_down_q <= down;
      known_q    <= 1'b1;
    end
  end

  logic turns_up, turns_down;
  assign turns_up   = moved && known_q && was_down_q && !down;
  assign turns_down = moved && known_q && !was_down_q && down;
  for (genvar n = 0; n < 4; n++) begin : g_phase  // levels of A and B at the reversal
    reversal_up:            cover property (@(posedge clk_i) disable iff (!rst_ni)
                                            turns_up && level_q[1:0] == 2'(n) && filter_i == 4'd0);
    reversal_down:          cover property (@(posedge clk_i) disable iff (!rst_ni)
                                            turns_down && level_q[1:0] == 2'(n) && filter_i == 4'd0);
    filtered_reversal_up:   cover property (@(posedge clk_i) disable iff (!rst_ni)
                                            turns_up && level_q[1:0] == 2'(n) && filter_i != 4'd0);
    filtered_reversal_down: cover property (@(posedge clk_i) disable iff (!rst_ni)
                                            turns_down && level_q[1:0] == 2'(n) && filter_i != 4'd0);
    illegal_here:           cover property (@(posedge clk_i) disable iff (!rst_ni)
                                            illegal && level_q[1:0] == 2'(n));
  end

  for (genvar n = 0; n < 16; n++) begin : g_filter
    counts:  cover property (@(posedge clk_i) disable iff (!rst_ni) moved && filter_i == 4'(n));
    rejects: cover property (@(posedge clk_i) disable iff (!rst_ni) rejected != 3'd0 && filter_i == 4'(n));
  end

  zero_with_step:      cover property (@(posedge clk_i) disable iff (!rst_ni) set_zero_i && moved);
  zero_with_index:     cover property (@(posedge clk_i) disable iff (!rst_ni) set_zero_i && index_q);
  clear_with_error:    cover property (@(posedge clk_i) disable iff (!rst_ni) clear_error_i && illegal);
  both_counters_wait:  cover property (@(posedge clk_i) disable iff (!rst_ni) error_wait_q && rejected_wait_q);
  wraps_up:            cover property (@(posedge clk_i) disable iff (!rst_ni)
                                       moved && !down && count_q == 32'sh7fffffff);
  wraps_down:          cover property (@(posedge clk_i) disable iff (!rst_ni)
                                       moved && down && count_q == -32'sh80000000);
  errors_at_the_end:   cover property (@(posedge clk_i) disable iff (!rst_ni) error_wait_q && error_count_o == '1);
  rejects_at_the_end:  cover property (@(posedge clk_i) disable iff (!rst_ni)
                                       rejected_wait_q && rejected_count_o == '1);
  other_polarity:      cover property (@(posedge clk_i) disable iff (!rst_ni) moved && polarity_i);
endmodule

bind quad_decoder quad_decoder_cover u_cover (.*);
`endif

`ifdef COVER_ramp
// ramp: what begins one, where it ends, what stays frozen.
module ramp_cover #(
  parameter int W = 24
) (
  input logic clk_i,
  input logic rst_ni,
  input logic armed_i,
  input logic restart_i,
  input logic frozen_i,
  input logic derated_i,
  input logic limit_hold_o,
  input logic limit_torque_o,
  input logic begins,
  input logic moves,
  input logic changes,
  input logic [3:0] scene_i,
  input logic [3:0] scene_q,
  input logic ramping_q,
  input logic stepping_q,
  input logic stay_q,
  input logic down,
  input logic stepping,
  input logic frozen,
  input logic [W-2:0] step_q,
  input logic signed [W-1:0] change_q,
  input logic signed [W-1:0] ramp_q
);
  logic signed [W-1:0] next;
  assign next = ramp_q + change_q;

  begins_by_arming:  cover property (@(posedge clk_i) disable iff (!rst_ni) begins && !armed_i);
  begins_by_scene:   cover property (@(posedge clk_i) disable iff (!rst_ni) begins && armed_i && scene_i != scene_q && !ramping_q);
  begins_by_ease:    cover property (@(posedge clk_i) disable iff (!rst_ni) begins && armed_i && derated_i && !limit_hold_o);
  begins_by_relief:  cover property (@(posedge clk_i) disable iff (!rst_ni) begins && armed_i && !derated_i && limit_hold_o);
  begins_by_restart: cover property (@(posedge clk_i) disable iff (!rst_ni) restart_i && armed_i && !ramping_q);
  steps_up:          cover property (@(posedge clk_i) disable iff (!rst_ni) moves && stepping_q && !stay_q && !down);
  steps_down:        cover property (@(posedge clk_i) disable iff (!rst_ni) moves && stepping_q && !stay_q && down);
  ends_up:           cover property (@(posedge clk_i) disable iff (!rst_ni) moves && ramping_q && stay_q && !down);
  ends_down:         cover property (@(posedge clk_i) disable iff (!rst_ni) moves && ramping_q && stay_q && down);
  at_once_up:        cover property (@(posedge clk_i) disable iff (!rst_ni) moves && !stepping_q && !down);
  at_once_down:      cover property (@(posedge clk_i) disable iff (!rst_ni) moves && !stepping_q && down);
  step_0:            cover property (@(posedge clk_i) disable iff (!rst_ni) moves && stepping_q && step_q == '0 && !frozen_i);
  frozen_growth:     cover property (@(posedge clk_i) disable iff (!rst_ni) changes && frozen && !ramping_q && stepping);
  frozen_fall:       cover property (@(posedge clk_i) disable iff (!rst_ni) changes && frozen && !ramping_q && !stepping);
  frozen_sign:       cover property (@(posedge clk_i) disable iff (!rst_ni) changes && frozen && !ramping_q && stepping && down && ramp_q > 0);
  through_0:         cover property (@(posedge clk_i) disable iff (!rst_ni)
                                     moves && !stepping_q && next[W-1] != ramp_q[W-1] && ramp_q != 0 && next != 0);
  at_torque_limit:   cover property (@(posedge clk_i) disable iff (!rst_ni) limit_torque_o && ramping_q);
endmodule

bind ramp ramp_cover #(.W(W)) u_cover (
  .begins(at_ramp_begin_i), .moves(at_tau_ref_i),
  .changes(at_ramp_change_i), .*);
`endif

`ifdef COVER_rounding
// rounding: every tie, beside it on both sides, of a number and of a negated one, in each mode.
module rounding_cover #(
  parameter int Drop = 2
) (
  input logic [Drop:0] low_i,
  input logic          negated_i,
  input logic          half,
  input logic          rest
);
  for (genvar n = 0; n < 4; n++) begin : g_kind  // kept bit odd, negated
    logic here;
    assign here = {low_i[Drop], negated_i} == 2'(n);
    if (feltgate_pkg::ROUNDING == 0) begin : g_half_up
      always_comb begin
        half_up_tie:   cover (here && half && !rest);
        half_up_above: cover (here && half && rest);
        half_up_below: cover (here && !half && rest);
        half_up_exact: cover (here && !half && !rest);
      end
    end else if (feltgate_pkg::ROUNDING == 1) begin : g_floor
      always_comb begin
        floor_tie:   cover (here && half && !rest);
        floor_above: cover (here && half && rest);
        floor_below: cover (here && !half && rest);
        floor_exact: cover (here && !half && !rest);
      end
    end else begin : g_even
      always_comb begin
        even_tie:   cover (here && half && !rest);
        even_above: cover (here && half && rest);
        even_below: cover (here && !half && rest);
        even_exact: cover (here && !half && !rest);
      end
    end
  end
endmodule

bind rounding rounding_cover #(.Drop(Drop)) u_cover (.*);
`endif

`ifdef COVER_scenes
// scenes: each one entered, saturated, left; a tie of each rounded term.
module scenes_cover #(
  parameter int Mask  = 0,
  parameter int Guard = 2,
  parameter int PartW = 24,
  parameter int TorqueW = 21,
  parameter int SceneTorqueW = 24
) (
  input logic clk_i,
  input logic rst_ni,
  input logic armed_i,
  input logic rounds,
  input logic [3:0] scene_i,
  input logic signed [PartW:0] sum_q,
  input logic signed [SceneTorqueW-1:0] rounded_q,
  input logic signed [TorqueW-1:0] word_q,
  input logic signed [TorqueW-1:0] late_term_o
);
  logic [3:0] before_q;
  logic       known_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      before_q <= '0;
      known_q  <= 1'b0;
    end else if (rounds) begin
      before_q <= scene_i;
      known_q  <= 1'b1;
    end
  end

  logic tie, wide;
  assign tie  = sum_q[Guard-1:0] == {1'b1, {(Guard - 1) {1'b0}}};
  assign wide = rounded_q[SceneTorqueW-1:TorqueW-1] != {(SceneTorqueW - TorqueW + 1) {rounded_q[SceneTorqueW-1]}};
  for (genvar n = 2; n < 10; n++) begin : g_scene
    localparam bit Built = Mask[n];
    localparam bit Rounds = n != int'(feltgate_map_pkg::SCENE_SETPOINT) && n != int'(feltgate_map_pkg::SCENE_MEMBRANE);
    logic here, enters, leaves;
    assign here   = armed_i && scene_i == 4'(n);
    assign enters = rounds && known_q && here && before_q != 4'(n);
    assign leaves = rounds && known_q && armed_i && scene_i != 4'(n) && before_q == 4'(n);
    if (Built) begin : g_built
      entered: cover property (@(posedge clk_i) disable iff (!rst_ni) enters);
      left:    cover property (@(posedge clk_i) disable iff (!rst_ni) leaves);
      acts:    cover property (@(posedge clk_i) disable iff (!rst_ni) here && (rounded_q != 0 || word_q != 0 || late_term_o != 0));
      if (Rounds) begin : g_rounds
        tie_even: cover property (@(posedge clk_i) disable iff (!rst_ni) rounds && here && tie && !sum_q[Guard]);
        tie_odd:  cover property (@(posedge clk_i) disable iff (!rst_ni) rounds && here && tie && sum_q[Guard]);
        beyond_any_torque: cover property (@(posedge clk_i) disable iff (!rst_ni) here && wide && word_q == 0);
      end
    end
  end
endmodule

bind scenes scenes_cover #(.Mask(Mask), .Guard(Guard), .PartW(PartW), .TorqueW(TorqueW),
                           .SceneTorqueW(feltgate_pkg::SCENE_TORQUE_W)) u_cover (.rounds(wave_i[AtRounded]), .*);
`endif

`ifdef COVER_torque_control
// torque_control: each mode at each limit, both regions of the voltage gain, a mode's change.
module torque_control_cover (
  input logic clk_i,
  input logic rst_ni,
  input logic armed_i,
  input logic [1:0] mode_i,
  input logic shows,
  input logic region,
  input logic limit_current_o,
  input logic limit_voltage_o,
  input logic limit_duty_o,
  input logic over_limit_i,
  input logic region_high_o,
  input logic voltage_over,
  input logic signed [feltgate_pkg::CURRENT_W-1:0] current_ref_o,
  input logic signed [feltgate_pkg::VOLTAGE_W-1:0] voltage_o,
  input logic signed [feltgate_pkg::DUTY_W-1:0] duty_o
);
  for (genvar n = 0; n < 3; n++) begin : g_mode
    logic here;
    assign here = shows && armed_i && mode_i == 2'(n);
    at_current_limit:    cover property (@(posedge clk_i) disable iff (!rst_ni) here && limit_current_o && current_ref_o > 0);
    at_minus_current:    cover property (@(posedge clk_i) disable iff (!rst_ni) here && limit_current_o && current_ref_o < 0);
    at_voltage_limit:    cover property (@(posedge clk_i) disable iff (!rst_ni) here && limit_voltage_o && voltage_o > 0);
    at_minus_voltage:    cover property (@(posedge clk_i) disable iff (!rst_ni) here && limit_voltage_o && voltage_o < 0);
    at_duty_limit:       cover property (@(posedge clk_i) disable iff (!rst_ni) here && limit_duty_o && duty_o > 0);
    at_minus_duty:       cover property (@(posedge clk_i) disable iff (!rst_ni) here && limit_duty_o && duty_o < 0);
    free_of_limits:      cover property (@(posedge clk_i) disable iff (!rst_ni) here && !limit_current_o && !limit_voltage_o &&
                                         !limit_duty_o && duty_o != 0);
  end
  enters_high_region: cover property (@(posedge clk_i) disable iff (!rst_ni) region && over_limit_i && !region_high_o);
  leaves_high_region: cover property (@(posedge clk_i) disable iff (!rst_ni) region && !over_limit_i && region_high_o);
  beyond_the_port:    cover property (@(posedge clk_i) disable iff (!rst_ni) shows && voltage_over);
  disarmed:           cover property (@(posedge clk_i) disable iff (!rst_ni) shows && !armed_i && voltage_o == 0 && duty_o == 0);
endmodule

bind torque_control torque_control_cover u_cover (
  .shows(product_is_emf_constant_i), .region(at_region_i), .*);
`endif

`default_nettype wire
