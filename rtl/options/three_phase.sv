// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Bridge socket: three legs by the voltage law. The duty is the amplitude of the legs' voltages, which turn with the
// motor: angle and duty are sampled Lead clocks before the PWM takes its on-times. docs/blocks/three_phase.md

`default_nettype none

module three_phase (
    input  logic               clk_i,
    input  logic               rst_ni,
    input  cfg::params_t       p,
    input  cfg::drive_t        drive_i,
    output cfg::bridge_t       bridge_o,
    input  logic signed [31:0] count_i,   // of the encoder
    input  logic        [31:0] offset_i,  // electrical angle at count 0
    output logic               gate_a_hi_o,
    output logic               gate_a_lo_o,
    output logic               gate_b_hi_o,
    output logic               gate_b_lo_o,
    output logic               gate_c_hi_o,
    output logic               gate_c_lo_o
);
  localparam int Lead = 85;  // commutation needs 42; a smaller number is a newer angle
  logic [11:0] since_q;      // clocks since a period began
  logic samples, takes, opens, fresh_q, period_start, unused_valid;
  logic [11:0] on_a, on_b, on_c;
  logic signed [cfg::DUTY_W-1:0] amplitude_q, duty_active_q;  // of the sample; in force
  assign samples = since_q == 12'(cfg::PWM_PERIOD - 1 - Lead);
  assign takes   = since_q == 12'(cfg::PWM_PERIOD - 1);
  // The gates open with the first sample of an arming, so no on-times of the last one reach them.
  assign opens   = drive_i.gates_enable && fresh_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {since_q, fresh_q, amplitude_q, duty_active_q} <= '0;
    end else begin
      since_q <= period_start ? 12'd1 : since_q + 12'd1;
      fresh_q <= drive_i.gates_enable && (fresh_q || samples);
      if (samples) amplitude_q <= drive_i.duty;
      if (!opens) duty_active_q <= '0;
      else if (takes) duty_active_q <= amplitude_q;
    end
  end
  commutation #(.Period(cfg::PWM_PERIOD)) u_commutation (
      .clk_i(clk_i), .rst_ni(rst_ni), .sample_i(samples), .count_i(count_i), .gain_i(p.commutation_gain),
      .offset_i(offset_i), .amplitude_i(drive_i.duty), .polarity_i(drive_i.polarity), .on_a_o(on_a), .on_b_o(on_b),
      .on_c_o(on_c), .valid_o(unused_valid)
  );
  pwm_three_phase #(.Period(cfg::PWM_PERIOD), .DeadClocks(cfg::DEAD_CLOCKS), .ShortestClocks(cfg::SHORTEST_CLOCKS)) u_pwm (
      .clk_i(clk_i), .rst_ni(rst_ni), .clear_i(drive_i.gates_clear), .enable_i(opens), .on_a_i(on_a), .on_b_i(on_b),
      .on_c_i(on_c), .gate_a_hi_o(gate_a_hi_o), .gate_a_lo_o(gate_a_lo_o), .gate_b_hi_o(gate_b_hi_o),
      .gate_b_lo_o(gate_b_lo_o), .gate_c_hi_o(gate_c_hi_o), .gate_c_lo_o(gate_c_lo_o), .period_start_o(period_start)
  );
  always_comb begin
    bridge_o = '0;
    bridge_o.period_start = period_start;
    bridge_o.duty_active  = duty_active_q;
  end
endmodule

`default_nettype wire
