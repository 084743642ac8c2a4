// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Current, voltage and duty against their words, and which way they turn, for any products and any words.
`default_nettype none

module limits_proof (
    input logic                              clk_i,
    input logic                              rst_ni,
    input cfg::params_t                      p,
    input logic                              armed_i,
    input logic        [                1:0] mode_i,
    input logic                              start_i,
    input logic signed [  cfg::TORQUE_W-1:0] tau_ref_i,
    input logic signed [  cfg::TORQUE_W-1:0] tau_hat_i,
    input logic signed [cfg::VELOCITY_W-1:0] velocity_i
);
  localparam int AppliedW = cfg::WITH_ADDEND_W;
  localparam int O = cfg::VELOCITY_W;
  localparam logic signed [cfg::VOLTAGE_W-1:0] Most = {1'b0, {(cfg::VOLTAGE_W - 1) {1'b1}}};
  `include "reset.svh"
  logic signed [cfg::CURRENT_W-1:0] current;
  logic signed [cfg::VOLTAGE_W-1:0] voltage;
  logic signed [cfg::FEED_W-1:0] feed;
  logic signed [cfg::DUTY_W-1:0] duty;
  logic limit_current, limit_voltage, limit_duty, valid;
  torque_law u_dut (
      .*,
      .current_o(current),
      .voltage_o(voltage),
      .feed_o(feed),
      .duty_o(duty),
      .limit_current_o(limit_current),
      .limit_voltage_o(limit_voltage),
      .limit_duty_o(limit_duty),
      .valid_o(valid)
  );
  (* hierconn *) wire [11:0] \u_dut.at ;
  (* hierconn *) wire \u_dut.beyond ;
  (* hierconn *) wire signed [AppliedW-1:0] \u_dut.applied_q ;
  (* hierconn *) wire signed [cfg::EMF_W-1:0] \u_dut.emf_q ;
  (* hierconn *) wire signed [cfg::VOLTAGE_W+1:0] \u_dut.offset_q ;
  (* hierconn *) wire signed [O-1:0] \u_dut.operand_q ;
  (* hierconn *) wire signed [17:0] \u_dut.factor_q ;
  (* hierconn *) wire signed [O+17:0] \u_dut.product_q ;
  wire signed [39:0] applied = 40'($signed( \u_dut.applied_q ));
  wire signed [39:0] emf = 40'($signed( \u_dut.emf_q ));
  wire signed [39:0] offset = 40'($signed( \u_dut.offset_q ));
  wire signed [O+17:0] product = \u_dut.product_q ;
  function automatic logic within(input logic signed [39:0] x, input logic [39:0] most);
    within = x <= $signed(most) && x >= -$signed(most);
  endfunction

  // A tick's clocks; armed and mode hold for all of them.
  logic [12:0] at_q;  // the last one: the duty is new
  logic armed_q, after_q;
  logic [1:0] mode_q;
  wire direct = mode_i == 2'(map::MODE_VOLTAGE);
  always_ff @(posedge clk_i) {armed_q, mode_q} <= {armed_i, mode_i};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {at_q, after_q} <= '0;
    else {at_q, after_q} <= {at_q[11:0], start_i, 1'b1};
  end
  always_comb begin
    assume (!start_i || at_q[11:0] == '0);
    assume (at_q == '0 || (armed_i == armed_q && mode_i == mode_q));
  end
  // A product has the sign of its operands and is no larger than a torque and a word make where it is of a torque.
  logic signed [O-1:0] operand_q;
  logic signed [17:0] factor_q;
  logic told_q;
  always_ff @(posedge clk_i) {told_q, operand_q, factor_q} <= {past_ok_q, \u_dut.operand_q , \u_dut.factor_q };
  always_comb begin
    if (told_q) begin
      assume ((product == '0) == (operand_q == '0 || factor_q == '0));
      assume (product == '0 || (product < 0) == ((operand_q < 0) != (factor_q < 0)));
      if (!fx::overflows(64'(operand_q), cfg::TORQUE_W)) assume (!fx::overflows(64'(product), cfg::TORQUE_W + 18));
      if (!fx::overflows(64'(operand_q), AppliedW)) assume (!fx::overflows(64'(product), AppliedW + 18));
    end
  end

  // The limits as they came by in this tick, and those in force.
  logic [39:0] current_limit_q, duty_limit_q, window_q, step_q, current_most_q, duty_most_q;
  logic above_q, below_q, beyond_q, stepped_q;
  logic signed [39:0] emf_q, current_was_q, voltage_was_q, duty_was_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {current_most_q, duty_most_q} <= '0;
    else begin
      if (at_q[3]) current_most_q <= current_limit_q;
      if (at_q[11]) duty_most_q <= duty_limit_q;
    end
  end
  always_ff @(posedge clk_i) begin
    if (at_q[2]) current_limit_q <= 40'(p.current_limit);
    if (at_q[3]) step_q <= 40'(p.voltage_step);
    if (at_q[6]) window_q <= 40'(p.voltage_window);
    if (at_q[10]) duty_limit_q <= 40'(p.duty_limit);
    // All products of the current point up, or down.
    if (at_q[1]) {above_q, below_q} <= {product >= 0, product <= 0};
    if (at_q[2] && mode_i != 2'(map::MODE_OPEN) && !direct) {above_q, below_q} <= {above_q && product >= 0, below_q && product <= 0};
    if (at_q[7]) emf_q <= emf;
    beyond_q <= \u_dut.beyond ;
    {current_was_q, voltage_was_q, duty_was_q} <= {40'(current), applied, 40'(duty)};
  end

  always_comb begin
    if (past_ok_q && rst_ni && after_q) begin
      current_within_limit: assert (within(40'(current), current_most_q));
      duty_within_limit: assert (within(40'(duty), duty_most_q));
      change_in_their_clocks: assert ((at_q[4] || 40'(current) == current_was_q) && (at_q[8] || applied == voltage_was_q) &&
                                      (at_q[12] || 40'(duty) == duty_was_q));
      valid_with_the_duty: assert (valid == at_q[12]);
      limits_are_told: assert ((!at_q[4] || limit_current == (beyond_q && armed_q)) &&
                               (!at_q[8] || limit_voltage == (beyond_q && armed_q)) && (!at_q[12] || limit_duty == beyond_q));
      inside_at: assert ( \u_dut.at == at_q[11:0] && (at_q & (at_q - 13'd1)) == '0);
      if (at_q[4]) begin
        current_turns: assert (direct || !((below_q && current > 0) || (above_q && current < 0)));
        disarmed_current_is_0: assert (armed_q || current == '0);
        pulls: cover (current < 0 && limit_current);
      end
      if (at_q[6]) set_point_steps: assert (!direct || within(offset + emf - applied, step_q) || applied != 40'(voltage));
      if (at_q[8]) begin
        voltage_within_window: assert (!armed_q || within(applied - emf_q, window_q));
        disarmed_voltage_is_0: assert (armed_q || (applied == '0 && voltage == '0));
        voltage_saturates: assert (40'(voltage) == applied || (applied > 0 ? voltage == Most : voltage == ~Most));
        drives: cover (voltage > 0 && limit_voltage && emf_q < 0);
      end
      if (at_q[12]) begin
        duty_turns: assert (!((applied <= 0 && duty > 0) || (applied >= 0 && duty < 0)));
        turns: cover (duty < 0 && limit_duty);
      end
    end
  end
endmodule

`default_nettype wire
