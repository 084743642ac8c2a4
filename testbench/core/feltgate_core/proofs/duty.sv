// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// From the sampled position to the duty at the PWM, and in force in the bridge: in which clocks. What the numbers
// are is free. The wrapper counts clocks from each sample.
`default_nettype none

module duty_proof (
    `include "core_inputs.svh"
);
  `include "reset.svh"
  `include "core.svh"
  localparam int Most = 50;  // clocks from the sample
  localparam int Age = feltgate_map_pkg::EVENT_AT_DUTY + 1 - feltgate_map_pkg::EVENT_AT_SAMPLE;
  localparam int Period = feltgate_pkg::PWM_PERIOD;
  localparam int Half = Period / 2;
  localparam int DutyW = feltgate_pkg::DUTY_W;

  (* hierconn *) wire [31:0] \u_core.u_encoder.u_quad_decoder.position_o ;
  (* hierconn *) wire [feltgate_pkg::LIMITER_W-1:0] \u_core.u_actuation.limited ;
  (* hierconn *) wire \u_core.u_actuation.g_two_legs.u_pwm.period_start_o ;
  (* hierconn *) wire [10:0] \u_core.u_actuation.g_two_legs.u_pwm.level_q ;
  (* hierconn *) wire \u_core.u_actuation.g_two_legs.u_pwm.rising_q ;
  wire start = \u_core.u_actuation.g_two_legs.u_pwm.period_start_o ;

  // Clocks since the last sample, and since that of which the duty is.
  logic sampled_q, fresh_q;
  logic [15:0] age_q, duty_age_q;
  logic due;  // the duty of this wave is taken
  assign due = wave[feltgate_map_pkg::EVENT_AT_DUTY];
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      sampled_q <= 1'b0;
      fresh_q   <= 1'b0;
    end else begin
      if (wave[feltgate_map_pkg::EVENT_AT_SAMPLE]) sampled_q <= 1'b1;
      if (sampled_q && due) fresh_q <= 1'b1;
    end
  end
  always_ff @(posedge clk_i) begin
    age_q      <= wave[feltgate_map_pkg::EVENT_AT_SAMPLE] ? 16'd1 : age_q + 16'd1;
    duty_age_q <= (duty_due_q ? age_q : duty_age_q) + 16'd1;
  end
  logic [15:0] duty_age;  // of the duty that stands
  assign duty_age = duty_due_q ? age_q : duty_age_q;

  // A clock before.
  logic after_q, duty_due_q, sample_q, enabled_q;
  logic [31:0] decoder_q, position_q;
  logic [feltgate_pkg::LIMITER_W-1:0] limited_q;
  logic signed [DutyW-1:0] duty_q, active_q;
  logic [15:0] duty_age_then_q;
  logic fresh_then_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      after_q    <= 1'b0;
      duty_due_q <= 1'b0;
    end else begin
      after_q    <= 1'b1;
      duty_due_q <= due;
    end
  end
  always_ff @(posedge clk_i) begin
    sample_q        <= wave[feltgate_map_pkg::EVENT_AT_SAMPLE];
    decoder_q       <= \u_core.u_encoder.u_quad_decoder.position_o ;
    position_q      <= position;
    limited_q       <= \u_core.u_actuation.limited ;
    duty_q          <= duty;
    active_q        <= duty_active;
    enabled_q       <= gates_enable;
    duty_age_then_q <= duty_age;
    fresh_then_q    <= fresh_q;
  end

  // Clock of the PWM's period, as pwm.period has it, and the ticks in it: after a reset both begin together.
  logic [15:0] clock_q, ticks_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      clock_q <= 16'(Period - 2);
      ticks_q <= 16'd0;
    end else begin
      clock_q <= (clock_q == 16'(Period - 1)) ? 16'd0 : clock_q + 16'd1;
      if (last) ticks_q <= (ticks_q == 16'(Period / N - 1)) ? 16'd0 : ticks_q + 16'd1;
    end
  end
  logic [15:0] since;  // clocks since a period's duty was taken
  assign since = (clock_q >= 16'(Period - 2)) ? clock_q - 16'(Period - 2) : clock_q + 16'd2;

  always_comb begin
    if (past_ok_q && rst_ni) begin
      if (after_q) begin
        sample_is_the_decoders: assert (position == (sample_q ? decoder_q : position_q));
        duty_once_a_sample: assert (duty_due_q ? duty == limited_q[DutyW-1:0] : duty == duty_q);
        duty_within_50: assert (duty == duty_q || !sampled_q || (age_q == 16'(Age) && Age <= Most));
        bridge_takes_the_duty: assert (duty_active == (!enabled_q ? '0 : start ? duty_q : active_q));
      end
      inside_sampled: assert (!sampled_q || age_q <= 16'(N));
      in_force_within_50: assert (!(start && fresh_then_q) || duty_age_then_q + 16'd1 <= 16'(Most));
      inside_age: assert (sampled_q ? (age_q == ((phase_q > 10'(First)) ? 16'(phase_q) - 16'(First)
                                                                         : 16'(phase_q) + 16'(N - First)) &&
                                       (began_q || phase_q > 10'(First)))
                                    : !began_q && phase_q <= 10'(First));
      inside_fresh: assert (fresh_q == (sampled_q && (began_q || at > 10'(feltgate_map_pkg::EVENT_AT_DUTY))));
      inside_due: assert (duty_due_q == (at == 10'(feltgate_map_pkg::EVENT_AT_DUTY + 1) && sampled_q));
      inside_duty_age: assert (!fresh_q || duty_due_q || duty_age_q ==
          ((at > 10'(feltgate_map_pkg::EVENT_AT_DUTY)) ? 16'(at) : 16'(at) + 16'(N)));
      inside_then: assert (!(after_q && fresh_then_q) || duty_age_then_q + 16'd1 ==
          ((at > 10'(feltgate_map_pkg::EVENT_AT_DUTY + 1)) ? 16'(at) : 16'(at) + 16'(N)));
      inside_clock: assert (clock_q < 16'(Period) && ticks_q < 16'(Period / N) &&
                            since == ticks_q * 16'(N) + 16'(phase_q));
      inside_level: assert (\u_core.u_actuation.g_two_legs.u_pwm.rising_q ? 16'(\u_core.u_actuation.g_two_legs.u_pwm.level_q ) == clock_q - 16'(Half)
                                                   : 16'(\u_core.u_actuation.g_two_legs.u_pwm.level_q ) == 16'(Half) - clock_q);
      inside_rising: assert (\u_core.u_actuation.g_two_legs.u_pwm.rising_q == (clock_q >= 16'(Half)));
      inside_start: assert (start == (clock_q == 16'(Period - 1) && after_q));
      period_starts: cover (after_q && start);
      samples: cover (sample_q && position != '0);
    end
  end
endmodule

`default_nettype wire
