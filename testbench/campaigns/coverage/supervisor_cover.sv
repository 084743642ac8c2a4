// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cover points of supervisor: every cause trips, is the first, is cleared; causes that come together; the ends of the timers.
// docs/testing.md
`default_nettype none

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

`default_nettype wire
