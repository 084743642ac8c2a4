// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The host's side of an axis: register port, parameters, and the snapshot that is read back.
// reg_rdata_o follows reg_addr_i by three clocks. docs/blocks/host.md

`default_nettype none

module host #(
    parameter ParameterFile = ""
) (
    input  logic                   clk_i,
    input  logic                   rst_ni,
    input  cfg::tick_t             tick_i,
    input  cfg::panel_t            panel_i,
    input  logic           [11:0] reg_addr_i,
    input  logic           [31:0] reg_wdata_i,
    input  logic                   reg_write_i,
    output logic                   reg_busy_o,
    output logic           [31:0] reg_rdata_o,
    input  cfg::position_t         position_i,
    input  cfg::bridge_t           bridge_i,
    input  cfg::safety_t           safety_i,
    input  logic                   testing_i,   // this axis or another runs its self-test
    input  cfg::snapshot_t         values_i,    // of the chain
    output cfg::params_t           p_o,
    output cfg::control_t          control_o,
    output cfg::commands_t         commands_o,
    output logic           [ 3:0] scene_o,     // in force in this tick
    output logic                   set_zero_o,  // with the last clock of a tick
    output logic                   restart_o,   // likewise: the torque ramps from the next tick on
    output logic                   trip_o,      // a word has changed by itself
    output cfg::snapshot_t         snapshot_o,  // with the words of status and faults
    output cfg::word_t             word_o
);
  logic control_error, word_error, write, refused, saturated, freeze, thaw;
  logic [8:0] address;
  logic [31:0] data, parameter_word, snapshot_word;
  registers u_registers (
      .clk_i(clk_i), .rst_ni(rst_ni), .tick_i(tick_i.last), .reg_addr_i(reg_addr_i), .reg_wdata_i(reg_wdata_i),
      .reg_write_i(reg_write_i), .reg_busy_o(reg_busy_o), .armed_i(safety_i.armed || safety_i.locks),
      .polarity_holds_i(position_i.polarity_holds), .set_zero_i(panel_i.set_zero), .scene_i(scene_o),
      .control_o(control_o), .control_error_o(control_error), .write_o(write), .address_o(address), .data_o(data),
      .set_zero_o(set_zero_o), .clear_faults_o(commands_o.clear_faults), .kick_o(commands_o.kick), .freeze_o(freeze),
      .thaw_o(thaw), .disarm_o(commands_o.disarm), .stop_o(commands_o.host_stop), .restart_o(restart_o),
      .refused_o(refused), .saturated_o(saturated)
  );
  params #(.ParameterFile(ParameterFile)) u_params (
      .clk_i(clk_i), .rst_ni(rst_ni), .clock_i(tick_i.clock), .scene_i(scene_o), .write_i(write), .address_i(address),
      .data_i(data), .read_addr_i(reg_addr_i[8:0]), .read_data_o(parameter_word), .p_o(p_o), .word_error_o(word_error)
  );
  assign commands_o.host      = control_o.host;
  assign commands_o.host_arm  = control_o.arm;
  assign commands_o.panel_arm = panel_i.arm;
  assign commands_o.stop      = panel_i.stop;
  assign commands_o.mode      = control_o.mode;
  assign trip_o               = control_error || word_error;

  // The scene of a tick.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) scene_o <= '0;
    else if (tick_i.last) scene_o <= control_o.host ? control_o.scene : panel_i.scene;
  end

  always_comb begin
    snapshot_o = values_i;
    snapshot_o.faults = '0;
    snapshot_o.faults[map::B_FAULTS_SEEN+:16]    = safety_i.faults;
    snapshot_o.faults[map::B_FAULTS_FIRST+:5]    = safety_i.first_fault;
    snapshot_o.faults[map::B_FAULTS_CURRENT+:5]  = bridge_i.why[4:0];
    snapshot_o.faults[map::B_FAULTS_ABSOLUTE+:6] = position_i.why;
    snapshot_o.status = '0;
    snapshot_o.status[map::B_STATUS_LIMITS+:12]     = values_i.limits;
    snapshot_o.status[map::B_STATUS_SCENE+:4]       = scene_o;
    snapshot_o.status[map::B_STATUS_ARMED]          = safety_i.armed;
    snapshot_o.status[map::B_STATUS_MODE+:2]        = control_o.mode;
    snapshot_o.status[map::B_STATUS_SELF_TEST+:2]   = safety_i.test_result;
    snapshot_o.status[map::B_STATUS_TESTING]        = testing_i;
    snapshot_o.status[map::B_STATUS_DRIVER_FAULT]   = bridge_i.why[5];
    snapshot_o.status[map::B_STATUS_CURRENT_MISSING] = bridge_i.why[6];
    snapshot_o.status[map::B_STATUS_ENCODER_ERROR]  = position_i.error;
    snapshot_o.status[map::B_STATUS_REFUSED]        = refused;
    snapshot_o.status[map::B_STATUS_SATURATED]      = saturated;
    snapshot_o.status[map::B_STATUS_UNKICKED]       = safety_i.unkicked;
  end
  snapshot u_snapshot (
      .clk_i(clk_i), .rst_ni(rst_ni), .tick_i(tick_i.last), .begin_i(tick_i.tau_ref), .end_i(tick_i.duty),
      .freeze_i(freeze), .thaw_i(thaw), .values_i(snapshot_o), .read_addr_i(reg_addr_i[5:0]),
      .read_data_o(snapshot_word), .word_o(word_o)
  );

  // What the host reads.
  logic [11:0] addr_q, addr_q2;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {addr_q, addr_q2, reg_rdata_o} <= '0;
    end else begin
      {addr_q2, addr_q} <= {addr_q, reg_addr_i};
      if (addr_q2[11:9] == 3'd0)                                reg_rdata_o <= parameter_word;
      else if (addr_q2[11:6] == map::A_SNAPSHOT[11:6])          reg_rdata_o <= snapshot_word;
      else if (addr_q2 == map::A_CONTROL)                       reg_rdata_o <= 32'(control_o);
      else                                                      reg_rdata_o <= '0;
    end
  end
endmodule

`default_nettype wire
