// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cover points of the core: each scene entered, at its torque limit, left; each fault while armed; each snapshot word read.
// docs/testing.md
`default_nettype none

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

`default_nettype wire
