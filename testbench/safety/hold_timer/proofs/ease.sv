// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// When the torque limit is eased and when it is given back, for any clocks, words and ticks.
`default_nettype none

module ease_proof (
    input logic                            clk_i,
    input logic                            rst_ni,
    input cfg::params_t                    p,
    input logic                            armed_i,
    input logic        [             31:0] tick_count_i,
    input logic                            start_i,
    input logic signed [cfg::TORQUE_W-1:0] tau_ref_i,
    input logic                            moved_i
);
  localparam int Bits = map::HOLD_BITS;
  `include "reset.svh"
  logic derated;
  hold_timer u_dut (.*, .derated_o(derated));
  (* hierconn *) wire [Bits-1:0] \u_dut.units_q ;
  (* hierconn *) wire \u_dut.strong_q ;

  // Units for which the torque was held: ends of 2^HOLD_UNIT_BITS ticks. From 2^HOLD_BITS on it says so for good.
  // In reach: the words since the hold began were times that the block can wait for.
  logic strong_q, now_q, was_q, held, held_q, due, due_q, unit, in_reach_q, in_reach_was_q, eased_q, after_q;
  logic [Bits:0] units_q;
  logic signed [cfg::TORQUE_W:0] size;
  assign size = tau_ref_i < 0 ? -((cfg::TORQUE_W + 1)'(tau_ref_i)) : (cfg::TORQUE_W + 1)'(tau_ref_i);
  assign held = armed_i && !moved_i;
  assign unit = tick_count_i[map::HOLD_UNIT_BITS-1:0] == '0;
  assign due  = held && strong_q && units_q >= p.hold_time;
  always_ff @(posedge clk_i) {eased_q, was_q, held_q, due_q, in_reach_was_q} <= {derated, now_q, held, due, in_reach_q};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {strong_q, units_q, after_q, now_q} <= '0;
      in_reach_q <= 1'b1;
    end else begin
      after_q <= 1'b1;
      now_q   <= start_i;
      if (start_i) strong_q <= size > $signed({2'b0, p.hold_torque});
      if (now_q) begin
        if (!held || !strong_q) {units_q, in_reach_q} <= 1;
        else begin
          if (unit) units_q <= (units_q + 1'b1) | {units_q[Bits], {Bits{1'b0}}};
          if (p.hold_time[Bits]) in_reach_q <= 1'b0;
        end
      end
    end
  end

  always_comb begin
    if (rst_ni && past_ok_q) begin
      inside_strong: assert ( \u_dut.strong_q == strong_q);
      inside_units: assert ( \u_dut.units_q == units_q[Bits-1:0]);
      inside_reach: assert (!in_reach_q || derated || !units_q[Bits]);
      inside_before: assert (after_q || !derated);
    end
    if (rst_ni && past_ok_q && after_q) begin
      stays_between: assert (was_q || derated == eased_q);
      given_back: assert (!was_q || held_q || !derated);
      kept_until_then: assert (!was_q || !held_q || !eased_q || derated);
      eases_on_time: assert (!was_q || !in_reach_was_q || !due_q || derated);
      eases_no_earlier: assert (!was_q || eased_q || !derated || due_q);
      eases: cover (derated && !eased_q);
      gives_back: cover (!derated && eased_q);
    end
  end
endmodule

`default_nettype wire
