// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The host's register port: control word, commands and writes of parameters. A write is accepted in a
// clock with reg_write_i high and reg_busy_o low, and takes effect in the last clock of the tick; a
// parameter saturates to its format. A disarm and a stop do not wait for an earlier write. While
// armed some words are refused, and some make the torque ramp. docs/blocks/host.md

`default_nettype none

module registers (
    input  logic           clk_i,
    input  logic           rst_ni,
    input  logic           tick_i,            // last clock of a tick
    input  logic    [11:0] reg_addr_i,
    input  logic    [31:0] reg_wdata_i,
    input  logic           reg_write_i,       // held with address and data until accepted
    output logic           reg_busy_o,        // a write waits for tick_i
    input  logic           armed_i,           // armed, or armed from the next clock on
    input  logic           polarity_holds_i,  // the encoder's polarity keeps its value
    input  logic           set_zero_i,        // of the panel, one clock
    input  logic    [ 3:0] scene_i,           // in force
    output cfg::control_t  control_o,
    output logic           control_error_o,   // a field that holds while armed has changed by itself
    output logic           write_o,           // with tick_i: the parameter lands
    output logic    [ 8:0] address_o,
    output logic    [31:0] data_o,
    output logic           set_zero_o,        // commands, with tick_i
    output logic           clear_faults_o,
    output logic           kick_o,
    output logic           freeze_o,
    output logic           thaw_o,
    output logic           disarm_o,          // written since the end of the last tick
    output logic           stop_o,            // likewise
    output logic           restart_o,         // with tick_i: this change starts the ramp
    output logic           refused_o,         // the last parameter was refused
    output logic           saturated_o        // the last parameter did not fit its format
);
  // The write that waits.
  logic to_parameter_q, to_control_q, to_command_q, zero_q;
  logic [8:0] address_q;
  logic [31:0] data_q;
  logic at_parameter, at_control, at_command;
  cfg::control_t written;
  assign at_parameter = reg_addr_i[11:9] == 3'd0;
  assign at_control   = reg_addr_i == map::A_CONTROL;
  assign at_command   = reg_addr_i == map::A_COMMAND;
  assign reg_busy_o   = to_parameter_q || to_control_q || to_command_q;
  assign address_o    = address_q;
  assign data_o       = data_q;
  assign written      = data_q[map::W_CONTROL-1:0];

  // Bits of `above` lie above the parameter's format: they equal the sign, or without a sign 0.
  logic has_sign, negative, misfit;
  logic [31:0] above, fitted;
  assign {has_sign, above} = at_parameter ? cfg::parameter_above(reg_addr_i[8:0]) : 33'd0;
  assign negative = has_sign && reg_wdata_i[31];
  assign misfit   = ((reg_wdata_i ^ {32{negative}}) & above) != 32'd0;
  assign fitted   = !misfit ? reg_wdata_i : negative ? above : reg_wdata_i[31] ? 32'd0 : ~above;

  logic common, refuses, ramps, input_scene, disarms, stops;
  assign common      = address_q[8:6] == 3'd0;
  assign input_scene = map::INPUT_SCENES[scene_i];  // its torque does not depend on the position
  assign refuses     = armed_i && common && map::REFUSED_WHILE_ARMED[address_q[5:0]];
  assign ramps       = common ? map::RAMPS_WHILE_ARMED[address_q[5:0]] : address_q[8:5] == scene_i && !input_scene;
  assign write_o     = tick_i && to_parameter_q && !refuses;
  assign restart_o   = (set_zero_o && !input_scene) || (tick_i && to_parameter_q && ramps);
  assign disarms     = reg_write_i && at_control && reg_wdata_i[map::B_CONTROL_HOST] && !reg_wdata_i[map::B_CONTROL_ARM];
  assign stops       = reg_write_i && at_command && reg_wdata_i[map::B_COMMAND_STOP];

  assign set_zero_o     = tick_i && (zero_q || (to_command_q && data_q[map::B_COMMAND_SET_ZERO]));
  assign clear_faults_o = tick_i && to_command_q && data_q[map::B_COMMAND_CLEAR_FAULTS];
  assign kick_o         = tick_i && to_command_q && data_q[map::B_COMMAND_KICK];
  assign freeze_o       = tick_i && to_command_q && data_q[map::B_COMMAND_FREEZE];
  assign thaw_o         = tick_i && to_command_q && data_q[map::B_COMMAND_THAW];

  // Mode, polarities and filter hold while armed; their parity is stored with them.
  logic parity_q, holds;
  assign holds           = armed_i && !disarm_o;
  assign control_error_o = parity_q != ^control_o[map::W_CONTROL-1:map::B_CONTROL_MODE];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {to_parameter_q, to_control_q, to_command_q, zero_q, address_q, data_q} <= '0;
      {disarm_o, stop_o, refused_o, saturated_o} <= '0;
      control_o <= cfg::CONTROL_RESET;
      parity_q  <= ^cfg::CONTROL_RESET[map::W_CONTROL-1:map::B_CONTROL_MODE];
    end else begin
      if (reg_write_i && !reg_busy_o) begin
        {to_parameter_q, to_control_q, to_command_q} <= {at_parameter, at_control, at_command};
        address_q <= reg_addr_i[8:0];
        data_q    <= fitted;
        if (at_parameter) saturated_o <= misfit;
      end else if (tick_i) begin
        {to_parameter_q, to_control_q, to_command_q} <= 3'b000;
      end
      disarm_o <= disarms || (disarm_o && !tick_i);
      stop_o   <= stops || (stop_o && !tick_i);
      zero_q   <= set_zero_i || (zero_q && !tick_i);
      if (tick_i && to_parameter_q) refused_o <= refuses;
      if (tick_i && to_control_q) begin
        control_o.host  <= written.host;
        control_o.arm   <= written.arm;
        control_o.scene <= written.scene;
        if (!holds) begin
          control_o.mode             <= written.mode;
          control_o.motor_polarity   <= written.motor_polarity;
          control_o.encoder_polarity <= polarity_holds_i ? control_o.encoder_polarity : written.encoder_polarity;
          control_o.pwm_mode         <= written.pwm_mode;
          control_o.filter           <= written.filter;
          parity_q <= ^{written.mode, written.motor_polarity,
                        polarity_holds_i ? control_o.encoder_polarity : written.encoder_polarity,
                        written.pwm_mode, written.filter};
        end
      end
      if (tick_i && disarm_o) begin  // wins over a waiting write that arms
        control_o.host <= 1'b1;
        control_o.arm  <= 1'b0;
      end
    end
  end
endmodule

`default_nettype wire
