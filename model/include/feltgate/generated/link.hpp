// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generated from rtl/registers.toml by
// `feltgate generate`: do not edit.
#pragma once

#include <cstdint>
#include <string_view>

namespace feltgate {

/// A word of the host's link.
struct LinkWord {
  std::string_view name;
  std::uint16_t address;
  bool writable;
};

/// Addresses, bits and numbers of the host's link.
struct LinkMap {
  static constexpr std::uint32_t identity = 0x46454c54;  ///< what the word identity says
  static constexpr std::uint32_t version = 0x10000;  ///< what the word version says
  static constexpr std::uint32_t baud = 0xf4240;  ///< bits per second where nothing else is said
  static constexpr std::uint32_t frame_end = 0xc0;  ///< byte before and after a frame
  static constexpr std::uint32_t frame_escape = 0xdb;  ///< byte that changes the next one's meaning
  static constexpr std::uint32_t escaped_end = 0xdc;  ///< after the escape: frame_end
  static constexpr std::uint32_t escaped_escape = 0xdd;  ///< after the escape: frame_escape
  static constexpr std::uint32_t kind_read = 0x1;  ///< first byte of a request to read
  static constexpr std::uint32_t kind_write = 0x2;  ///< first byte of a request to write
  static constexpr std::uint32_t kind_stream = 0x40;  ///< first byte of a frame that nobody asked for
  static constexpr std::uint32_t kind_reply = 0x80;  ///< set in the first byte of a reply
  static constexpr std::uint32_t request_bytes = 0xc;  ///< bytes of every request, its CRC among them
  static constexpr std::uint32_t read_words = 0x40;  ///< most words of one read
  static constexpr std::uint32_t map_bits = 0xe;  ///< bits of an address; a request beyond is bad. One more where features.engine is set
  static constexpr std::uint32_t no_sequence = 0x100;  ///< last_write_sequence before the first write
  static constexpr std::uint32_t words = 0x1000;  ///< first address of the link's words; below are the core's
  static constexpr std::uint32_t memory = 0x2000;  ///< first address of the capture memory: 8 words of a row, then the next row
  static constexpr std::uint32_t rows_log2 = 0xa;  ///< log2 of the rows of the capture memory
  static constexpr std::uint32_t columns = 0x8;  ///< words of a row
  static constexpr std::uint32_t trigger_mode_bits = 0x3;  ///< bits of trigger_mode
  static constexpr std::uint32_t trigger_rises = 0x1;  ///< trigger_mode: the word rises to the level or above, signed
  static constexpr std::uint32_t trigger_falls = 0x2;  ///< trigger_mode: the word falls below the level
  static constexpr std::uint32_t trigger_bit = 0x3;  ///< trigger_mode: a bit of the level becomes 1
  static constexpr std::uint32_t trigger_event = 0x4;  ///< trigger_mode: an event of a law; a bit of its own, which stays 0 without an engine
  static constexpr std::uint32_t any_event = 0x200;  ///< set in trigger_level: an event of any number; the bits below it are the number
  static constexpr std::uint32_t engine = 0x4000;  ///< first address of the engine's words, where features.engine is set

  /// Addresses.
  struct A {
    static constexpr std::uint16_t identity = 0x1000;
    static constexpr std::uint16_t version = 0x1001;
    static constexpr std::uint16_t design_crc = 0x1002;
    static constexpr std::uint16_t clock_hz = 0x1003;
    static constexpr std::uint16_t clocks_per_tick = 0x1004;
    static constexpr std::uint16_t features = 0x1005;
    static constexpr std::uint16_t frames_good = 0x1006;
    static constexpr std::uint16_t frames_bad = 0x1007;
    static constexpr std::uint16_t last_write_sequence = 0x1008;
    static constexpr std::uint16_t board = 0x1009;
    static constexpr std::uint16_t inputs = 0x100a;
    static constexpr std::uint16_t stream_words = 0x1010;
    static constexpr std::uint16_t stream_period = 0x1011;
    static constexpr std::uint16_t stream_dropped = 0x1012;
    static constexpr std::uint16_t capture_control = 0x1020;
    static constexpr std::uint16_t capture_state = 0x1021;
    static constexpr std::uint16_t capture_words = 0x1022;
    static constexpr std::uint16_t capture_pre = 0x1023;
    static constexpr std::uint16_t capture_period = 0x1024;
    static constexpr std::uint16_t trigger_word = 0x1025;
    static constexpr std::uint16_t trigger_mode = 0x1026;
    static constexpr std::uint16_t trigger_level = 0x1027;
    static constexpr std::uint16_t capture_first = 0x1028;
    static constexpr std::uint16_t capture_rows = 0x1029;
  };

  /// Bits of the words' fields, and their widths.
  struct B {
    static constexpr int features_simulated = 0;
    static constexpr int features_capture = 1;
    static constexpr int features_stream = 2;
    static constexpr int features_engine = 3;
    static constexpr int features_rows_log2 = 8;
    static constexpr int features_rows_log2_width = 8;
    static constexpr int features_columns = 16;
    static constexpr int features_columns_width = 8;
    static constexpr int capture_control_start = 0;
    static constexpr int capture_control_abort = 1;
    static constexpr int capture_control_trigger = 2;
  };

  /// The snapshot's words by number, in the order of their slots.
  struct N {
    static constexpr int status = 0;
    static constexpr int position = 1;
    static constexpr int tick = 2;
    static constexpr int velocity = 3;
    static constexpr int index = 4;
    static constexpr int encoder = 5;
    static constexpr int tau_hat = 6;
    static constexpr int faults = 7;
    static constexpr int tau_ref = 8;
    static constexpr int current_ref = 9;
    static constexpr int voltage = 10;
    static constexpr int duty = 11;
  };
  static constexpr int snapshot_words = 12;
  static constexpr int slots[] = {0, 1, 6, 9, 11, 14, 23, 26, 28, 34, 40, 46};

  static constexpr LinkWord all[] = {
      {"identity", A::identity, false},
      {"version", A::version, false},
      {"design_crc", A::design_crc, false},
      {"clock_hz", A::clock_hz, false},
      {"clocks_per_tick", A::clocks_per_tick, false},
      {"features", A::features, false},
      {"frames_good", A::frames_good, false},
      {"frames_bad", A::frames_bad, false},
      {"last_write_sequence", A::last_write_sequence, false},
      {"board", A::board, false},
      {"inputs", A::inputs, false},
      {"stream_words", A::stream_words, true},
      {"stream_period", A::stream_period, true},
      {"stream_dropped", A::stream_dropped, false},
      {"capture_control", A::capture_control, true},
      {"capture_state", A::capture_state, false},
      {"capture_words", A::capture_words, true},
      {"capture_pre", A::capture_pre, true},
      {"capture_period", A::capture_period, true},
      {"trigger_word", A::trigger_word, true},
      {"trigger_mode", A::trigger_mode, true},
      {"trigger_level", A::trigger_level, true},
      {"capture_first", A::capture_first, false},
      {"capture_rows", A::capture_rows, false},
  };
};

}  // namespace feltgate
