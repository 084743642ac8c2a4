// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// From the drive's amperes and volts to those of a current's controller, once a tick: the reference, what is fed forward
// (back-EMF and dead voltage), and the limit. New one clock after drive_i.valid. docs/blocks/current.md

`default_nettype none

module current_command (
    input  logic               clk_i,
    input  logic               rst_ni,
    input  cfg::params_t       p,
    input  cfg::drive_t        drive_i,
    output logic signed [18:0] reference_o,     // [1,1,17] of full scale
    output logic signed [17:0] feed_forward_o,  // [1,0,17] of the supply, saturated
    output logic        [16:0] limit_o          // [0,0,17] of the supply: of the voltage
);
  localparam logic [31:0] PerClock = 32'(((1 << 17) - 1) / cfg::PWM_PERIOD);  // a whole period is below the supply: 17 bits
  logic [11:0] duty_limit;
  logic signed [43:0] feed_q;
  assign duty_limit     = p.duty_limit > 12'(cfg::PWM_PERIOD) ? 12'(cfg::PWM_PERIOD) : p.duty_limit;
  assign feed_forward_o = 18'(fx::saturate(fx::scale(64'(feed_q), -cfg::FEED_DROP), 18));
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {reference_o, feed_q, limit_o} <= '0;
    end else if (drive_i.valid) begin
      reference_o <= 19'((64'($signed(drive_i.current)) + (64'sd1 <<< (cfg::CURRENT_DROP - 1))) >>> cfg::CURRENT_DROP);
      feed_q      <= 44'($signed(drive_i.feed)) * 44'(cfg::FEED_GAIN);
      limit_o     <= 17'(32'(duty_limit) * PerClock);
    end
  end
endmodule

`default_nettype wire
