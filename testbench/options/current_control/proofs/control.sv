// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The law of a result and its clocks: products as sums of shifted factors, and where the integrator goes.
`default_nettype none

module control_proof (
    input logic               clk_i,
    input logic               rst_ni,
    input logic               armed_i,
    input logic               valid_i,
    input logic signed [18:0] reference_i,
    input logic signed [18:0] current_i,
    input logic signed [17:0] emf_i,
    input logic        [16:0] proportional_i,
    input logic        [16:0] integral_i,
    input logic        [16:0] limit_i
);
  localparam int Latency = 20;
  localparam int Busy = 38;
  localparam int Bits = 17;  // of a gain

  `include "reset.svh"

  logic valid, saturated;
  logic signed [17:0] voltage;
  logic signed [18:0] resistive;
  current_control u_dut (
      .*,
      .voltage_o(voltage),
      .resistive_o(resistive)
  );
  (* hierconn *) wire [5:0] \u_dut.step_q ;
  (* hierconn *) wire [Bits-1:0] \u_dut.u_serial_multiplier.low_q ;
  (* hierconn *) wire [19:0] \u_dut.u_serial_multiplier.high_q ;
  (* hierconn *) wire [19:0] \u_dut.u_serial_multiplier.factor_q ;
  (* hierconn *) wire [19:0] \u_dut.base_q ;
  (* hierconn *) wire [24:0] \u_dut.wanted_q ;
  (* hierconn *) wire [35:0] \u_dut.integrator_q ;
  (* hierconn *) wire \u_dut.above ;
  (* hierconn *) wire \u_dut.below ;
  wire signed [19:0] high = $signed(\u_dut.u_serial_multiplier.high_q );
  wire signed [19:0] factor = $signed(\u_dut.u_serial_multiplier.factor_q );
  wire signed [36:0] product = $signed({\u_dut.u_serial_multiplier.high_q , \u_dut.u_serial_multiplier.low_q });
  wire signed [39:0] integrator = 40'($signed(\u_dut.integrator_q ));
  // In LSB of the voltage, with a few bits more than they need.
  wire signed [20:0] whole = 21'($signed(\u_dut.integrator_q [35:Bits]));
  wire signed [20:0] base = 21'($signed(\u_dut.base_q ));  // integrator and back-EMF: base_of_the_law
  wire signed [20:0] applied = 21'(voltage);
  wire signed [26:0] wanted = 27'($signed(\u_dut.wanted_q ));

  // The clocks since a current was taken.
  logic [Busy:1] since_q;
  logic take;
  assign take = armed_i && valid_i && since_q == '0;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) since_q <= '0;
    else since_q <= armed_i ? {since_q[Busy-1:1], take} : '0;
  end
  assign valid = since_q[Latency];  // a new voltage
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) saturated <= 1'b0;
    else if (!armed_i || since_q[Latency-1]) saturated <= armed_i && ( \u_dut.above || \u_dut.below );
  end

  // A product: the factor, moved up by a bit in each clock, summed where the gain has a one.
  logic signed [39:0] moved_q, sum_q;
  logic signed [26:0] part_q;
  logic signed [20:0] emf_q, left;
  logic [Bits-1:0] gain_q;
  logic [4:0] moves_q;  // bits of the gain that are summed
  logic second_q;
  assign left = applied - base;
  always_ff @(posedge clk_i) begin
    if (take || since_q[Latency]) begin
      moved_q  <= take ? 40'(reference_i) - 40'(current_i) : 40'(left);
      gain_q   <= take ? proportional_i : integral_i;
      sum_q    <= take ? 40'sd4096 : '0;
      moves_q  <= '0;
      second_q <= !take;
    end else if (moves_q != 5'(Bits)) begin
      moved_q <= moved_q <<< 1;
      gain_q  <= gain_q >> 1;
      sum_q   <= sum_q + (gain_q[0] ? moved_q : '0);
      moves_q <= moves_q + 5'd1;
    end
    if (take) emf_q <= 21'(emf_i);
    if (since_q[Latency-2]) part_q <= 27'(sum_q >>> 13);
  end

  // What was there before, and the limit of the last result.
  logic signed [39:0] integrator_q, added_q;
  logic signed [20:0] whole_q, left_q, limit_q, voltage_q, way;
  logic armed_q, done_q;
  assign way = whole - whole_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      armed_q <= 1'b0;
      done_q  <= 1'b0;
      limit_q <= '0;
    end else begin
      armed_q <= armed_i;
      done_q  <= armed_i && since_q[Busy];
      if (!armed_i) limit_q <= '0;
      else if (since_q[Latency-1]) limit_q <= $signed({4'd0, limit_i});
    end
  end
  always_ff @(posedge clk_i) begin
    integrator_q <= integrator;
    whole_q      <= whole;
    left_q       <= left;
    added_q      <= sum_q;
    voltage_q    <= applied;
  end

  logic [5:0] place;
  always_comb begin
    place = 6'd0;
    for (int k = 1; k <= Busy; k++) if (since_q[k]) place = 6'(k);
  end
  always_comb begin
    if (past_ok_q && rst_ni) begin
      disarmed_is_zero: assert (armed_q || (voltage == '0 && integrator == '0));
      within_the_limit: assert (applied <= limit_q && applied >= -limit_q);
      voltage_is_held: assert (valid || !armed_q || (applied == voltage_q));
      base_of_the_law: assert (place == '0 || base == whole + emf_q);
      sum_of_the_law: assert ((!since_q[Latency-1] && !valid) || wanted == 27'(whole) + 27'(emf_q) + part_q);
      limited_to_the_nearer_end: assert (!valid || 27'(applied) == (wanted > 27'(limit_q) ? 27'(limit_q) :
                                                               wanted < -(27'(limit_q)) ? -(27'(limit_q)) : wanted));
      inside_saturated: assert (!valid || saturated == (27'(applied) != wanted));
      integrator_is_held: assert (done_q || !armed_q || integrator == integrator_q);
      integrator_never_wraps: assert (!done_q || integrator == integrator_q + added_q);
      whole_part_is_shown: assert (21'(resistive) == whole);
      integrator_in_its_range: assert (whole <= 21'sd262143 && whole >= -21'sd262142);
      integrator_towards_the_applied: assert (!done_q ||
          (left_q >= 0 ? way >= 0 && way <= left_q : way <= 0 && way >= left_q));
      second_factor_is_what_is_left: assert (place <= 6'(Latency) || 21'(factor) == left);
      unlimited_it_is_the_proportional_part: assert (place <= 6'(Latency) || saturated || 27'(factor) == part_q);
      products_are_sums: assert (!(since_q[Latency-2] || since_q[Busy]) || 40'(product) == sum_q);
      limited_up: cover (valid && saturated && voltage > 0);
      limited_down: cover (valid && saturated && voltage < 0);
      unlimited: cover (valid && !saturated && voltage > 0);
    end
  end

  logic multiplies;
  assign multiplies = since_q[Latency-2:1] != '0 || since_q[Busy:Latency+1] != '0;
  always_comb begin
    if (past_ok_q && rst_ni) begin
      inside_since: assert ((since_q & (since_q - 1'b1)) == '0 && \u_dut.step_q == place);
      inside_moves: assert (place == '0 || (second_q == (place > 6'(Latency)) &&
          6'(moves_q) == (place > 6'(Latency) ? place - 6'(Latency + 1) :
                          place > 6'(Latency - 2) ? 6'(Bits) : place - 6'd1)));
      inside_factor: assert (!multiplies || (40'(factor) <<< moves_q) == moved_q);
      inside_gain: assert (!multiplies || (\u_dut.u_serial_multiplier.low_q & ~({Bits{1'b1}} << (5'(Bits) - moves_q))) == gain_q);
      inside_sum: assert (!multiplies || (40'(product) >>> (5'(Bits) - moves_q)) == sum_q);
      inside_emf: assert (place == '0 || (emf_q <= 21'sd131071 && emf_q >= -21'sd131072));
      inside_limit: assert (limit_q >= 0 && limit_q <= 21'sd131071);
      inside_bound: assert (place <= 6'(Latency) || (factor > 0 ? high >= 0 && high < factor :
                            factor < 0 ? high <= 0 && high >= factor : high == 0));
      inside_none_yet: assert (place <= 6'(Latency) || high != 0 || factor > 0 || sum_q == 0);
    end
  end
endmodule

`default_nettype wire
