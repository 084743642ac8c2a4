// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// When a cause of the supervisor's own trips: speed, growth against the command, heat, silence, encoder
// errors. Each law is written here in whole ticks and wide numbers.
`default_nettype none

module limits_proof (
    input logic                                           clk_i,
    input logic                                           rst_ni,
    input logic        [                              8:0] start_i,  // where in a tick a reset ends
    input logic                                           period_start_i,
    input logic                                           host_i,
    input logic                                           host_arm_i,
    input logic                                           arm_i,
    input logic                                           disarm_i,
    input logic                                           stop_i,
    input logic                                           clear_faults_i,
    input logic                                           kick_i,
    input logic                                           encoder_error_i,
    input logic signed [      feltgate_pkg::VELOCITY_W-1:0] velocity_i,
    input logic signed [       feltgate_pkg::CURRENT_W-1:0] current_ref_i,
    input logic        [                             31:0] param_i,
    input logic signed [    feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    input logic        [feltgate_map_pkg::W_FAULTS_SEEN-1:0] trips_i,
    input logic                                           axis_silent_i,
    input logic                                           axis_blocked_i,
    input logic                                           watch_i    // from here on errors are counted
);
  `include "wave.svh"
  wire tick_i = tick;
  wire [feltgate_map_pkg::WAVE_LENGTH-1:0] wave_i = wave;
  `include "supervisor.svh"

  localparam logic [FaultsW-1:0] OwnCauses = (FaultsW'(1) << feltgate_map_pkg::FAULT_ENCODER) |
      (FaultsW'(1) << feltgate_map_pkg::FAULT_SPEED) | (FaultsW'(1) << feltgate_map_pkg::FAULT_POLARITY) |
      (FaultsW'(1) << feltgate_map_pkg::FAULT_I2T) | (FaultsW'(1) << feltgate_map_pkg::FAULT_WATCHDOG) | FaultsW'(1);
  localparam int VelocityW = feltgate_pkg::VELOCITY_W;
  localparam int CurrentW = feltgate_pkg::CURRENT_W;

  // A tick counts as whole where the reset is over before its wave.
  logic whole_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) whole_q <= 1'b0;
    else if (wave[0]) whole_q <= 1'b1;
  end

  logic signed [VelocityW-1:0] velocity_q;
  logic signed [CurrentW-1:0] current_q;
  logic steady;
  assign steady = whole_q && phase_q > 9'(feltgate_map_pkg::EVENT_AT_SPEED_SIZE) &&
                  phase_q <= 9'(feltgate_map_pkg::EVENT_AT_POLARITY);
  always_ff @(posedge clk_i) begin
    velocity_q <= velocity_i;
    current_q  <= current_ref_i;
  end
  always_comb begin
    assume ((trips_i & OwnCauses) == '0);
    assume (tick || (!clear_faults_i && !kick_i));
    assume (!steady || (velocity_i == velocity_q && current_ref_i == current_q));
  end


  // Size of a signal against the word on the bus; a negative word is below everything.
  function automatic logic over_limit(input logic signed [32:0] x, input logic [31:0] word);
    over_limit = word[31] || (x < 0 ? -x : x) > $signed({1'b0, word});
  endfunction

  // Over-speed.
  logic fast_q;
  always_ff @(posedge clk_i) begin
    if (wave[feltgate_map_pkg::PARAM_AT_OVERSPEED]) fast_q <= over_limit(33'(velocity_i), param_i);
  end

  // Growth against the command: ticks of the window, the velocity before it, the windows before it that grew.
  localparam int Drop = (feltgate_pkg::VELOCITY_F > feltgate_map_pkg::GROWTH_BITS) ?
                        feltgate_pkg::VELOCITY_F - feltgate_map_pkg::GROWTH_BITS : 0;
  localparam int Longest = 2 ** feltgate_map_pkg::RUNAWAY_BITS;
  logic signed [VelocityW-1:0] coarse, before_q, growth;
  logic grew_q, strong_q, last_grew_q, against, ends, ends_q;
  logic [17:0] ticks_q;
  assign coarse = (velocity_i >>> Drop) <<< Drop;
  assign growth = coarse - before_q;
  assign against = gates && strong_q && (velocity_i < 0) != (current_ref_i < 0);
  assign ends = ticks_q >= 18'(Longest) || {14'd0, ticks_q} >= param_i;
  always_ff @(posedge clk_i) begin
    if (wave[feltgate_map_pkg::PARAM_AT_POLARITY_SPEED])
      grew_q <= over_limit(33'(growth), param_i) && (growth < 0) == (velocity_i < 0);
    if (wave[feltgate_map_pkg::PARAM_AT_POLARITY_CURRENT]) strong_q <= over_limit(33'(current_ref_i), param_i);
    ends_q <= ends;
    if (wave[feltgate_map_pkg::EVENT_AT_POLARITY]) begin
      if (against && !ends_q) ticks_q <= ticks_q + 18'd1;
      else begin
        ticks_q     <= 18'd1;
        before_q    <= coarse;
        last_grew_q <= against && grew_q;
      end
    end
  end
  // Two ticks of reset state: the first window may begin anywhere.
  logic window_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) window_q <= 1'b0;
    else if (whole_q && wave[feltgate_map_pkg::EVENT_AT_POLARITY]) window_q <= 1'b1;
  end

  // Heat: what a tick makes of it, all at once.
  localparam int SumW = feltgate_pkg::I2T_W + 1;
  localparam int SquaredW = feltgate_pkg::CURRENT_SQUARED_W;
  localparam int SquaredDrop = 2 * feltgate_pkg::CURRENT_ESTIMATE_F - feltgate_pkg::CURRENT_SQUARED_F;
  (* hierconn *) wire [SumW-1:0] \u_dut.sum_q ;
  wire [SumW-1:0] heat = \u_dut.sum_q ;
  logic [SumW:0] cooled_q;
  logic [SquaredW-1:0] added_q;
  logic [SumW-1:0] heat_q;
  logic hot_q, heated_q, taken_q;
  logic [31:0] nominal;
  assign nominal = param_i[31] ? 32'd0 : param_i;
  always_ff @(posedge clk_i) begin
    heat_q   <= heat;
    heated_q <= wave[feltgate_map_pkg::EVENT_AT_HEAT];
    if (wave[feltgate_map_pkg::PARAM_AT_I2T_BUDGET]) hot_q <= heat >= SumW'(param_i);
    if (wave[feltgate_map_pkg::PARAM_AT_NOMINAL_CURRENT_SQUARED]) begin
      cooled_q <= (heat > SumW'(nominal)) ? (SumW + 1)'(heat) - (SumW + 1)'(nominal) : '0;
      added_q  <= (armed && heat < SumW'(33'd1 << 32)) ? product_i[SquaredDrop+:SquaredW] : '0;
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) taken_q <= 1'b0;
    else taken_q <= whole_q && wave[feltgate_map_pkg::EVENT_AT_HEAT];
  end

  // Silence: ticks since the last kick, or since the gates opened.
  localparam logic [25:0] Patience = 26'd1 << feltgate_map_pkg::KICKLESS_BITS;
  logic [25:0] silence_q;
  logic awake_q, silent_q, still_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) awake_q <= 1'b0;
    else if (kick_i) awake_q <= 1'b1;
  end
  always_ff @(posedge clk_i) begin
    if (tick) silence_q <= (kick_i || !gates) ? 26'd0 : silence_q + 26'd1;
    if (wave[feltgate_map_pkg::PARAM_AT_WATCHDOG_TICKS])
      silent_q <= silence_q >= Patience || param_i[31] || {6'd0, silence_q} >= param_i;
  end
  (* hierconn *) wire [feltgate_map_pkg::KICKLESS_BITS:0] \u_dut.kickless_ticks_q ;
  (* hierconn *) wire \u_dut.awake_q ;

  // Errors: those since watch_i, or since the last trip, and those that were forgiven meanwhile.
  localparam int Borne = feltgate_map_pkg::ERRORS_BORNE;
  logic [feltgate_map_pkg::FORGIVE_BITS-1:0] forgive_q;
  logic [15:0] errors_q, forgiven_q;
  logic forgive, watched_q;
  logic [3:0] recent_q;  // since the last trip or reset, up to 15
  assign forgive = tick && forgive_q == '1;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      forgive_q  <= '0;
      watched_q  <= 1'b0;
      errors_q   <= '0;
      forgiven_q <= '0;
      recent_q   <= '0;
    end else begin
      if (tick) forgive_q <= forgive_q + feltgate_map_pkg::FORGIVE_BITS'(1);
      if (trip[feltgate_map_pkg::FAULT_ENCODER]) recent_q <= '0;
      else if (encoder_error_i && recent_q != 4'd15) recent_q <= recent_q + 4'd1;
      if (watch_i || trip[feltgate_map_pkg::FAULT_ENCODER] || forgiven_q[15]) begin
        errors_q   <= '0;
        forgiven_q <= '0;
      end else begin
        errors_q   <= errors_q + 16'(encoder_error_i);
        forgiven_q <= forgiven_q + 16'(forgive);
      end
    end
  end
  localparam int ErrorsW = $clog2(Borne + 1);
  (* hierconn *) wire [ErrorsW-1:0] \u_dut.errors_q ;
  (* hierconn *) wire [feltgate_map_pkg::FORGIVE_BITS-1:0] \u_dut.forgive_ticks_q ;

  logic late;  // after the tick, before the wave
  assign late = phase_q > 9'(Clocks - 1 - feltgate_map_pkg::FIRST_WAVE_CLOCK) || phase_q == 9'd0;
  (* hierconn *) wire \u_dut.host_counts_q ;
  (* hierconn *) wire \u_dut.panel_counts_q ;
  wire counts = \u_dut.host_counts_q || \u_dut.panel_counts_q ;

  // Inside: what the laws' registers share with the block's.
  (* hierconn *) wire [feltgate_map_pkg::RUNAWAY_BITS:0] \u_dut.runaway_ticks_q ;
  (* hierconn *) wire [feltgate_map_pkg::RUNAWAY_BITS:0] \u_dut.next_ticks_q ;
  (* hierconn *) wire \u_dut.expired_q ;
  (* hierconn *) wire [VelocityW-Drop-1:0] \u_dut.begin_q ;
  (* hierconn *) wire [feltgate_map_pkg::RUNAWAY_WINDOWS-2:0] \u_dut.grown_q ;

  always_comb begin
    if (past_ok_q) begin
      heat_in_its_clock: assert (heated_q || heat == heat_q);
    end
    if (rst_ni && past_ok_q) begin
      overspeed_in_its_clock: assert (!whole_q || trip[feltgate_map_pkg::FAULT_SPEED] ==
                                      (wave[feltgate_map_pkg::EVENT_AT_SPEED] && fast_q));
      runaway_in_its_clock: assert (!window_q || trip[feltgate_map_pkg::FAULT_POLARITY] ==
                                    (wave[feltgate_map_pkg::EVENT_AT_POLARITY] && against && ends_q &&
                                     grew_q && last_grew_q));
      heat_is_its_law: assert (!taken_q || (SumW + 1)'(heat) == cooled_q + (SumW + 1)'(added_q));
      hot_in_its_clock: assert (!whole_q || trip[feltgate_map_pkg::FAULT_I2T] ==
                                (wave[feltgate_map_pkg::EVENT_AT_HEAT] && hot_q));
      silence_in_its_clock: assert (!whole_q || trip[feltgate_map_pkg::FAULT_WATCHDOG] ==
                                    (wave[feltgate_map_pkg::EVENT_AT_WATCHDOG] && gates && awake_q && silent_q));
      inside_patience_ends: assert (!gates || !awake_q || !whole_q || silence_q <= Patience);
      errors_trip: assert (errors_q <= forgiven_q + 16'(Borne));
      seven_are_borne: assert (!trip[feltgate_map_pkg::FAULT_ENCODER] || (encoder_error_i && recent_q >= 4'(Borne)));

      inside_window: assert (!window_q || ({1'b0, \u_dut.runaway_ticks_q } == ticks_q &&
          \u_dut.begin_q == before_q[VelocityW-1:Drop] &&
                             \u_dut.grown_q == last_grew_q && ticks_q <= 18'(Longest) &&
                             before_q == (before_q >>> Drop) <<< Drop));
      inside_turn: assert (!window_q || !wave[feltgate_map_pkg::EVENT_AT_POLARITY] || (\u_dut.expired_q == ends_q &&
                           (ends_q || {1'b0, \u_dut.next_ticks_q } == ticks_q + 18'd1)));
      inside_awake: assert (\u_dut.awake_q == awake_q);
      inside_silence: assert (!gates || !awake_q ||
          \u_dut.kickless_ticks_q == silence_q[feltgate_map_pkg::KICKLESS_BITS:0]);
      inside_whole: assert ((!gates || window_q) && (!window_q || whole_q) && (whole_q || !counts || late) &&
                            (window_q || !counts || late || phase_q <= 9'(feltgate_map_pkg::EVENT_AT_POLARITY)));
      inside_patience: assert (!gates || !awake_q || silence_q != Patience || late ||
                               phase_q <= 9'(feltgate_map_pkg::EVENT_AT_WATCHDOG));
      inside_errors: assert (16'(\u_dut.errors_q ) + forgiven_q >= errors_q && 4'(\u_dut.errors_q ) <= recent_q &&
                             forgive_q == \u_dut.forgive_ticks_q );
      too_fast: cover (trip[feltgate_map_pkg::FAULT_SPEED] && velocity_i < 0 && whole_q);
      too_many_errors: cover (trip[feltgate_map_pkg::FAULT_ENCODER]);
      too_hot: cover (trip[feltgate_map_pkg::FAULT_I2T] && taken_q == 1'b0 && whole_q);
    end
  end
endmodule

`default_nettype wire
