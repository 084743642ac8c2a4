// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The limiter beside the clamp that it is said to be: any x, any word as a limit, any kind of signal.
`default_nettype none

module clamp_proof (
    input logic                                            clk_i,
    input logic                                            valid_i,
    input logic                                            torque_i,
    input logic                                            voltage_i,
    input logic                                            duty_i,
    input logic signed [feltgate_pkg::LIMITER_INPUT_W-1:0] early_term_i,
    input logic signed [feltgate_pkg::LIMITER_INPUT_W-1:0] late_term_i,
    input logic                                            early_up_i,
    input logic                                            late_not_i,
    input logic                                            late_up_i,
    input logic        [                             31:0] param_i,
    input logic signed [  feltgate_pkg::WITH_ADDEND_W-1:0] addend_i
);
  localparam int W = feltgate_pkg::LIMITER_W;
  localparam int WideW = feltgate_pkg::LIMITER_INPUT_W + 2;

  logic signed [feltgate_pkg::WITH_ADDEND_W-1:0] limited;
  logic                over_limit;
  limiter u_dut (
      .*,
      .limited_o(limited),
      .over_limit_o(over_limit)
  );

  logic [1:0] age_q;  // clocks since the start, 2 from then on
  initial age_q = 2'd0;
  always_ff @(posedge clk_i) if (age_q != 2'd2) age_q <= age_q + 2'd1;

  // A clock ago: what came ahead and of which kind it is.
  logic signed [WideW-1:0] early_q, late;
  assign late = (late_not_i ? -1 - WideW'(late_term_i) : WideW'(late_term_i)) + WideW'({1'b0, late_up_i});
  logic                    early_on_q, valid_q, torque_q, voltage_q, duty_q;
  always_ff @(posedge clk_i) begin
    early_q   <= WideW'(early_term_i) + WideW'({1'b0, early_up_i});
    early_on_q <= early_term_i != 0 || early_up_i;
    valid_q   <= valid_i;
    torque_q  <= torque_i;
    voltage_q <= voltage_i;
    duty_q    <= duty_i;
  end
  always_comb begin
    assume (4'(torque_i) + 4'(voltage_i) + 4'(duty_i) <= 4'd1);
    assume (!early_on_q || (late_term_i == 0 && !late_not_i && !late_up_i));
    assume (addend_i >= -(feltgate_pkg::WITH_ADDEND_W'(1) <<< (W - 1)) &&
            addend_i < (feltgate_pkg::WITH_ADDEND_W'(1) <<< (W - 1)));
  end

  // Two clocks ago: x, its limit, and the most that its format holds.
  logic signed [WideW-1:0] x_q, limit_q, most_q;
  logic                    had_valid_q;
  always_ff @(posedge clk_i) begin
    had_valid_q <= valid_q;
    x_q         <= early_q + late;
    limit_q     <= WideW'($signed(param_i[W-1:0]));
    if (duty_q) most_q <= (WideW'(1) <<< (feltgate_pkg::DUTY_W - 1)) - 1;
    else if (voltage_q) most_q <= (WideW'(1) <<< (feltgate_pkg::VOLTAGE_W - 1)) - 1;
    else if (torque_q) most_q <= (WideW'(1) <<< (feltgate_pkg::TORQUE_W - 1)) - 1;
    else most_q <= (WideW'(1) <<< (W - 1)) - 1;
  end
  logic                    fits, given;
  logic signed [WideW-1:0] result;
  assign fits   = limit_q >= 0 && limit_q <= most_q;
  assign given  = had_valid_q && fits;
  assign result = WideW'(limited) - WideW'(addend_i);

  always_comb begin
    if (age_q == 2'd2) begin
      within_limit: assert (!had_valid_q || (fits ? result <= limit_q && result >= -limit_q : result == 0));
      misfit_gives_0: assert (!had_valid_q || fits || result == 0);
      within_format: assert (!had_valid_q || (result <= most_q && result >= -most_q));
      inside_untouched: assert (!given || x_q > limit_q || x_q < -limit_q || result == x_q);
      outside_at_its_limit: assert (!given || (x_q > limit_q ? result == limit_q :
                                               x_q >= -limit_q || result == -limit_q));
      idle_gives_nothing: assert (had_valid_q || result == 0);
      beyond_is_beyond: assert (over_limit == (!fits || x_q > limit_q || x_q < -limit_q));
      negative_limit: cover (had_valid_q && limit_q < 0 && x_q < 0);
      at_the_limit: cover (given && result < 0 && x_q == result && x_q == -limit_q);
      beyond_the_format: cover (given && result == 0 - limit_q && x_q < -(WideW'(1) <<< W));
      largest: cover (given && result == most_q && torque_q);
    end
  end
endmodule

`default_nettype wire
