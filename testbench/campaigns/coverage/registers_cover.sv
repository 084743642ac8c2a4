// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cover points of registers: each kind of write, what passes one that waits, what is refused, coincidences at the tick.
// docs/testing.md
`default_nettype none

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

`default_nettype wire
