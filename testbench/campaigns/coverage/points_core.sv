// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cover points: situations that the tests of axis, decoder and bridge must reach. The lock-steps of the other
// blocks count what they reach by themselves. COVER_<block> is defined where the block is among the sources.
// docs/testing.md
`default_nettype none

`ifdef COVER_axis
// The axis: each scene entered, at its torque limit, left; each fault while armed; each mode.
module axis_cover (
  input logic clk_i,
  input logic rst_ni,
  input logic tick,
  input logic armed,
  input logic gates,
  input logic host,
  input logic testing,
  input logic derated,
  input logic chatters,
  input logic stop,
  input logic [ 1:0] mode,
  input logic [ 3:0] scene,
  input logic [11:0] limits,
  input logic [15:0] faults,
  input logic [ 4:0] first_fault,
  input logic [11:0] reg_addr_i,
  input logic        reg_write_i,
  input logic signed [31:0] position
);
  logic [3:0] before_q;
  logic known_q, over;
  assign over = position != 32'(signed'(18'(position)));
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {before_q, known_q} <= '0;
    else if (tick) {before_q, known_q} <= {scene, 1'b1};
  end
  for (genvar n = 0; n < 10; n++) begin : g_scene
    entered: cover property (@(posedge clk_i) disable iff (!rst_ni) tick && known_q && armed && scene == 4'(n) && before_q != 4'(n));
    left:    cover property (@(posedge clk_i) disable iff (!rst_ni) tick && known_q && armed && scene != 4'(n) && before_q == 4'(n));
    if (n > 1) begin : g_force
      saturated: cover property (@(posedge clk_i) disable iff (!rst_ni) tick && armed && scene == 4'(n) && limits[map::L_TORQUE]);
    end
  end
  for (genvar n = 0; n < 10; n++) begin : g_limit
    reached: cover property (@(posedge clk_i) disable iff (!rst_ni) tick && limits[n]);
  end
  for (genvar n = 1; n <= map::FAULT_JUMP; n++) begin : g_fault
    seen:  cover property (@(posedge clk_i) disable iff (!rst_ni) tick && faults[n]);
    first: cover property (@(posedge clk_i) disable iff (!rst_ni) tick && first_fault == 5'(n));
  end
  for (genvar n = 0; n < 3; n++) begin : g_mode
    armed_in: cover property (@(posedge clk_i) disable iff (!rst_ni) tick && gates && mode == 2'(n));
  end
  by_panel:          cover property (@(posedge clk_i) disable iff (!rst_ni) tick && armed && !host);
  by_host:           cover property (@(posedge clk_i) disable iff (!rst_ni) tick && armed && host);
  tests_itself:      cover property (@(posedge clk_i) disable iff (!rst_ni) tick && testing);
  eases:             cover property (@(posedge clk_i) disable iff (!rst_ni) tick && derated);
  freezes:           cover property (@(posedge clk_i) disable iff (!rst_ni) tick && chatters);
  position_beyond:   cover property (@(posedge clk_i) disable iff (!rst_ni) tick && armed && over && !position[31]);
  position_below:    cover property (@(posedge clk_i) disable iff (!rst_ni) tick && armed && over && position[31]);
  write_in_the_tick: cover property (@(posedge clk_i) disable iff (!rst_ni) tick && reg_write_i);
  stop_while_armed:  cover property (@(posedge stop) rst_ni && gates);
  reads_a_snapshot:  cover property (@(posedge clk_i) disable iff (!rst_ni) !reg_write_i && reg_addr_i[11:6] == map::A_SNAPSHOT[11:6]);
endmodule

bind axis axis_cover u_cover (
  .tick(tick.last), .armed(safe.armed), .gates(safe.gates_enable), .host(control.host), .derated(safe.derated),
  .chatters(position_i.chatters), .stop(panel_i.stop), .mode(control.mode), .scene(scene_number), .faults(safe.faults),
  .first_fault(safe.first_fault), .position(position_q), .*);
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

`ifdef COVER_pwm
// pwm: duties and pulses at every end, in both modes, and what may meet a gate that is on.
module pwm_cover #(
  parameter int Period     = 1000,
  parameter int DeadClocks = 25
) (
  input logic               clk_i,
  input logic               rst_ni,
  input logic               clear_i,
  input logic               enable_i,
  input logic               mode_i,
  input logic               polarity_i,
  input logic               take,
  input logic signed [12:0] duty_i,
  input logic signed [13:0] threshold_q,
  input logic        [1:0]  gate_hi_q,
  input logic        [1:0]  gate_lo_q,
  input logic        [1:0]  changes,
  input logic        [1:0]  elapsed
);
  localparam logic signed [13:0] FULL = 14'(Period);
  localparam logic signed [13:0] DEAD = 14'(DeadClocks);

  logic signed [13:0] duty;
  logic               taken, running;
  logic        [3:0]  gates;
  assign duty    = 14'(duty_i);
  assign taken   = take && enable_i;
  assign running = enable_i && !clear_i;
  assign gates   = {gate_hi_q, gate_lo_q};

  for (genvar n = 0; n < 4; n++) begin : g_mode  // both modes, both polarities
    logic here;
    assign here = taken && {mode_i, polarity_i} == 2'(n);
    duty_zero:          cover property (@(posedge clk_i) disable iff (!rst_ni) here && duty == 0);
    duty_one:           cover property (@(posedge clk_i) disable iff (!rst_ni) here && duty == 1);
    duty_minus_one:     cover property (@(posedge clk_i) disable iff (!rst_ni) here && duty == -1);
    duty_full:          cover property (@(posedge clk_i) disable iff (!rst_ni) here && duty == FULL);
    duty_minus_full:    cover property (@(posedge clk_i) disable iff (!rst_ni) here && duty == -FULL);
    duty_nearly_full:   cover property (@(posedge clk_i) disable iff (!rst_ni) here && duty == FULL - 1);
    duty_minus_nearly:  cover property (@(posedge clk_i) disable iff (!rst_ni) here && duty == 1 - FULL);
    duty_beyond:        cover property (@(posedge clk_i) disable iff (!rst_ni) here && duty > FULL);
    duty_minus_beyond:  cover property (@(posedge clk_i) disable iff (!rst_ni) here && duty < -FULL);
    duty_dead_time:     cover property (@(posedge clk_i) disable iff (!rst_ni) here && duty == DEAD);
    duty_below_dead:    cover property (@(posedge clk_i) disable iff (!rst_ni)
                                        here && duty > 0 && duty < DEAD);
  end

  for (genvar l = 0; l < 2; l++) begin : g_leg
    logic hi, lo;
    assign hi = gate_hi_q[l];
    assign lo = gate_lo_q[l];
    // A level wanted for less than the dead time: the gate stays off.
    pulse_swallowed:  cover property (@(posedge clk_i) disable iff (!rst_ni)
                                      running && changes[l] && !elapsed[l] && !hi && !lo);
    disabled_in_high: cover property (@(posedge clk_i) disable iff (!rst_ni) hi && !enable_i && !clear_i);
    disabled_in_low:  cover property (@(posedge clk_i) disable iff (!rst_ni) lo && !enable_i && !clear_i);
    both_off_running: cover property (@(posedge clk_i) disable iff (!rst_ni) running && !hi && !lo && elapsed[l]);
  end

  // The raw clear comes between the clocks.
  cleared_in_high:     cover property (@(posedge clear_i) rst_ni && gate_hi_q != 2'b00);
  cleared_in_low:      cover property (@(posedge clear_i) rst_ni && gate_hi_q == 2'b00 && gate_lo_q != 2'b00);
  disabled_at_take:    cover property (@(posedge clk_i) disable iff (!rst_ni) take && !enable_i && duty != 0);
  driven_forward:      cover property (@(posedge clk_i) disable iff (!rst_ni) gates == 4'b0110);
  driven_backward:     cover property (@(posedge clk_i) disable iff (!rst_ni) gates == 4'b1001);
  both_low:            cover property (@(posedge clk_i) disable iff (!rst_ni) gates == 4'b0011);
  never_above_carrier: cover property (@(posedge clk_i) disable iff (!rst_ni) running && threshold_q <= 0);
  always_above:        cover property (@(posedge clk_i) disable iff (!rst_ni) running && threshold_q >= FULL);
endmodule

bind pwm pwm_cover #(.Period(Period), .DeadClocks(DeadClocks)) u_cover (.*);
`endif

`default_nettype wire
