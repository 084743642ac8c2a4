// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One to three cores as axes of one device, and the engine whose programs give their torques, if
// the design has one. The axes share tick and register port and arm together; a fault of one axis
// turns off the gates of all. In each vector, axis n is bit n, or the n-th part from below. All
// axes run in step; the timing is that of feltgate_core. docs/architecture.md

`default_nettype none

module feltgate_axes #(
    parameter int AxisCount = feltgate_pkg::AXES,
    parameter int Engine = feltgate_pkg::ENGINE,  // 0: programmed torque comes from the ports
    parameter int ReadBack = 1,    // as in feltgate_core
    parameter ParameterFile = "",  // as in feltgate_core, for all axes
    /* verilator lint_off UNUSEDPARAM */  // without an engine
    parameter ProgramContent = "", // as in axes_engine, also those below
    parameter DataContent = "",
    parameter TableContent = "",
    parameter logic [feltgate_engine_pkg::RESET_BITS-1:0] Reset = feltgate_engine_pkg::RESET_EMPTY
    /* verilator lint_on UNUSEDPARAM */
) (
    input  logic clk_i,
    input  logic rst_ni,

    // Encoders, motors
    input  logic [AxisCount-1:0] enc_a_i,
    input  logic [AxisCount-1:0] enc_b_i,
    input  logic [AxisCount-1:0] enc_z_i,
    output logic [AxisCount-1:0] gate_a_hi_o,
    output logic [AxisCount-1:0] gate_a_lo_o,
    output logic [AxisCount-1:0] gate_b_hi_o,
    output logic [AxisCount-1:0] gate_b_lo_o,
    output logic [AxisCount-1:0] gate_c_hi_o,  // of bridges with PHASES = 3; else 0
    output logic [AxisCount-1:0] gate_c_lo_o,
    input  logic [AxisCount-1:0] encoder_data_i,  // of absolute encoders, as in feltgate_core
    output logic [AxisCount-1:0] encoder_select_no,
    output logic [AxisCount-1:0] encoder_clock_o,
    output logic [AxisCount-1:0] encoder_command_o,

    // Panel
    input  logic                   arm_i,
    input  logic                   stop_i,
    input  logic [  AxisCount-1:0] set_zero_i,
    input  logic [4*AxisCount-1:0] scene_i,

    // Programmed torque, as in feltgate_core; not used if the design has an engine
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [AxisCount*feltgate_pkg::TORQUE_W-1:0] law_torque_i,
    input  logic                                        law_late_i,
    input  logic                                        law_restart_i,
    /* verilator lint_on UNUSEDSIGNAL */
    output logic                                        measured_o,

    // Register port: axis n at n * 0x400, the engine at feltgate_engine_pkg::PORT_FIRST
    input  logic [15:0] reg_addr_i,
    input  logic [31:0] reg_wdata_i,
    input  logic        reg_write_i,
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic        reg_read_i,  // one clock: the host has taken the word (engine's events)
    /* verilator lint_on UNUSEDSIGNAL */
    output logic        reg_busy_o,  // of the addressed axis or engine
    output logic [31:0] reg_rdata_o,

    // Events of programs
    output logic        event_valid_o,
    output logic [ 8:0] event_number_o,
    output logic [31:0] event_value_o,

    // Snapshots: with snapshot_valid_o high, all values belong to one tick
    output logic                                          snapshot_valid_o,
    output logic [                                  31:0] tick_count_o,
    output logic [                      AxisCount*32-1:0] position_o,
    output logic [AxisCount*feltgate_pkg::VELOCITY_W-1:0] velocity_o,
    output logic [  AxisCount*feltgate_pkg::TORQUE_W-1:0] tau_hat_o,
    output logic [  AxisCount*feltgate_pkg::TORQUE_W-1:0] tau_ref_o,
    output logic [ AxisCount*feltgate_pkg::CURRENT_W-1:0] current_ref_o,
    output logic [ AxisCount*feltgate_pkg::VOLTAGE_W-1:0] voltage_o,
    output logic [    AxisCount*feltgate_pkg::DUTY_W-1:0] duty_o,
    output logic [                       AxisCount*4-1:0] scene_o,
    output logic [AxisCount*feltgate_map_pkg::W_STATUS_LIMITS-1:0] limits_o,
    output logic [  AxisCount*feltgate_map_pkg::W_FAULTS_SEEN-1:0] faults_o,
    output logic [ AxisCount*feltgate_map_pkg::W_FAULTS_FIRST-1:0] first_fault_o,
    output logic [                         AxisCount-1:0] armed_o,
    output logic [    AxisCount*feltgate_pkg::DUTY_W-1:0] duty_active_o,
    output logic [                         AxisCount-1:0] gates_enable_o,
    output logic [                         AxisCount-1:0] zeroed_o,

    // The snapshot's words, one at a time
    output logic                    word_valid_o,
    output logic [             5:0] word_slot_o,
    output logic [AxisCount*32-1:0] word_data_o
);
  localparam int FirstW = feltgate_map_pkg::W_FAULTS_FIRST;
  generate
  if (AxisCount < 1 || AxisCount > 3) begin : g_check_axes
    AXES_must_be_1_to_3 missing ();
  end
  endgenerate

  // State of each axis. All of these except arm_requests come from registers.
  logic [AxisCount-1:0] arm_requests, ready, testing, faulty;

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

  // All axes are in step, so common signals come from axis 0.
  logic [AxisCount-1:0] snapshot_valid, word_valid, measured;
  logic [5:0] word_slot[AxisCount];
  logic [31:0] tick_count[AxisCount];
  assign snapshot_valid_o = snapshot_valid[0];
  assign word_valid_o     = word_valid[0];
  assign measured_o       = measured[0];
  assign word_slot_o      = word_slot[0];
  assign tick_count_o     = tick_count[0];

  // Signals from and to the engine.
  localparam int TorqueW = feltgate_pkg::TORQUE_W;
  logic [AxisCount*TorqueW-1:0] law_torque;
  logic [AxisCount-1:0] in_law;
  logic law_late, law_restart, unchecked, unfit;
  logic [AxisCount-1:0] current_clock, heartbeat;  // no axis has a current loop
  logic [19*AxisCount-1:0] current;

  generate
  genvar n;
  for (n = 0; n < AxisCount; n = n + 1) begin : g_axis
    localparam logic [AxisCount-1:0] Own = AxisCount'(1) << n;
    localparam logic [AxisCount-1:0] Before = Own - AxisCount'(1);
    assign addressed[n] = reg_addr_i[15:10] == 6'(n);
    assign faulty[n]    = first_fault_o[n*FirstW+:FirstW] != '0;
    assign in_law[n]    = scene_o[4*n+:4] == feltgate_map_pkg::SCENE_LAW;

    feltgate_core #(.ReadBack(ReadBack), .ParameterFile(ParameterFile)) u_core (
        .clk_i(clk_i), .rst_ni(rst_ni),
        .enc_a_i(enc_a_i[n]), .enc_b_i(enc_b_i[n]), .enc_z_i(enc_z_i[n]),
        .gate_a_hi_o(gate_a_hi_o[n]), .gate_a_lo_o(gate_a_lo_o[n]),
        .gate_b_hi_o(gate_b_hi_o[n]), .gate_b_lo_o(gate_b_lo_o[n]),
        .gate_c_hi_o(gate_c_hi_o[n]), .gate_c_lo_o(gate_c_lo_o[n]),
        .encoder_data_i(encoder_data_i[n]), .encoder_select_no(encoder_select_no[n]),
        .encoder_clock_o(encoder_clock_o[n]), .encoder_command_o(encoder_command_o[n]),
        .hall_i(3'b000), .current_data_i(1'b0), .current_clock_o(current_clock[n]), .current_o(current[19*n+:19]),
        .driver_fault_i(1'b0), .heartbeat_o(heartbeat[n]),
        .arm_i(arm_i), .stop_i(stop_i), .set_zero_i(set_zero_i[n]), .scene_i(scene_i[4*n+:4]),
        .law_torque_i(law_torque[n*TorqueW+:TorqueW]),
        .law_late_i(law_late), .law_restart_i(law_restart),
        .axis_fault_i(|(faulty & ~Own)),
        .axis_silent_i(!(&(arm_requests | Own)) || unchecked),
        .axis_blocked_i(!(&(ready | Own)) || unfit),
        .axis_testing_i(|(testing & ~Own)),
        .axis_waits_i(|(testing & Before)),
        .arm_request_o(arm_requests[n]), .ready_o(ready[n]), .testing_o(testing[n]),
        .measured_o(measured[n]), .zeroed_o(zeroed_o[n]),
        .reg_addr_i({{2{!addressed[n]}}, reg_addr_i[9:0]}),
        .reg_wdata_i(reg_wdata_i), .reg_write_i(reg_write_i),
        .reg_busy_o(busy[n]), .reg_rdata_o(rdata[n]),
        .snapshot_valid_o(snapshot_valid[n]),
        .tick_count_o(tick_count[n]),
        .position_o(position_o[32*n+:32]),
        .velocity_o(velocity_o[n*feltgate_pkg::VELOCITY_W+:feltgate_pkg::VELOCITY_W]),
        .tau_hat_o(tau_hat_o[n*feltgate_pkg::TORQUE_W+:feltgate_pkg::TORQUE_W]),
        .tau_ref_o(tau_ref_o[n*feltgate_pkg::TORQUE_W+:feltgate_pkg::TORQUE_W]),
        .current_ref_o(current_ref_o[n*feltgate_pkg::CURRENT_W+:feltgate_pkg::CURRENT_W]),
        .voltage_o(voltage_o[n*feltgate_pkg::VOLTAGE_W+:feltgate_pkg::VOLTAGE_W]),
        .duty_o(duty_o[n*feltgate_pkg::DUTY_W+:feltgate_pkg::DUTY_W]),
        .scene_o(scene_o[4*n+:4]),
        .limits_o(limits_o[n*feltgate_map_pkg::W_STATUS_LIMITS+:feltgate_map_pkg::W_STATUS_LIMITS]),
        .faults_o(faults_o[n*feltgate_map_pkg::W_FAULTS_SEEN+:feltgate_map_pkg::W_FAULTS_SEEN]),
        .first_fault_o(first_fault_o[n*FirstW+:FirstW]),
        .armed_o(armed_o[n]),
        .duty_active_o(duty_active_o[n*feltgate_pkg::DUTY_W+:feltgate_pkg::DUTY_W]),
        .gates_enable_o(gates_enable_o[n]),
        .word_valid_o(word_valid[n]), .word_slot_o(word_slot[n]), .word_data_o(word_data_o[32*n+:32])
    );
  end
  endgenerate

  generate
  if (Engine != 0) begin : g_engine
    logic [32*AxisCount-1:0] velocity, tau_hat;
    for (n = 0; n < AxisCount; n = n + 1) begin : g_inputs
      assign velocity[32*n+:32] = 32'($signed(velocity_o[n*feltgate_pkg::VELOCITY_W+:feltgate_pkg::VELOCITY_W]));
      assign tau_hat[32*n+:32]  = 32'($signed(tau_hat_o[n*TorqueW+:TorqueW]));
    end
    axes_engine #(
        .AxisCount(AxisCount),
        .ProgramContent(ProgramContent), .DataContent(DataContent), .TableContent(TableContent), .Reset(Reset)
    ) u_engine (
        .clk_i(clk_i), .rst_ni(rst_ni),
        .law_i(in_law), .arm_request_i(arm_requests), .armed_i(armed_o), .zeroed_i(zeroed_o),
        .snapshot_i(snapshot_valid_o), .measured_i(measured_o), .tick_count_i(tick_count_o),
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

  logic unused;
  always_comb begin
    unused = ^{snapshot_valid, word_valid, measured, in_law, current_clock, heartbeat, current};
    for (int k = 0; k < AxisCount; k++) unused = unused ^ (^{word_slot[k], tick_count[k]});
  end
endmodule

`default_nettype wire
