// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Serial lines of a sensor: select, clock, command out, data in, the highest bit first. The sensor
// launches a bit with a rising edge of the clock; it is taken just before the next one. valid_o
// GapClocks + (2 FrameBits + 1) HalfClocks + 5 clocks after start_i at the latest; frame and checks
// hold until the next frame. docs/blocks/absolute_encoder.md

`default_nettype none

module serial_frame #(
    parameter int FrameBits  = 16,
    parameter int HalfClocks = 5,   // half a serial clock, 4 or more
    parameter int GapClocks  = 20   // from the select to the serial clock, and between two frames at least
) (
    input  logic                 clk_i,
    input  logic                 rst_ni,
    input  logic                 start_i,        // begins a frame if idle_o
    output logic                 idle_o,
    input  logic [FrameBits-1:0] command_i,      // taken with start_i
    output logic                 select_no,
    output logic                 serial_clock_o,
    output logic                 command_o,
    input  logic                 data_i,         // asynchronous
    output logic [FrameBits-1:0] frame_o,
    output logic                 odd_o,          // the parity of all bits
    output logic                 crc_wrong_o,    // the CRC-6 of all bits, x^6 + x + 1, is not 0
    output logic                 valid_o         // one clock
);
  localparam int WaitW = $clog2((GapClocks > 2 * HalfClocks ? GapClocks : 2 * HalfClocks) + 1);
  localparam int PeriodW = $clog2(FrameBits + 1);
  localparam logic [WaitW-1:0] TakeAt = WaitW'(2);  // two flip-flops after the pin
  typedef enum logic [1:0] {Idle, Lead, Read, Gap} state_t;  // Lead: selected, before the first serial clock
  state_t state_q;
  logic [WaitW-1:0] wait_q;      // clocks of Lead and Gap, in Read of a serial clock
  logic [PeriodW-1:0] period_q;  // serial clocks so far
  logic [FrameBits-1:0] command_q;
  logic [5:0] crc_q;
  logic meta_q, bit_q, clocks, take, last, waited, crc_bit;
  assign idle_o      = state_q == Idle;
  assign clocks      = state_q == Read && period_q < PeriodW'(FrameBits);
  assign take        = state_q == Read && wait_q == TakeAt && period_q != '0;
  assign last        = take && period_q == PeriodW'(FrameBits);
  assign waited      = wait_q == WaitW'(GapClocks - 1);
  assign command_o   = command_q[FrameBits-1];
  assign crc_bit     = crc_q[5] ^ bit_q;
  assign crc_wrong_o = crc_q != '0;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {meta_q, bit_q, wait_q, period_q, command_q, serial_clock_o, valid_o} <= '0;
      select_no <= 1'b1;
      state_q   <= Idle;
    end else begin
      {bit_q, meta_q} <= {meta_q, data_i};
      select_no       <= !(state_q == Lead || state_q == Read);
      serial_clock_o  <= clocks && wait_q < WaitW'(HalfClocks);
      valid_o         <= last;
      wait_q          <= wait_q + 1'b1;
      case (state_q)
        Idle: begin
          wait_q   <= '0;
          period_q <= '0;
          if (start_i) begin
            state_q   <= Lead;
            command_q <= command_i;
          end
        end
        Lead: if (waited) begin
          wait_q  <= '0;
          state_q <= Read;
        end
        Read: begin
          if (wait_q == WaitW'(2 * HalfClocks - 1)) begin
            wait_q   <= '0;
            period_q <= period_q + 1'b1;
          end
          if (clocks && wait_q == '0 && period_q != '0) command_q <= command_q << 1;
          if (last) begin
            wait_q  <= '0;
            state_q <= Gap;
          end
        end
        default: if (waited) state_q <= Idle;
      endcase
    end
  end
  always_ff @(posedge clk_i) begin
    if (state_q == Lead) begin
      {crc_q, odd_o} <= '0;
    end else if (take) begin
      frame_o <= {frame_o[FrameBits-2:0], bit_q};
      odd_o   <= odd_o ^ bit_q;
      crc_q   <= {crc_q[4:1], crc_q[0] ^ crc_bit, crc_bit};
    end
  end
endmodule

`default_nettype wire
