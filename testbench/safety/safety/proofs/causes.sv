// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// When a cause trips: speed, jump, growth against the command, heat, silence, ticks that stand, encoder
// errors. Each law is written here in wide numbers. Arming and latches are cut away: the gates may be on
// or off in any clock.
`default_nettype none

module causes_proof (
    input logic                                 clk_i,
    input logic                                 rst_ni,
    input logic        [                  11:0] start_i,  // where in a period of the PWM a reset ends
    input cfg::params_t                         p,
    input cfg::tick_t                           tick_i,
    input cfg::commands_t                       commands_i,
    input cfg::position_t                       position_i,
    input cfg::bridge_t                         bridge_i,
    input cfg::peers_t                          peers_i,
    input logic        [                  15:0] trips_i,
    input logic signed [   cfg::VELOCITY_W-1:0] velocity_i,
    input logic signed [     cfg::TORQUE_W-1:0] tau_ref_i,
    input logic signed [    cfg::CURRENT_W-1:0] current_i,
    input logic signed [    cfg::VOLTAGE_W-1:0] voltage_i,
    input logic                                 watch_i   // from here on errors are counted
);
  `include "reset.svh"
  cfg::safety_t safety_o;
  safety u_dut (.*);
  (* hierconn *) wire [15:0] \u_dut.trips ;
  (* hierconn *) wire \u_dut.gates_enable ;
  (* hierconn *) wire \u_dut.armed ;
  (* hierconn *) wire \u_dut.arms ;
  wire [15:0] trip = \u_dut.trips ;
  wire gates = \u_dut.gates_enable ;
  wire arms = \u_dut.arms ;
  wire tick = tick_i.last;
  localparam int VelocityW = cfg::VELOCITY_W;

  // As safety.latch proves it: the gates open at the end of a tick that arms only, and close at any trip.
  logic after_q, tick_q, gates_q, arms_q, trip_q;
  always_ff @(posedge clk_i) begin
    {tick_q, gates_q, arms_q, trip_q} <= {tick, gates, arms, trip != '0};
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) after_q <= 1'b0;
    else after_q <= 1'b1;
  end
  always_comb begin
    assume (rst_ni || !gates);
    assume (!gates || (after_q && !trip_q && (tick_q ? arms_q : gates_q)));
    assume (!arms || (tick && trip == '0));
    assume (!commands_i.kick || tick);
    assume (trips_i == '0 && position_i.why == '0 && !commands_i.host_stop);
  end
  // Start of the checks of polarity, and clocks since the sample; what they read holds meanwhile.
  logic scene_q;
  logic [6:0] sampled_q;
  logic signed [VelocityW-1:0] velocity_q;
  logic signed [cfg::CURRENT_W-1:0] current_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {scene_q, sampled_q} <= '0;
    else {scene_q, sampled_q} <= {tick_i.scene, sampled_q[5:0], tick_i.sample};
  end
  always_ff @(posedge clk_i) {velocity_q, current_q} <= {velocity_i, current_i};
  always_comb begin
    assume (!tick_i.sample || sampled_q == '0);
    assume (!scene_q || (!tick_i.scene && velocity_i == velocity_q && current_i == current_q));
  end

  function automatic logic over(input logic signed [34:0] x, input logic [31:0] word);
    over = (x < 0 ? -x : x) > $signed({3'd0, word});
  endfunction

  // Speed, and a jump beyond what the low-pass can: a step is the product of a difference of W + 1 bits and a word
  // of 17 bits, with A1_F fraction bits.
  localparam logic signed [VelocityW+2:0] Most = (VelocityW + 3)'(1) << (VelocityW + 17 - cfg::P_VELOCITY_A1_F);
  logic fast_q, judged_q;
  logic signed [VelocityW-1:0] last_q;
  logic signed [VelocityW+2:0] moved_q;
  (* hierconn *) wire signed [VelocityW-1:0] \u_dut.u_overspeed.before_q ;
  always_ff @(posedge clk_i) begin
    fast_q  <= over(35'(velocity_i), 32'(p.overspeed));
    moved_q <= (VelocityW + 3)'(velocity_i) - (VelocityW + 3)'(last_q);
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {judged_q, last_q} <= '0;
    else begin
      judged_q <= tick_i.velocity;
      if (tick_i.velocity) last_q <= velocity_i;
    end
  end

  // Growth against the command: ticks of the window, the velocity before it, whether the window before it grew.
  localparam int Drop = cfg::VELOCITY_F > map::GROWTH_BITS ? cfg::VELOCITY_F - map::GROWTH_BITS : 0;
  localparam int RunawayW = map::RUNAWAY_BITS + 1;
  logic signed [VelocityW-1:0] coarse, before_q, growth;
  logic grew_q, strong_q, last_grew_q, against, ends_q;
  logic [RunawayW-1:0] window_q;
  assign coarse  = (velocity_i >>> Drop) <<< Drop;
  assign growth  = coarse - before_q;
  assign against = gates && strong_q && (velocity_i < 0) != (current_i < 0);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {before_q, grew_q, strong_q, last_grew_q, ends_q, window_q} <= '0;
    else begin
      if (tick_i.scene) begin
        grew_q   <= over(35'(growth), 32'(p.polarity_speed)) && (growth < 0) == (velocity_i < 0);
        strong_q <= over(35'(current_i), 32'(p.polarity_current));
        ends_q   <= window_q >= RunawayW'(p.polarity_ticks);
      end
      if (scene_q) begin
        window_q <= against && !ends_q ? window_q + 1'b1 : RunawayW'(1);
        if (!against || ends_q) {before_q, last_grew_q} <= {coarse, against && grew_q};
      end
    end
  end
  (* hierconn *) wire [RunawayW-1:0] \u_dut.u_polarity.ticks_q ;
  (* hierconn *) wire [VelocityW-Drop-1:0] \u_dut.u_polarity.begin_q ;
  (* hierconn *) wire [map::RUNAWAY_WINDOWS-2:0] \u_dut.u_polarity.grown_q ;

  // Heat: what a tick makes of it, all at once.
  localparam int SumW = cfg::I2T_W + 1;
  localparam int SquaredW = cfg::CURRENT_SQUARED_W;
  localparam int SquaredDrop = 2 * cfg::CURRENT_ESTIMATE_F - cfg::CURRENT_SQUARED_F;
  (* hierconn *) wire [SumW-1:0] \u_dut.u_motor_heat.sum_q ;
  (* hierconn *) wire [63:0] \u_dut.u_motor_heat.product ;
  (* hierconn *) wire [6:0] \u_dut.u_motor_heat.at ;
  wire [SumW-1:0] heat = \u_dut.u_motor_heat.sum_q ;
  wire [63:0] square = \u_dut.u_motor_heat.product ;
  logic [SumW-1:0] cooled_q, heat_q;
  logic [SquaredW-1:0] added_q;
  logic hot_q, taken_q, heated_q;
  always_ff @(posedge clk_i) begin
    heat_q   <= heat;
    heated_q <= sampled_q[6];
    if (sampled_q[5]) begin
      hot_q    <= heat >= SumW'(p.i2t_budget);
      cooled_q <= heat > SumW'(p.nominal_current_squared) ? heat - SumW'(p.nominal_current_squared) : '0;
      added_q  <= \u_dut.armed && heat < SumW'(33'd1 << 32) ? square[SquaredDrop+:SquaredW] : '0;
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) taken_q <= 1'b0;
    else taken_q <= sampled_q[6];
  end

  // Silence: ticks since the last kick, or since the gates opened.
  localparam logic [25:0] Patience = (26'd1 << map::KICKLESS_BITS) - 26'd1;  // of the word
  logic [25:0] silence_q;
  logic awake_q, silent_q, asked_q, duty_q, regular_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {awake_q, silent_q, asked_q, duty_q, silence_q, regular_q} <= 1;
    else begin
      regular_q <= regular_q && (!tick || (asked_q && !tick_i.duty));  // a duty in each tick, before its end
      duty_q <= tick_i.duty;
      if (commands_i.kick) awake_q <= 1'b1;
      if (tick) silence_q <= commands_i.kick || !gates ? 26'd0 : silence_q + 26'd1;
      if (tick_i.duty) silent_q <= silence_q >= 26'(p.watchdog_ticks);
      asked_q <= tick_i.duty || (asked_q && !tick);  // in this tick
    end
  end
  (* hierconn *) wire [map::KICKLESS_BITS:0] \u_dut.u_watchdog.ticks_q ;
  (* hierconn *) wire \u_dut.awake ;

  // Ticks that stand: period_start comes in every Period-th clock, as pwm.period proves.
  localparam int Period = cfg::PWM_PERIOD;
  localparam int Periods = (cfg::CLOCKS_PER_TICK + Period - 1) / Period;
  localparam int PeriodsW = $clog2(Periods + 1);
  (* hierconn *) wire [PeriodsW-1:0] \u_dut.u_tick_monitor.periods_q ;
  wire [PeriodsW-1:0] periods = \u_dut.u_tick_monitor.periods_q ;
  (* hierconn *) wire \u_dut.u_tick_monitor.tick_q ;
  logic [11:0] carrier_q;      // clocks since the last start
  logic [15:0] open_q, since_q;  // clocks since tick rose, with the gates on; anyhow, up to 2^15
  logic rose_q;
  always_ff @(posedge clk_i) carrier_q <= !rst_ni ? start_i : bridge_i.period_start ? 12'd0 : carrier_q + 12'd1;
  always_comb begin
    assume (bridge_i.period_start == (carrier_q == 12'(Period - 1)));
    assume (carrier_q < 12'(Period) && start_i < 12'(Period));
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {rose_q, open_q, since_q} <= '0;
    else begin
      rose_q  <= tick;
      open_q  <= (tick && !rose_q) || !gates ? 16'd0 : open_q + 16'd1;
      since_q <= tick && !rose_q ? 16'd0 : since_q[15] ? since_q : since_q + 16'd1;
    end
  end

  // Errors: those since watch_i, or since the last trip, and those that were forgiven meanwhile.
  localparam int Borne = map::ERRORS_BORNE;
  logic [map::FORGIVE_BITS-1:0] forgive_q;
  logic [15:0] errors_q, forgiven_q;
  logic [3:0] recent_q;  // since the last trip or reset, up to 15
  wire trip_errors = trip[map::FAULT_ENCODER];
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {forgive_q, errors_q, forgiven_q, recent_q} <= '0;
    else begin
      if (tick) forgive_q <= forgive_q + 1'b1;
      if (trip_errors) recent_q <= '0;
      else if (position_i.illegal && recent_q != 4'd15) recent_q <= recent_q + 4'd1;
      if (watch_i || trip_errors || forgiven_q[15]) {errors_q, forgiven_q} <= '0;
      else begin
        errors_q   <= errors_q + 16'(position_i.illegal);
        forgiven_q <= forgiven_q + 16'(tick && forgive_q == '1);
      end
    end
  end
  (* hierconn *) wire [$clog2(Borne + 1)-1:0] \u_dut.u_encoder_errors.errors_q ;
  (* hierconn *) wire [map::FORGIVE_BITS-1:0] \u_dut.u_encoder_errors.ticks_q ;

  always_comb begin
    if (past_ok_q) begin
      heat_in_its_clock: assert (heated_q || heat == heat_q);
    end
    if (rst_ni && past_ok_q) begin
      overspeed_in_its_clock: assert (trip[map::FAULT_SPEED] == (judged_q && fast_q));
      jump_in_its_clock: assert (!trip[map::FAULT_JUMP] || judged_q);
      possible_never_trips: assert (!trip[map::FAULT_JUMP] || moved_q >= Most || moved_q <= -Most);
      impossible_trips: assert (!judged_q || trip[map::FAULT_JUMP] || (moved_q < 2 * Most && moved_q > -2 * Most));
      inside_last: assert ( \u_dut.u_overspeed.before_q == last_q);
      runaway_in_its_clock: assert (trip[map::FAULT_POLARITY] == (scene_q && against && ends_q && grew_q && last_grew_q));
      inside_window: assert ( \u_dut.u_polarity.ticks_q == window_q && \u_dut.u_polarity.begin_q == before_q[VelocityW-1:Drop] &&
                             \u_dut.u_polarity.grown_q == last_grew_q && before_q == (before_q >>> Drop) <<< Drop);
      heat_is_its_law: assert (!taken_q || (SumW + 1)'(heat) == (SumW + 1)'(cooled_q) + (SumW + 1)'(added_q));
      hot_in_its_clock: assert (trip[map::FAULT_I2T] == (sampled_q[6] && hot_q));
      inside_one: assert ((sampled_q & (sampled_q - 7'd1)) == 0);
      inside_heat: assert ( \u_dut.u_motor_heat.at == sampled_q);
      silence_in_its_clock: assert (!regular_q || trip[map::FAULT_WATCHDOG] == (duty_q && gates && awake_q && silent_q));
      awake_from_the_first_kick: assert ( \u_dut.awake == awake_q);
      inside_silence: assert (!regular_q || !gates || !awake_q || (26'( \u_dut.u_watchdog.ticks_q ) == silence_q &&
                              silence_q <= Patience &&
                              (silence_q != Patience || !asked_q || (duty_q && silent_q))));
      standing_trips: assert (!gates || open_q <= 16'((Periods + 1) * Period));
      in_time_never_trips: assert (!trip[map::FAULT_TICK] || since_q > 16'(Periods * Period - 1));
      inside_tick: assert ( \u_dut.u_tick_monitor.tick_q == rose_q);
      inside_open: assert (!gates || open_q > 16'((Periods + 1) * Period) ||
                           open_q <= 16'(periods) * 16'(Period) + 16'(carrier_q) + 16'd1);
      inside_since: assert (periods <= PeriodsW'(Periods) && (periods == '0 || since_q[15] ||
                            since_q + 16'(Period) >= 16'(periods) * 16'(Period) + 16'(carrier_q) + 16'd1));
      errors_trip: assert (errors_q <= forgiven_q + 16'(Borne));
      seven_are_borne: assert (!trip_errors || (position_i.illegal && recent_q >= 4'(Borne)));
      inside_errors: assert (16'( \u_dut.u_encoder_errors.errors_q ) + forgiven_q >= errors_q &&
                             4'( \u_dut.u_encoder_errors.errors_q ) <= recent_q && forgive_q == \u_dut.u_encoder_errors.ticks_q );
      too_fast: cover (trip[map::FAULT_SPEED] && velocity_i < 0);
      falls: cover (trip[map::FAULT_JUMP] && moved_q < 0);
      too_hot: cover (trip[map::FAULT_I2T]);
      too_many_errors: cover (trip_errors);
      opens: cover (gates && bridge_i.period_start);
    end
  end
endmodule

`default_nettype wire
