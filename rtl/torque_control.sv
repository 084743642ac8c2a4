// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Torque control: torque reference to current, voltage and duty.
//   I = Jn*Kp/Ktn * tau_ref + (1 - Jn*Kp)/Ktn * tau_hat        limited, shown to the observer
//   V = gain*I + Ke*w + dead voltage                           limited
//   duty = V * period/supply                                   limited
// One adder and one limiter serve all of them in turn, the region's border too. Clocks are those of
// the wave: it takes products 22, 23, 27, 28, 29, 34, 40 four clocks after their slots; current in
// 34, voltage in 40, duty in 46. docs/blocks/torque_control.md

`default_nettype none

module torque_control #(
    // 1: unsaturated current to the observer, 2: limit on one side only, 3: region border
    // exclusive, 4: tau_hat fed back in open loop, 5: disarming leaves the voltage, 6: duty
    // truncated, 7: back-EMF of the wrong sign
    parameter int Defect = 0
) (
    input  logic                                         clk_i,
    input  logic                                         rst_ni,
    input  logic                                         armed_i,
    input  logic        [                           1:0] mode_i,     // 0 closed, 1 open, 2 voltage
    input  logic        [                          49:0] wave_i,
    input  logic        [                          31:0] param_i,
    input  logic signed [feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    input  logic signed [    feltgate_pkg::TORQUE_W-1:0] tau_ref_i,
    output logic                                         region_high_o,
    output logic signed [   feltgate_pkg::CURRENT_W-1:0] operand_o,        // I in 34, V in 40
    output logic signed [   feltgate_pkg::CURRENT_W-1:0] current_ref_o,
    output logic signed [   feltgate_pkg::VOLTAGE_W-1:0] voltage_o,
    output logic signed [      feltgate_pkg::DUTY_W-1:0] duty_o,
    output logic                                         limit_current_o,
    output logic                                         limit_voltage_o,
    output logic                                         limit_duty_o
);
  localparam int CurrentW = feltgate_pkg::CURRENT_W;
  localparam int CurrentF = feltgate_pkg::CURRENT_F;
  localparam int VoltageW = feltgate_pkg::VOLTAGE_W;
  localparam int VoltageF = feltgate_pkg::VOLTAGE_F;
  localparam int TorqueF = feltgate_pkg::TORQUE_F;
  localparam int DutyW = feltgate_pkg::DUTY_W;
  localparam int PartA = feltgate_pkg::CURRENT_SUM_W;
  localparam int PartV = feltgate_pkg::VOLTAGE_SUM_W;
  localparam int DutyPart = feltgate_pkg::DUTY_SUM_W;
  localparam int Wide = (PartA > PartV) ? PartA : PartV;
  // Fraction bits that each product has and its sum has not.
  localparam int TauRefDrop = TorqueF + feltgate_pkg::P_TORQUE_GAIN_F - CurrentF;
  localparam int TauHatDrop = TorqueF + feltgate_pkg::P_OBSERVER_GAIN_F - CurrentF;
  localparam int DirectDrop = VoltageF + feltgate_pkg::P_VOLTAGE_TO_CURRENT_F - CurrentF;
  localparam int EmfDrop = feltgate_pkg::VELOCITY_F + feltgate_pkg::P_EMF_CONSTANT_F - VoltageF;
  localparam int DeadDrop = TorqueF + feltgate_pkg::P_DEAD_VOLTAGE_SLOPE_F - VoltageF;
  localparam int GainDrop = CurrentF + feltgate_pkg::P_VOLTAGE_GAIN_F - VoltageF;
  localparam int DutyDrop = VoltageF + feltgate_pkg::P_DUTY_GAIN_F;

  localparam logic [1:0] Open = 2'd1;
  localparam logic [1:0] Voltage = 2'd2;

  logic direct;
  assign direct = (mode_i == Voltage);

  // Terms, each 0 outside its clock, so that the limiter's input is but an or: clearing a register
  // costs no logic, selecting does. What has a clock to spare is ored ahead in early_q. Disarmed,
  // current and voltage are 0 before they reach the limiter.
  logic signed [    Wide-1:0] kept_q, offset_q, current_q, border_q, direct_q, dead_q;
  logic signed [    Wide-1:0] fixed_q, set_q, voltage_q, early_q, sum;
  logic signed [DutyPart-1:0] duty_q;
  logic signed [CurrentW-1:0] limited_q;
  logic                       lively, beyond_half, carry;
  assign lively = armed_i || Defect == 5;
  localparam int ProductW = feltgate_pkg::PRODUCT_BITS;
  localparam logic [ProductW-1:0] Below = (ProductW'(1) << (DutyDrop - 1)) - ProductW'(1);
  assign beyond_half = (product_i & Below) != '0;
  assign carry       = product_i[DutyDrop-1] && Defect != 6 &&
                       (feltgate_pkg::ROUNDING == 0 ||
                        (feltgate_pkg::ROUNDING == 2 && (beyond_half || product_i[DutyDrop])));
  always_ff @(posedge clk_i) begin
    if (wave_i[26]) begin
      if (direct) offset_q <= Wide'(voltage_o);
      else if (Defect == 7) offset_q <= -Wide'(product_i >>> EmfDrop);
      else offset_q <= Wide'(product_i >>> EmfDrop);
    end
    if (wave_i[27]) begin
      if (mode_i == Open && Defect != 4) kept_q <= '0;
      else kept_q <= Wide'(product_i >>> TauHatDrop);
    end
    if (!wave_i[28]) border_q <= '0;
    else border_q <= Wide'(tau_ref_i);
    if (!(wave_i[31] && direct && armed_i)) direct_q <= '0;
    else direct_q <= Wide'(product_i >>> DirectDrop);
    if (!(wave_i[32] && !direct && armed_i)) current_q <= '0;
    else current_q <= Wide'(product_i >>> TauRefDrop) + kept_q;
    if (!(wave_i[33] && !direct)) dead_q <= '0;
    else dead_q <= Wide'(product_i >>> DeadDrop);
    fixed_q <= Wide'(limited_q) + offset_q;  // seen in 37 and 38
    if (!(wave_i[37] && direct && lively)) set_q <= '0;
    else set_q <= fixed_q;
    if (!(wave_i[38] && !direct && lively)) voltage_q <= '0;
    else voltage_q <= Wide'(product_i >>> GainDrop) + fixed_q;
    if (!wave_i[44]) duty_q <= '0;
    else duty_q <= DutyPart'(product_i >>> DutyDrop) + DutyPart'({1'b0, carry});
    early_q <= border_q | direct_q | dead_q | set_q;
  end
  assign sum = early_q | current_q | voltage_q | Wide'(duty_q);

  // Limiter: sum to [-limit, limit], limit being the word on the bus. Only as many bits are
  // compared as a limit has: a sum that needs more is beyond any limit.
  logic signed [CurrentW-1:0] limit, low;
  logic signed [CurrentW  :0] upper_gap, lower_gap;
  logic                       too_high, too_low, above, below, silent;
  assign limit     = param_i[CurrentW-1:0];
  assign low       = sum[CurrentW-1:0];
  assign too_high  = !sum[Wide-1] && sum[Wide-2:CurrentW-1] != '0;
  assign too_low   = sum[Wide-1] && sum[Wide-2:CurrentW-1] != '1;
  assign upper_gap = (CurrentW + 1)'(limit) - (CurrentW + 1)'(low);
  assign lower_gap = (CurrentW + 1)'(limit) + (CurrentW + 1)'(low);
  assign silent    = !lively && (wave_i[33] || wave_i[39]);
  assign above     = (too_high || (upper_gap[CurrentW] && !too_low)) && !silent;
  assign below     = (too_low || (lower_gap[CurrentW] && !too_high)) && !silent && Defect != 2;
  logic signed [CurrentW-1:0] limited;
  assign limited = above ? limit : below ? -limit : low;

  assign operand_o = limited_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      region_high_o   <= 1'b0;
      limited_q       <= '0;
      current_ref_o   <= '0;
      voltage_o       <= '0;
      duty_o          <= '0;
      limit_current_o <= 1'b0;
      limit_voltage_o <= 1'b0;
      limit_duty_o    <= 1'b0;
    end else begin
      if (wave_i[33] || wave_i[35] || wave_i[39]) limited_q <= limited;
      if (wave_i[33]) begin
        current_ref_o   <= (Defect == 1) ? low : limited;
        limit_current_o <= above || below;
      end
      // The region of the voltage gain, decided before its word is fetched.
      if (wave_i[30]) region_high_o <= above || below || (Defect == 3 && upper_gap == '0);
      if (wave_i[24] && direct) voltage_o <= param_i[VoltageW-1:0];
      else if (wave_i[39]) voltage_o <= VoltageW'(limited);
      if (wave_i[39]) limit_voltage_o <= above || below;
      if (wave_i[45]) begin
        duty_o       <= DutyW'(limited);
        limit_duty_o <= above || below;
      end
    end
  end

  logic unused_wave;
  assign unused_wave = &{wave_i[49:46], wave_i[43:40], wave_i[36], wave_i[34], wave_i[29],
                         wave_i[25], wave_i[23:0], param_i,
                         upper_gap[0], lower_gap[0]};
endmodule

`default_nettype wire
