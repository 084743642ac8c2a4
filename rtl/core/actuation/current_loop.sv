// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The loop of a measured current: sensors, controller and check, what they take from the wave, and the bridge's duty
// or, of three phases, the on-times of its legs. Timing: a new duty in each PWM period, which the PWM takes at its
// start; the measured current is held from EVENT_AT_SAMPLE on. docs/blocks/current.md

`default_nettype none

module current_loop (
    input  logic                                           clk_i,
    input  logic                                           rst_ni,
    input  logic        [feltgate_map_pkg::WAVE_LENGTH-1:0] wave_i,
    input  logic        [                             31:0] param_i,
    input  logic signed [  feltgate_pkg::PRODUCT_BITS-1:0]  product_i,
    input  logic signed [feltgate_pkg::WITH_ADDEND_W-1:0]   limited_i,       // of the limiter
    input  logic signed [     feltgate_pkg::CURRENT_W-1:0]  current_ref_i,   // A
    input  logic signed [        feltgate_pkg::DUTY_W-1:0]  duty_i,          // of the voltage law
    input  logic                                            direct_i,        // voltage mode: the loop rests
    input  logic                                            polarity_i,      // of the motor
    input  logic                                            gates_enable_i,
    input  logic                                            clear_i,         // of the faults that are kept
    input  logic                                            period_start_i,  // of the PWM
    input  logic signed [                             31:0] count_i,         // of the encoder, for three phases
    input  logic        [                             31:0] gain_i,          // of the angle, the same
    input  logic        [                             31:0] offset_i,
    input  logic        [feltgate_pkg::CURRENT_LOOP*(feltgate_pkg::PHASES-2):0] current_data_i,  // of each modulator
    input  logic                                            driver_fault_i,  // of the bridge's driver, asynchronous
    output logic                                            current_clock_o, // to the modulators
    output logic signed [                             18:0] current_o,       // measured, [1,1,17] of full scale
    output logic signed [     feltgate_pkg::CURRENT_W-1:0]  motor_current_o, // the same, A
    output logic        [feltgate_map_pkg::W_FAULTS_CURRENT+1:0] state_o,    // faults.current; then driver, current missing
    output logic signed [        feltgate_pkg::DUTY_W-1:0]  duty_o,          // for the bridge; 0 with three phases
    output logic        [                             35:0] on_o             // on-times of legs C, B, A; else 0
);
  localparam int Period = feltgate_pkg::PWM_PERIOD;
  localparam int EmfDrop = feltgate_pkg::VELOCITY_F + feltgate_pkg::P_EMF_CONSTANT_F - feltgate_pkg::VOLTAGE_F;
  localparam int CurrentDrop = feltgate_pkg::CURRENT_DROP;
  localparam int CurrentW = feltgate_pkg::CURRENT_W;
  localparam int StateW = feltgate_map_pkg::W_FAULTS_CURRENT;
  localparam int SupplyF = 17;  // voltages of the loop are [1,0,17] of the supply
  localparam logic [11:0] LimitGain = 12'(((1 << SupplyF) - 1) / Period);  // a whole period is below the supply: 17 bits

  // A product with a constant as a sum, so that no multiplier is inferred. Carries are saved, so that one adder is
  // left: of several Yosys lets two carry chains of an ECP5 begin with the same cells, which nextpnr refuses.
  function automatic logic signed [43:0] times(input logic signed [31:0] x, input logic [11:0] constant);
    logic signed [43:0] sum, carry, term, both;
    sum   = '0;
    carry = '0;
    for (int n = 0; n < 12; n++) begin
      if (constant[n]) begin
        term  = 44'(x) <<< n;
        both  = (sum & carry) | (sum & term) | (carry & term);
        sum   = sum ^ carry ^ term;
        carry = both <<< 1;
      end
    end
    times = sum + carry;
  endfunction

  // From the wave, once per tick: the reference; back-EMF and dead voltage, which are fed forward; the limit.
  logic signed [31:0] emf_q, dead_q;
  logic signed [43:0] feed_q, feed;
  logic signed [18:0] reference_q;
  logic signed [17:0] feed_forward;
  logic        [16:0] limit_q;
  always_ff @(posedge clk_i) begin
    if (wave_i[feltgate_map_pkg::PRODUCT_AT_EMF_CONSTANT]) emf_q <= 32'(product_i >>> EmfDrop);
    if (wave_i[feltgate_map_pkg::EVENT_AT_VOLTAGE_OFFSET]) dead_q <= 32'(limited_i);
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      reference_q <= '0;
      feed_q      <= '0;
      limit_q     <= '0;
    end else begin
      if (wave_i[feltgate_map_pkg::EVENT_AT_VOLTAGE]) begin
        reference_q <= 19'((32'(current_ref_i) + (32'sd1 <<< (CurrentDrop - 1))) >>> CurrentDrop);
        feed_q      <= times(emf_q + dead_q, 12'(feltgate_pkg::FEED_GAIN));
      end
      if (wave_i[feltgate_map_pkg::PARAM_AT_DUTY_LIMIT])
        limit_q <= param_i[31] ? '0 : 17'(times(param_i > 32'(Period) ? Period : param_i, LimitGain));
    end
  end
  assign feed         = feed_q >>> feltgate_pkg::FEED_DROP;
  assign feed_forward = (feed[43:17] == {27{feed[43]}}) ? feed[17:0] : {feed[43], {17{!feed[43]}}};

  // The middle of a window is that of a pulse at the terminals. All sensors have the clock of the first one.
  localparam int Sensors = feltgate_pkg::PHASES - 1;
  logic [11:0] since_q;  // clocks since a period began
  logic measured;
  logic [Sensors-1:0] sense_clock, aligned, overcurrent, stuck, saturated, offset, calibrated;
  logic [19*Sensors-1:0] at_shunt;  // of each
  logic signed [18:0] current, mean_q, resistive, across;
  logic missing_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) since_q <= '0;
    else since_q <= period_start_i ? 12'd1 : since_q + 12'd1;
  end
  /* verilator lint_off PINCONNECTEMPTY */
  generate
  genvar s;
  for (s = 0; s < Sensors; s = s + 1) begin : g_sense
    current_sense u_current_sense (
        .clk_i(clk_i), .rst_ni(rst_ni),
        .modulator_clock_o(sense_clock[s]), .data_i(current_data_i[s]),
        .strobe_i(since_q == 12'(feltgate_pkg::CURRENT_STROBE)),
        .armed_i(gates_enable_i), .clear_i(clear_i),
        .threshold_i(8'(feltgate_pkg::CURRENT_OVERCURRENT)), .current_o(at_shunt[19*s+:19]), .valid_o(), .aligned_o(aligned[s]),
        .overcurrent_o(overcurrent[s]), .calibrated_o(calibrated[s]), .offset_fault_o(offset[s]),
        .stuck_o(stuck[s]), .saturated_o(saturated[s])
    );
  end
  endgenerate
  assign current_clock_o = sense_clock[0];
  assign state_o[StateW-1:0] = {calibrated != '1, offset != '0, saturated != '0, stuck != '0, overcurrent != '0};

  // With the gates enabled, the driver's fault and a current that is missing are kept until the faults are cleared.
  logic driver_q, driver_q2, driver_kept_q, missing, open_phase;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      driver_q      <= 1'b0;
      driver_q2     <= 1'b0;
      driver_kept_q <= 1'b0;
      missing_q     <= 1'b0;
    end else begin
      driver_q      <= driver_fault_i && feltgate_pkg::DRIVER_FAULT != 0;
      driver_q2     <= driver_q;
      driver_kept_q <= (driver_q2 && gates_enable_i) || (driver_kept_q && !clear_i);
      missing_q     <= missing || open_phase || (missing_q && !clear_i);
    end
  end
  assign state_o[StateW+:2] = {missing_q, driver_q2 || driver_kept_q};

  // The current that makes tau_ref positive. The observer and the heat take the mean of the last period whose window
  // was whole.
  logic signed [31:0] in_format;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      mean_q    <= '0;
      current_o <= '0;
    end else begin
      if (measured) mean_q <= current;
      if (wave_i[feltgate_map_pkg::EVENT_AT_SAMPLE]) current_o <= mean_q;
    end
  end
  assign in_format       = 32'(current_o) <<< CurrentDrop;
  assign motor_current_o = (in_format[31:CurrentW-1] == {(33 - CurrentW) {in_format[31]}}) ? in_format[CurrentW-1:0]
                           : {in_format[31], {(CurrentW - 1) {!in_format[31]}}};

  logic signed [20:0] along;  // measured, for the check
  current_check u_current_check (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .armed_i(gates_enable_i && !direct_i), .valid_i(aligned[0]),
      .resistive_i(resistive), .across_i(across), .current_i(along),
      .resistance_i(17'(feltgate_pkg::CURRENT_RESISTANCE)), .margin_i(17'(feltgate_pkg::CURRENT_MARGIN)), .missing_o(missing)
  );

  generate
  if (feltgate_pkg::PHASES == 2) begin : g_one_current
    logic signed [17:0] voltage;
    logic signed [43:0] share;
    logic signed [feltgate_pkg::DUTY_W-1:0] duty_q;
    assign {on_o, open_phase, across} = '0;
    assign measured = aligned[0];
    // In a motor that is connected the other way round it flows against that at the shunt.
    assign current = polarity_i ? -at_shunt : at_shunt;
    assign along   = 21'(current);
    current_control u_current_control (
        .clk_i(clk_i), .rst_ni(rst_ni),
        .armed_i(gates_enable_i && !direct_i), .valid_i(measured), .reference_i(reference_q), .current_i(current),
        .emf_i(feed_forward), .proportional_i(17'(feltgate_pkg::CURRENT_PROPORTIONAL)), .integral_i(17'(feltgate_pkg::CURRENT_INTEGRAL)),
        .limit_i(limit_q), .voltage_o(voltage), .valid_o(), .saturated_o(),
        .resistive_o(resistive)
    );
    // Rounded in two steps, so that the second adder does not repeat low bits of the first.
    assign share = times(32'(voltage), 12'(Period)) >>> (SupplyF - 1);
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) duty_q <= '0;
      else duty_q <= feltgate_pkg::DUTY_W'((share + 44'sd1) >>> 1);
    end
    assign duty_o = direct_i ? duty_i : duty_q;
    logic unused_turn;
    assign unused_turn = ^{gain_i, offset_i, count_i};
  end else begin : g_three_currents
    logic signed [43:0] amplitude;
    logic signed [17:0] direct_v;
    // In direct voltage the duty is the length of the voltage.
    assign amplitude = times(32'(duty_i), LimitGain);
    assign direct_v  = (amplitude[43:17] == {27{amplitude[43]}}) ? amplitude[17:0] : {amplitude[43], {17{!amplitude[43]}}};
    field_oriented #(.Period(Period)) u_field_oriented (
        .clk_i(clk_i), .rst_ni(rst_ni),
        .armed_i(gates_enable_i), .valid_i(aligned[0]), .direct_i(direct_i), .reference_i(reference_q),
        .current_a_i(at_shunt[18:0]), .current_b_i(at_shunt[37:19]), .emf_i(direct_i ? direct_v : feed_forward),
        .position_i(count_i), .gain_i(gain_i), .offset_i(offset_i), .polarity_i(polarity_i),
        .proportional_i(17'(feltgate_pkg::CURRENT_PROPORTIONAL)), .integral_i(17'(feltgate_pkg::CURRENT_INTEGRAL)),
        .limit_i(limit_q), .current_q_o(along), .resistive_o(resistive), .across_o(across),
        .open_o(open_phase), .saturated_o(),
        .on_a_o(on_o[11:0]), .on_b_o(on_o[23:12]), .on_c_o(on_o[35:24]), .valid_o(measured)
    );
    assign current = (along[20:18] == {3{along[20]}}) ? along[18:0] : {along[20], {18{!along[20]}}};
    assign duty_o = '0;
    logic unused_sense;
    assign unused_sense = ^{sense_clock[1], aligned[1]};
  end
  /* verilator lint_on PINCONNECTEMPTY */
  endgenerate
endmodule

`default_nettype wire
