// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One axis of several, or beside an engine: a device, and what it takes of the others. The program's
// torque and whether an axis before tests itself are sampled with the position, and hold for a tick.
// docs/architecture.md

`default_nettype none
`include "device.svh"

module axes_member #(
    parameter int AxisCount = 1,
    parameter int Number = 0,      // of this axis
    parameter ParameterFile = ""
) (
    input  logic clk_i,
    input  logic rst_ni,
    `PINS(logic),
    // Panel
    input  logic       arm_i,
    input  logic       stop_i,
    input  logic       set_zero_i,
    input  logic [3:0] scene_i,
    // Program
    input  logic signed [cfg::TORQUE_W-1:0] law_torque_i,
    input  logic       law_late_i,
    input  logic       law_restart_i,
    input  logic       unchecked_i,  // arming waits for the program's CRC
    input  logic       unfit_i,      // the program's CRC is wrong
    // All axes, and this one
    input  logic [5*AxisCount-1:0] first_faults_i,
    input  logic [  AxisCount-1:0] arm_requests_i,
    input  logic [  AxisCount-1:0] ready_i,
    input  logic [  AxisCount-1:0] testing_i,
    output logic        arm_request_o,
    output logic        ready_o,
    output logic        testing_o,
    // Register port
    input  logic [11:0] reg_addr_i,
    input  logic [31:0] reg_wdata_i,
    input  logic        reg_write_i,
    output logic        reg_busy_o,
    output logic [31:0] reg_rdata_o,
    // Results, as in feltgate_axes
    output logic        sample_o,
    output logic        measured_o,
    output logic        duty_valid_o,
    output logic        last_o,
    output logic [31:0] tick_count_o,
    output logic        zeroed_o,
    output logic [31:0] position_o,
    output logic [cfg::VELOCITY_W-1:0] velocity_o,
    output logic [cfg::TORQUE_W-1:0]   tau_hat_o,
    output logic [cfg::TORQUE_W-1:0]   tau_ref_o,
    output logic [cfg::CURRENT_W-1:0]  current_ref_o,
    output logic [cfg::VOLTAGE_W-1:0]  voltage_o,
    output logic [cfg::DUTY_W-1:0]     duty_o,
    output logic [ 3:0] scene_o,
    output logic [11:0] limits_o,
    output logic [15:0] faults_o,
    output logic [ 4:0] first_fault_o,
    output logic        armed_o,
    output logic        gates_enable_o,
    output logic signed [cfg::DUTY_W-1:0] duty_active_o,
    output logic        word_valid_o,
    output logic [ 5:0] word_slot_o,
    output logic [31:0] word_data_o
);
  localparam logic [AxisCount-1:0] Own = AxisCount'(1) << Number;
  localparam logic [AxisCount-1:0] Before = Own - AxisCount'(1);
  cfg::law_t law;
  cfg::peers_t peers;
  cfg::tick_t tick;
  cfg::snapshot_t snapshot;
  cfg::safety_t safe;
  cfg::word_t word;

  logic signed [cfg::TORQUE_W-1:0] torque_q;
  logic late_q, waits_q;
  logic [AxisCount-1:0] faulty;
  always_comb for (int k = 0; k < AxisCount; k++) faulty[k] = first_faults_i[5*k+:5] != '0;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)          {torque_q, late_q, waits_q} <= '0;
    else if (tick.sample) {torque_q, late_q, waits_q} <= {law_torque_i, law_late_i, |(testing_i & Before)};
  end
  assign law           = {torque_q, late_q, law_restart_i};
  assign peers.fault   = |(faulty & ~Own);
  assign peers.silent  = !(&(arm_requests_i | Own)) || unchecked_i;
  assign peers.blocked = !(&(ready_i | Own)) || unfit_i;
  assign peers.testing = |(testing_i & ~Own);
  assign peers.waits   = waits_q;

  `DEVICE #(.ParameterFile(ParameterFile)) u_device (
      .panel_i({arm_i, stop_i, set_zero_i, scene_i}), .law_i(law), .peers_i(peers),
      .tick_o(tick), .snapshot_o(snapshot), .safety_o(safe), .word_o(word),
      .*  // clock, reset, pins, register port
  );
  assign arm_request_o  = safe.arm_request;
  assign ready_o        = safe.ready;
  assign testing_o      = safe.testing;
  assign sample_o       = tick.sample;
  assign measured_o     = tick.tau_hat;
  assign duty_valid_o   = tick.duty;
  assign last_o         = tick.last;
  assign tick_count_o   = tick.count;
  assign position_o     = snapshot.position;
  assign velocity_o     = snapshot.velocity;
  assign tau_hat_o      = snapshot.tau_hat;
  assign tau_ref_o      = snapshot.tau_ref;
  assign current_ref_o  = snapshot.current;
  assign voltage_o      = snapshot.voltage;
  assign duty_o         = snapshot.duty;
  assign scene_o        = snapshot.scene;
  assign limits_o       = snapshot.limits;
  assign faults_o       = safe.faults;
  assign first_fault_o  = safe.first_fault;
  assign armed_o        = safe.armed;
  assign gates_enable_o = safe.gates_enable;
  assign word_valid_o   = word.valid;
  assign word_slot_o    = word.place;
  assign word_data_o    = word.data;
endmodule

`default_nettype wire
