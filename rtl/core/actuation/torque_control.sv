// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Torque control: torque reference to current, voltage and duty.
//   I = Jn*Kp/Ktn * tau_ref + (1 - Jn*Kp)/Ktn * tau_hat        limited; the observer gets it
//   V = gain*I + Ke*w + dead voltage                           V - Ke*w is limited (the window)
//   duty = V * period/supply                                   limited
// The core's one limiter limits the sums and then adds addend_o. The limiter gets a sum in the clock of the limit's
// word. One clock later limited_i is the result, and one more clock later the output has it.
// docs/blocks/torque_control.md

`default_nettype none

module torque_control (
    input  logic                                                   clk_i,
    input  logic                                                   rst_ni,
    input  logic                                                   armed_i,
    input  logic        [                                     1:0] mode_i,  // 0 closed, 1 open loop, 2 voltage
    input  logic                                                   product_is_emf_constant_i,
    input  logic                                                   product_is_observer_gain_i,
    input  logic                                                   at_border_i,
    input  logic                                                   at_region_i,
    input  logic                                                   param_is_voltage_setpoint_i,
    input  logic                                                   product_is_voltage_to_current_i,
    input  logic                                                   param_is_voltage_step_i,
    input  logic                                                   product_is_torque_gain_i,
    input  logic                                                   at_direct_voltage_i,
    input  logic                                                   param_is_current_limit_i,
    input  logic                                                   product_is_dead_voltage_slope_i,
    input  logic                                                   at_current_i,
    input  logic                                                   at_hold_size_i,
    input  logic                                                   param_is_dead_voltage_i,
    input  logic                                                   at_voltage_offset_i,
    input  logic                                                   product_next_voltage_gain_i,
    input  logic                                                   product_is_voltage_gain_i,
    input  logic                                                   param_is_voltage_window_i,
    input  logic                                                   at_voltage_i,
    input  logic                                                   product_is_duty_gain_i,
    input  logic                                                   at_duty_i,
    input  logic        [                                    31:0] param_i,
    input  logic signed [          feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    input  logic signed [              feltgate_pkg::TORQUE_W-1:0] tau_ref_i,  // Nm
    output logic signed [       feltgate_pkg::LIMITER_INPUT_W-1:0] early_term_o,  // one clock before its limit
    output logic signed [       feltgate_pkg::LIMITER_INPUT_W-1:0] late_term_o,   // with its limit
    output logic                                                   late_up_o,     // with late_term_o: it is rounded up
    output logic signed [         feltgate_pkg::WITH_ADDEND_W-1:0] addend_o,      // to the limited value
    input  logic signed [         feltgate_pkg::WITH_ADDEND_W-1:0] limited_i,     // with addend_o added
    input  logic                                                   over_limit_i,
    output logic                                                   region_high_o,  // high torque
    output logic signed [             feltgate_pkg::CURRENT_W-1:0] current_ref_o,  // A
    output logic signed [             feltgate_pkg::VOLTAGE_W-1:0] voltage_o,  // V
    output logic signed [                feltgate_pkg::DUTY_W-1:0] duty_o,  // PWM clocks
    output logic                                                   limit_current_o,  // limited in this tick
    output logic                                                   limit_voltage_o,
    output logic                                                   limit_duty_o
);
  localparam int CurrentF = feltgate_pkg::CURRENT_F;
  localparam int VoltageF = feltgate_pkg::VOLTAGE_F;
  localparam int TorqueF = feltgate_pkg::TORQUE_F;
  localparam int CurrentSumW = feltgate_pkg::CURRENT_SUM_W;
  localparam int VoltageSumW = feltgate_pkg::VOLTAGE_SUM_W;
  localparam int DutySumW = feltgate_pkg::DUTY_SUM_W;
  localparam int EmfW = feltgate_pkg::EMF_W;
  localparam bit EmfInLaw = feltgate_pkg::EMF_IN_LAW != 0;
  localparam int AppliedSumW = feltgate_pkg::WITH_ADDEND_W;
  localparam int SumW = (CurrentSumW > VoltageSumW) ? CurrentSumW : VoltageSumW;
  localparam int Wide = feltgate_pkg::LIMITER_INPUT_W;
  // Drop: fraction bits of a product below the last bit of its sum.
  localparam int TauRefDrop = TorqueF + feltgate_pkg::P_TORQUE_GAIN_F - CurrentF;
  localparam int TauHatDrop = TorqueF + feltgate_pkg::P_OBSERVER_GAIN_F - CurrentF;
  localparam int DirectDrop = VoltageF + feltgate_pkg::P_VOLTAGE_TO_CURRENT_F - CurrentF;
  localparam int EmfDrop = feltgate_pkg::VELOCITY_F + feltgate_pkg::P_EMF_CONSTANT_F - VoltageF;
  localparam int DeadDrop = TorqueF + feltgate_pkg::P_DEAD_VOLTAGE_SLOPE_F - VoltageF;
  localparam int GainDrop = CurrentF + feltgate_pkg::P_VOLTAGE_GAIN_F - VoltageF;
  localparam int DutyDrop = VoltageF + feltgate_pkg::P_DUTY_GAIN_F;

  localparam logic [1:0] Open = 2'(feltgate_map_pkg::MODE_OPEN);
  localparam logic [1:0] Voltage = 2'(feltgate_map_pkg::MODE_VOLTAGE);

  logic voltage_mode, torque_armed, voltage_armed;
  assign voltage_mode  = mode_i == Voltage;
  assign torque_armed = !voltage_mode && armed_i;
  assign voltage_armed   = voltage_mode && armed_i;

  logic carry;
  rounding #(
      .Drop(DutyDrop)
  ) u_rounding (
      .low_i(product_i[DutyDrop:0]),
      .negated_i(1'b0),
      .up_o(carry)
  );

  // The addend to the limiter's result is not 0 in three clocks:
  //   after PARAM_AT_VOLTAGE_STEP    the voltage of the previous tick, added to the step of its ramp
  //   after PARAM_AT_DEAD_VOLTAGE    minus the back-EMF, if the law does not compensate the back-EMF
  //   after PARAM_AT_VOLTAGE_WINDOW  the back-EMF, added to the result of the window
  logic signed [         EmfW-1:0] emf_q;
  always_ff @(posedge clk_i) begin
    if (product_is_emf_constant_i) emf_q <= EmfW'(product_i >>> EmfDrop);
    if (param_is_voltage_step_i && voltage_armed) addend_o <= AppliedSumW'(voltage_o);
    else if (param_is_voltage_window_i && armed_i) addend_o <= AppliedSumW'(emf_q);
    else if (param_is_dead_voltage_i && !EmfInLaw && !voltage_mode) addend_o <= -(AppliedSumW'(emf_q));
    else addend_o <= '0;
  end

  // Start values of the sums. At most one of them is not 0, so an OR combines them.
  logic signed [VoltageSumW-1:0] voltage_offset_q;
  logic signed [CurrentSumW-1:0] current_of_tau_hat_q;
  logic                          fixes;
  assign fixes = voltage_mode ? at_direct_voltage_i : at_voltage_offset_i;
  always_ff @(posedge clk_i) begin
    if (mode_i == Open || param_is_current_limit_i) current_of_tau_hat_q <= '0;
    else if (product_is_observer_gain_i) current_of_tau_hat_q <= CurrentSumW'(product_i >>> TauHatDrop);
    if (param_is_voltage_window_i) voltage_offset_q <= '0;
    else if (fixes) voltage_offset_q <= VoltageSumW'(limited_i);
  end

  // Each term is 0 outside its clock, so an OR forms the limiter's input. A register's synchronous
  // clear costs no logic, a multiplexer does. Disarmed, current and voltage are 0 at that input.
  logic signed [ feltgate_pkg::TORQUE_W-1:0] compared_tau_ref_q;
  logic signed [feltgate_pkg::VOLTAGE_W : 0] error_q;
  logic signed [CurrentSumW-1:0] direct_q;
  logic signed [VoltageSumW-1:0] dead_q;
  logic signed [       SumW-1:0] base, product, sum_q;
  logic signed [   DutySumW-1:0] duty_q;
  logic signed [           EmfW-1:0] less_emf_q;  // complement of the back-EMF; the carry completes it
  logic                              voltage_q;
  assign base    = SumW'(current_of_tau_hat_q) | SumW'(voltage_offset_q);
  // Clock of torque_gain: the current of tau_ref; of voltage_gain: the voltage of the current.
  // In the voltage mode the latter product is 0, and the back-EMF is subtracted.
  assign product = (product_is_voltage_gain_i ? SumW'(product_i >>> GainDrop) : SumW'(product_i >>> TauRefDrop)) |
                   SumW'(less_emf_q);
  always_ff @(posedge clk_i) begin
    voltage_q <= product_next_voltage_gain_i && voltage_mode;
    if (!(product_next_voltage_gain_i && voltage_mode)) less_emf_q <= '0;
    else less_emf_q <= ~emf_q;
    if (!(at_border_i || at_hold_size_i)) compared_tau_ref_q <= '0;
    else compared_tau_ref_q <= tau_ref_i;
    if (!(product_is_voltage_to_current_i && voltage_armed)) direct_q <= '0;
    else direct_q <= CurrentSumW'(product_i >>> DirectDrop);
    if (!(product_is_dead_voltage_slope_i && !voltage_mode)) dead_q <= '0;
    else dead_q <= VoltageSumW'(product_i >>> DeadDrop);
    if (!(param_is_voltage_setpoint_i && voltage_armed)) error_q <= '0;
    else error_q <= $signed(param_i[feltgate_pkg::VOLTAGE_W-1:0]) - voltage_o;
    if (!((product_is_torque_gain_i && torque_armed) || (product_is_voltage_gain_i && armed_i))) sum_q <= '0;
    else sum_q <= product + base + SumW'({1'b0, voltage_q});
    if (!product_is_duty_gain_i) duty_q <= '0;
    else duty_q <= DutySumW'(product_i >>> DutyDrop);
    late_up_o <= product_is_duty_gain_i && carry;
  end
  assign early_term_o = Wide'(compared_tau_ref_q) | Wide'(direct_q) | Wide'(dead_q);
  assign late_term_o  = Wide'(sum_q) | Wide'(duty_q) | Wide'(error_q);

  // The voltage saturates at the range of its port. The voltage at the motor is below the supply,
  // so this matters only for the current estimate. It saturates after its register: the sum is late in
  // its clock.
  localparam int VoltageW = feltgate_pkg::VOLTAGE_W;
  logic signed [AppliedSumW-1:0] applied_q;
  logic                          voltage_over;
  assign voltage_over = applied_q[AppliedSumW-1:VoltageW-1] != {(AppliedSumW - VoltageW + 1) {applied_q[AppliedSumW-1]}};
  assign voltage_o    = voltage_over ? {applied_q[AppliedSumW-1], {(VoltageW - 1) {~applied_q[AppliedSumW-1]}}}
                                     : applied_q[VoltageW-1:0];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      region_high_o   <= 1'b0;
      current_ref_o   <= '0;
      applied_q       <= '0;
      duty_o          <= '0;
      limit_current_o <= 1'b0;
      limit_voltage_o <= 1'b0;
      limit_duty_o    <= 1'b0;
    end else begin
      // The region of the voltage gain is decided before its word is fetched.
      if (at_region_i) region_high_o <= over_limit_i;
      if (at_current_i) begin
        current_ref_o   <= limited_i[feltgate_pkg::CURRENT_W-1:0];
        limit_current_o <= over_limit_i && armed_i;
      end
      if (at_voltage_i) begin
        applied_q       <= limited_i;
        limit_voltage_o <= over_limit_i && armed_i;
      end
      if (at_duty_i) begin
        duty_o       <= limited_i[feltgate_pkg::DUTY_W-1:0];
        limit_duty_o <= over_limit_i;
      end
    end
  end

  logic unused;
  assign unused = ^param_i;  // a voltage has fewer bits than a word
endmodule

`default_nettype wire
