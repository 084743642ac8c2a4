// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// How long the twin of absolute_encoder takes to name a fault: a faultless sensor of each framing,
// then one event. Documentation: docs/blocks/absolute_encoder.md
#pragma once

#include "sensors.hpp"

namespace feltgate::test {

enum class Event {
  cable_cut,
  shorted_to_ground,
  magnet_lost,
  wrong_bit,
  held_in_motion,
  half_a_turn_off
};

/// Clocks from the event to the first fault, the longest of all moments, and its bits; -1: none in
/// 40 readings.
struct Named {
  std::int64_t clocks = -1;
  int faults = 0;
};

class Detection {
 public:
  Detection(int framing, std::int64_t every, bool moves) : every_(every), moves_(moves) {
    p_.framing = framing;
  }

  Named longest(Event event) const {
    Named found{0, 0};
    for (int reading = 40; reading < 40 + 2 * (1 << p_.diag_log2); ++reading) {
      const Named one = named(event, reading);
      if (one.clocks < 0) return one;
      if (one.clocks > found.clocks) found = one;
    }
    return found;
  }

 private:
  std::uint64_t word(int reading, int command, bool wrong, Event event) const {
    const int held = wrong && event == Event::held_in_motion ? wrong_from_ : reading;
    std::int64_t angle = moves_ ? 1000 + 40 * held : 1000;
    if (wrong && event == Event::half_a_turn_off) angle += 1 << (p_.bits - 1);
    const auto position = static_cast<std::uint64_t>(angle) & ((std::uint64_t{1} << p_.bits) - 1);
    const bool ill = wrong && event == Event::magnet_lost;
    std::uint64_t word = 0;
    if (p_.framing == AbsoluteEncoder::kSpi) {
      word = command == p_.diag_address ? (ill ? 0x900U : 0x180U) : position;
      if (odd(word)) word |= 0x8000;
    } else if (p_.framing == AbsoluteEncoder::kSsi) {
      word = (position << 4 | (ill ? 2U : 0U)) << 6;
      word |= crc6(word, p_.frame_bits());
    } else {
      word = (position << 2 | (ill ? 1U : 3U)) << 6;
      word |= crc6(word, p_.bits + 8) ^ 0x3f;
    }
    return wrong && event == Event::wrong_bit ? word ^ 0x10 : word;
  }

  Named named(Event event, int reading) const {
    AbsoluteEncoder twin(p_);
    AbsoluteEncoder::In in;
    const bool biss = p_.framing == AbsoluteEncoder::kBiss;
    bool was_high = biss;
    int edges = 0, command = 0, answers = -1;
    std::uint64_t sent = 0;
    wrong_from_ = reading;
    for (std::int64_t clock = 0; clock < (reading + 40) * every_; ++clock) {
      const auto now = static_cast<int>(clock / every_);
      const bool wrong = now > reading;
      in.sample = clock % every_ == 0;
      if (in.sample) {
        sent = word(now, answers, wrong, event);
        edges = command = 0;
      }
      const bool high = twin.out().serial_clock;
      if (high && !was_high) ++edges;
      if (!high && was_high) command = command << 1 | (twin.out().command ? 1 : 0);
      if (edges == 16 && !high) answers = command & 0x3fff;
      was_high = high;
      const int bit = biss ? edges - 4 : edges - 1;
      in.data = bit >= 0 && bit < p_.frame_bits() && (sent >> (p_.frame_bits() - 1 - bit) & 1) != 0;
      if (biss && bit < 0) in.data = edges != 2;
      if (!twin.out().busy) in.data = true;
      if (wrong && event == Event::cable_cut) in.data = true;
      if (wrong && event == Event::shorted_to_ground) in.data = false;
      twin.clock(in);
      const int faults = twin.out().faults;
      if (faults != 0 && now > 30) return {clock - reading * every_, faults};
    }
    return {};
  }

  AbsoluteEncoder::Parameters p_{};
  std::int64_t every_;
  bool moves_;
  mutable int wrong_from_ = 0;
};

}  // namespace feltgate::test
