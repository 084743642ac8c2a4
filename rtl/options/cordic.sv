// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Turns a vector by an angle, back or forward, or gives its angle and length; the vector grows by 1.64676. A half turn or
// none, then 16 angles with two clocks each. Results 34 clocks after start_i, held. docs/blocks/three_phase.md

`default_nettype none

module cordic #(
    parameter int W = 24
) (
    input  logic                clk_i,
    input  logic                rst_ni,
    input  logic                start_i,    // one clock: takes the vector and the angle; the next two hold for 34 clocks
    input  logic                back_i,     // turns back by z_i, else forward
    input  logic                measure_i,  // turns until y is 0: x_o is the length, z_o grows by the angle
    input  logic signed [W-1:0] x_i,
    input  logic signed [W-1:0] y_i,
    input  logic        [ 19:0] z_i,        // 2^-20 turn
    output logic signed [W-1:0] x_o,
    output logic signed [W-1:0] y_o,
    output logic        [ 19:0] z_o
);
  function automatic logic [17:0] arc(input logic [3:0] power);  // atan 2^-power, 2^-20 turn
    case (power)
      4'd0:    arc = 18'd131072;
      4'd1:    arc = 18'd77376;
      4'd2:    arc = 18'd40884;
      4'd3:    arc = 18'd20753;
      4'd4:    arc = 18'd10417;
      4'd5:    arc = 18'd5213;
      4'd6:    arc = 18'd2607;
      4'd7:    arc = 18'd1304;
      4'd8:    arc = 18'd652;
      4'd9:    arc = 18'd326;
      4'd10:   arc = 18'd163;
      4'd11:   arc = 18'd81;
      4'd12:   arc = 18'd41;
      4'd13:   arc = 18'd20;
      4'd14:   arc = 18'd10;
      default: arc = 18'd5;
    endcase
  endfunction
  localparam logic [5:0] HalfTurn = 6'd1, Ends = 6'd34;
  logic [5:0] step_q;  // clocks since start_i
  logic [3:0] place;
  logic half_turn, falls, clockwise, second;
  logic signed [W-1:0] x_old_q;
  assign place     = 4'((step_q - 6'd2) >> 1);
  assign second    = step_q[0];  // of the two clocks of an angle: x, then y and z
  assign half_turn = measure_i ? x_o[W-1] : z_o[19] != z_o[18];
  assign falls     = measure_i ? y_o[W-1] : !z_o[19];  // z
  assign clockwise = measure_i ? !y_o[W-1] : back_i ? !z_o[19] : z_o[19];
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)                               step_q <= '0;
    else if (start_i)                          step_q <= HalfTurn;
    else if (step_q != '0 && step_q != Ends) step_q <= step_q + 6'd1;
  end
  always_ff @(posedge clk_i) begin
    if (start_i) begin
      {x_o, y_o, z_o} <= {x_i, y_i, z_i};
    end else if (step_q == HalfTurn) begin
      if (half_turn) {x_o, y_o, z_o[19]} <= {~x_o, ~y_o, !z_o[19]};
    end else if (step_q != '0 && step_q != Ends) begin
      if (!second) begin
        x_o     <= clockwise ? x_o + (y_o >>> place) : x_o - (y_o >>> place);
        x_old_q <= x_o;
      end else begin
        y_o <= clockwise ? y_o - (x_old_q >>> place) : y_o + (x_old_q >>> place);
        z_o <= falls ? z_o - 20'(arc(place)) : z_o + 20'(arc(place));
      end
    end
  end
endmodule

`default_nettype wire
