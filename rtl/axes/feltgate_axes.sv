// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One to three devices as axes of one, and the engine whose programs give their torques, if the
// design has one. The axes share tick and register port and arm together; a fault of one axis turns
// off the gates of all. In each vector, axis n is bit n, or the n-th part from below.
// docs/architecture.md

`default_nettype none
`include "device.svh"

module feltgate_axes #(
    parameter int AxisCount = cfg::AXES,
    parameter int Engine = cfg::ENGINE,  // 0: programmed torque comes from the ports
    parameter ParameterFile = "",  // as in axis, for all axes
    /* verilator lint_off UNUSEDPARAM */  // without an engine
    parameter ProgramContent = "", // as in axes_engine, also those below
    parameter DataContent = "",
    parameter TableContent = "",
    parameter logic [feltgate_engine_pkg::RESET_BITS-1:0] Reset = feltgate_engine_pkg::RESET_EMPTY
    /* verilator lint_on UNUSEDPARAM */
) (
    input  logic clk_i,
    input  logic rst_ni,
    `PINS(logic [AxisCount-1:0]),

    // Panel
    input  logic                   arm_i,
    input  logic                   stop_i,
    input  logic [  AxisCount-1:0] set_zero_i,
    input  logic [4*AxisCount-1:0] scene_i,

    // Programmed torque, sampled with the position; not used if the design has an engine
    input  logic [AxisCount*cfg::TORQUE_W-1:0] law_torque_i,
    input  logic                               law_late_i,
    input  logic                               law_restart_i,
    output logic                               measured_o,

    // Register port: axis n at n * 0x400, the engine at feltgate_engine_pkg::PORT_FIRST
    input  logic [15:0] reg_addr_i,
    input  logic [31:0] reg_wdata_i,
    input  logic        reg_write_i,
    input  logic        reg_read_i,  // one clock: the host has taken the word (engine's events)
    output logic        reg_busy_o,  // of the addressed axis or engine
    output logic [31:0] reg_rdata_o,

    // Events of programs
    output logic        event_valid_o,
    output logic [ 8:0] event_number_o,
    output logic [31:0] event_value_o,

    // Snapshots: with snapshot_valid_o high, all values belong to one tick, whose last clock is last_o
    output logic                                 snapshot_valid_o,
    output logic                                 last_o,
    output logic [                         31:0] tick_count_o,
    output logic [             AxisCount*32-1:0] position_o,
    output logic [AxisCount*cfg::VELOCITY_W-1:0] velocity_o,
    output logic [  AxisCount*cfg::TORQUE_W-1:0] tau_hat_o,
    output logic [  AxisCount*cfg::TORQUE_W-1:0] tau_ref_o,
    output logic [ AxisCount*cfg::CURRENT_W-1:0] current_ref_o,
    output logic [ AxisCount*cfg::VOLTAGE_W-1:0] voltage_o,
    output logic [    AxisCount*cfg::DUTY_W-1:0] duty_o,
    output logic [              AxisCount*4-1:0] scene_o,
    output logic [             AxisCount*12-1:0] limits_o,
    output logic [             AxisCount*16-1:0] faults_o,
    output logic [              AxisCount*5-1:0] first_fault_o,
    output logic [                AxisCount-1:0] armed_o,
    output logic [    AxisCount*cfg::DUTY_W-1:0] duty_active_o,
    output logic [                AxisCount-1:0] gates_enable_o,
    output logic [                AxisCount-1:0] zeroed_o,

    // The snapshots' words, of each axis one at a time; all of a tick come before its last clock
    output logic [   AxisCount-1:0] word_valid_o,
    output logic [ 6*AxisCount-1:0] word_slot_o,
    output logic [32*AxisCount-1:0] word_data_o
);
  generate
  if (AxisCount < 1 || AxisCount > 3) begin : g_check_axes
    AXES_must_be_1_to_3 missing ();
  end
  endgenerate

  // Register port. An axis that is not addressed gets an address without a word, which reads 0, so
  // an OR combines the read data.
  logic [AxisCount-1:0] busy, addressed;
  logic [31:0] rdata[AxisCount];
  logic engine_busy;  // only if it is addressed
  logic [31:0] engine_rdata;
  assign reg_busy_o = |(busy & addressed) || engine_busy;
  always_comb begin
    reg_rdata_o = engine_rdata;
    for (int k = 0; k < AxisCount; k++) reg_rdata_o = reg_rdata_o | rdata[k];
  end

  // State of each axis for the others. The axes are in step up to tau_hat: of these signals those of
  // axis 0. A scene may take longer than that of another axis, so a snapshot waits for all duties.
  localparam int TorqueW = cfg::TORQUE_W;
  logic [AxisCount-1:0] arm_requests, ready, testing, sample, measured, last, duty_valid, done_q;
  logic [31:0] tick_count[AxisCount];
  logic [AxisCount*TorqueW-1:0] law_torque;
  logic law_late, law_restart, unchecked, unfit;
  assign measured_o       = measured[0];
  assign last_o           = last[0];
  assign tick_count_o     = tick_count[0];
  assign snapshot_valid_o = |duty_valid && &(done_q | duty_valid);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) done_q <= '0;
    else         done_q <= last_o ? '0 : done_q | duty_valid;
  end

  generate
  genvar n;
  for (n = 0; n < AxisCount; n = n + 1) begin : g_axis
    assign addressed[n] = reg_addr_i[15:10] == 6'(n);
    axes_member #(.AxisCount(AxisCount), .Number(n), .ParameterFile(ParameterFile)) u_member (
        .clk_i(clk_i), .rst_ni(rst_ni), `PINS_OF(n),
        .arm_i(arm_i), .stop_i(stop_i), .set_zero_i(set_zero_i[n]), .scene_i(scene_i[4*n+:4]),
        .law_torque_i(law_torque[n*TorqueW+:TorqueW]), .law_late_i(law_late), .law_restart_i(law_restart),
        .unchecked_i(unchecked), .unfit_i(unfit), .first_faults_i(first_fault_o),
        .arm_requests_i(arm_requests), .ready_i(ready), .testing_i(testing),
        .arm_request_o(arm_requests[n]), .ready_o(ready[n]), .testing_o(testing[n]),
        .reg_addr_i({{2{!addressed[n]}}, reg_addr_i[9:0]}), .reg_wdata_i(reg_wdata_i), .reg_write_i(reg_write_i),
        .reg_busy_o(busy[n]), .reg_rdata_o(rdata[n]),
        .sample_o(sample[n]), .measured_o(measured[n]), .duty_valid_o(duty_valid[n]), .last_o(last[n]),
        .tick_count_o(tick_count[n]), .zeroed_o(zeroed_o[n]),
        .position_o(position_o[32*n+:32]), .velocity_o(velocity_o[n*cfg::VELOCITY_W+:cfg::VELOCITY_W]),
        .tau_hat_o(tau_hat_o[n*TorqueW+:TorqueW]), .tau_ref_o(tau_ref_o[n*TorqueW+:TorqueW]),
        .current_ref_o(current_ref_o[n*cfg::CURRENT_W+:cfg::CURRENT_W]),
        .voltage_o(voltage_o[n*cfg::VOLTAGE_W+:cfg::VOLTAGE_W]), .duty_o(duty_o[n*cfg::DUTY_W+:cfg::DUTY_W]),
        .scene_o(scene_o[4*n+:4]), .limits_o(limits_o[12*n+:12]), .faults_o(faults_o[16*n+:16]),
        .first_fault_o(first_fault_o[5*n+:5]), .armed_o(armed_o[n]), .gates_enable_o(gates_enable_o[n]),
        .duty_active_o(duty_active_o[n*cfg::DUTY_W+:cfg::DUTY_W]),
        .word_valid_o(word_valid_o[n]), .word_slot_o(word_slot_o[6*n+:6]), .word_data_o(word_data_o[32*n+:32])
    );
  end

  if (Engine != 0) begin : g_engine
    logic [AxisCount-1:0] in_law;
    logic [32*AxisCount-1:0] velocity, tau_hat;
    for (n = 0; n < AxisCount; n = n + 1) begin : g_inputs
      assign in_law[n]          = scene_o[4*n+:4] == map::SCENE_LAW;
      assign velocity[32*n+:32] = 32'($signed(velocity_o[n*cfg::VELOCITY_W+:cfg::VELOCITY_W]));
      assign tau_hat[32*n+:32]  = 32'($signed(tau_hat_o[n*TorqueW+:TorqueW]));
    end
    axes_engine #(
        .AxisCount(AxisCount),
        .ProgramContent(ProgramContent), .DataContent(DataContent), .TableContent(TableContent), .Reset(Reset)
    ) u_engine (
        .clk_i(clk_i), .rst_ni(rst_ni),
        .law_i(in_law), .arm_request_i(arm_requests), .armed_i(armed_o), .zeroed_i(zeroed_o),
        .sample_i(sample[0]), .measured_i(measured_o), .last_i(last_o), .tick_count_i(tick_count_o),
        .position_i(position_o), .velocity_i(velocity), .tau_hat_i(tau_hat),
        .torque_o(law_torque), .late_o(law_late), .restart_o(law_restart),
        .unchecked_o(unchecked), .unfit_o(unfit),
        .reg_addr_i(reg_addr_i), .reg_wdata_i(reg_wdata_i), .reg_write_i(reg_write_i), .reg_read_i(reg_read_i),
        .reg_busy_o(engine_busy), .reg_rdata_o(engine_rdata),
        .event_valid_o(event_valid_o), .event_number_o(event_number_o), .event_value_o(event_value_o)
    );
  end else begin : g_no_engine
    assign law_torque     = law_torque_i;
    assign law_late       = law_late_i;
    assign law_restart    = law_restart_i;
    assign unchecked      = 1'b0;
    assign unfit          = 1'b0;
    assign engine_busy    = 1'b0;
    assign engine_rdata   = '0;
    assign event_valid_o  = 1'b0;
    assign event_number_o = '0;
    assign event_value_o  = '0;
  end
  endgenerate
endmodule

`default_nettype wire
