// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generated from rtl/registers.toml by
// `feltgate generate`: do not edit. Addresses, bits and numbers of the host's link.

`default_nettype none

/* verilator lint_off UNUSEDPARAM */  // a block uses the constants that concern it
package feltgate_link_pkg;
  localparam logic [31:0] IDENTITY = 32'h46454c54;  // what the word identity says
  localparam logic [31:0] VERSION = 32'h10000;  // what the word version says
  localparam logic [31:0] BAUD = 32'hf4240;  // bits per second where nothing else is said
  localparam logic [31:0] FRAME_END = 32'hc0;  // byte before and after a frame
  localparam logic [31:0] FRAME_ESCAPE = 32'hdb;  // byte that changes the next one's meaning
  localparam logic [31:0] ESCAPED_END = 32'hdc;  // after the escape: frame_end
  localparam logic [31:0] ESCAPED_ESCAPE = 32'hdd;  // after the escape: frame_escape
  localparam logic [31:0] KIND_READ = 32'h1;  // first byte of a request to read
  localparam logic [31:0] KIND_WRITE = 32'h2;  // first byte of a request to write
  localparam logic [31:0] KIND_STREAM = 32'h40;  // first byte of a frame that nobody asked for
  localparam logic [31:0] KIND_REPLY = 32'h80;  // set in the first byte of a reply
  localparam logic [31:0] REQUEST_BYTES = 32'hc;  // bytes of every request, its CRC among them
  localparam logic [31:0] READ_WORDS = 32'h40;  // most words of one read
  localparam logic [31:0] MAP_BITS = 32'he;  // bits of an address; a request beyond is bad
  localparam logic [31:0] NO_SEQUENCE = 32'h100;  // last_write_sequence before the first write
  localparam logic [31:0] WORDS = 32'h1000;  // first address of the link's words; below are the core's
  localparam logic [31:0] MEMORY = 32'h2000;  // first address of the capture memory: 8 words of a row, then the next row
  localparam logic [31:0] ROWS_LOG2 = 32'ha;  // log2 of the rows of the capture memory
  localparam logic [31:0] COLUMNS = 32'h8;  // words of a row

  // Addresses of the words; bits (B) and widths (W) of their fields.
  localparam logic [15:0] A_IDENTITY = 16'h1000;
  localparam logic [15:0] A_VERSION = 16'h1001;
  localparam logic [15:0] A_DESIGN_CRC = 16'h1002;
  localparam logic [15:0] A_CLOCK_HZ = 16'h1003;
  localparam logic [15:0] A_CLOCKS_PER_TICK = 16'h1004;
  localparam logic [15:0] A_FEATURES = 16'h1005;
  localparam int B_FEATURES_SIMULATED = 0;
  localparam int B_FEATURES_CAPTURE = 1;
  localparam int B_FEATURES_STREAM = 2;
  localparam int B_FEATURES_ROWS_LOG2 = 8;
  localparam int W_FEATURES_ROWS_LOG2 = 8;
  localparam int B_FEATURES_COLUMNS = 16;
  localparam int W_FEATURES_COLUMNS = 8;
  localparam logic [15:0] A_FRAMES_GOOD = 16'h1006;
  localparam logic [15:0] A_FRAMES_BAD = 16'h1007;
  localparam logic [15:0] A_LAST_WRITE_SEQUENCE = 16'h1008;
  localparam logic [15:0] A_BOARD = 16'h1009;
  localparam logic [15:0] A_INPUTS = 16'h100a;
  localparam logic [15:0] A_STREAM_WORDS = 16'h1010;
  localparam logic [15:0] A_STREAM_PERIOD = 16'h1011;
  localparam logic [15:0] A_STREAM_DROPPED = 16'h1012;
  localparam logic [15:0] A_CAPTURE_CONTROL = 16'h1020;
  localparam int B_CAPTURE_CONTROL_START = 0;
  localparam int B_CAPTURE_CONTROL_ABORT = 1;
  localparam int B_CAPTURE_CONTROL_TRIGGER = 2;
  localparam logic [15:0] A_CAPTURE_STATE = 16'h1021;
  localparam logic [15:0] A_CAPTURE_WORDS = 16'h1022;
  localparam logic [15:0] A_CAPTURE_PRE = 16'h1023;
  localparam logic [15:0] A_CAPTURE_PERIOD = 16'h1024;
  localparam logic [15:0] A_TRIGGER_WORD = 16'h1025;
  localparam logic [15:0] A_TRIGGER_MODE = 16'h1026;
  localparam logic [15:0] A_TRIGGER_LEVEL = 16'h1027;
  localparam logic [15:0] A_CAPTURE_FIRST = 16'h1028;
  localparam logic [15:0] A_CAPTURE_ROWS = 16'h1029;
endpackage
/* verilator lint_on UNUSEDPARAM */

`default_nettype wire
