// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cover points of hold_timer: it eases, is relieved by an edge and by disarming, and never does where it is off.
// docs/testing.md
`default_nettype none

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

`default_nettype wire
