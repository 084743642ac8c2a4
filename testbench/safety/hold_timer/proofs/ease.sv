// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// When the torque limit is eased and when it is given back, for any clocks, words and ticks.
`default_nettype none

module ease_proof (
    input logic                                      clk_i,
    input logic                                      rst_ni,
    input logic                                      armed_i,
    input logic [feltgate_map_pkg::WAVE_LENGTH-1:0] wave_i,
    input logic [                             31:0] tick_count_i,
    input logic [                             31:0] param_i,
    input logic                                      moved_i,
    input logic                                      over_limit_i
);
  localparam int Bits = feltgate_map_pkg::HOLD_BITS;

  logic past_ok_q;
  initial past_ok_q = 1'b0;
  always_ff @(posedge clk_i) past_ok_q <= 1'b1;

  logic derated;
  hold_timer u_dut (
      .*,
      .at_hold_strong_i(wave_i[feltgate_map_pkg::EVENT_AT_HOLD_STRONG]),
      .at_hold_i(wave_i[feltgate_map_pkg::EVENT_AT_HOLD]),
      .derated_o(derated)
  );
  (* hierconn *) wire [Bits-1:0] \u_dut.units_q ;
  (* hierconn *) wire \u_dut.strong_q ;
  (* hierconn *) wire \u_dut.begun_q ;

  logic strong_q;
  always_comb begin
    if (!past_ok_q) assume (!rst_ni);
  end

  // Units for which the torque was held: ends of 2^HOLD_UNIT_BITS ticks. From 2^HOLD_BITS on it says so for good.
  // In reach: the words since the hold began were times that the block can wait for.
  logic now, held, due, unit, in_reach_q, in_reach_was_q, eased_q, now_q, held_q, due_q, after_q;
  logic [Bits:0] units_q;
  assign now  = wave_i[feltgate_map_pkg::EVENT_AT_HOLD];
  assign held = armed_i && !moved_i;
  assign unit = tick_count_i[feltgate_map_pkg::HOLD_UNIT_BITS-1:0] == '0;
  assign due  = held && strong_q && (param_i[31] || 32'(units_q) >= param_i);
  always_ff @(posedge clk_i) begin
    eased_q <= derated;
    now_q   <= now;
    held_q  <= held;
    due_q   <= due;
    in_reach_was_q <= in_reach_q;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      strong_q   <= 1'b0;
      units_q    <= '0;
      in_reach_q <= 1'b1;
      after_q    <= 1'b0;
    end else begin
      after_q <= 1'b1;
      if (wave_i[feltgate_map_pkg::EVENT_AT_HOLD_STRONG]) strong_q <= over_limit_i;
      if (now) begin
        if (!held || !strong_q) begin
          units_q    <= '0;
          in_reach_q <= 1'b1;
        end else begin
          if (unit) units_q <= (units_q + 1'b1) | {units_q[Bits], {Bits{1'b0}}};
          if (!param_i[31] && param_i >= 32'd1 << Bits) in_reach_q <= 1'b0;
        end
      end
    end
  end

  always_comb begin
    inside_strong: assert (!past_ok_q || \u_dut.strong_q == strong_q);
    if (rst_ni && past_ok_q && after_q) begin
      stays_between: assert (now_q || derated == eased_q);
      given_back: assert (!now_q || held_q || !derated);
      kept_until_then: assert (!now_q || !held_q || !eased_q || derated);
      eases_on_time: assert (!now_q || !in_reach_was_q || !due_q || derated);
      eases_no_earlier: assert (!now_q || eased_q || !derated || due_q);
      eases: cover (derated && !eased_q);
      gives_back: cover (!derated && eased_q);
    end
    if (rst_ni && past_ok_q) begin
      inside_units: assert (\u_dut.units_q == units_q[Bits-1:0]);
      inside_begun: assert (\u_dut.begun_q || (!strong_q && units_q == '0));
      inside_reach: assert (!in_reach_q || derated || !units_q[Bits]);
      inside_before: assert (after_q || !derated);
    end
  end
endmodule

`default_nettype wire
