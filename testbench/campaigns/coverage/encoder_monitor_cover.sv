// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cover points of encoder_monitor: each way to a trip, each way that a row of edges ends.
// docs/testing.md
`default_nettype none

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

`default_nettype wire
