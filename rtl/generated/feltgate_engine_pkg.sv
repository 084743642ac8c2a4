// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generated from rtl/engine/engine.toml by
// `feltgate generate`: do not edit. Numbers, instructions and addresses of the engine.

`default_nettype none

/* verilator lint_off UNUSEDPARAM */  // a block uses the constants that concern it
package feltgate_engine_pkg;
  localparam int THREADS = 4;  // programs that run beside each other
  localparam int ROUND_CLOCKS = 6;  // clocks from one instruction of a thread to its next
  localparam int START_CLOCKS = 4;  // clocks between two runs of a thread beside those that its inputs take (engine_period in engine_ops.hpp)
  localparam int THREAD_WORDS = 128;  // a thread's program begins at this times its number
  localparam int PROGRAM_WORDS = 512;  // words of program memory
  localparam int PROGRAM_BITS = 36;  // bits of a program word, and of a table word
  localparam int DATA_WORDS = 512;  // words of data memory
  localparam int DATA_BITS = 32;  // bits of a data word
  localparam int FACTOR_BITS = 18;  // low bits of y that multiply, signed
  localparam int TABLE_WORDS = 512;  // words of table memory
  localparam int VALUE_BITS = 20;  // low bits of a table word: the value that LRP starts from, signed
  localparam int SLOPE_BITS = 16;  // bits of a table word above the value: what LRP adds over a whole segment, signed
  localparam int FRACTION_BITS = 12;  // low bits of a table position, within a segment
  localparam int OUTPUTS = 3;  // outputs, one per axis; an engine of fewer axes drops the others
  localparam int PRIVATE_WORDS = 64;  // private words of a thread
  localparam int INPUT_FIRST = 48;  // first private word that the hardware writes before a run
  localparam int INPUT_AXIS_WORDS = 3;  // inputs of an axis: position, velocity, tau_hat
  localparam int INPUT_TICK = 57;  // private word of the tick's number
  localparam int EXCHANGE_WORDS = 16;  // exchange words that a thread may write
  localparam int PARAMETER_WORDS = 32;  // words of a bank of parameters
  localparam int EVENT_BITS = 9;  // bits of an event's number
  localparam int DIVIDER_BITS = 12;  // bits of a thread's divider, ticks per start; 0 counts as 1
  localparam int AGE_BITS = 16;  // bits of max_age, ticks
  localparam int MAILBOX_STEP = 64;  // ticks that mailbox_age counts as one: those whose number is a multiple of it end a step
  localparam int HOST_BITS = 12;  // bits of a host address
  localparam int PORT_FIRST = 16384;  // first address of the engine at the register port of the axes

  // Shifts of a product, by the field mode.
  localparam int SHIFT_0 = 0;
  localparam int SHIFT_1 = 12;
  localparam int SHIFT_2 = 17;
  localparam int SHIFT_3 = 27;

  // Bits (B) and widths (W) of a program word's fields.
  localparam int B_OP = 32;
  localparam int W_OP = 4;
  localparam int B_MODE = 30;
  localparam int W_MODE = 2;
  localparam int B_LAST = 29;
  localparam int B_DST = 27;
  localparam int W_DST = 2;
  localparam int B_D = 18;
  localparam int W_D = 9;
  localparam int B_A = 9;
  localparam int W_A = 9;
  localparam int B_B = 0;
  localparam int W_B = 9;

  // Instructions.
  localparam logic [3:0] OP_ADD = 4'd0;
  localparam logic [3:0] OP_SUB = 4'd1;
  localparam logic [3:0] OP_MUL = 4'd2;
  localparam logic [3:0] OP_MAC = 4'd3;
  localparam logic [3:0] OP_MLW = 4'd4;
  localparam logic [3:0] OP_MIN = 4'd5;
  localparam logic [3:0] OP_MAX = 4'd6;
  localparam logic [3:0] OP_SEL = 4'd7;
  localparam logic [3:0] OP_CMP = 4'd8;
  localparam logic [3:0] OP_LRP = 4'd9;
  localparam logic [3:0] OP_TAB = 4'd10;
  localparam logic [3:0] OP_TST = 4'd11;
  localparam logic [3:0] OP_FRC = 4'd12;
  localparam logic [3:0] OP_BRF = 4'd13;
  localparam logic [3:0] OP_ABS = 4'd14;
  localparam logic [3:0] OP_NOP = 4'd15;

  // First data words of the regions.
  localparam logic [8:0] D_OWN = 9'd0;
  localparam logic [8:0] D_EXCHANGE = 9'd256;
  localparam logic [8:0] D_PARAMETER = 9'd320;
  localparam logic [8:0] D_PARAMETER_BANK = 9'd352;
  localparam logic [8:0] D_LOWER = 9'd384;
  localparam logic [8:0] D_UPPER = 9'd416;
  localparam logic [8:0] D_CONSTANT = 9'd448;

  // Addresses of the host, and bits of what is there.
  localparam logic [11:0] H_DATA = 12'h000;
  localparam logic [11:0] H_PROGRAM = 12'h200;
  localparam logic [11:0] H_TABLE = 12'h400;
  localparam logic [11:0] H_PROGRAM_HIGH = 12'h600;
  localparam logic [11:0] H_TABLE_HIGH = 12'h800;
  localparam logic [11:0] H_HIGH = 12'ha00;
  localparam logic [11:0] H_RUN = 12'ha01;
  localparam logic [11:0] H_DIVIDER0 = 12'ha02;
  localparam logic [11:0] H_DIVIDER1 = 12'ha03;
  localparam logic [11:0] H_DIVIDER2 = 12'ha04;
  localparam logic [11:0] H_DIVIDER3 = 12'ha05;
  localparam logic [11:0] H_CRC = 12'ha06;
  localparam logic [11:0] H_LINE_BASE = 12'ha07;
  localparam logic [11:0] H_MAX_AGE = 12'ha08;
  localparam logic [11:0] H_COMMIT = 12'ha09;
  localparam logic [11:0] H_STATUS = 12'ha0a;
  localparam int B_STATUS_COMMITTING = 0;
  localparam int B_STATUS_REFUSED = 1;
  localparam int B_STATUS_CRC_BUSY = 2;
  localparam int B_STATUS_CRC_GOOD = 3;
  localparam int B_STATUS_LATE = 4;
  localparam int B_STATUS_BANK = 5;
  localparam int B_STATUS_OVERRUN = 6;
  localparam int B_STATUS_MAILBOX_LATE = 7;
  localparam int B_STATUS_RUNNING = 8;
  localparam int W_STATUS_RUNNING = 4;
  localparam int B_STATUS_DROPPED = 12;
  localparam logic [11:0] H_REFUSED_WORD = 12'ha0b;
  localparam logic [11:0] H_MAILBOX_FIRST = 12'ha0c;
  localparam logic [11:0] H_MAILBOX_AGE = 12'ha0d;
  localparam logic [11:0] H_EVENT_COUNT = 12'ha10;
  localparam logic [11:0] H_EVENT_NUMBER = 12'ha11;
  localparam logic [11:0] H_EVENT_VALUE = 12'ha12;
  localparam logic [11:0] H_EVENT_TICK = 12'ha13;
  localparam logic [11:0] H_EVENTS_LOST = 12'ha14;

  // What the engine's words hold after a reset: fields, and an engine that waits for a host.
  localparam int B_RESET_RUN = 0;
  localparam int W_RESET_RUN = 4;
  localparam int B_RESET_DIVIDER0 = 4;
  localparam int W_RESET_DIVIDER0 = 12;
  localparam int B_RESET_DIVIDER1 = 16;
  localparam int W_RESET_DIVIDER1 = 12;
  localparam int B_RESET_DIVIDER2 = 28;
  localparam int W_RESET_DIVIDER2 = 12;
  localparam int B_RESET_DIVIDER3 = 40;
  localparam int W_RESET_DIVIDER3 = 12;
  localparam int B_RESET_LINE_BASE = 52;
  localparam int W_RESET_LINE_BASE = 10;
  localparam int B_RESET_MAILBOX_FIRST = 62;
  localparam int W_RESET_MAILBOX_FIRST = 6;
  localparam int B_RESET_MAILBOX_AGE = 68;
  localparam int W_RESET_MAILBOX_AGE = 16;
  localparam int B_RESET_CRC = 84;
  localparam int W_RESET_CRC = 32;
  localparam int B_RESET_MAX_AGE = 116;
  localparam int W_RESET_MAX_AGE = 16;
  localparam int RESET_BITS = 132;
  localparam logic [131:0] RESET_EMPTY = {16'd0, 32'd0, 16'd0, 6'd32, 10'd512, 12'd0, 12'd0, 12'd0, 12'd0, 4'd0};
endpackage
/* verilator lint_on UNUSEDPARAM */

`default_nettype wire
