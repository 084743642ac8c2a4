// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cover points of self_test: each answer, each way that it ends, each direction.
// docs/testing.md
`default_nettype none

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

`default_nettype wire
