// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Latches an over-current. A fast sinc3 filter shares the integrators of current_sense and has its own combs. Its
// first two results after a reset are not used. docs/blocks/current.md

`default_nettype none

module overcurrent #(
    parameter int FilterLog2 = 3,  // of the decimation
    parameter int Hits       = 3   // results in a row at the threshold or above
) (
    input  logic                    clk_i,
    input  logic                    rst_ni,
    input  logic                    take_i,        // a bit of the modulator
    input  logic                    integrated_i,  // two clocks later: integral_i moves
    input  logic [  3*FilterLog2:0] integral_i,    // third of the bits, low bits
    input  logic [3*FilterLog2-2:0] threshold_i,   // [0,0,3*FilterLog2-1] of full scale
    input  logic                    clear_i,
    output logic                    overcurrent_o
);
  localparam int W = 3 * FilterLog2 + 1;
  localparam int HitW = $clog2(Hits + 1);
  localparam logic [W-1:0] Half = W'(1) << (W - 2);
  logic [FilterLog2-1:0] phase_q;
  logic [1:0] samples_q;
  logic sample_q;
  logic [3:0] steps_q;
  logic [W-1:0] comb_q, comb_in, delay_q, delay_q2, delay_q3;
  assign comb_in = steps_q[0] ? integral_i : comb_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      phase_q   <= '0;
      samples_q <= 2'd0;
      sample_q  <= 1'b0;
      steps_q   <= 4'd0;
      comb_q    <= '0;
      delay_q   <= '0;
      delay_q2  <= '0;
      delay_q3  <= '0;
    end else begin
      steps_q <= {steps_q[2:0], integrated_i && sample_q};
      if (take_i) begin
        phase_q  <= phase_q + 1'b1;
        sample_q <= &phase_q;
      end
      if (steps_q[0] && samples_q != 2'd3) samples_q <= samples_q + 2'd1;
      if (steps_q[2:0] != 3'd0) begin
        comb_q   <= comb_in - delay_q;
        delay_q  <= delay_q2;
        delay_q2 <= delay_q3;
        delay_q3 <= comb_in;
      end
    end
  end

  // Over-current. Cleared only while the last fast result is below the threshold.
  logic             result, hit, hit_q;
  logic [W-1:0] value, magnitude;
  logic [ HitW-1:0] hits_q;
  assign result = steps_q[3] && samples_q == 2'd3;
  assign value  = comb_q - Half;
  assign magnitude   = value[W-1] ? -value : value;
  assign hit         = magnitude >= W'(threshold_i);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      hit_q         <= 1'b0;
      hits_q        <= '0;
      overcurrent_o <= 1'b0;
    end else begin
      if (result) begin
        hit_q <= hit;
        if (!hit) hits_q <= '0;
        else if (hits_q != HitW'(Hits)) hits_q <= hits_q + 1'b1;
      end
      if (result && hit && hits_q >= HitW'(Hits - 1)) overcurrent_o <= 1'b1;
      else if (clear_i && !hit_q && !(result && hit)) overcurrent_o <= 1'b0;
    end
  end
endmodule

`default_nettype wire
