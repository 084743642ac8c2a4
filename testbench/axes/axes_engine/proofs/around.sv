// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What stands between the engine and two axes, whatever the engine does: of it only the ports are read.
`default_nettype none

module around_proof (
    input logic        clk_i,
    input logic        rst_ni,
    input logic [ 1:0] law_i,
    input logic [ 1:0] arm_request_i,
    input logic [ 1:0] armed_i,
    input logic [ 1:0] zeroed_i,
    input logic        sample_i,
    input logic        last_i,
    input logic        measured_i,
    input logic [31:0] tick_count_i,
    input logic [63:0] position_i,
    input logic [63:0] velocity_i,
    input logic [63:0] tau_hat_i,
    input logic [15:0] addr_i,
    input logic [31:0] wdata_i,
    input logic        write_i,
    input logic        read_i
);
  localparam int TorqueW = 2 * cfg::TORQUE_W;

`include "reset.svh"

  logic [TorqueW-1:0] torque;
  logic late, restart, unchecked, unfit, busy, event_valid;
  logic [31:0] rdata, event_value;
  logic [ 8:0] event_number;
  axes_engine #(.AxisCount(2)) u_dut (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .law_i(law_i), .arm_request_i(arm_request_i), .armed_i(armed_i), .zeroed_i(zeroed_i),
      .last_i(last_i), .sample_i(sample_i), .measured_i(measured_i), .tick_count_i(tick_count_i),
      .position_i(position_i), .velocity_i(velocity_i), .tau_hat_i(tau_hat_i),
      .torque_o(torque), .late_o(late), .restart_o(restart), .unchecked_o(unchecked), .unfit_o(unfit),
      .reg_addr_i(addr_i), .reg_wdata_i(wdata_i), .reg_write_i(write_i), .reg_read_i(read_i),
      .reg_busy_o(busy), .reg_rdata_o(rdata),
      .event_valid_o(event_valid), .event_number_o(event_number), .event_value_o(event_value)
  );
  (* hierconn *) wire [TorqueW-1:0] \u_dut.u_engine.torque_o ;
  (* hierconn *) wire \u_dut.u_engine.armed_i ;
  (* hierconn *) wire \u_dut.u_engine.enter_i ;
  (* hierconn *) wire \u_dut.u_engine.locked_i ;
  (* hierconn *) wire \u_dut.u_engine.tick_i ;
  (* hierconn *) wire [31:0] \u_dut.u_engine.tick_count_i ;
  (* hierconn *) wire [63:0] \u_dut.u_engine.position_i ;
  (* hierconn *) wire [63:0] \u_dut.u_engine.velocity_i ;
  (* hierconn *) wire [63:0] \u_dut.u_engine.tau_hat_i ;
  (* hierconn *) wire \u_dut.u_engine.fresh_o ;
  (* hierconn *) wire \u_dut.u_engine.late_o ;
  (* hierconn *) wire \u_dut.u_engine.changed_o ;
  (* hierconn *) wire \u_dut.u_engine.crc_start_i ;
  (* hierconn *) wire \u_dut.u_engine.crc_done_o ;
  (* hierconn *) wire \u_dut.u_engine.crc_good_o ;
  (* hierconn *) wire \u_dut.u_engine.event_valid_o ;
  (* hierconn *) wire [8:0] \u_dut.u_engine.event_number_o ;
  (* hierconn *) wire [31:0] \u_dut.u_engine.event_value_o ;
  (* hierconn *) wire [11:0] \u_dut.u_engine.addr_i ;
  (* hierconn *) wire [31:0] \u_dut.u_engine.wdata_i ;
  (* hierconn *) wire \u_dut.u_engine.write_i ;
  (* hierconn *) wire \u_dut.u_engine.read_i ;
  (* hierconn *) wire [31:0] \u_dut.u_engine.rdata_o ;
  (* hierconn *) wire \u_dut.u_engine.busy_o ;
  (* hierconn *) wire \u_dut.checks_q ;
  (* hierconn *) wire \u_dut.check_of_these_q ;
  (* hierconn *) wire \u_dut.checked_q ;
  (* hierconn *) wire \u_dut.law_any_q ;
  (* hierconn *) wire \u_dut.armed_q ;
  (* hierconn *) wire [1:0] \u_dut.runs_q ;
  (* hierconn *) wire \u_dut.taken_q ;
  wire starts = \u_dut.u_engine.crc_start_i ;
  wire done = \u_dut.u_engine.crc_done_o ;
  wire good = \u_dut.u_engine.crc_good_o ;
  wire fresh = \u_dut.u_engine.fresh_o ;

  // The computation that runs, and whether one began and ended since the end of a tick at which an axis did not ask.
  logic runs_q, begun_q, checked_q, told_q, withdrawn;  // told: since then the axes have taken late_o
  assign withdrawn = last_i && arm_request_i != 2'b11;
  // What makes the torque jump, the runs that ended since, and whether their torque was taken.
  logic in_law_q, was_armed_q, jumps, open_q;
  logic [1:0] ended_q;
  assign jumps = (law_i != '0 && !in_law_q) || (armed_i != '0 && !was_armed_q) || zeroed_i != '0 || \u_dut.u_engine.changed_o ;
  logic ours, after_q;
  logic [31:0] word_then_q;
  assign ours = addr_i[15:12] == 4'(feltgate_engine_pkg::PORT_FIRST >> 12);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {runs_q, begun_q, checked_q, told_q, in_law_q, was_armed_q, open_q, after_q} <= '0;
      ended_q <= 2'd0;
    end else begin
      after_q <= 1'b1;
      if (done) runs_q <= 1'b0;
      if (starts) runs_q <= 1'b1;
      if (starts) begun_q <= 1'b1;
      if (done && begun_q) checked_q <= 1'b1;
      if (checked_q && sample_i) told_q <= 1'b1;
      if (withdrawn) {begun_q, checked_q, told_q} <= 3'b000;
      in_law_q    <= law_i != '0;
      was_armed_q <= armed_i != '0;
      if (jumps) begin
        open_q  <= 1'b1;
        ended_q <= 2'd0;
      end else if (open_q) begin
        if (fresh && ended_q != 2'd2) ended_q <= ended_q + 2'd1;
        if (ended_q == 2'd2 && sample_i) open_q <= 1'b0;
      end
    end
  end
  always_ff @(posedge clk_i) word_then_q <= ours ? \u_dut.u_engine.rdata_o : '0;

  always_comb begin
    if (past_ok_q && rst_ni) begin
      checked_since_asked: assert (unchecked || (checked_q && told_q));
      every_request_is_checked: assert (starts == (last_i && arm_request_i == 2'b11 && !checked_q && !runs_q));
      unfit_in_laws: assert (unfit == (law_i != '0 && checked_q && !good));
      no_torque_unchecked: assert (late == (\u_dut.u_engine.late_o || !good));
      locked_while_it_counts: assert (\u_dut.u_engine.locked_i == (armed_i != '0 || arm_request_i == 2'b11 || runs_q));
      jumps_until_sampled: assert (restart == open_q);
      any_axis_is_heard: assert (\u_dut.u_engine.armed_i == (armed_i != '0) && \u_dut.u_engine.enter_i == (law_i != '0 && !in_law_q));
      inputs_pass: assert (\u_dut.u_engine.tick_i == measured_i && \u_dut.u_engine.tick_count_i == tick_count_i &&
                           {\u_dut.u_engine.position_i , \u_dut.u_engine.velocity_i , \u_dut.u_engine.tau_hat_i } == {position_i, velocity_i, tau_hat_i});
      outputs_pass: assert (torque == \u_dut.u_engine.torque_o &&
          {event_valid, event_number, event_value} == {\u_dut.u_engine.event_valid_o , \u_dut.u_engine.event_number_o , \u_dut.u_engine.event_value_o });
      only_its_addresses: assert (\u_dut.u_engine.write_i == (write_i && ours) && \u_dut.u_engine.read_i == (read_i && ours) &&
          \u_dut.u_engine.wdata_i == wdata_i && \u_dut.u_engine.addr_i == addr_i[11:0] && busy == (ours && \u_dut.u_engine.busy_o ));
      read_of_its_addresses: assert (!after_q || rdata == word_then_q);
      inside_check: assert (\u_dut.checks_q == runs_q && \u_dut.check_of_these_q == begun_q && \u_dut.checked_q == checked_q && unchecked == !told_q && (checked_q || !told_q));
      inside_past: assert (\u_dut.law_any_q == in_law_q && \u_dut.armed_q == was_armed_q && ended_q != 2'd3);
      inside_runs: assert (\u_dut.runs_q == (open_q ? 2'd2 - ended_q : 2'd0) && (!\u_dut.taken_q || !open_q || ended_q != 2'd2 || restart));
      is_checked: cover (!unchecked);
      jump_ends: cover (after_q && ended_q == 2'd2 && !open_q);
    end
  end
endmodule

`default_nettype wire
