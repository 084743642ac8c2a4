// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A UART line as a host of another clock drives it: its own baud rate, any phase, gaps, pulses of
// one clock, stop bits that are low, breaks. Documentation: docs/testing.md
#pragma once

#include <cstdint>
#include <deque>

#include "random.hpp"

namespace feltgate::test {

struct RoughLine {
  struct Faults {
    bool pulses = false;   ///< of one clock, at least six clocks apart
    bool framing = false;  ///< stop bits that are low, breaks, half bytes
  };
  /// `bit_clocks`: of this host.
  RoughLine(std::uint64_t seed, double bit_clocks, Faults f)
      : random(seed), bit(bit_clocks), faults(f) {}

  /// The level in the next clock.
  bool next() {
    now += 1.0;
    while (now >= edge) begin_bit();
    bool now_level = level;
    if (faults.pulses && since_pulse > 6 && random.one_in(25)) {
      since_pulse = 0;
      now_level = !now_level;
    }
    ++since_pulse;
    return now_level;
  }

  void begin_bit() {
    if (left == 0) begin();
    level = (bits & 1U) != 0;
    bits >>= 1;
    --left;
    edge += bit * (left == 0 ? last : 1.0);
  }

  /// A byte, a gap, or what is wrong.
  void begin() {
    last = 1.0;
    if (random.one_in(3)) {  // idle for any time
      bits = 1;
      left = 1;
      last = random.one_in(20) ? 30.0 : 0.001 * static_cast<double>(1 + random.below(2000));
      return;
    }
    if (faults.framing && random.one_in(20)) {  // low for long: one error
      bits = 0x1000U;
      left = 13;
      last = 2.0;
      wrong += 1;
      return;
    }
    const auto byte = static_cast<std::uint8_t>(random.below(256));
    const bool low_stop = faults.framing && random.one_in(20);
    bits = (low_stop ? 0x400U : 0x200U) | static_cast<unsigned>(byte) << 1;
    left = low_stop ? 11 : 10;
    if (low_stop) {
      ++wrong;
    } else {
      sent.push_back(byte);
    }
  }

  Random random;
  double bit, now = 0, edge = 0, last = 1;
  Faults faults;
  bool level = true;
  unsigned bits = 1;
  int left = 0, since_pulse = 0;
  std::deque<std::uint8_t> sent;  ///< whose stop bits were high
  std::int64_t wrong = 0;         ///< the others
};

}  // namespace feltgate::test
