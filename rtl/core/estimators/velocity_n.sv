// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// N-method velocity: the counts of the last M1 ticks times 2^n (or a quantised gain), saturated,
// then low-pass filtered. Wave clocks: travel is sampled in EVENT_AT_SAMPLE, the filter's product is
// taken in EVENT_AT_VELOCITY. Formats: travel [1,15,0] counts, wraps; velocity in rad/s, format set
// by the design. docs/blocks/velocity.md

`default_nettype none

module velocity_n #(
    parameter int M1     = feltgate_pkg::M1,
    parameter int Shift  = feltgate_pkg::VELOCITY_SHIFT,
    parameter int Gain   = feltgate_pkg::VELOCITY_GAIN,   // 0: 2^Shift; else Gain * 2^-GainF
    parameter int GainF  = feltgate_pkg::VELOCITY_GAIN_F
) (
    input  logic                                                  clk_i,
    input  logic                                                  rst_ni,
    input  logic                                                  at_sample_i,
    input  logic                                                  at_travel_i,
    input  logic                                                  at_velocity_raw_i,
    input  logic                                                  at_velocity_difference_i,
    input  logic                                                  at_velocity_i,
    input  logic signed [feltgate_pkg::TRAVEL_BITS-1:0]           travel_i,  // counts, wraps
    output logic signed [feltgate_pkg::VELOCITY_DIFFERENCE_W-1:0] operand_o,
    input  logic signed [feltgate_pkg::PRODUCT_BITS-1:0]          product_i,
    output logic signed [feltgate_pkg::VELOCITY_W-1:0]            velocity_o,   // rad/s
    output logic                                                  saturated_o  // raw_q saturated
);
  localparam int T = feltgate_pkg::TRAVEL_BITS;
  localparam int W = feltgate_pkg::VELOCITY_W;
  localparam int F = feltgate_pkg::VELOCITY_F;
  localparam int AddressW = (M1 > 1) ? $clog2(M1 + 1) : 1;

  generate
  if (!(M1 >= 1 && M1 < 2 ** (T - 1))) begin : g_check_window
    M1_must_be_1_to_32767 missing ();
  end
  if (!(Gain >= 0 && Gain < 2 ** 17 && (Gain != 0 ||
        (F + Shift >= 1 && W - F - Shift >= 2 && W - F - Shift <= T)))) begin : g_check_gain
    the_velocity_must_have_room_for_its_counts missing ();
  end
  endgenerate

  // Delay line of M1 entries. Until it is full, the oldest entry counts as 0, the travel at reset.
  logic        [       T-1:0] line    [2**AddressW];
  logic        [       T-1:0] line_q;
  logic        [AddressW-1:0] pointer_q;
  logic                       filled_q, begun_q;
  logic signed [       T-1:0] travel_q, oldest_q, difference_q;
  always_ff @(posedge clk_i) begin
    if (at_velocity_raw_i) line[pointer_q] <= travel_q;
    line_q <= line[pointer_q];
  end
  // No reset: until the first wave begins the pointer is held at 0.
  logic last;
  assign last = pointer_q == AddressW'(M1 - 1);
  always_ff @(posedge clk_i) begin
    if (!begun_q || (at_velocity_difference_i && last)) pointer_q <= '0;
    else if (at_velocity_difference_i) pointer_q <= pointer_q + 1'b1;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      filled_q <= 1'b0;
      begun_q  <= 1'b0;
    end else begin
      if (at_sample_i) begun_q <= 1'b1;
      if (at_velocity_difference_i && last) filled_q <= 1'b1;
    end
  end

  // No reset: the block RAM's output is late in the clock, so no logic may follow it.
  always_ff @(posedge clk_i) begin
    if (!filled_q) oldest_q <= '0;
    else if (at_sample_i) oldest_q <= line_q;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      travel_q     <= '0;
      difference_q <= '0;
    end else begin
      if (at_sample_i) travel_q <= travel_i;
      if (at_travel_i) difference_q <= travel_q - oldest_q;
    end
  end

  // Counts to rad/s. The value saturates if the velocity has too few integer bits.
  logic                over;
  logic signed [W-1:0] raw, raw_q;
  generate
  if (Gain == 0) begin : gen_shift
    localparam int Low  = F + Shift;  // weight of one count in bits of the velocity
    localparam int Room = W - Low;    // bits of a count that fit, sign included
    assign over = difference_q[T-1:Room-1] != {(T - Room + 1) {difference_q[T-1]}};
    assign raw  = {difference_q[Room-1:0], {Low{1'b0}}};
  end else begin : gen_gain
    // Quantised gain, if no power of two is close enough; truncated below the velocity's LSB.
    localparam int Up      = (F > GainF) ? F - GainF : 0;
    localparam int Down    = (GainF > F) ? GainF - F : 0;
    localparam int ScaledW = T + 18 + Up;
    logic signed [T+17:0]      product;
    logic signed [ScaledW-1:0] scaled;
    assign product = difference_q * $signed({1'b0, 17'(Gain)});
    assign scaled  = (ScaledW'(product) <<< Up) >>> Down;
    assign over    = scaled[ScaledW-1:W-1] != {(ScaledW - W + 1) {scaled[ScaledW-1]}};
    assign raw     = scaled[W-1:0];
  end
  endgenerate
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      raw_q       <= '0;
      saturated_o <= 1'b0;
    end else if (at_velocity_raw_i) begin
      raw_q       <= raw;
      saturated_o <= 1'b0;
      if (over) begin
        raw_q       <= {difference_q[T-1], {(W - 1) {~difference_q[T-1]}}};
        saturated_o <= 1'b1;
      end
    end
  end

  lowpass #(
      .Width(W),
      .OperandW(feltgate_pkg::VELOCITY_DIFFERENCE_W),
      .ProductDrop(feltgate_pkg::VELOCITY_DIFFERENCE_F + feltgate_pkg::P_VELOCITY_A1_F - F),
      .ProductW(feltgate_pkg::PRODUCT_BITS)
  ) u_lowpass (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .valid_i(at_velocity_difference_i),
      .update_i(at_velocity_i),
      .follow_i(1'b0),
      .x_i(raw_q),
      .operand_o(operand_o),
      .product_i(product_i),
      .y_o(velocity_o)
  );
endmodule

`default_nettype wire
