// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The device of a design with a port for each pin and signal, the same in all designs: what C++ sees
// of a Verilated core. A design without an option has its inputs unused, its outputs at rest.
// Documentation: docs/architecture.md

`default_nettype none

module feltgate_core #(
    parameter ParameterFile = ""
) (
    input  logic clk_i,
    input  logic rst_ni,

    // Encoder, motor
    input  logic enc_a_i,
    input  logic enc_b_i,
    input  logic enc_z_i,
    input  logic encoder_data_i,
    output logic encoder_select_no,
    output logic encoder_clock_o,
    output logic encoder_command_o,
    input  logic [2:0] hall_i,
    output logic gate_a_hi_o,
    output logic gate_a_lo_o,
    output logic gate_b_hi_o,
    output logic gate_b_lo_o,
    output logic gate_c_hi_o,
    output logic gate_c_lo_o,
    input  logic [1:0] current_data_i,
    output logic current_clock_o,
    output logic signed [cfg::CURRENT_W-1:0] current_o,  // A, measured
    input  logic driver_fault_i,
    output logic heartbeat_o,

    // Panel, program of the scene law, other axes
    input  logic       arm_i,
    input  logic       stop_i,
    input  logic       set_zero_i,
    input  logic [3:0] scene_i,
    input  logic signed [cfg::TORQUE_W-1:0] law_torque_i,
    input  logic law_late_i,
    input  logic law_restart_i,
    input  logic axis_fault_i,
    input  logic axis_silent_i,
    input  logic axis_blocked_i,
    input  logic axis_testing_i,
    input  logic axis_waits_i,
    output logic arm_request_o,
    output logic ready_o,
    output logic testing_o,
    output logic measured_o,
    output logic zeroed_o,

    // Register port
    input  logic [11:0] reg_addr_i,
    input  logic [31:0] reg_wdata_i,
    input  logic        reg_write_i,
    output logic        reg_busy_o,
    output logic [31:0] reg_rdata_o,

    // Results; with snapshot_valid_o high all belong to one tick
    output logic                                  snapshot_valid_o,
    output logic        [                   31:0] tick_count_o,
    output logic signed [                   31:0] position_o,
    output logic signed [    cfg::VELOCITY_W-1:0] velocity_o,
    output logic signed [      cfg::TORQUE_W-1:0] tau_hat_o,
    output logic signed [      cfg::TORQUE_W-1:0] tau_ref_o,
    output logic signed [     cfg::CURRENT_W-1:0] current_ref_o,
    output logic signed [     cfg::VOLTAGE_W-1:0] voltage_o,
    output logic signed [        cfg::DUTY_W-1:0] duty_o,
    output logic        [                    3:0] scene_o,
    output logic        [                   11:0] limits_o,
    output logic        [                   15:0] faults_o,
    output logic        [                    4:0] first_fault_o,
    output logic                                  armed_o,
    output logic signed [        cfg::DUTY_W-1:0] duty_active_o,
    output logic                                  gates_enable_o,
    output logic                                  word_valid_o,
    output logic        [                    5:0] word_slot_o,
    output logic        [                   31:0] word_data_o
);
  cfg::panel_t panel_i;
  cfg::law_t law_i;
  cfg::peers_t peers_i;
  cfg::tick_t tick_o;
  cfg::snapshot_t snapshot_o;
  cfg::safety_t safety_o;
  cfg::word_t word_o;
  assign panel_i = {arm_i, stop_i, set_zero_i, scene_i};
  assign law_i   = {law_torque_i, law_late_i, law_restart_i};
  assign peers_i = {axis_fault_i, axis_silent_i, axis_blocked_i, axis_testing_i, axis_waits_i};

  if (cfg::ABSOLUTE_ENCODER != 0 && cfg::PHASES == 3 && cfg::CURRENT_LOOP != 0) begin : gen_gimbal_current
    gimbal_current_top #(.ParameterFile(ParameterFile)) u_top (.*);
    assign current_o = u_top.bridge.current;
  end else if (cfg::ABSOLUTE_ENCODER != 0 && cfg::PHASES == 3) begin : gen_gimbal_motor
    gimbal_motor_top #(.ParameterFile(ParameterFile)) u_top (.*);
    assign {current_clock_o, current_o, heartbeat_o} = '0;
  end else if (cfg::ABSOLUTE_ENCODER != 0) begin : gen_lever_absolute
    lever_absolute_top #(.ParameterFile(ParameterFile)) u_top (.*);
    assign {gate_c_hi_o, gate_c_lo_o, current_clock_o, current_o, heartbeat_o} = '0;
  end else if (cfg::PHASES == 3) begin : gen_hall_motor
    hall_motor_top #(.ParameterFile(ParameterFile)) u_top (.*);
    assign {encoder_select_no, encoder_clock_o, encoder_command_o} = 3'b100;
    assign {current_clock_o, current_o, heartbeat_o} = '0;
  end else if (cfg::CURRENT_LOOP != 0) begin : gen_lever_current
    lever_current_top #(.ParameterFile(ParameterFile)) u_top (.current_data_i(current_data_i[0]), .*);
    assign current_o = u_top.bridge.current;
    assign {encoder_select_no, encoder_clock_o, encoder_command_o} = 3'b100;
    assign {gate_c_hi_o, gate_c_lo_o} = '0;
  end else begin : gen_lever
    lever_top #(.ParameterFile(ParameterFile)) u_top (.*);
    assign {encoder_select_no, encoder_clock_o, encoder_command_o} = 3'b100;
    assign {gate_c_hi_o, gate_c_lo_o, current_clock_o, current_o, heartbeat_o} = '0;
  end

  assign measured_o       = tick_o.tau_hat;
  assign snapshot_valid_o = tick_o.duty;
  assign tick_count_o     = tick_o.count;
  assign position_o       = snapshot_o.position;
  assign velocity_o       = snapshot_o.velocity;
  assign tau_hat_o        = snapshot_o.tau_hat;
  assign tau_ref_o        = snapshot_o.tau_ref;
  assign current_ref_o    = snapshot_o.current;
  assign voltage_o        = snapshot_o.voltage;
  assign duty_o           = snapshot_o.duty;
  assign scene_o          = snapshot_o.scene;
  assign limits_o         = snapshot_o.limits;
  assign faults_o         = safety_o.faults;
  assign first_fault_o    = safety_o.first_fault;
  assign armed_o          = safety_o.armed;
  assign gates_enable_o   = safety_o.gates_enable;
  assign arm_request_o    = safety_o.arm_request;
  assign ready_o          = safety_o.ready;
  assign testing_o        = safety_o.testing;
  assign word_valid_o     = word_o.valid;
  assign word_slot_o      = word_o.place;
  assign word_data_o      = word_o.data;
endmodule

`default_nettype wire
