// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generated from rtl/registers.toml by
// `feltgate generate`: do not edit. Addresses, bits and numbers of the host's link.

`default_nettype none

/* verilator lint_off UNUSEDPARAM */  // a block uses the constants that concern it
package feltgate_link_pkg;
  localparam int IDENTITY = 'h46454c54;  // what the word identity says
  localparam int VERSION = 'h10000;  // what the word version says
  localparam int BAUD = 'hf4240;  // bits per second where nothing else is said
  localparam int FRAME_END = 'hc0;  // byte before and after a frame
  localparam int FRAME_ESCAPE = 'hdb;  // byte that changes the next one's meaning
  localparam int ESCAPED_END = 'hdc;  // after the escape: frame_end
  localparam int ESCAPED_ESCAPE = 'hdd;  // after the escape: frame_escape
  localparam int KIND_READ = 'h1;  // first byte of a request to read
  localparam int KIND_WRITE = 'h2;  // first byte of a request to write
  localparam int KIND_STREAM = 'h40;  // first byte of a frame that nobody asked for
  localparam int KIND_REPLY = 'h80;  // set in the first byte of a reply
  localparam int REQUEST_BYTES = 'hc;  // bytes of every request, its CRC among them
  localparam int READ_WORDS = 'h40;  // most words of one read
  localparam int MAP_BITS = 'he;  // bits of an address; a request beyond is bad. One more where features.engine is set
  localparam int NO_SEQUENCE = 'h100;  // last_write_sequence before the first write
  localparam int WORDS = 'h1000;  // first address of the link's words; below are the core's
  localparam int MEMORY = 'h2000;  // first address of the capture memory: 8 words of a row, then the next row
  localparam int ROWS_LOG2 = 'ha;  // log2 of the rows of the capture memory
  localparam int COLUMNS = 'h8;  // words of a row
  localparam int TRIGGER_MODE_BITS = 'h3;  // bits of trigger_mode
  localparam int TRIGGER_RISES = 'h1;  // trigger_mode: the word rises to the level or above, signed
  localparam int TRIGGER_FALLS = 'h2;  // trigger_mode: the word falls below the level
  localparam int TRIGGER_BIT = 'h3;  // trigger_mode: a bit of the level becomes 1
  localparam int TRIGGER_EVENT = 'h4;  // trigger_mode: an event of a law; a bit of its own, which stays 0 without an engine
  localparam int ANY_EVENT = 'h200;  // set in trigger_level: an event of any number; the bits below it are the number
  localparam int ENGINE = 'h4000;  // first address of the engine's words, where features.engine is set

  // The CRC-32 of a frame: reflected polynomial, register after a whole frame.
  localparam logic [31:0] CRC_POLYNOMIAL = 32'hedb88320;
  localparam logic [31:0] CRC_GOOD = 32'hdebb20e3;

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
  localparam int B_FEATURES_ENGINE = 3;
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

  // The snapshot's words by number, in the order of their slots.
  localparam int SNAPSHOT_WORDS = 12;
  localparam logic [5:0] FIRST_SLOT = 6'd0;
  localparam int N_STATUS = 0;
  localparam int N_POSITION = 1;
  localparam int N_TICK = 2;
  localparam int N_VELOCITY = 3;
  localparam int N_INDEX = 4;
  localparam int N_ENCODER = 5;
  localparam int N_TAU_HAT = 6;
  localparam int N_FAULTS = 7;
  localparam int N_TAU_REF = 8;
  localparam int N_CURRENT_REF = 9;
  localparam int N_VOLTAGE = 10;
  localparam int N_DUTY = 11;
endpackage
/* verilator lint_on UNUSEDPARAM */

`default_nettype wire
