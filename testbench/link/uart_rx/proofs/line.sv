// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// uart_rx on any line: what a byte and an error are made of, by the nominal rate. A level is what two of three
// clocks on end have, as the page says.
`default_nettype none

`ifdef MBAUD_6
`define RATE 6000000
`else
`define RATE feltgate_link_pkg::BAUD
`endif

module line_proof (
    input logic clk_i,
    input logic rst_ni,
    input logic rx_i
);
  localparam int Baud = `RATE;
  localparam int ClockHz = cfg::CLOCK_HZ;
  // A middle is met to a clock, and a quarter more, since the rate is one of whole steps. Units as in uart_tx's
  // proof: a clock lasts 2 Baud, a bit 2 ClockHz.
  localparam logic [31:0] OFF = 32'(2 * Baud + Baud / 2);
  localparam logic [31:0] STEP = 32'((64'(Baud) * 64'd131072 / 64'(ClockHz) + 64'd1) / 64'd2);

`include "reset.svh"

  logic [7:0] got;
  logic valid, error;
  uart_rx #(.ClockHz(ClockHz), .Baud(Baud)) u_dut (
      .clk_i(clk_i), .rst_ni(rst_ni), .rx_i(rx_i), .byte_o(got), .valid_o(valid), .error_o(error)
  );
  (* hierconn *) wire [2:0] \u_dut.seen_q ;
  (* hierconn *) wire \u_dut.late_q ;
  (* hierconn *) wire \u_dut.busy_q ;
  (* hierconn *) wire \u_dut.ready_q ;
  (* hierconn *) wire [3:0] \u_dut.bit_q ;
  (* hierconn *) wire [15:0] \u_dut.phase_q ;

  // The level, two clocks later than the line for the synchronizer.
  logic [3:0] past_q;
  logic level;
  assign level = 2'({1'b0, past_q[1]} + {1'b0, past_q[2]} + {1'b0, past_q[3]}) >= 2'd2;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) past_q <= '1;
    else past_q <= {past_q[2:0], rx_i};
  end

  // Since the level fell where a byte may begin: that clock is 0. It goes on while the receiver is in a byte.
  logic in, may_q, fell_q, in_then_q;
  logic [31:0] now_q, count_q;
  logic [9:0] was_high_q, was_low_q;  // in the middle of each bit, or in a clock beside it
  logic [9:0] is_middle;
  assign in = \u_dut.busy_q ;
  always_comb begin
    is_middle = '0;
    for (int k = 0; k < 10; k++) begin
      is_middle[k] = now_q + OFF >= 32'((2 * k + 1) * ClockHz) && now_q <= 32'((2 * k + 1) * ClockHz) + OFF;
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      may_q      <= 1'b0;
      fell_q     <= 1'b0;
      now_q      <= '0;
      count_q    <= '0;
      was_high_q <= '0;
      was_low_q  <= '0;
    end else begin
      may_q  <= level;
      fell_q <= !in && may_q && !level;
      if (!in) begin
        now_q      <= 32'(2 * Baud);
        count_q    <= 32'd1;
        was_high_q <= '0;
        was_low_q  <= '0;
      end else begin
        now_q      <= now_q + 32'(2 * Baud);
        count_q    <= count_q + 32'd1;
        was_high_q <= was_high_q | (is_middle & {10{level}});
        was_low_q  <= was_low_q | (is_middle & {10{!level}});
      end
    end
  end
  always_ff @(posedge clk_i) in_then_q <= in;

  // The bits that were taken, the last one the highest.
  logic bits_right;
  always_comb begin
    bits_right = 1'b1;
    for (int k = 1; k < 9; k++) begin
      if (4'(k) < \u_dut.bit_q && !(got[3'(4'd8 + 4'(k) - \u_dut.bit_q )] ? was_high_q[k] : was_low_q[k])) bits_right = 1'b0;
    end
  end
  logic byte_right, after_q;
  always_comb begin
    byte_right = 1'b1;
    for (int k = 0; k < 8; k++) if (!(got[k] ? was_high_q[k+1] : was_low_q[k+1])) byte_right = 1'b0;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) after_q <= 1'b0;
    else after_q <= 1'b1;
  end

  always_comb begin
    if (past_ok_q && rst_ni) begin
      never_both: assert (!valid || !error);
      byte_of_the_middles: assert (!valid || byte_right);
      valid_of_a_high_stop: assert (!valid || (was_low_q[0] && was_high_q[9]));
      error_of_a_low_stop: assert (!error || (was_low_q[0] && was_low_q[9]));
      in_its_time: assert (!(valid || error) || (in_then_q && now_q + OFF >= 32'(19 * ClockHz) &&
                                                 now_q <= 32'(19 * ClockHz + 2 * Baud) + OFF));
      begins_with_a_fall: assert (!after_q || in_then_q || in == fell_q);
      short_low_is_none: assert (!in || now_q <= 32'(ClockHz + 2 * Baud) + OFF || was_low_q[0]);
      every_start_is_told: assert (!after_q || !in_then_q || in || valid || error ||
                                   (was_high_q[0] && now_q <= 32'(ClockHz + 2 * Baud) + OFF));
      never_stuck: assert (!in || now_q <= 32'(19 * ClockHz + Baud / 8));

      inside_level: assert ({\u_dut.late_q , \u_dut.seen_q [2:0]} == past_q);
      inside_ready: assert (in || \u_dut.ready_q == may_q);
      inside_time: assert (!(in || valid || error || (after_q && in_then_q)) || now_q == count_q * 32'(2 * Baud));
      inside_phase: assert (!in || (\u_dut.bit_q <= 4'd9 && 32'h8000 + count_q * STEP == {12'd0, \u_dut.bit_q , \u_dut.phase_q }));
      inside_start: assert (!in || \u_dut.bit_q == 4'd0 || was_low_q[0]);
      inside_count: assert (count_q < 32'(11 * (ClockHz / Baud + 1)));
      inside_bits: assert (!in || bits_right);
      begins: cover (in);
      refuses: cover (after_q && in_then_q && !in);
    end
  end
endmodule

`default_nettype wire
