// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Whatever the programs do: without a fresh result for more than max_age ticks the outputs are late, and
// stay so; a torque changes only at the end of a run, and is within its format what was put out last.
`default_nettype none

module age_proof (
    input logic               clk_i,
    input logic               rst_ni,
    input logic               clear_i,
    input logic               zero_i,
    input logic               watched_i,
    input logic               enter_i,
    input logic               tick_i,
    input logic signed [31:0] result_i,
    input logic               output_i,
    input logic               last_i,
    input logic        [ 1:0] thread_i,
    input logic        [ 1:0] number_i,
    input logic        [15:0] max_age_i
);
  `include "reset.svh"
  // A write of run clears and enters; the first clock after a reset enters.
  logic young_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) young_q <= 1'b1;
    else young_q <= 1'b0;
  end
  always_comb assume (enter_i || !(clear_i || young_q));

  localparam int W = cfg::TORQUE_W;
  logic signed [2*W-1:0] torque, torque_q;
  logic fresh, late, late_q, ended_q, ended2_q, cleared_q, zeroed_q, forgives_q;
  engine_outputs #(.AxisCount(2)) u_dut (
      .*,
      .torque_o(torque),
      .fresh_o(fresh),
      .late_o(late)
  );
  (* hierconn *) wire [15:0] \u_dut.age_q ;
  (* hierconn *) wire \u_dut.ends_q ;
  (* hierconn *) wire [W-1:0] \u_dut.g_axis[1].limited ;
  (* hierconn *) wire \u_dut.g_axis[1].waits_q ;

  // The second axis: its last output, the nearest that a torque can be.
  localparam logic signed [31:0] MOST = 32'sd1 <<< (W - 1);
  logic signed [W-1:0] second, second_q, said_q;
  assign second = torque[2*W-1:W];
  always_ff @(posedge clk_i) begin
    if (output_i && number_i == 2'd1) begin
      if (result_i >= MOST) said_q <= {1'b0, {(W - 1) {1'b1}}};
      else if (result_i < -MOST) said_q <= {1'b1, {(W - 1) {1'b0}}};
      else said_q <= W'(result_i);
    end
  end
  logic signed [W-1:0] said2_q;
  always_ff @(posedge clk_i) begin
    second_q <= second;
    said2_q  <= said_q;
  end

  // Ticks since the last fresh result; what max_age was with the last tick.
  logic [16:0] quiet_q;
  logic [15:0] allowed_q;
  logic ticked_q;
  always_ff @(posedge clk_i) begin
    allowed_q <= max_age_i;
    ticked_q  <= tick_i;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      quiet_q    <= '0;
      torque_q   <= '0;
      late_q     <= 1'b0;
      ended2_q   <= 1'b0;
      cleared_q  <= 1'b0;
      zeroed_q   <= 1'b0;
      forgives_q <= 1'b0;
    end else begin
      if (enter_i || !watched_i) quiet_q <= '0;
      else if (fresh) quiet_q <= {16'd0, tick_i};
      else if (tick_i && !quiet_q[16]) quiet_q <= quiet_q + 17'd1;
      torque_q   <= torque;
      late_q     <= late;
      ended2_q   <= ended_q;
      cleared_q  <= clear_i || zero_i;
      zeroed_q   <= zero_i;
      forgives_q <= enter_i || !watched_i;
    end
  end
  always_ff @(posedge clk_i) ended_q <= last_i;

  always_comb begin
    if (rst_ni && past_ok_q) begin
      late_in_time: assert (!ticked_q || late || fresh || quiet_q <= {1'b0, allowed_q});
      late_stays: assert (!late_q || late || forgives_q);
      torque_at_an_end: assert (torque == torque_q || ended2_q || cleared_q);
      zero_without_mailbox: assert (!zeroed_q || torque == '0);
      torque_of_output: assert (second == second_q || second == said2_q || cleared_q);
      inside_said: assert (!\u_dut.g_axis[1].waits_q || \u_dut.g_axis[1].limited == said_q);
      inside_ends: assert (\u_dut.ends_q == ended_q);
      inside_age: assert (young_q || late || fresh || quiet_q == {1'b0, \u_dut.age_q });
      becomes_late: cover (late && max_age_i == 16'd1);
      beyond: cover (second != second_q && second == {1'b1, {(W - 1) {1'b0}}});
      renewed: cover (fresh && torque != '0);
    end
  end
endmodule

`default_nettype wire
