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

  // Adder: one product, cut to the sum's binary point, plus what has been kept. Clock 29 passes
  // tau_ref on, so that the limiter compares it with the border in 30.
  logic signed [    Wide-1:0] kept_q, offset_q, sum_q, term, addend;
  logic signed [CurrentW-1:0] limited_q;
  logic                       carry, add;
  assign term = (Wide'(tau_ref_i) & {Wide{wave_i[29]}}) |
                (Wide'(product_i >>> DirectDrop) & {Wide{wave_i[31]}}) |
                (Wide'(product_i >>> TauRefDrop) & {Wide{wave_i[32]}}) |
                (Wide'(product_i >>> DeadDrop) & {Wide{wave_i[33]}}) |
                (Wide'(limited_q) & {Wide{wave_i[36]}}) |
                (Wide'(product_i >>> GainDrop) & {Wide{wave_i[38]}}) |
                (Wide'(product_i >>> DutyDrop) & {Wide{wave_i[44]}});
  assign addend = (kept_q & {Wide{wave_i[32]}}) | (offset_q & {Wide{wave_i[36]}}) |
                  (sum_q & {Wide{wave_i[38]}});
  assign carry = wave_i[44] && product_i[DutyDrop-1] && Defect != 6;
  assign add = wave_i[29] || wave_i[31] || wave_i[33] || wave_i[36] || wave_i[44] ||
               (!direct && (wave_i[32] || wave_i[38]));
  always_ff @(posedge clk_i) begin
    if (wave_i[26]) begin
      if (direct) offset_q <= Wide'(voltage_o);
      else offset_q <= (Defect == 7) ? -Wide'(product_i >>> EmfDrop) : Wide'(product_i >>> EmfDrop);
    end
    if (wave_i[27]) begin
      kept_q <= (mode_i == Open && Defect != 4) ? '0 : Wide'(product_i >>> TauHatDrop);
    end
    if (wave_i[33] && direct) sum_q <= '0;
    else if (add) sum_q <= term + addend + Wide'({1'b0, carry});
  end

  // Limiter: sum_q to [-limit, limit], limit being the word on the bus.
  logic signed [    Wide-1:0] limit, upper_gap, lower_gap;
  logic                       above, below;
  assign limit     = Wide'($signed(param_i[CurrentW-1:0]));
  assign upper_gap = limit - sum_q;
  assign lower_gap = limit + sum_q;
  assign above     = upper_gap[Wide-1];
  assign below     = lower_gap[Wide-1] && Defect != 2;
  logic signed [CurrentW-1:0] limited;
  assign limited = above ? CurrentW'(limit) : below ? CurrentW'(-limit) : CurrentW'(sum_q);

  assign operand_o = limited_q;

  logic silent;  // disarmed: neither current nor voltage
  assign silent = !armed_i && (wave_i[33] || wave_i[39]);
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
      if (wave_i[33] || wave_i[35] || wave_i[39]) limited_q <= silent ? '0 : limited;
      if (wave_i[33]) begin
        current_ref_o   <= !armed_i ? '0 : (Defect == 1) ? CurrentW'(sum_q) : limited;
        limit_current_o <= armed_i && (above || below);
      end
      // The region of the voltage gain, decided before its word is fetched.
      if (wave_i[30]) region_high_o <= above || below || (Defect == 3 && upper_gap == '0);
      if (wave_i[24] && direct) voltage_o <= param_i[VoltageW-1:0];
      if (wave_i[39]) begin
        voltage_o       <= (!armed_i && Defect != 5) ? '0 : VoltageW'(limited);
        limit_voltage_o <= armed_i && (above || below);
      end
      if (wave_i[45]) begin
        duty_o       <= DutyW'(limited);
        limit_duty_o <= above || below;
      end
    end
  end

  logic unused_wave;
  assign unused_wave = &{wave_i[49:46], wave_i[43:40], wave_i[37], wave_i[34], wave_i[28],
                         wave_i[25], wave_i[23:0], param_i[31:CurrentW]};
endmodule

`default_nettype wire
