// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cover points of the core itself, and of what guards and drives the bridge: situations that the blocks' tests must reach.
// COVER_<block> is defined where the block is among the sources. docs/testing.md
`default_nettype none

`ifdef COVER_feltgate_core
// the core: each scene entered, at its torque limit, left; each fault while armed; each snapshot word read.
module feltgate_core_cover (
  input logic clk_i,
  input logic rst_ni,
  input logic tick,
  input logic armed_o,
  input logic gates_enable_o,
  input logic host,
  input logic testing_o,
  input logic derated,
  input logic chatters,
  input logic position_over,
  input logic reg_write_i,
  input logic stop_i,
  input logic [feltgate_map_pkg::W_CONTROL-1:0] control,
  input logic [11:0] limits_o,
  input logic [ 3:0] scene_o,
  input logic [ 3:0] scene_wanted,
  input logic [11:0] reg_addr_i,
  input logic [15:0] faults_o,
  input logic [ 4:0] first_fault_o,
  input logic signed [31:0] position
);
  for (genvar n = 0; n < 10; n++) begin : g_scene
    entered: cover property (@(posedge clk_i) disable iff (!rst_ni) tick && armed_o && scene_wanted == 4'(n) && scene_o != 4'(n));
    left:    cover property (@(posedge clk_i) disable iff (!rst_ni) tick && armed_o && scene_wanted != 4'(n) && scene_o == 4'(n));
    if (n > 1) begin : g_force
      saturated: cover property (@(posedge clk_i) disable iff (!rst_ni) tick && armed_o && scene_o == 4'(n) &&
                                 limits_o[feltgate_map_pkg::L_TORQUE]);
    end
  end
  for (genvar n = 0; n < 10; n++) begin : g_limit
    reached: cover property (@(posedge clk_i) disable iff (!rst_ni) tick && limits_o[n]);
  end
  for (genvar n = 1; n <= feltgate_map_pkg::FAULT_JUMP; n++) begin : g_fault
    seen:  cover property (@(posedge clk_i) disable iff (!rst_ni) tick && faults_o[n]);
    first: cover property (@(posedge clk_i) disable iff (!rst_ni) tick && first_fault_o == 5'(n));
  end
  for (genvar n = 0; n < 3; n++) begin : g_mode
    armed_in: cover property (@(posedge clk_i) disable iff (!rst_ni) tick && gates_enable_o &&
                              control[feltgate_map_pkg::B_CONTROL_MODE+:feltgate_map_pkg::W_CONTROL_MODE] == 2'(n));
  end
  by_panel:          cover property (@(posedge clk_i) disable iff (!rst_ni) tick && armed_o && !host);
  by_host:           cover property (@(posedge clk_i) disable iff (!rst_ni) tick && armed_o && host);
  tests_itself:      cover property (@(posedge clk_i) disable iff (!rst_ni) tick && testing_o);
  eases:             cover property (@(posedge clk_i) disable iff (!rst_ni) tick && derated);
  freezes:           cover property (@(posedge clk_i) disable iff (!rst_ni) tick && chatters);
  position_beyond:   cover property (@(posedge clk_i) disable iff (!rst_ni) tick && armed_o && position_over && !position[31]);
  position_below:    cover property (@(posedge clk_i) disable iff (!rst_ni) tick && armed_o && position_over && position[31]);
  write_in_the_tick: cover property (@(posedge clk_i) disable iff (!rst_ni) tick && reg_write_i);
  stop_while_armed:  cover property (@(posedge stop_i) rst_ni && gates_enable_o);
  reads_a_snapshot:  cover property (@(posedge clk_i) disable iff (!rst_ni) !reg_write_i &&
                                     reg_addr_i[11:6] == feltgate_map_pkg::A_SNAPSHOT[11:6]);
endmodule

bind feltgate_core feltgate_core_cover u_cover (
  .host(control[feltgate_map_pkg::B_CONTROL_HOST]), .scene_wanted(u_wave.scene_wanted),
  .position(u_encoder.position), .position_over(u_encoder.position_over), .*);
`endif

`ifdef COVER_hold_timer
// hold_timer: it eases, is relieved by an edge and by disarming, and never does where it is off.
module hold_timer_cover #(
  parameter int W = 13
) (
  input logic clk_i,
  input logic rst_ni,
  input logic armed_i,
  input logic moved_i,
  input logic now,
  input logic strong_q,
  input logic unit,
  input logic expired,
  input logic derated_o,
  input logic [W-1:0] units_q,
  input logic [31:0] param_i
);
  eases:              cover property (@(posedge clk_i) disable iff (!rst_ni) now && armed_i && !moved_i && strong_q && expired && !derated_o);
  stays_eased:        cover property (@(posedge clk_i) disable iff (!rst_ni) now && armed_i && !moved_i && !strong_q && derated_o);
  relieved_by_edge:   cover property (@(posedge clk_i) disable iff (!rst_ni) now && armed_i && moved_i && derated_o);
  relieved_by_disarm: cover property (@(posedge clk_i) disable iff (!rst_ni) now && !armed_i && derated_o);
  edge_at_the_end:    cover property (@(posedge clk_i) disable iff (!rst_ni) now && armed_i && moved_i && strong_q && expired && !derated_o);
  weak_in_time:       cover property (@(posedge clk_i) disable iff (!rst_ni) now && armed_i && !moved_i && !strong_q && units_q != '0);
  time_beyond_bits:   cover property (@(posedge clk_i) disable iff (!rst_ni) now && strong_q && param_i[31:W] != '0);
  time_0:             cover property (@(posedge clk_i) disable iff (!rst_ni) now && strong_q && armed_i && !moved_i && param_i == '0);
  counts:             cover property (@(posedge clk_i) disable iff (!rst_ni) now && armed_i && !moved_i && strong_q && unit);
  exactly_in_time:    cover property (@(posedge clk_i) disable iff (!rst_ni) now && armed_i && !moved_i && strong_q && param_i != '0 &&
                                      param_i == 32'(units_q) && !derated_o);
endmodule

bind hold_timer hold_timer_cover #(.W(W)) u_cover (.now(at_hold_i), .*);
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

`ifdef COVER_registers
// registers: each kind of write, what passes one that waits, what is refused, coincidences at the tick.
module registers_cover (
  input logic clk_i,
  input logic rst_ni,
  input logic tick_i,
  input logic reg_write_i,
  input logic reg_busy_o,
  input logic at_parameter,
  input logic at_control,
  input logic at_command,
  input logic to_parameter_q,
  input logic to_control_q,
  input logic to_command_q,
  input logic disarms,
  input logic stops,
  input logic disarm_o,
  input logic stop_o,
  input logic holds,
  input logic refuses,
  input logic ramps,
  input logic restart_o,
  input logic set_zero_i,
  input logic set_zero_o,
  input logic zero_q,
  input logic clear_faults_o,
  input logic kick_o,
  input logic armed_i,
  input logic input_scene,
  input logic misfit,
  input logic negative,
  input logic high,
  input logic lower,
  input logic at_least_hold_i,
  input logic derated_i,
  input logic testing_i,
  input logic written_q2
);
  parameter_taken:    cover property (@(posedge clk_i) disable iff (!rst_ni) tick_i && to_parameter_q && !refuses);
  parameter_refused:  cover property (@(posedge clk_i) disable iff (!rst_ni) tick_i && to_parameter_q && refuses);
  parameter_ramps:    cover property (@(posedge clk_i) disable iff (!rst_ni) tick_i && to_parameter_q && ramps && armed_i);
  control_held:       cover property (@(posedge clk_i) disable iff (!rst_ni) tick_i && to_control_q && holds);
  control_taken:      cover property (@(posedge clk_i) disable iff (!rst_ni) tick_i && to_control_q && !holds);
  nowhere:            cover property (@(posedge clk_i) disable iff (!rst_ni) reg_write_i && !at_parameter && !at_control && !at_command);
  write_while_busy:   cover property (@(posedge clk_i) disable iff (!rst_ni) reg_write_i && reg_busy_o);
  write_at_the_tick:  cover property (@(posedge clk_i) disable iff (!rst_ni) reg_write_i && !reg_busy_o && tick_i);
  busy_at_the_tick:   cover property (@(posedge clk_i) disable iff (!rst_ni) reg_write_i && reg_busy_o && tick_i);
  disarm_passes:      cover property (@(posedge clk_i) disable iff (!rst_ni) disarms && reg_busy_o);
  disarm_passes_arm:  cover property (@(posedge clk_i) disable iff (!rst_ni) tick_i && disarm_o && to_control_q);
  stop_passes:        cover property (@(posedge clk_i) disable iff (!rst_ni) stops && reg_busy_o);
  disarm_at_the_tick: cover property (@(posedge clk_i) disable iff (!rst_ni) disarms && tick_i);
  stop_at_the_tick:   cover property (@(posedge clk_i) disable iff (!rst_ni) stops && tick_i);
  stop_waits:         cover property (@(posedge clk_i) disable iff (!rst_ni) stop_o && tick_i);
  zero_by_pin:        cover property (@(posedge clk_i) disable iff (!rst_ni) tick_i && zero_q);
  zero_by_command:    cover property (@(posedge clk_i) disable iff (!rst_ni) set_zero_o && !zero_q);
  zero_at_the_tick:   cover property (@(posedge clk_i) disable iff (!rst_ni) set_zero_i && tick_i);
  zero_restarts:      cover property (@(posedge clk_i) disable iff (!rst_ni) set_zero_o && restart_o);
  zero_of_an_input:   cover property (@(posedge clk_i) disable iff (!rst_ni) set_zero_o && input_scene);
  clears:             cover property (@(posedge clk_i) disable iff (!rst_ni) clear_faults_o);
  kicks:              cover property (@(posedge clk_i) disable iff (!rst_ni) kick_o);
  kick_and_clear:     cover property (@(posedge clk_i) disable iff (!rst_ni) kick_o && clear_faults_o);
  command_waits:      cover property (@(posedge clk_i) disable iff (!rst_ni) to_command_q && !tick_i);
  high_gain:          cover property (@(posedge clk_i) disable iff (!rst_ni) high);
  eased_limit:        cover property (@(posedge clk_i) disable iff (!rst_ni) lower && at_least_hold_i);
  test_limit:         cover property (@(posedge clk_i) disable iff (!rst_ni) lower && !at_least_hold_i);
  test_above_eased:   cover property (@(posedge clk_i) disable iff (!rst_ni) testing_i && derated_i && !lower);
  saturates_up:       cover property (@(posedge clk_i) disable iff (!rst_ni) reg_write_i && misfit && !negative);
  saturates_down:     cover property (@(posedge clk_i) disable iff (!rst_ni) reg_write_i && misfit && negative);
  fetched_as_written: cover property (@(posedge clk_i) disable iff (!rst_ni) written_q2);
endmodule

bind registers registers_cover u_cover (
  .high(region_high_i && slot_fetch_i == LOW), .*);
`endif

`ifdef COVER_self_test
// self_test: each answer, each way that it ends, each direction.
module self_test_cover (
  input logic clk_i,
  input logic rst_ni,
  input logic armed_i,
  input logic direct_i,
  input logic turn,
  input logic wait_q,
  input logic first_q,
  input logic second_q,
  input logic rest_q,
  input logic still,
  input logic gives_up,
  input logic begins,
  input logic against,
  input logic failed,
  input logic over_q,
  input logic trip_o,
  input logic signed [2:0] net_q,
  input logic signed [2:0] net,
  input logic [feltgate_map_pkg::W_STATUS_SELF_TEST-1:0] result_o
);
  for (genvar n = 0; n < 4; n++) begin : g_result
    told: cover property (@(posedge clk_i) disable iff (!rst_ni) turn && result_o == 2'(n));
  end
  pulse_begins:        cover property (@(posedge clk_i) disable iff (!rst_ni) turn && armed_i && wait_q && begins);
  moved_in_the_wait:   cover property (@(posedge clk_i) disable iff (!rst_ni) turn && armed_i && wait_q && !still);
  gives_up_waiting:    cover property (@(posedge clk_i) disable iff (!rst_ni) turn && armed_i && wait_q && gives_up);
  against_in_first:    cover property (@(posedge clk_i) disable iff (!rst_ni) turn && armed_i && first_q && against);
  against_in_second:   cover property (@(posedge clk_i) disable iff (!rst_ni) turn && armed_i && second_q && against);
  answer_in_first:     cover property (@(posedge clk_i) disable iff (!rst_ni) turn && first_q && net != net_q && net == 3'sd2);
  answer_in_second:    cover property (@(posedge clk_i) disable iff (!rst_ni) turn && second_q && net != net_q && net == 3'sd2);
  back_and_forth:      cover property (@(posedge clk_i) disable iff (!rst_ni) turn && first_q && net_q == 3'sd1 && net == 3'sd0);
  late_first_count:    cover property (@(posedge clk_i) disable iff (!rst_ni) turn && second_q && net_q == 3'sd0 && !still);
  held:                cover property (@(posedge clk_i) disable iff (!rst_ni) turn && armed_i && failed);
  disarmed_in_wait:    cover property (@(posedge clk_i) disable iff (!rst_ni) turn && !armed_i && wait_q);
  disarmed_in_first:   cover property (@(posedge clk_i) disable iff (!rst_ni) turn && !armed_i && first_q);
  disarmed_in_second:  cover property (@(posedge clk_i) disable iff (!rst_ni) turn && !armed_i && second_q);
  trips:               cover property (@(posedge clk_i) disable iff (!rst_ni) trip_o);
  none_in_direct_mode: cover property (@(posedge clk_i) disable iff (!rst_ni) turn && !armed_i && direct_i && !over_q);
  none_without_pulse:  cover property (@(posedge clk_i) disable iff (!rst_ni) turn && !armed_i && !direct_i && over_q);
  rests:               cover property (@(posedge clk_i) disable iff (!rst_ni) turn && rest_q);
endmodule

bind self_test self_test_cover u_cover (.turn(at_self_test_turn_i), .*);
`endif

`ifdef COVER_supervisor
// supervisor: every cause trips, is the first, is cleared; causes that come together; the ends of the timers.
module supervisor_cover (
  input logic clk_i,
  input logic rst_ni,
  input logic tick_i,
  input logic request,
  input logic stop_i,
  input logic kick_i,
  input logic encoder_error_i,
  input logic encoder_trip,
  input logic forgive,
  input logic watchdog_trip,
  input logic i2t_trip,
  input logic stop_trip,
  input logic polarity_trip,
  input logic speed_trip,
  input logic clear_o,
  input logic any_trip,
  input logic may_arm,
  input logic arms,
  input logic counts,
  input logic waits,
  input logic in_time,
  input logic handed,
  input logic gates_enable_o,
  input logic unkicked_o,
  input logic full,
  input logic of_runaway,
  input logic cooled_negative,
  input logic [feltgate_map_pkg::W_FAULTS_SEEN-1:0] trip,
  input logic [feltgate_map_pkg::W_FAULTS_SEEN-1:0] faults_o,
  input logic [feltgate_map_pkg::W_FAULTS_FIRST-1:0] first_fault_o
);
  localparam int NONE = feltgate_map_pkg::FAULT_NONE;
  localparam int LAST = feltgate_map_pkg::FAULT_JUMP;

  logic none;
  assign none = 32'(first_fault_o) == NONE;
  for (genvar n = 1; n <= LAST; n++) begin : g_fault
    armed_trip:    cover property (@(posedge clk_i) disable iff (!rst_ni) trip[n] && gates_enable_o);
    first:         cover property (@(posedge clk_i) disable iff (!rst_ni) trip[n] && none);
    cleared:       cover property (@(posedge clk_i) disable iff (!rst_ni) clear_o && faults_o[n]);
    if (n != feltgate_map_pkg::FAULT_POLARITY && n != feltgate_map_pkg::FAULT_WATCHDOG) begin : g_any_time
      beside_first: cover property (@(posedge clk_i) disable iff (!rst_ni)
                                    trip[n] && !none && 32'(first_fault_o) != n);
    end
    // Clear and trip in one clock: the fault stands. The other causes have their clock of the wave.
    if (n == feltgate_map_pkg::FAULT_ENCODER || n == feltgate_map_pkg::FAULT_STOP ||
        n == feltgate_map_pkg::FAULT_TICK || n == feltgate_map_pkg::FAULT_WORD) begin : g_in_the_clear
      in_the_clear: cover property (@(posedge clk_i) disable iff (!rst_ni) clear_o && trip[n]);
    end
  end

  two_at_once:          cover property (@(posedge clk_i) disable iff (!rst_ni) (trip & (trip - 16'd1)) != '0);
  watchdog_with_stop:   cover property (@(posedge clk_i) disable iff (!rst_ni) watchdog_trip && stop_trip);
  i2t_with_stop:        cover property (@(posedge clk_i) disable iff (!rst_ni) i2t_trip && stop_trip);
  trip_at_a_tick:       cover property (@(posedge clk_i) disable iff (!rst_ni) any_trip && tick_i && gates_enable_o);
  trip_as_it_arms:      cover property (@(posedge clk_i) disable iff (!rst_ni) any_trip && tick_i && request && may_arm && !gates_enable_o);
  error_as_one_forgives: cover property (@(posedge clk_i) disable iff (!rst_ni) encoder_error_i && forgive && !encoder_trip);
  trip_as_one_forgives: cover property (@(posedge clk_i) disable iff (!rst_ni) encoder_trip && forgive);
  clear_while_asked:    cover property (@(posedge clk_i) disable iff (!rst_ni) tick_i && request && !none);
  arms_now:             cover property (@(posedge clk_i) disable iff (!rst_ni) tick_i && arms && !gates_enable_o);
  refused_by_level:     cover property (@(posedge clk_i) disable iff (!rst_ni) tick_i && request && !counts && !gates_enable_o && none);
  waits_now:            cover property (@(posedge clk_i) disable iff (!rst_ni) tick_i && waits);
  refused_by_time:      cover property (@(posedge clk_i) disable iff (!rst_ni) tick_i && request && counts && !in_time && !gates_enable_o && none);
  handed_while_armed:   cover property (@(posedge clk_i) disable iff (!rst_ni) tick_i && handed && gates_enable_o);
  disarms_now:          cover property (@(posedge clk_i) disable iff (!rst_ni) tick_i && !request && gates_enable_o);
  kicked_in_time:       cover property (@(posedge clk_i) disable iff (!rst_ni) tick_i && kick_i && gates_enable_o);
  kickless_to_the_end:  cover property (@(posedge clk_i) disable iff (!rst_ni) full && !of_runaway);
  cooled_below_0:       cover property (@(posedge clk_i) disable iff (!rst_ni) cooled_negative);
  speed_and_polarity:   cover property (@(posedge clk_i) disable iff (!rst_ni) polarity_trip || speed_trip);
  stop_between_clocks:  cover property (@(posedge stop_i) rst_ni && gates_enable_o);
  if (feltgate_pkg::REQUIRE_WATCHDOG != 0) begin : g_require
    arming_unkicked: cover property (@(posedge clk_i) disable iff (!rst_ni) tick_i && request && unkicked_o && counts && none);
  end
endmodule

bind supervisor supervisor_cover u_cover (
  .cooled_negative(param_is_i2t_budget_i && rest < 0), .*);  // the clock of EVENT_AT_COOLED
`endif

`default_nettype wire
