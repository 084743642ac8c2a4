// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Arms, watches and alone opens the gates. Six causes of fault; a fault is latched and the gates
// are off one clock after its cause is seen. Estimated current [1,8,8] A, I2t sum [0,31,2] A^2
// tick. Documentation: docs/blocks/supervisor.md
`default_nettype none

module supervisor #(
  parameter int Defect = 0  // test only: see testbench/supervisor
) (
  input  logic               clk_i,
  input  logic               rst_ni,
  input  logic               tick_i,           // last clock of a tick: arming and disarming
  input  logic               arm_i,            // request, a level
  input  logic               stop_i,           // external stop, asynchronous
  input  logic               clear_faults_i,   // in the clock of tick_i; acts while arm_i is low
  input  logic               kick_i,           // in the clock of tick_i
  input  logic               encoder_error_i,  // high in a clock with an illegal transition
  input  logic signed [feltgate_pkg::VELOCITY_W-1:0] velocity_i,     // new from wave clock 9
  input  logic signed [feltgate_pkg::CURRENT_W-1:0]  current_ref_i,  // the previous tick's
  /* verilator lint_off UNUSEDSIGNAL */  // the block takes its own clocks and bits off the buses
  input  logic        [49:0] wave_i,
  input  logic        [31:0] param_i,
  input  logic signed [feltgate_pkg::PRODUCT_BITS-1:0] product_i,
  /* verilator lint_on UNUSEDSIGNAL */
  output logic signed [feltgate_pkg::CURRENT_ESTIMATE_W-1:0] current_estimate_o,  // from t = 12
  output logic               armed_o,          // changes only at tick_i
  output logic               gates_enable_o,   // falls at once on a fault
  output logic        [7:0]  faults_o,         // bit n: cause n was seen
  output logic        [3:0]  first_fault_o     // number of the first cause, 0 none
);

  localparam logic [3:0] ENCODER  = 4'd1;
  localparam logic [3:0] SPEED    = 4'd2;
  localparam logic [3:0] POLARITY = 4'd3;
  localparam logic [3:0] I2T      = 4'd4;
  localparam logic [3:0] WATCHDOG = 4'd5;
  localparam logic [3:0] STOP     = 4'd6;

  localparam int LEAK_BITS     = 10;  // one encoder error is forgiven every 2^LEAK_BITS ticks
  localparam int BUCKET        = 7;   // encoder errors that are borne
  localparam int POLARITY_BITS = 16;  // longest times: 2^BITS ticks, whatever the parameter says
  localparam int WATCHDOG_BITS = 24;

  localparam int COUNTED_W     = POLARITY_BITS + 1;
  localparam int TIMER_W       = WATCHDOG_BITS + 1;

  localparam int PART_W = feltgate_pkg::CURRENT_ESTIMATE_PART_W;
  localparam int SQUARED_W = feltgate_pkg::CURRENT_SQUARED_W;
  localparam int V_DROP = feltgate_pkg::VOLTAGE_F + feltgate_pkg::P_INVERSE_RESISTANCE_F -
                          feltgate_pkg::CURRENT_ESTIMATE_PART_F;
  localparam int W_DROP = feltgate_pkg::VELOCITY_F + feltgate_pkg::P_EMF_OVER_RESISTANCE_F -
                          feltgate_pkg::CURRENT_ESTIMATE_PART_F;
  localparam int SQUARED_DROP = 2 * feltgate_pkg::CURRENT_ESTIMATE_F -
                                feltgate_pkg::CURRENT_SQUARED_F;
  localparam int SUM_W = feltgate_pkg::I2T_W + 1;  // a sum at the budget may still grow by I^2
  localparam int UNIT_W = SUM_W + 1;

  // I = V/R - (Ke/R)*w, of the voltage and the velocity of the previous tick.
  logic signed [PART_W-1:0] part_v_q, part_w;

  assign part_w = product_i[W_DROP+:PART_W];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      part_v_q           <= '0;
      current_estimate_o <= '0;
    end else begin
      if (wave_i[9])  part_v_q <= product_i[V_DROP+:PART_W];
      if (wave_i[11]) current_estimate_o <= {part_v_q[PART_W-1], part_v_q} -
                                            {part_w[PART_W-1], part_w};
    end
  end

  // Registers without a reset below are written before they are read: warm_q sets the I2t sum in
  // the first clock, live_q (off after a reset) holds the two timers.
  logic warm_q, live_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) warm_q <= 1'b0;
    else         warm_q <= 1'b1;
  end

  // One adder compares with the parameter on the bus: unit = param + operand + carry, where the
  // operand is the complement ~x, that is -x-1, of what is compared (of a signal: its size); so
  // unit < 0 says x >= param, or x > param with the carry. What is only ever compared is kept as a
  // complement. Operands are loaded one clock ahead into registers of which all but one are 0; the
  // sign is looked at one clock later.
  logic [SUM_W-1:0]     not_sum_q;       // I2t sum
  logic [COUNTED_W-1:0] not_polarity_q;  // ticks of running away so far, plus 1
  logic [TIMER_W-1:0]   not_watchdog_q;  // ticks since the last kick
  logic [TIMER_W-1:0]   not_timer, not_timer_next;
  logic                 takes_signal, takes_sum, takes_polarity, positive;
  logic signed [31:0]   signal;
  logic [31:0]          of_signal_q;
  logic [SUM_W-1:0]     of_sum_q;
  logic [TIMER_W-1:0]   of_timer_q;
  logic                 carry_q, signal_q, timer_q, over_q, unused_carry;
  logic [UNIT_W-1:0]    operand, unit;

  assign takes_signal   = wave_i[15] || wave_i[18] || wave_i[19];
  assign takes_sum      = wave_i[16] || wave_i[17];
  assign takes_polarity = wave_i[20] || wave_i[22];
  assign signal    = wave_i[19] ? 32'(current_ref_i) : 32'(velocity_i);
  assign positive  = !signal[31] || (Defect == 3);
  assign not_timer = takes_polarity ? {{(TIMER_W - COUNTED_W) {1'b1}}, not_polarity_q} :
                                      not_watchdog_q;

  always_ff @(posedge clk_i) begin
    of_signal_q <= takes_signal ? (signal ^ {32{positive}}) : '0;
    of_sum_q    <= takes_sum ? not_sum_q : '0;
    of_timer_q  <= (takes_signal || takes_sum) ? '0 : not_timer;
    carry_q     <= takes_signal && positive;  // a signal is over above its limit, the others at it
    signal_q    <= takes_signal;
    timer_q     <= !takes_signal && !takes_sum;
    over_q      <= unit[UNIT_W-1];
  end

  assign operand[TIMER_W-1:0]    = of_signal_q[TIMER_W-1:0] | of_sum_q[TIMER_W-1:0] | of_timer_q;
  assign operand[31:TIMER_W]     = of_signal_q[31:TIMER_W] | of_sum_q[31:TIMER_W] |
                                   {(32 - TIMER_W) {timer_q}};
  assign operand[SUM_W-1]        = of_sum_q[SUM_W-1] || timer_q || signal_q;
  assign operand[UNIT_W-1]       = 1'b1;
  assign {unit, unused_carry}    =
      {{(UNIT_W - 32) {param_i[31] && signal_q}}, param_i, 1'b1} + {operand, carry_q};

  // I2t: each tick sum := max(sum - Inom^2, 0) + I^2, without I^2 while disarmed. At 2^32 or more
  // nothing is added, so that it cannot wrap. In complements: cooled is param + ~sum as it stands.
  logic [UNIT_W-1:0]    not_cooled_q;
  logic [SQUARED_W-1:0] square_q;

  always_ff @(posedge clk_i) begin
    if (wave_i[17])                                                not_cooled_q <= unit;
    else if (wave_i[18] && !not_cooled_q[UNIT_W-1] && Defect != 4) not_cooled_q <= '1;
    if (wave_i[17]) begin
      if (armed_o && not_sum_q[SUM_W-1]) square_q <= product_i[SQUARED_DROP+:SQUARED_W];
      else                               square_q <= '0;
    end
    if (!warm_q)         not_sum_q <= '1;
    else if (wave_i[19]) not_sum_q <= not_cooled_q[SUM_W-1:0] -
                                      {{(SUM_W - SQUARED_W) {1'b0}}, square_q};
  end

  // Wrong polarity: fast against the commanded current in each of so many ticks.
  // Host watchdog: awake from the first kick on. One decrementer serves both timers.
  logic fast_q, runs_away_q, awake_q, polarity_full, watchdog_full;

  assign not_timer_next = not_timer - TIMER_W'(1);
  assign polarity_full  = !not_polarity_q[POLARITY_BITS];
  assign watchdog_full  = !not_watchdog_q[WATCHDOG_BITS];

  always_ff @(posedge clk_i) begin
    if (!live_q || (wave_i[22] && !runs_away_q)) not_polarity_q <= ~COUNTED_W'(1);
    else if (wave_i[22])                         not_polarity_q <= not_timer_next[COUNTED_W-1:0];
    if (!live_q || (kick_i && Defect != 5)) not_watchdog_q <= '1;
    else if (tick_i)                        not_watchdog_q <= not_timer_next;
    if (wave_i[20]) fast_q <= over_q;
    if (wave_i[21]) runs_away_q <= over_q && fast_q && (velocity_i[feltgate_pkg::VELOCITY_W-1] !=
                                                        current_ref_i[feltgate_pkg::CURRENT_W-1]);
  end

  // Encoder errors fill a bucket that leaks; the error that finds it full trips and empties it.
  logic [LEAK_BITS-1:0] leak_q;
  logic [BUCKET-1:0]    bucket_q;  // filled from bit 0
  logic                 leak, error_trip;

  assign leak       = tick_i && (leak_q == '1);
  assign error_trip = encoder_error_i && bucket_q[BUCKET-1];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      leak_q   <= '0;
      bucket_q <= '0;
      awake_q  <= 1'b0;
    end else begin
      if (tick_i) leak_q <= leak_q + LEAK_BITS'(1);
      if (error_trip)           bucket_q <= '0;
      else if (encoder_error_i) bucket_q <= {bucket_q[BUCKET-2:0], 1'b1};
      else if (leak)            bucket_q <= {1'b0, bucket_q[BUCKET-1:1]};
      if (kick_i) awake_q <= 1'b1;
    end
  end

  // Faults. Polarity, watchdog and stop need open gates, the others are seen at any time.
  logic       speed_trip, polarity_trip, i2t_trip, watchdog_trip, stop_trip;
  logic [1:0] stop_q;
  logic [7:0] trip, kept;
  logic       any_trip, clear, faulty;
  logic [3:0] code;

  assign speed_trip    = wave_i[17] && over_q;
  assign i2t_trip      = wave_i[19] && over_q;
  assign polarity_trip = wave_i[22] && live_q && runs_away_q &&
                         (over_q || polarity_full);
  assign watchdog_trip = wave_i[47] && live_q && awake_q && (over_q || watchdog_full);
  assign stop_trip     = stop_q[1] && live_q;
  assign trip = {1'b0, stop_trip, watchdog_trip, i2t_trip, polarity_trip, speed_trip, error_trip,
                 1'b0};

  always_comb begin
    if (error_trip)         code = ENCODER;
    else if (speed_trip)    code = SPEED;
    else if (polarity_trip) code = POLARITY;
    else if (i2t_trip)      code = I2T;
    else if (watchdog_trip) code = WATCHDOG;
    else                    code = STOP;
  end

  assign any_trip = trip != 8'd0;
  assign clear    = clear_faults_i && !arm_i;
  assign kept     = clear ? 8'd0 : faults_o;
  assign faulty   = first_fault_o != 4'd0;

  // A request that was high during a reset, a fault or a stop must fall before it counts again.
  logic asked_q, arms, holds;

  assign arms  = arm_i && (!asked_q || Defect == 6) && !faulty && !stop_q[1];
  assign holds = arm_i && live_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      stop_q        <= 2'b11;
      faults_o      <= 8'd0;
      first_fault_o <= 4'd0;
      asked_q       <= 1'b1;
      live_q        <= 1'b0;
      armed_o       <= 1'b0;
    end else begin
      stop_q   <= {stop_q[0], stop_i};
      faults_o <= kept | ((Defect == 1 && live_q) ? 8'd0 : trip);
      if (any_trip && (!faulty || clear || Defect == 2)) first_fault_o <= code;
      else if (clear)                                    first_fault_o <= 4'd0;
      if (tick_i) asked_q <= arm_i;
      if (any_trip && Defect != 1) live_q <= 1'b0;
      else if (tick_i)             live_q <= arms || holds;
      if (tick_i) armed_o <= (arms || holds) && !any_trip;
    end
  end

  assign gates_enable_o = live_q;

endmodule

`default_nettype wire
