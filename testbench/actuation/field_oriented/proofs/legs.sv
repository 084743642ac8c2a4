// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The legs of any voltage, by its two parts: what each phase is above the mean of the highest and the lowest.
`default_nettype none

module legs_proof (
    input logic               clk_i,
    input logic               rst_ni,
    input logic               armed_i,
    input logic               valid_i,
    input logic               direct_i,
    input logic signed [18:0] reference_i,
    input logic signed [18:0] current_a_i,
    input logic signed [18:0] current_b_i,
    input logic signed [17:0] emf_i,
    input logic signed [31:0] position_i,
    input logic        [31:0] gain_i,
    input logic        [31:0] offset_i,
    input logic               polarity_i,
    input logic        [16:0] proportional_i,
    input logic        [16:0] integral_i,
    input logic        [16:0] limit_i
);
  localparam int Period = 1000;
  localparam int Middle = Period / 2 * 16 + 8;  // of a leg, 2^-4 clocks, with a half

  `include "reset.svh"

  logic valid;
  logic [11:0] on_a, on_b, on_c;
  field_oriented #(
      .Period(Period)
  ) u_dut (
      .*,
      .current_q_o(), .resistive_o(), .across_o(), .open_o(), .saturated_o(),
      .on_a_o(on_a), .on_b_o(on_b), .on_c_o(on_c), .valid_o(valid)
  );
  (* hierconn *) wire [3:0] \u_dut.op_q ;
  (* hierconn *) wire [5:0] \u_dut.step_q ;
  (* hierconn *) wire \u_dut.mirror_q , \u_dut.a_between_q , \u_dut.b_between_q ;
  (* hierconn *) wire [17:0] \u_dut.u_q , \u_dut.v_q , \u_dut.outer_q , \u_dut.leg_q ;
  (* hierconn *) wire [11:0] \u_dut.high_leg_q ;
  wire signed [31:0] u_q = 32'($signed(\u_dut.u_q ));
  wire signed [31:0] v_q = 32'($signed(\u_dut.v_q ));
  wire signed [31:0] outer = 32'($signed(\u_dut.outer_q ));
  wire signed [31:0] leg = 32'($signed(\u_dut.leg_q ));
  wire mirror_q = \u_dut.mirror_q ;
  wire [5:0] step = \u_dut.step_q ;
  logic again;  // the voltage is limited, and the legs are made
  assign again = \u_dut.op_q == 4'd11;

  // The legs: their differences are 2 (u - v), 4 v and -2 (u + v), and the highest is as far above the middle as the
  // lowest is below.
  logic signed [16:0] u, v, b, c, highest, lowest, leg_a, leg_a_q;
  logic in_hexagon;
  function automatic logic signed [31:0] size(input logic signed [31:0] value);
    size = value < 0 ? -value : value;
  endfunction
  function automatic logic is_leg(input logic [11:0] on, input logic signed [16:0] from_middle);  // rounded down
    is_leg = on == 12'((17'(Middle) + from_middle) >>> 4);
  endfunction
  assign in_hexagon = size(v_q) <= 4 * Period && size(u_q) + size(v_q) <= 8 * Period;
  assign u       = 17'(u_q);
  assign v       = 17'(v_q);
  assign b       = (v - u) <<< 1;   // less A
  assign c       = -((u + v) <<< 1);
  assign highest = b >= 0 && b >= c ? b : c >= 0 ? c : '0;
  assign lowest  = b <= 0 && b <= c ? b : c <= 0 ? c : '0;
  assign leg_a   = -((highest + lowest) >>> 1);
  always_ff @(posedge clk_i) begin
    if (again && step == 6'd0) leg_a_q <= leg_a;
  end

  logic signed [16:0] far;
  assign far = \u_dut.a_between_q ? v <<< 1 : \u_dut.b_between_q ? u + v : u - v;

  always_comb begin
    if (past_ok_q && rst_ni) begin
      legs_by_space_vectors: assert (!valid || !in_hexagon || (is_leg(on_a, leg_a_q) &&
          is_leg(mirror_q ? on_c : on_b, leg_a_q + b) && is_leg(mirror_q ? on_b : on_c, leg_a_q + c)));
      within_the_period: assert (!valid || !in_hexagon || (on_a <= 12'(Period) && on_b <= 12'(Period) && on_c <= 12'(Period)));
      a_voltage: cover (in_hexagon && u_q == 32'sd3000 && v_q == -32'sd3500);
      inside_valid: assert (!valid || (again && step == 6'd4));
      inside_legs: assert (!again || !in_hexagon || step == 6'd0 || (\u_dut.a_between_q == ((u_q + v_q < 0) != (u_q - v_q < 0)) &&
          \u_dut.b_between_q == ((u_q < 0) == (v_q < 0)) && outer == 32'(far) && (step != 6'd2 || leg == Middle + outer) &&
          (step != 6'd3 || (leg == Middle - outer && \u_dut.high_leg_q == 12'((Middle + outer) >>> 4)))));
      inside_leg_a: assert (!again || !in_hexagon || step == 6'd0 || leg_a_q == (\u_dut.a_between_q ? u <<< 1 : far));
      inside_leg_b: assert (!again || !in_hexagon || step < 6'd2 ||
          leg_a_q + b == (\u_dut.a_between_q ? far : \u_dut.b_between_q ? (v <<< 2) - far : -far));
      inside_leg_c: assert (!again || !in_hexagon || step < 6'd2 ||
          leg_a_q + c == (\u_dut.a_between_q || \u_dut.b_between_q ? -far : -far - (v <<< 2)));
    end
  end
endmodule

`default_nettype wire
