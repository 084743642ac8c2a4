// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One key, four commands. Pressed while armed: stop (through stop_o, a fault, if a host has armed).
// Pressed and released within LongPressClocks while stopped: request to arm. Held for
// LongPressClocks: set zero (one clock), or with a fault clear the faults (one clock) and keep the
// zero; never arms. blocked_i, a fault, a disarm from elsewhere and LongPressClocks without arming
// cancel the request; arming again then needs a new press. Documentation: docs/boards/panel.md
`default_nettype none

module panel_key #(
  parameter int HoldBits        = 19,
  parameter int LongPressClocks = 50000000
) (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic down_i,    // high while pressed; synchronous to clk_i, bounces
  input  logic armed_i,
  input  logic fault_i,
  input  logic blocked_i, // 1: the key cannot arm; a fault has the same effect
  output logic arm_o,
  output logic stop_o,    // this key is down and a host has armed
  output logic set_zero_o,
  output logic clear_faults_o
);

  localparam int HELD_BITS = $clog2(LongPressClocks + 1);
  localparam logic [HELD_BITS-1:0] LONG_PRESS = LongPressClocks[HELD_BITS-1:0];

  logic                 down, down_q, armed_q;
  logic                 spent_q;  // this press has acted; its release does nothing
  logic                 arm_q, stop_q, set_zero_q, clear_faults_q;
  logic [HELD_BITS-1:0] held_q;   // clocks since the key moved; saturates at LongPressClocks

  // The key counts as down after reset: a key held through a reset must be released before it acts.
  panel_debounce #(.Width(1), .HoldBits(HoldBits), .ResetValue(1)) u_debounce (
    .clk_i(clk_i),
    .rst_ni(rst_ni),
    .level_i(down_i),
    .level_o(down)
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      down_q         <= 1'b1;
      armed_q        <= 1'b0;
      spent_q        <= 1'b1;
      arm_q          <= 1'b0;
      stop_q         <= 1'b0;
      set_zero_q     <= 1'b0;
      clear_faults_q <= 1'b0;
      held_q         <= LONG_PRESS;
    end else begin
      down_q         <= down;
      armed_q        <= armed_i;
      set_zero_q     <= 1'b0;
      clear_faults_q <= 1'b0;
      if (down && !down_q) begin
        spent_q <= arm_q || armed_i;
        arm_q   <= 1'b0;
        stop_q  <= armed_i && !arm_q;
        held_q  <= '0;
      end else if (down && held_q != LONG_PRESS) begin
        held_q <= held_q + 1'b1;
        if (held_q == LONG_PRESS - 1'b1) begin
          spent_q        <= 1'b1;
          set_zero_q     <= !fault_i;
          clear_faults_q <= fault_i;
        end
      end else if (!down && down_q) begin
        arm_q  <= !spent_q;
        stop_q <= 1'b0;
        held_q <= '0;
      end else if (!down && held_q != LONG_PRESS) begin
        held_q <= held_q + 1'b1;
      end
      if (fault_i || blocked_i || (!armed_i && (armed_q || held_q == LONG_PRESS))) arm_q <= 1'b0;
    end
  end

  assign arm_o = arm_q;
  assign stop_o = stop_q;
  assign set_zero_o = set_zero_q;
  assign clear_faults_o = clear_faults_q;
endmodule

`default_nettype wire
