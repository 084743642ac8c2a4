// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Supervisor: arms, latches faults, and alone enables the gates. It detects seven of the fifteen
// fault causes itself; other blocks report theirs on trips_i. A fault is latched and
// gates_enable_o falls one clock after the cause is seen; the gates are off a clock later. A limit
// is compared in the clock PARAM_AT_* in which it is on the parameter bus, and acts in the next,
// EVENT_AT_*. Estimated current [1,8,8] A, I2t sum [0,31,2] A^2 tick. docs/blocks/supervisor.md
`default_nettype none

module supervisor (
  input  logic               clk_i,
  input  logic               rst_ni,
  input  logic               tick_i,           // last clock of a tick; arms and disarms here
  input  logic               period_start_i,   // one clock per period of the PWM
  input  logic               host_i,           // 1: the host has control, 0: the panel
  input  logic               host_arm_i,       // the host's request to arm, a level
  input  logic               arm_i,            // the panel's request to arm, a level
  input  logic               disarm_i,         // 1: requests to arm do not count in this tick
  input  logic               stop_i,           // external stop, asynchronous, any pulse width
  input  logic               clear_faults_i,   // in the clock of tick_i
  input  logic               kick_i,           // in the clock of tick_i
  input  logic               encoder_error_i,  // high in a clock with an illegal transition
  input  logic signed [feltgate_pkg::VELOCITY_W-1:0] velocity_i,     // rad/s, from EVENT_AT_VELOCITY + 1
  input  logic signed [feltgate_pkg::CURRENT_W-1:0]  current_ref_i,  // of the previous tick
  input  logic               at_estimate_part_i,
  input  logic               at_current_estimate_i,
  input  logic               at_speed_size_i,
  input  logic               param_is_overspeed_i,
  input  logic               at_current_squared_i,
  input  logic               at_nominal_i,
  input  logic               at_speed_i,
  input  logic               at_growth_size_i,
  input  logic               param_is_i2t_budget_i,
  input  logic               at_heat_i,
  input  logic               at_strong_size_i,
  input  logic               param_is_polarity_speed_i,
  input  logic               param_is_polarity_current_i,
  input  logic               param_is_polarity_ticks_i,
  input  logic               at_polarity_i,
  input  logic               param_is_watchdog_ticks_i,
  input  logic               at_watchdog_i,
  input  logic        [31:0] param_i,
  input  logic signed [feltgate_pkg::PRODUCT_BITS-1:0] product_i,
  output logic signed [feltgate_pkg::CURRENT_ESTIMATE_W-1:0] current_estimate_o,
  output logic               armed_o,          // changes only at tick_i
  output logic               gates_enable_o,   // falls at once on a fault
  output logic               gates_clear_o,    // asynchronous: from the stop's edge until it is handled
  output logic               unkicked_o,       // arming waits for the first kick
  output logic               arm_request_o,    // request of the one that has control, if it counts
  output logic               arms_o,           // in the clock of tick_i: armed from the next one on
  output logic               ready_o,          // this axis can be armed
  output logic               clear_o,          // clear_faults_i while there is no request to arm
  input  logic               axis_silent_i,    // another axis does not request arming, or a sensor starts: a request waits
  input  logic               axis_blocked_i,   // another axis, or a sensor, is not ready: a request is refused
  input  logic        [feltgate_map_pkg::W_FAULTS_SEEN-1:0] trips_i,  // causes of other blocks, by bit
  output logic        [feltgate_map_pkg::W_FAULTS_SEEN-1:0] faults_o,  // bit n: cause n was seen
  output logic        [feltgate_map_pkg::W_FAULTS_FIRST-1:0] first_fault_o  // number of the first, 0: none
);

  localparam int FAULTS_W = feltgate_map_pkg::W_FAULTS_SEEN;
  localparam int FIRST_W  = feltgate_map_pkg::W_FAULTS_FIRST;
  localparam logic [FIRST_W-1:0] NONE = FIRST_W'(feltgate_map_pkg::FAULT_NONE);

  logic encoder_trip, speed_trip, polarity_trip, i2t_trip, watchdog_trip, stop_trip, tick_trip;

  // Cause 1, encoder errors. BORNE errors are tolerated, the next one trips. Every 2^FORGIVE_BITS
  // ticks the count of errors decreases by one.
  localparam int ERRORS_W = $clog2(feltgate_map_pkg::ERRORS_BORNE + 1);
  localparam logic [ERRORS_W-1:0] BORNE = ERRORS_W'(feltgate_map_pkg::ERRORS_BORNE);

  logic [ERRORS_W-1:0] errors_q;  // errors that still count
  logic [feltgate_map_pkg::FORGIVE_BITS-1:0] forgive_ticks_q;
  logic forgive;

  assign encoder_trip = encoder_error_i && errors_q == BORNE;
  assign forgive      = tick_i && forgive_ticks_q == '1;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)     forgive_ticks_q <= '0;
    else if (tick_i) forgive_ticks_q <= forgive_ticks_q + feltgate_map_pkg::FORGIVE_BITS'(1);
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                        errors_q <= '0;
    else if (encoder_trip)              errors_q <= '0;
    else if (encoder_error_i)           errors_q <= errors_q + ERRORS_W'(1);
    else if (forgive && errors_q != '0) errors_q <= errors_q - ERRORS_W'(1);
  end

  // Change of the velocity since the window of cause 3 began, without its lowest bits.
  localparam int GROWTH_DROP = (feltgate_pkg::VELOCITY_F > feltgate_map_pkg::GROWTH_BITS) ?
                               feltgate_pkg::VELOCITY_F - feltgate_map_pkg::GROWTH_BITS : 0;
  localparam int GROWTH_W = feltgate_pkg::VELOCITY_W - GROWTH_DROP;

  logic        [GROWTH_W-1:0] begin_q;
  logic signed [GROWTH_W-1:0] gained;
  assign gained = velocity_i[feltgate_pkg::VELOCITY_W-1:GROWTH_DROP] - begin_q;

  // Comparison of |signal| with the signed limit on the bus, for causes 2 and 3. Each signal is
  // latched one clock ahead in a register that is 0 outside its clock, so an OR combines them. For
  // a negative x, {~x, 1} = 2|x| - 1, which needs no adder; 2|x| - 1 > 2 * limit means |x| > limit.
  // Every signal is above a negative limit.
  logic signed [feltgate_pkg::VELOCITY_W-1:0] speed_q;
  logic signed [GROWTH_W-1:0]                 gained_q;
  logic signed [feltgate_pkg::CURRENT_W-1:0]  current_q;
  logic signed [31:0] signal;
  logic        [31:0] twice_size;
  logic               over;

  assign signal     = 32'(speed_q) | 32'(current_q) | (32'(gained_q) <<< GROWTH_DROP);
  assign twice_size = {signal[31] ? ~signal[30:0] : signal[30:0], signal[31]};
  assign over       = param_i[31] || {param_i[30:0], 1'b0} < twice_size;

  always_ff @(posedge clk_i) begin
    if (!at_speed_size_i) speed_q <= '0;
    else speed_q <= velocity_i;
    if (!at_growth_size_i) gained_q <= '0;
    else gained_q <= gained;
    if (!at_strong_size_i) current_q <= '0;
    else current_q <= current_ref_i;
  end

  // Cause 2, over-speed: |velocity| > overspeed.
  logic too_fast_q;

  assign speed_trip = at_speed_i && too_fast_q;

  always_ff @(posedge clk_i) begin
    if (param_is_overspeed_i) too_fast_q <= over;
  end

  // Two tick counters share an adder and a comparator: cause 3 uses them in the clock in which its
  // limit is on the bus, cause 5 in all others. While the gates are closed the counter of cause 5
  // counts the ticks for which a request to arm waits. A counter with its top bit set has reached every
  // limit. A wrap of the kick counter before the first kick has no effect. For cause 3 both results
  // are registered, because the way from the parameter RAM through the comparator is long:
  // EVENT_AT_POLARITY is the clock after PARAM_AT_POLARITY_TICKS.
  localparam int RUNAWAY_W  = feltgate_map_pkg::RUNAWAY_BITS + 1;
  localparam int KICKLESS_W = feltgate_map_pkg::KICKLESS_BITS + 1;

  logic [RUNAWAY_W-1:0]  runaway_ticks_q;   // ticks of the window, including this one
  logic [KICKLESS_W-1:0] kickless_ticks_q;  // ticks since the last kick or arming, or of waiting
  logic [KICKLESS_W-1:0] ticks, next_ticks;
  logic [RUNAWAY_W-1:0]  next_ticks_q;
  logic                  of_runaway, full, in_reach, expired, expired_q;
  logic                  handed, request, arms, waits;  // control; to arm, at the end of a tick

  assign of_runaway = param_is_polarity_ticks_i;
  assign ticks      = of_runaway ? KICKLESS_W'(runaway_ticks_q) : kickless_ticks_q;
  assign next_ticks = ticks + KICKLESS_W'(1);
  assign full       = of_runaway ? runaway_ticks_q[RUNAWAY_W-1] : kickless_ticks_q[KICKLESS_W-1];
  assign in_reach   = param_i[31:KICKLESS_W-1] == '0;
  assign expired    = full || (in_reach && ticks[KICKLESS_W-2:0] >= param_i[KICKLESS_W-2:0]);

  always_ff @(posedge clk_i) begin
    expired_q    <= expired;
    next_ticks_q <= next_ticks[RUNAWAY_W-1:0];
  end

  // Cause 3, wrong polarity: in RUNAWAY_WINDOWS consecutive windows of polarity_ticks, the speed
  // against the commanded current has grown. A window restarts when the speed is not against the
  // current.
  localparam int GROWN_W = feltgate_map_pkg::RUNAWAY_WINDOWS - 1;

  logic [GROWN_W-1:0] grown_q;  // the previous windows; 1: the speed has grown
  logic grows_q, strong_q, against;

  assign against       = strong_q && gates_enable_o && (velocity_i[feltgate_pkg::VELOCITY_W-1] !=
                                                        current_ref_i[feltgate_pkg::CURRENT_W-1]);
  assign polarity_trip = at_polarity_i && against && expired_q && grows_q &&
                         grown_q == '1;

  always_ff @(posedge clk_i) begin
    if (param_is_polarity_speed_i)
      grows_q <= over && signal[31] == velocity_i[feltgate_pkg::VELOCITY_W-1];
  end
  always_ff @(posedge clk_i) begin
    if (param_is_polarity_current_i) strong_q <= over;
  end
  always_ff @(posedge clk_i) begin
    if (at_polarity_i) begin
      if (against && !expired_q) runaway_ticks_q <= next_ticks_q;
      else begin
        runaway_ticks_q <= RUNAWAY_W'(1);
        begin_q         <= velocity_i[feltgate_pkg::VELOCITY_W-1:GROWTH_DROP];
        grown_q         <= (against && grows_q) ? GROWN_W'({grown_q, 1'b1}) : '0;
      end
    end
  end

  // Cause 4, I2t. The current is an estimate: I = V/R - (Ke/R)*w, with the voltage and the velocity
  // of the previous tick.
  localparam int PART_W = feltgate_pkg::CURRENT_ESTIMATE_PART_W;
  localparam int V_DROP = feltgate_pkg::VOLTAGE_F + feltgate_pkg::P_INVERSE_RESISTANCE_F -
                          feltgate_pkg::CURRENT_ESTIMATE_PART_F;
  localparam int W_DROP = feltgate_pkg::VELOCITY_F + feltgate_pkg::P_EMF_OVER_RESISTANCE_F -
                          feltgate_pkg::CURRENT_ESTIMATE_PART_F;

  logic signed [PART_W-1:0] part_v_q, part_w;

  assign part_w = product_i[W_DROP+:PART_W];

  always_ff @(posedge clk_i) begin
    if (at_estimate_part_i) part_v_q <= product_i[V_DROP+:PART_W];
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) current_estimate_o <= '0;
    else if (at_current_estimate_i)
      current_estimate_o <= (PART_W + 1)'(part_v_q) - (PART_W + 1)'(part_w);
  end

  // Heat: once per tick sum := max(sum - Inom^2, 0) + I^2, with I^2 = 0 while disarmed. It trips
  // one tick after sum >= budget. From 2^32 on nothing is added, so the sum cannot wrap.
  localparam int SQUARED_W = feltgate_pkg::CURRENT_SQUARED_W;
  localparam int SQUARED_DROP = 2 * feltgate_pkg::CURRENT_ESTIMATE_F -
                                feltgate_pkg::CURRENT_SQUARED_F;
  localparam int SUM_W = feltgate_pkg::I2T_W + 1;  // a sum at the budget can still grow by I^2

  // A reset does not clear the sum: a reset clears faults, but the motor stays hot.
  logic        [SUM_W-1:0]     sum_q = SUM_W'(feltgate_pkg::I2T_START);
  logic        [30:0]          nominal_q;  // Inom^2; a negative word counts as 0
  logic signed [SUM_W:0]       rest;
  logic        [SUM_W-1:0]     cooled_q;
  logic        [SQUARED_W-1:0] square_q;
  logic                        too_hot_q;

  assign rest     = $signed({1'b0, sum_q}) - $signed((SUM_W + 1)'(nominal_q));
  assign i2t_trip = at_heat_i && too_hot_q;

  always_ff @(posedge clk_i) begin
    if (!at_nominal_i || param_i[31]) nominal_q <= '0;
    else nominal_q <= param_i[30:0];
  end
  always_ff @(posedge clk_i) begin
    if (rest < 0) cooled_q <= '0;
    else cooled_q <= rest[SUM_W-1:0];
  end
  always_ff @(posedge clk_i) begin
    if (param_is_i2t_budget_i) too_hot_q <= sum_q >= SUM_W'(param_i);
  end
  always_ff @(posedge clk_i) begin
    if (at_current_squared_i)
      square_q <= (armed_o && !sum_q[SUM_W-1]) ? product_i[SQUARED_DROP+:SQUARED_W] : '0;
  end
  always_ff @(posedge clk_i) begin
    if (at_heat_i) sum_q <= cooled_q + SUM_W'(square_q);
  end

  // Cause 5, host watchdog: watchdog_ticks ticks without a kick, from the first kick on.
  logic awake_q, silent_q;

  assign watchdog_trip = at_watchdog_i && gates_enable_o && awake_q &&
                         silent_q;

  assign unkicked_o = feltgate_pkg::REQUIRE_WATCHDOG != 0 && !awake_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)     awake_q <= 1'b0;
    else if (kick_i) awake_q <= 1'b1;
  end
  always_ff @(posedge clk_i) begin
    if (param_is_watchdog_ticks_i) silent_q <= expired || param_i[31];
  end
  always_ff @(posedge clk_i) begin
    if (tick_i) kickless_ticks_q <= (gates_enable_o ? arms && !kick_i : waits && !handed) ? next_ticks : '0;
  end

  // Cause 6, external stop. The pin itself clears the gates and sets the flip-flop stopped_q, with
  // or without a clock. stopped_q, through two synchroniser flip-flops, is the cause. It is
  // released once the cause was seen, the gates are off and no fault is latched. It has no
  // asynchronous reset, because few devices have a flip-flop with asynchronous set and reset; it
  // powers up set.
  logic       stopped_q = 1'b1;
  logic [1:0] stop_q;
  logic       dealt_with;

  assign stop_trip     = stop_q[1] && gates_enable_o;
  assign dealt_with    = stop_q[1] && !gates_enable_o && first_fault_o == NONE;
  assign gates_clear_o = stop_i || stopped_q;

  always_ff @(posedge clk_i or posedge stop_i) begin
    if (stop_i)          stopped_q <= 1'b1;
    else if (dealt_with) stopped_q <= 1'b0;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) stop_q <= 2'b11;
    else         stop_q <= {stop_q[0], stopped_q};
  end

  // Cause 9, tick_i is stuck, low or high. The PWM's carrier does not depend on it. TICK_PERIODS
  // PWM periods always contain a tick; it trips if one more period begins without a tick.
  localparam int TICK_PERIODS = (feltgate_pkg::CLOCKS_PER_TICK + feltgate_pkg::PWM_PERIOD - 1) /
                                feltgate_pkg::PWM_PERIOD;
  localparam int PERIODS_W = $clog2(TICK_PERIODS + 1);

  logic                 tick_q, too_many;
  logic [PERIODS_W-1:0] tickless_q;  // periods that began since the last tick

  assign too_many  = tickless_q == PERIODS_W'(TICK_PERIODS);
  assign tick_trip = period_start_i && too_many;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      tick_q     <= 1'b0;
      tickless_q <= '0;
    end else begin
      tick_q <= tick_i;
      if (tick_i && !tick_q)                tickless_q <= '0;
      else if (period_start_i && !too_many) tickless_q <= tickless_q + PERIODS_W'(1);
    end
  end

  // Faults stay until they are cleared. If several come in one clock, the lowest number is the
  // first. In a clock without a cause both keep their value, so they need no enable.
  logic [FAULTS_W-1:0] trip;
  logic                any_trip;

  assign trip = (FAULTS_W'(encoder_trip) << feltgate_map_pkg::FAULT_ENCODER) |
                (FAULTS_W'(speed_trip) << feltgate_map_pkg::FAULT_SPEED) |
                (FAULTS_W'(polarity_trip) << feltgate_map_pkg::FAULT_POLARITY) |
                (FAULTS_W'(i2t_trip) << feltgate_map_pkg::FAULT_I2T) |
                (FAULTS_W'(watchdog_trip) << feltgate_map_pkg::FAULT_WATCHDOG) |
                (FAULTS_W'(stop_trip) << feltgate_map_pkg::FAULT_STOP) |
                (FAULTS_W'(tick_trip) << feltgate_map_pkg::FAULT_TICK) | trips_i;

  assign any_trip = trip != '0;
  assign clear_o  = clear_faults_i && !request;

  function automatic logic [FIRST_W-1:0] lowest(input logic [FAULTS_W-1:0] causes);
    lowest = NONE;
    for (int n = FAULTS_W - 1; n > 0; n--) if (causes[n]) lowest = FIRST_W'(n);
  endfunction

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      faults_o      <= '0;
      first_fault_o <= NONE;
    end else begin
      faults_o <= (clear_o ? '0 : faults_o) | trip;
      if (clear_o || first_fault_o == NONE) first_fault_o <= lowest(trip);
    end
  end

  // Arming, at the end of a tick. A request counts from a tick in which it was low, while its side
  // has control, until it is refused. One that counts opens the gates, holds them open, or waits. A
  // change of control refuses what holds them open.
  localparam int WAIT_TICKS = feltgate_pkg::CLOCK_HZ / 1000 * feltgate_map_pkg::ARM_WAIT_MS /
                              feltgate_pkg::CLOCKS_PER_TICK - 1;
  logic host_counts_q, panel_counts_q, host_q, counts, able, in_time, may_arm;
  logic stop_seen_q;  // in this tick

  assign request = (host_i ? host_arm_i : arm_i) && !disarm_i;
  assign handed  = host_i != host_q;
  assign counts  = (host_i ? host_counts_q : panel_counts_q) && !(gates_enable_o && handed);
  assign able    = first_fault_o == NONE && !stop_q[1] && !stop_seen_q && !unkicked_o;
  assign in_time = handed || kickless_ticks_q < KICKLESS_W'(WAIT_TICKS);
  assign may_arm = request && ready_o && !any_trip && (gates_enable_o || (!axis_blocked_i && in_time));
  assign arms    = may_arm && !axis_silent_i;  // arms, or stays armed
  assign waits   = may_arm && axis_silent_i && !gates_enable_o;

  assign arm_request_o = request && counts;
  assign ready_o       = able && counts;
  assign arms_o        = arms;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) stop_seen_q <= 1'b0;
    else         stop_seen_q <= !tick_i && (stop_seen_q || stop_q[1]);
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      host_q         <= 1'b0;
      host_counts_q  <= 1'b0;
      panel_counts_q <= 1'b0;
      armed_o        <= 1'b0;
      gates_enable_o <= 1'b0;
    end else if (tick_i) begin
      host_q         <= host_i;
      host_counts_q  <= !host_arm_i || (host_i && (arms || waits));
      panel_counts_q <= !arm_i || (!host_i && (arms || waits));
      armed_o        <= arms;
      gates_enable_o <= arms;
    end else if (any_trip) begin
      gates_enable_o <= 1'b0;
    end
  end

  logic unused;
  assign unused = ^product_i;  // the estimate takes its bits of a product
endmodule

`default_nettype wire
