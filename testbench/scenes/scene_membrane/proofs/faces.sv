// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The membrane's torque against the side from which the lever came, tick after tick.
`default_nettype none

module faces_proof (
    input logic        clk_i,
    input logic        rst_ni,
    input logic [ 8:0] start_i,  // where in a tick a reset ends
    input logic        select_i,
    input logic        distance_positive_i,
    input logic        gap_negative_i,
    input logic [31:0] param_i
);
  localparam int W = feltgate_pkg::TORQUE_W;
  localparam int Lower = feltgate_map_pkg::PARAM_AT_MEMBRANE_LOWER;
  localparam int Upper = feltgate_map_pkg::PARAM_AT_MEMBRANE_UPPER;
  localparam int Torque = feltgate_map_pkg::PARAM_AT_MEMBRANE_TORQUE;

  `include "wave.svh"
  logic select_q;
  always_ff @(posedge clk_i) select_q <= select_i;
  always_comb begin
    assume (rst_ni || start_i == 9'(Clocks - feltgate_map_pkg::FIRST_WAVE_CLOCK));  // where the sequencer begins
    assume (tick_q || !rst_ni || select_i == select_q);
  end

  logic signed [W-1:0] plus, minus;
  scene_membrane u_dut (
      .*,
      .param_is_membrane_upper_i(wave[feltgate_map_pkg::PARAM_AT_MEMBRANE_UPPER]),
      .param_was_membrane_upper_i(wave[feltgate_map_pkg::PARAM_AT_MEMBRANE_UPPER+1]),
      .param_is_membrane_torque_i(wave[feltgate_map_pkg::PARAM_AT_MEMBRANE_TORQUE]),
      .plus_o(plus),
      .minus_o(minus)
  );
  (* hierconn *) wire \u_dut.seen_q ;
  (* hierconn *) wire \u_dut.side_q ;
  (* hierconn *) wire \u_dut.below_q ;
  (* hierconn *) wire \u_dut.above_q ;

  // Where the lever is in this tick: below the lower face, above the upper one, else inside; where it was
  // outside last, since the scene was selected.
  logic whole_q, below_q, above_q, inside, came_below_q, came_above_q, new_q;
  logic signed [W-1:0] word_q, wanted;
  assign inside = !below_q && !above_q;
  always_ff @(posedge clk_i) begin
    if (wave[Upper]) begin
      below_q <= distance_positive_i;
      above_q <= gap_negative_i;
    end
    if (wave[Torque]) word_q <= param_i[W-1] ? '0 : param_i[W-1:0];
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      whole_q      <= 1'b0;
      came_below_q <= 1'b0;
      came_above_q <= 1'b0;
      new_q        <= 1'b0;
    end else begin
      if (wave[Lower]) whole_q <= 1'b1;
      new_q <= whole_q && wave[Torque];
      if (!select_i) begin
        came_below_q <= 1'b0;
        came_above_q <= 1'b0;
      end else if (wave[Upper+1] && !inside) begin
        came_below_q <= below_q;
        came_above_q <= !below_q;
      end
    end
  end
  assign wanted = (inside && select_q) ? word_q : '0;

  always_comb begin
    if (past_ok_q && rst_ni) begin
      if (new_q) begin
        back_where_it_came_from: assert (minus == (came_below_q ? wanted : '0) && plus == (came_above_q ? wanted : '0));
        outside_is_0: assert (inside || (plus == '0 && minus == '0));
      end
      never_negative: assert (!whole_q || phase_q <= 9'(Torque) || (plus >= 0 && minus >= 0));
      one_side_at_a_time: assert (!whole_q || phase_q <= 9'(Torque) || plus == 0 || minus == 0);
      unselected_is_0: assert (!whole_q || select_q || (plus == '0 && minus == '0));
      inside_faces: assert (!whole_q || phase_q <= 9'(Upper) || (\u_dut.below_q == below_q &&
          \u_dut.above_q == above_q));
      inside_begin: assert (whole_q || phase_q >= 9'(Clocks - feltgate_map_pkg::FIRST_WAVE_CLOCK) ||
          phase_q <= 9'(Lower));
      inside_side: assert (!(came_below_q && came_above_q) && \u_dut.seen_q == (came_below_q || came_above_q) &&
                           (!\u_dut.seen_q || \u_dut.side_q == came_above_q));
      from_above: cover (new_q && plus > 0);
      from_below: cover (new_q && minus > 0);
    end
  end
endmodule

`default_nettype wire
