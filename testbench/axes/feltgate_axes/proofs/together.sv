// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What three axes and the engine get of each other, and of panel and port, whatever they do.
`default_nettype none

module together_proof (
    input logic        clk_i,
    input logic        rst_ni,
    input logic [2:0]  enc_a_i,
    input logic [2:0]  enc_b_i,
    input logic [2:0]  enc_z_i,
    input logic        arm_i,
    input logic        stop_i,
    input logic [2:0]  set_zero_i,
    input logic [11:0] scene_i,
    input logic [15:0] addr_i,
    input logic [31:0] wdata_i,
    input logic        write_i,
    input logic        read_i
);
`include "reset.svh"
  logic busy;
  logic [31:0] rdata;
  logic [11:0] scene_o;
  logic [14:0] first_fault_o;
  logic [2:0] armed_o;
  feltgate_axes #(.AxisCount(3), .Engine(1)) u_dut (
      .clk_i(clk_i), .rst_ni(rst_ni), .enc_a_i(enc_a_i), .enc_b_i(enc_b_i), .enc_z_i(enc_z_i),
      .arm_i(arm_i), .stop_i(stop_i), .set_zero_i(set_zero_i), .scene_i(scene_i),
      .law_torque_i('0), .law_late_i(1'b0), .law_restart_i(1'b0),  // not used with an engine
      .reg_addr_i(addr_i), .reg_wdata_i(wdata_i), .reg_write_i(write_i), .reg_read_i(read_i),
      .reg_busy_o(busy), .reg_rdata_o(rdata), .scene_o(scene_o), .first_fault_o(first_fault_o), .armed_o(armed_o)
  );
  (* hierconn *) wire [4:0] \u_dut.g_axis[0].u_member.peers , \u_dut.g_axis[1].u_member.peers , \u_dut.g_axis[2].u_member.peers ;
  (* hierconn *) wire [6:0] \u_dut.g_axis[0].u_member.u_device.panel_i , \u_dut.g_axis[1].u_member.u_device.panel_i , \u_dut.g_axis[2].u_member.u_device.panel_i ;
  (* hierconn *) wire [cfg::TORQUE_W+1:0] \u_dut.g_axis[0].u_member.law , \u_dut.g_axis[1].u_member.law , \u_dut.g_axis[2].u_member.law ;
  (* hierconn *) wire \u_dut.g_axis[0].u_member.arm_request_o , \u_dut.g_axis[1].u_member.arm_request_o , \u_dut.g_axis[2].u_member.arm_request_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_member.ready_o , \u_dut.g_axis[1].u_member.ready_o , \u_dut.g_axis[2].u_member.ready_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_member.testing_o , \u_dut.g_axis[1].u_member.testing_o , \u_dut.g_axis[2].u_member.testing_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_member.armed_o , \u_dut.g_axis[1].u_member.armed_o , \u_dut.g_axis[2].u_member.armed_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_member.sample_o , \u_dut.g_axis[1].u_member.sample_o , \u_dut.g_axis[2].u_member.sample_o ;
  (* hierconn *) wire [4:0] \u_dut.g_axis[0].u_member.first_fault_o , \u_dut.g_axis[1].u_member.first_fault_o , \u_dut.g_axis[2].u_member.first_fault_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_member.u_device.reg_write_i , \u_dut.g_axis[1].u_member.u_device.reg_write_i , \u_dut.g_axis[2].u_member.u_device.reg_write_i ;
  (* hierconn *) wire \u_dut.g_axis[0].u_member.u_device.reg_busy_o , \u_dut.g_axis[1].u_member.u_device.reg_busy_o , \u_dut.g_axis[2].u_member.u_device.reg_busy_o ;
  (* hierconn *) wire [11:0] \u_dut.g_axis[0].u_member.u_device.reg_addr_i , \u_dut.g_axis[1].u_member.u_device.reg_addr_i , \u_dut.g_axis[2].u_member.u_device.reg_addr_i ;
  (* hierconn *) wire [31:0] \u_dut.g_axis[0].u_member.u_device.reg_wdata_i , \u_dut.g_axis[1].u_member.u_device.reg_wdata_i , \u_dut.g_axis[2].u_member.u_device.reg_wdata_i ;
  (* hierconn *) wire [31:0] \u_dut.g_axis[0].u_member.u_device.reg_rdata_o , \u_dut.g_axis[1].u_member.u_device.reg_rdata_o , \u_dut.g_axis[2].u_member.u_device.reg_rdata_o ;
  (* hierconn *) wire \u_dut.unchecked ;
  (* hierconn *) wire \u_dut.unfit ;
  (* hierconn *) wire \u_dut.engine_busy ;
  (* hierconn *) wire [31:0] \u_dut.engine_rdata ;
  (* hierconn *) wire \u_dut.law_late ;
  (* hierconn *) wire \u_dut.law_restart ;
  (* hierconn *) wire [2:0] \u_dut.g_engine.u_engine.law_i ;
  (* hierconn *) wire [2:0] \u_dut.g_engine.u_engine.arm_request_i ;
  (* hierconn *) wire [2:0] \u_dut.g_engine.u_engine.armed_i ;

  // Any one axis and what it gets; of all axes, axis n is bit n.
  (* anyconst *) logic [1:0] n;
  cfg::peers_t peers;
  cfg::panel_t panel;
  cfg::law_t law;
  logic [2:0] own, faults, requests, ready, testing, busies, armed;
  logic addressed, writes, sample, waits_q;
  logic [11:0] address;
  logic [31:0] data, words;
  assign own       = 3'd1 << n;
  assign addressed = addr_i[15:10] == {4'd0, n};
  assign faults    = {\u_dut.g_axis[2].u_member.first_fault_o != '0, \u_dut.g_axis[1].u_member.first_fault_o != '0, \u_dut.g_axis[0].u_member.first_fault_o != '0};
  assign requests = {\u_dut.g_axis[2].u_member.arm_request_o , \u_dut.g_axis[1].u_member.arm_request_o , \u_dut.g_axis[0].u_member.arm_request_o };
  assign ready = {\u_dut.g_axis[2].u_member.ready_o , \u_dut.g_axis[1].u_member.ready_o , \u_dut.g_axis[0].u_member.ready_o };
  assign testing = {\u_dut.g_axis[2].u_member.testing_o , \u_dut.g_axis[1].u_member.testing_o , \u_dut.g_axis[0].u_member.testing_o };
  assign armed = {\u_dut.g_axis[2].u_member.armed_o , \u_dut.g_axis[1].u_member.armed_o , \u_dut.g_axis[0].u_member.armed_o };
  assign busies    = { \u_dut.g_axis[2].u_member.u_device.reg_busy_o , \u_dut.g_axis[1].u_member.u_device.reg_busy_o , \u_dut.g_axis[0].u_member.u_device.reg_busy_o };
  assign words     = \u_dut.g_axis[2].u_member.u_device.reg_rdata_o | \u_dut.g_axis[1].u_member.u_device.reg_rdata_o | \u_dut.g_axis[0].u_member.u_device.reg_rdata_o ;
  always_comb begin
    assume (n <= 2'd2);
    case (n)
      2'd0: begin
        {peers, panel, law, sample} = { \u_dut.g_axis[0].u_member.peers , \u_dut.g_axis[0].u_member.u_device.panel_i , \u_dut.g_axis[0].u_member.law , \u_dut.g_axis[0].u_member.sample_o };
        {address, data, writes} = { \u_dut.g_axis[0].u_member.u_device.reg_addr_i , \u_dut.g_axis[0].u_member.u_device.reg_wdata_i , \u_dut.g_axis[0].u_member.u_device.reg_write_i };
      end
      2'd1: begin
        {peers, panel, law, sample} = { \u_dut.g_axis[1].u_member.peers , \u_dut.g_axis[1].u_member.u_device.panel_i , \u_dut.g_axis[1].u_member.law , \u_dut.g_axis[1].u_member.sample_o };
        {address, data, writes} = { \u_dut.g_axis[1].u_member.u_device.reg_addr_i , \u_dut.g_axis[1].u_member.u_device.reg_wdata_i , \u_dut.g_axis[1].u_member.u_device.reg_write_i };
      end
      default: begin
        {peers, panel, law, sample} = { \u_dut.g_axis[2].u_member.peers , \u_dut.g_axis[2].u_member.u_device.panel_i , \u_dut.g_axis[2].u_member.law , \u_dut.g_axis[2].u_member.sample_o };
        {address, data, writes} = { \u_dut.g_axis[2].u_member.u_device.reg_addr_i , \u_dut.g_axis[2].u_member.u_device.reg_wdata_i , \u_dut.g_axis[2].u_member.u_device.reg_write_i };
      end
    endcase
  end
  logic late_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {waits_q, late_q} <= 2'b00;
    else if (sample) {waits_q, late_q} <= {(testing & (own - 3'd1)) != 3'd0, \u_dut.law_late };
  end

  always_comb begin
    if (past_ok_q) begin
      any_fault_counts: assert (peers.fault == ((faults & ~own) != 3'd0));
      stop_for_all: assert (panel.stop == stop_i && panel.arm == arm_i && panel.set_zero == set_zero_i[n] &&
                            panel.scene == scene_i[4*n+:4]);
      arms_with_all: assert (peers.silent == ((~requests & ~own) != 3'd0 || \u_dut.unchecked ));
      ready_with_all: assert (peers.blocked == ((~ready & ~own) != 3'd0 || \u_dut.unfit ));
      tests_in_turn: assert (peers.waits == waits_q);
      nothing_beside_a_test: assert (peers.testing == ((testing & ~own) != 3'd0));
      late_for_all: assert (law.late == late_q && law.restart == \u_dut.law_restart );
      its_addresses: assert (address == {{2{!addressed}}, addr_i[9:0]} && writes == write_i && data == wdata_i);
      busy_if_addressed: assert (busy == ( \u_dut.engine_busy || (addr_i[15:10] < 6'd3 && busies[addr_i[11:10]])));
      word_of_all: assert (rdata == (words | \u_dut.engine_rdata ));
      engine_knows_the_axes: assert ( \u_dut.g_engine.u_engine.arm_request_i == requests && \u_dut.g_engine.u_engine.armed_i == armed &&
          \u_dut.g_engine.u_engine.law_i == {scene_o[11:8] == map::SCENE_LAW, scene_o[7:4] == map::SCENE_LAW, scene_o[3:0] == map::SCENE_LAW});
      told_of_each: assert (armed_o == armed && first_fault_o == {\u_dut.g_axis[2].u_member.first_fault_o , \u_dut.g_axis[1].u_member.first_fault_o , \u_dut.g_axis[0].u_member.first_fault_o });
      a_test: cover (testing[2] && !peers.waits && peers.testing);
      a_fault: cover (faults == 3'd4 && peers.fault);
    end
  end
endmodule

`default_nettype wire
