// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The register port, for any traffic: what lands, what is refused, what passes, what is read.
`default_nettype none

module port_proof (
    input logic           clk_i,
    input logic           rst_ni,
    input cfg::tick_t     other_i,      // its results
    input cfg::panel_t    panel_i,
    input logic    [11:0] reg_addr_i,
    input logic    [31:0] reg_wdata_i,
    input logic           reg_write_i,
    input cfg::position_t position_i,
    input cfg::bridge_t   bridge_i,
    input cfg::safety_t   safety_i,
    input logic           testing_i,
    input cfg::snapshot_t values_i
);
  localparam int ControlW = map::W_CONTROL;
  localparam int Held = map::B_CONTROL_MODE;
  localparam int N = cfg::CLOCKS_PER_TICK;
  `include "reset.svh"

  // The real clocks.
  cfg::tick_t tick_i;
  logic [cfg::TICK_W-1:0] clock;
  logic tick, sample;
  logic [31:0] count;
  tick_counter u_tick (.clk_i(clk_i), .rst_ni(rst_ni), .clock_o(clock), .sample_o(sample), .tick_o(tick), .count_o(count));
  always_comb begin
    tick_i = other_i;
    tick_i.clock = clock;
    tick_i.last  = tick;
  end

  logic busy, set_zero, restart, trip;
  logic [31:0] rdata;
  logic [3:0] scene;
  cfg::params_t p;
  cfg::control_t control_s;
  cfg::commands_t commands;
  cfg::snapshot_t snapshot;
  cfg::word_t word;
  host u_dut (
      .*,
      .reg_busy_o(busy),
      .reg_rdata_o(rdata),
      .p_o(p),
      .control_o(control_s),
      .commands_o(commands),
      .scene_o(scene),
      .set_zero_o(set_zero),
      .restart_o(restart),
      .trip_o(trip),
      .snapshot_o(snapshot),
      .word_o(word)
  );
  (* hierconn *) wire \u_dut.write ;
  (* hierconn *) wire \u_dut.refused ;
  (* hierconn *) wire \u_dut.saturated ;
  (* hierconn *) wire [8:0] \u_dut.address ;
  (* hierconn *) wire [31:0] \u_dut.data ;
  (* hierconn *) wire [31:0] \u_dut.snapshot_word ;
  (* hierconn *) wire [31:0] \u_dut.parameter_word ;
  (* hierconn *) wire \u_dut.word_error ;
  (* hierconn *) wire [11:0] \u_dut.addr_q2 ;
  (* hierconn *) wire \u_dut.u_registers.to_parameter_q ;
  (* hierconn *) wire \u_dut.u_registers.to_control_q ;
  (* hierconn *) wire \u_dut.u_registers.to_command_q ;
  (* hierconn *) wire \u_dut.u_registers.zero_q ;
  (* hierconn *) wire \u_dut.u_registers.parity_q ;
  wire word_error = \u_dut.word_error ;
  wire lands = \u_dut.write ;
  wire [ControlW-1:0] control = control_s;
  wire refused = \u_dut.refused ;
  wire saturated = \u_dut.saturated ;
  wire locked = safety_i.armed || safety_i.locks;

  // The nearest value that the format of a parameter holds.
  function automatic logic [31:0] fitted(input logic [11:0] address, input logic [31:0] data);
    logic has_sign;
    logic [31:0] above;
    logic signed [32:0] value, most, least;
    {has_sign, above} = cfg::parameter_above(address[8:0]);
    value = 33'($signed(data));
    most  = {1'b0, ~above};
    least = has_sign ? {1'b1, above} : 33'sd0;
    if (address >= 12'h200 || above == 32'd0) fitted = data;
    else if (value > most) fitted = most[31:0];
    else if (value < least) fitted = least[31:0];
    else fitted = data;
  endfunction

  // A write that was taken and waits.
  logic pending_q, taken, to_parameter, to_control, to_command, refuse, holds, common, scene_word, saturated_q;
  logic [11:0] at_q;
  logic [31:0] data_q;
  logic [9:0] busy_q;  // clocks that it waits
  assign taken        = reg_write_i && !busy;
  assign to_parameter = pending_q && at_q < 12'h200;
  assign to_control   = pending_q && at_q == map::A_CONTROL;
  assign to_command   = pending_q && at_q == map::A_COMMAND;
  assign common       = at_q[11:6] == 6'd0;
  assign refuse       = locked && common && map::REFUSED_WHILE_ARMED[at_q[5:0]];
  assign scene_word   = !common && at_q[8:5] == scene && !map::INPUT_SCENES[scene];
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {pending_q, saturated_q, busy_q} <= '0;
    else begin
      busy_q <= busy ? busy_q + 10'd1 : 10'd0;
      if (taken) begin
        pending_q <= 1'b1;
        at_q      <= reg_addr_i;
        data_q    <= fitted(reg_addr_i, reg_wdata_i);
        if (reg_addr_i < 12'h200) saturated_q <= fitted(reg_addr_i, reg_wdata_i) != reg_wdata_i;
      end else if (tick) pending_q <= 1'b0;
    end
  end

  // A disarm, a stop and a zero that came in this tick, taken or not.
  logic disarm_due_q, stop_due_q, zero_due_q, disarms, stops;
  assign disarms = reg_write_i && reg_addr_i == map::A_CONTROL && reg_wdata_i[map::B_CONTROL_HOST] && !reg_wdata_i[map::B_CONTROL_ARM];
  assign stops   = reg_write_i && reg_addr_i == map::A_COMMAND && reg_wdata_i[map::B_COMMAND_STOP];
  assign holds   = locked && !disarm_due_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {disarm_due_q, stop_due_q, zero_due_q} <= 3'b000;
    else begin
      disarm_due_q <= disarms || (disarm_due_q && !tick);
      stop_due_q   <= stops || (stop_due_q && !tick);
      zero_due_q   <= panel_i.set_zero || (zero_due_q && !tick);
    end
  end

  // What the last clock had, and whether it was one after the reset.
  logic after_q, tick_q, control_due_q, holds_q, polarity_holds_q, disarmed_q, parameter_due_q, refuse_q, refused_q;
  logic [ControlW-1:0] control_q, wanted_control;
  logic [31:0] data_then_q;
  logic [3:0] scene_q, scene_wanted_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) after_q <= 1'b0;
    else after_q <= 1'b1;
  end
  always_ff @(posedge clk_i) begin
    {tick_q, control_due_q, parameter_due_q} <= {tick, tick && to_control, tick && to_parameter};
    {refuse_q, refused_q, holds_q, disarmed_q} <= {refuse, refused, holds, tick && disarm_due_q};
    {polarity_holds_q, control_q, data_then_q} <= {position_i.polarity_holds, control, data_q};
    {scene_q, scene_wanted_q} <= {scene, control_s.host ? control_s.scene : panel_i.scene};
  end
  always_comb begin
    wanted_control = control_q;
    if (control_due_q) begin
      wanted_control[Held-1:0] = data_then_q[Held-1:0];
      if (!holds_q) wanted_control[ControlW-1:Held] = data_then_q[ControlW-1:Held];
      if (polarity_holds_q) wanted_control[map::B_CONTROL_ENCODER_POLARITY] = control_q[map::B_CONTROL_ENCODER_POLARITY];
    end
    if (disarmed_q) begin
      wanted_control[map::B_CONTROL_HOST] = 1'b1;
      wanted_control[map::B_CONTROL_ARM]  = 1'b0;
    end
  end

  // Reads: three clocks from the address, the last of them here.
  logic [11:0] read_at_q, read_at_q2, read_at_q3;
  logic [31:0] parameter_word_q, snapshot_word_q;
  logic [1:0] clocks_q;  // since the reset, up to 3
  always_ff @(posedge clk_i) begin
    {read_at_q, read_at_q2, read_at_q3} <= {reg_addr_i, read_at_q, read_at_q2};
    {parameter_word_q, snapshot_word_q}  <= { \u_dut.parameter_word , \u_dut.snapshot_word };
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) clocks_q <= '0;
    else if (clocks_q != '1) clocks_q <= clocks_q + 2'd1;
  end

  logic has_sign;
  logic [31:0] above;  // bits above the format of the word that is written
  assign {has_sign, above} = cfg::parameter_above( \u_dut.address );

  always_comb begin
    if (past_ok_q && rst_ni) begin
      lands_once: assert (lands == (tick && to_parameter && !refuse));
      lands_as_taken: assert (!lands || ( \u_dut.address == at_q[8:0] && \u_dut.data == data_q));
      fits_its_format: assert (!lands || ( \u_dut.data & above) == (has_sign && data_q[31] ? above : 32'd0));
      saturated_is_told: assert (saturated == saturated_q);
      busy_while_it_waits: assert (busy == (to_parameter || to_control || to_command));
      waits_a_tick_at_most: assert (!busy || busy_q < 10'(N));
      disarm_passes: assert (commands.disarm == disarm_due_q);
      stop_passes: assert (commands.host_stop == stop_due_q);
      commands_once: assert (commands.clear_faults == (tick && to_command && data_q[map::B_COMMAND_CLEAR_FAULTS]) &&
                             commands.kick == (tick && to_command && data_q[map::B_COMMAND_KICK]));
      zero_once: assert (set_zero == (tick && (zero_due_q || (to_command && data_q[map::B_COMMAND_SET_ZERO]))));
      jumps_restart: assert (restart == (tick && ((set_zero && !map::INPUT_SCENES[scene]) ||
          (to_parameter && (common ? map::RAMPS_WHILE_ARMED[at_q[5:0]] : scene_word)))));
      inside_fits: assert (!to_parameter || fitted(at_q, data_q) == data_q);
      inside_taken: assert ( \u_dut.u_registers.to_parameter_q == to_parameter && \u_dut.u_registers.to_control_q == to_control &&
                            \u_dut.u_registers.to_command_q == to_command);
      inside_data: assert (!busy || ( \u_dut.address == at_q[8:0] && \u_dut.data == data_q));
      inside_zero: assert ( \u_dut.u_registers.zero_q == zero_due_q);
      inside_parity: assert ( \u_dut.u_registers.parity_q == ^control[ControlW-1:Held]);
      inside_clock: assert (clock < cfg::TICK_W'(N) && tick == (clock == cfg::TICK_W'(N - 1)));
      inside_busy: assert (busy_q <= (busy || clock != '0 ? 10'(clock) : 10'(N)));
      if (after_q) begin
        control_by_writes_only: assert (control == wanted_control);
        disarm_lands: assert (!disarmed_q || (control_s.host && !control_s.arm));
        held_while_armed: assert (!holds_q || control[ControlW-1:Held] == control_q[ControlW-1:Held]);
        polarity_holds: assert (!polarity_holds_q || control_s.encoder_polarity == control_q[map::B_CONTROL_ENCODER_POLARITY]);
        refused_is_told: assert (refused == (parameter_due_q ? refuse_q : refused_q));
        scene_with_the_tick: assert (scene == (tick_q ? scene_wanted_q : scene_q));
      end
      inside_reads: assert (clocks_q < 2'd2 || \u_dut.addr_q2 == read_at_q2);
      if (clocks_q == 2'd3) begin
        reads_the_word: assert (read_at_q3 >= 12'h200 || rdata == parameter_word_q);
        reads_the_control_word: assert (read_at_q3 != map::A_CONTROL || rdata == 32'(control_q));
        reads_the_snapshot: assert (read_at_q3[11:6] != map::A_SNAPSHOT[11:6] || rdata == snapshot_word_q);
        reads_nothing_else: assert (read_at_q3 < 12'h200 || read_at_q3 == map::A_CONTROL ||
                                    read_at_q3[11:6] == map::A_SNAPSHOT[11:6] || rdata == 32'd0);
        broken_word_trips: assert (trip == word_error);
      end
      saturates: cover (saturated && lands);
      lands_armed: cover (lands && safety_i.armed);
      refuses: cover (refused && !refused_q);
      disarms_while_busy: cover (disarmed_q && control_due_q && !holds_q);
    end
  end
endmodule

`default_nettype wire
