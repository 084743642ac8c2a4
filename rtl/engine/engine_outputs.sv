// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Outputs of the engine. All outputs of a run appear together at its end (two clocks after last_i),
// saturated to the torque's format. The block also watches their age. docs/blocks/engine.md

`default_nettype none

module engine_outputs #(
    parameter int AxisCount = 1
) (
    input  logic               clk_i,
    input  logic               rst_ni,
    input  logic               clear_i,    // clears the outputs and those that wait
    input  logic               zero_i,     // outputs are 0 while this is 1
    input  logic               watched_i,  // a thread is enabled
    input  logic               enter_i,
    input  logic               tick_i,
    input  logic        [15:0] max_age_i,  // ticks
    // From the barrel, all valid in one clock.
    input  logic signed [31:0] result_i,
    input  logic               output_i,
    input  logic               last_i,
    input  logic        [ 1:0] thread_i,
    input  logic        [ 1:0] number_i,
    output logic signed [cfg::TORQUE_W*AxisCount-1:0] torque_o,
    output logic               fresh_o,    // one clock: all axes renewed since the last fresh_o
    output logic               late_o      // not fresh for > max_age_i ticks; until enter_i
);
  localparam int W = cfg::TORQUE_W;

  logic beyond;
  assign beyond = result_i[30:W-1] != {(32 - W) {result_i[31]}};

  logic ends_q;
  logic [1:0] thread_q;
  logic [AxisCount-1:0] appears, renewed_q;
  always_ff @(posedge clk_i) begin
    ends_q   <= last_i;
    thread_q <= thread_i;
  end

  genvar n;
  generate
    for (n = 0; n < AxisCount; n = n + 1) begin : g_axis
      logic [W-1:0] next_q, limited, torque_q;  // next_q: sign and low bits of the result
      logic beyond_q;
      logic [1:0] by_q;
      logic waits_q;
      assign appears[n] = ends_q && waits_q && by_q == thread_q;
      always_ff @(posedge clk_i) begin
        if (output_i && number_i == 2'(n)) begin
          next_q   <= {result_i[31], result_i[W-2:0]};
          beyond_q <= beyond;
          by_q     <= thread_i;
        end
      end
      assign limited = beyond_q ? {next_q[W-1], {(W - 1) {!next_q[W-1]}}} : next_q;
      always_ff @(posedge clk_i or negedge rst_ni) begin
        if (!rst_ni) begin
          torque_q <= '0;
          waits_q  <= 1'b0;
        end else begin
          if (clear_i || zero_i) torque_q <= '0;
          else if (appears[n]) torque_q <= limited;
          if (clear_i) waits_q <= 1'b0;
          else if (output_i && number_i == 2'(n)) waits_q <= 1'b1;
          else if (appears[n]) waits_q <= 1'b0;
        end
      end
      assign torque_o[W*n+:W] = torque_q;
    end
  endgenerate

  // Age of the outputs. A program can reset it only by outputs to all axes.
  logic [15:0] age_q;
  logic fresh;
  assign fresh = (renewed_q | appears) == '1;
  always_ff @(posedge clk_i) begin  // enter_i is 1 in the first clock after a reset
    if (fresh || enter_i || !watched_i) age_q <= '0;
    else if (tick_i) age_q <= age_q + 16'd1;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      renewed_q <= '0;
      fresh_o   <= 1'b0;
      late_o    <= 1'b0;
    end else begin
      renewed_q <= clear_i || fresh ? '0 : renewed_q | appears;
      fresh_o   <= fresh && !clear_i;
      if (enter_i || !watched_i) late_o <= 1'b0;
      else if (tick_i && !fresh && age_q >= max_age_i) late_o <= 1'b1;
    end
  end
endmodule

`default_nettype wire
