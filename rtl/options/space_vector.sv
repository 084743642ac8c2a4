// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Space vectors: on-times of three legs, of which the highest and the lowest are as far above as below the middle of the
// period. One leg lies between; of the others, in the order A, B, C, the first is outer_i above the middle, the second as
// much below. Distances are 2^-4 clocks, on-times [0,12,0] clocks. valid_o one clock after start_i. docs/blocks/three_phase.md

`default_nettype none

module space_vector #(
    parameter int Period = 1000  // clocks of a PWM period, even, 4 to 4094
) (
    input  logic               clk_i,
    input  logic               rst_ni,
    input  logic               enable_i,     // 0: all legs half a period
    input  logic               start_i,
    input  logic        [ 1:0] between_i,    // the leg between: 0 A, 1 B, 2 C
    input  logic signed [17:0] outer_i,
    input  logic signed [17:0] middle_i,     // of the leg between, above the middle of the period
    input  logic               half_down_i,  // half a clock is rounded down, else up
    input  logic               mirror_i,     // legs B and C change places
    output logic        [11:0] on_a_o,
    output logic        [11:0] on_b_o,
    output logic        [11:0] on_c_o,
    output logic               valid_o
);
  generate
  if (!(Period >= 4 && Period <= 4094 && Period % 2 == 0)) begin : g_check
    PERIOD_must_be_even_and_4_to_4094 missing ();
  end
  endgenerate
  localparam logic [11:0] Half = 12'(Period / 2);
  logic signed [17:0] half, first, second, between;
  logic [11:0] leg_b, leg_c;
  assign half    = $signed({2'd0, Half, 4'd8}) - 18'($signed({1'b0, half_down_i}));
  assign first   = (half + outer_i) >>> 4;
  assign second  = (half - outer_i) >>> 4;
  assign between = (half + middle_i) >>> 4;
  assign leg_b   = 12'(between_i == 2'd0 ? first : between_i == 2'd1 ? between : second);
  assign leg_c   = 12'(between_i == 2'd2 ? between : second);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {on_a_o, on_b_o, on_c_o} <= {3{Half}};
      valid_o <= 1'b0;
    end else begin
      valid_o <= enable_i && start_i;
      if (!enable_i) begin
        {on_a_o, on_b_o, on_c_o} <= {3{Half}};
      end else if (start_i) begin
        on_a_o <= 12'(between_i == 2'd0 ? between : first);
        on_b_o <= mirror_i ? leg_c : leg_b;
        on_c_o <= mirror_i ? leg_b : leg_c;
      end
    end
  end
endmodule

`default_nettype wire
