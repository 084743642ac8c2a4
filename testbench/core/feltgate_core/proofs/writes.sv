// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The register port of the whole core: a write lands once, where it says, within a tick, and is what the blocks
// find; nothing changes without one; a disarm and a stop pass whatever waits. The RAMs are taken out; of any one
// word of the parameter RAM the wrapper keeps what was written last.
`default_nettype none

module writes_proof (
    `include "core_inputs.svh"
);
  `include "reset.svh"
  `include "core.svh"
  `include "waiting.svh"
  `include "inside.svh"
  localparam int ControlW = feltgate_map_pkg::W_CONTROL;
  localparam int Held = feltgate_map_pkg::B_CONTROL_MODE;
  localparam int Host = feltgate_map_pkg::B_CONTROL_HOST;
  localparam int Arm = feltgate_map_pkg::B_CONTROL_ARM;

  // Beside the shared ones: the address at the port, what the RAM returns, the control word.
  (* hierconn *) wire [11:0] \u_core.u_wave.u_registers.reg_addr_i ;
  (* hierconn *) wire [35:0] \u_core.u_wave.u_registers.g_read.parameter_q ;
  (* hierconn *) wire [ControlW-1:0] \u_core.control ;
  (* hierconn *) wire \u_core.arms ;
  (* hierconn *) wire \u_core.u_safety.u_supervisor.request ;
  wire [ControlW-1:0] control = \u_core.control ;
  wire lands = \u_core.u_wave.u_registers.lands ;

  // What a parameter that waits must be refused for, and what a control word may not change.
  logic refuse, holds;
  assign refuse = (armed || \u_core.arms ) && at_q[11:6] == 6'd0 && feltgate_map_pkg::REFUSED_WHILE_ARMED[at_q[5:0]];
  assign holds  = armed && !disarm_due_q;

  // The word of an address, whichever that is, as it was written last; and what the slot of this clock asks for.
  logic [8:0] address_q, wanted;
  logic [31:0] word_q, word_then_q, word_then_q2, param;
  logic wanted_q, wanted_q2, read_q, read_q2, read_q3;
  logic fetched_q, asked_q;  // what the RAM was asked for, by the registers' own address
  logic [31:0] read_word_q, read_word_q2, read_word_q3;
  assign param = \u_core.u_actuation.u_torque_control.param_i ;
  always_comb begin
    wanted = {3'd0, (phase_q < 10'd64) ? phase_q[5:0] : 6'd63};
    if (phase_q < 10'd64 && feltgate_map_pkg::SCENE_SLOTS[phase_q[5:0]]) wanted = {scene, phase_q[4:0]};
    else if (phase_q == 10'(feltgate_map_pkg::PARAM_AT_VOLTAGE_GAIN) && \u_core.region_high )
      wanted = 9'(feltgate_map_pkg::PARAM_AT_VOLTAGE_GAIN_HIGH);
    else if (phase_q == 10'(feltgate_map_pkg::PARAM_AT_TORQUE_LIMIT))
      wanted = {3'd0, \u_core.u_wave.u_registers.least_at_q };
    else if (phase_q == 10'(feltgate_map_pkg::EVENT_AT_LEAST_FULL))
      wanted = 9'(feltgate_map_pkg::PARAM_AT_TORQUE_LIMIT);
    else if (phase_q == 10'(feltgate_map_pkg::EVENT_AT_LEAST_HOLD))
      wanted = 9'(feltgate_map_pkg::PARAM_AT_HOLD_LIMIT);
    else if (phase_q == 10'(feltgate_map_pkg::EVENT_AT_LEAST_TEST))
      wanted = 9'(feltgate_map_pkg::PARAM_AT_SELF_TEST_TORQUE);
  end
  always_ff @(posedge clk_i) begin
    address_q    <= address_q;
    if (lands && \u_core.u_wave.u_registers.address_q == address_q) word_q <= \u_core.u_wave.u_registers.written [31:0];
    word_then_q  <= word_q;
    word_then_q2 <= word_then_q;
    fetched_q    <= \u_core.u_wave.u_registers.fetch_address == address_q && !lands;
    asked_q      <= \u_core.u_wave.u_registers.reg_addr_i [8:0] == address_q && !lands;
    wanted_q     <= wanted == address_q;
    wanted_q2    <= wanted_q;
    read_q       <= reg_addr_i == 12'(address_q) && !lands;
    read_q2      <= read_q;
    read_q3      <= read_q2;
    read_word_q  <= word_q;
    read_word_q2 <= read_word_q;
    read_word_q3 <= read_word_q2;
  end
  always_comb begin
    if (past_ok_q && fetched_q) assume (\u_core.u_wave.u_registers.fetch_q [31:0] == word_then_q);
    if (past_ok_q && asked_q) assume (\u_core.u_wave.u_registers.g_read.parameter_q [31:0] == read_word_q);
  end

  // The last clock: what the control word must be now, and the clocks since the reset, up to 3.
  logic [1:0] clocks_q;
  logic control_due_q, holds_q, disarmed_q, stopped_q, last_q;
  logic [3:0] scene_wanted_q, scene_q;
  logic [ControlW-1:0] control_q, wanted_control;
  logic [31:0] data_then_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      clocks_q   <= 2'd0;
      disarmed_q <= 1'b0;
      stopped_q  <= 1'b0;
    end else begin
      if (clocks_q != 2'd3) clocks_q <= clocks_q + 2'd1;
      disarmed_q <= last && disarm_due_q;
      stopped_q  <= stop_due_q;
    end
  end
  always_ff @(posedge clk_i) begin
    last_q         <= last;
    control_due_q  <= last && to_control;
    holds_q        <= holds;
    scene_q        <= scene;
    control_q      <= control;
    data_then_q    <= data_q;
    scene_wanted_q <= control[Host] ? control[feltgate_map_pkg::B_CONTROL_SCENE+:4] : scene_i;
  end
  always_comb begin
    wanted_control = control_q;
    if (control_due_q) begin
      wanted_control[Held-1:0] = data_then_q[Held-1:0];
      if (!holds_q && !armed) wanted_control[ControlW-1:Held] = data_then_q[ControlW-1:Held];
    end
    if (disarmed_q) begin
      wanted_control[Host] = 1'b1;
      wanted_control[Arm]  = 1'b0;
    end
  end

  always_comb begin
    if (past_ok_q && rst_ni) begin
      lands_once: assert (lands == (last && to_parameter && !refuse));
      lands_as_taken: assert (!lands || (\u_core.u_wave.u_registers.address_q == at_q[8:0] &&
                                         \u_core.u_wave.u_registers.written [31:0] == data_q));
      waits_a_tick_at_most: assert (!busy || busy_q < 10'(N));
      commands_once: assert (
          \u_core.u_safety.u_supervisor.clear_faults_i == (last && to_command && data_q[feltgate_map_pkg::B_COMMAND_CLEAR_FAULTS]) &&
          \u_core.u_encoder.u_quad_decoder.clear_error_i == (\u_core.u_safety.u_supervisor.clear_faults_i && !\u_core.u_safety.u_supervisor.request ) &&
          \u_core.u_safety.u_supervisor.kick_i == (last && to_command && data_q[feltgate_map_pkg::B_COMMAND_KICK]));
      zero_once: assert (
          zeroed == (last && (zero_due_q || (to_command && data_q[feltgate_map_pkg::B_COMMAND_SET_ZERO]))) &&
          \u_core.u_encoder.u_quad_decoder.set_zero_i == zeroed && \u_core.u_encoder.u_encoder_monitor.set_zero_i == zeroed);
      control_in_its_blocks: assert (
          \u_core.u_actuation.u_torque_control.mode_i == control[feltgate_map_pkg::B_CONTROL_MODE+:2] &&
          \u_core.u_safety.u_self_test.direct_i == (\u_core.u_actuation.u_torque_control.mode_i == 2'(feltgate_map_pkg::MODE_VOLTAGE)) &&
          \u_core.u_actuation.g_two_legs.u_pwm.mode_i == control[feltgate_map_pkg::B_CONTROL_PWM_MODE] &&
          \u_core.u_actuation.g_two_legs.u_pwm.polarity_i == control[feltgate_map_pkg::B_CONTROL_MOTOR_POLARITY] &&
          \u_core.u_encoder.u_quad_decoder.polarity_i == control[feltgate_map_pkg::B_CONTROL_ENCODER_POLARITY] &&
          \u_core.u_encoder.u_quad_decoder.filter_i == control[feltgate_map_pkg::B_CONTROL_FILTER+:4] &&
          \u_core.u_scenes.scene_i == scene && \u_core.u_actuation.u_ramp.scene_i == scene);
      inside_taken: assert (\u_core.u_wave.u_registers.to_parameter_q == to_parameter &&
                            \u_core.u_wave.u_registers.to_control_q == to_control &&
                            \u_core.u_wave.u_registers.to_command_q == to_command);
      inside_data: assert (!busy || (\u_core.u_wave.u_registers.address_q == at_q[8:0] &&
                                     \u_core.u_wave.u_registers.data_q == data_q));
      inside_busy: assert (busy_q <= ((busy || phase_q != 10'd0) ? phase_q : 10'(N)));
      inside_due: assert (\u_core.u_wave.u_registers.disarm_o == disarm_due_q && \u_core.u_wave.u_registers.stop_o == stop_due_q &&
                          \u_core.u_wave.u_registers.zero_q == zero_due_q);
      inside_warm: assert (\u_core.u_wave.u_registers.warm_q == (clocks_q != 2'd0) &&
                           (began_q || 10'(clocks_q) == ((phase_q < 10'd3) ? phase_q : 10'd3)) &&
                           (!began_q || clocks_q == 2'd3));
      if (clocks_q != 2'd0) begin
        control_by_writes_only: assert (control == wanted_control);
        scene_with_the_tick: assert (scene == (last_q ? scene_wanted_q : scene_q));
        disarm_lands: assert (!disarmed_q || (!gates_enable && !armed && control[Host] && !control[Arm]));
        stop_lands: assert (!stopped_q || (!gates_enable && faults[feltgate_map_pkg::FAULT_STOP]));
      end
      if (wave != '0 && at <= 10'(feltgate_map_pkg::EVENT_AT_WATCHDOG)) begin
        word_in_its_clock: assert (!wanted_q2 || param == word_then_q2);
      end
      one_bus: assert (\u_core.u_scenes.param_i == param && \u_core.u_actuation.u_limiter.param_i == param &&
                       \u_core.u_actuation.u_ramp.param_i == param && \u_core.u_safety.u_supervisor.param_i == param &&
                       \u_core.u_safety.u_self_test.param_i == param && \u_core.u_safety.u_hold_timer.param_i == param &&
                       \u_core.u_wave.u_multipliers.param_i == param);
      if (clocks_q == 2'd3) reads_what_landed: assert (!read_q3 || rdata == read_word_q3);
      fetches: cover (wave[3] && wanted_q2 && param != 32'd0);
      waits: cover (busy && reg_write_i && phase_q == 10'd4);
      has_stopped: cover (stopped_q && faults[feltgate_map_pkg::FAULT_STOP]);
    end
  end
endmodule

`default_nettype wire
