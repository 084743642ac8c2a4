// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/options/hall_sensor.sv: three Hall lines to an electrical angle that the encoder's
// counts carry. Documentation: docs/blocks/three_phase.md
#pragma once

#include <cstdint>

namespace feltgate {

/// The code of the lines in a sector of 60 electrical degrees, 0 to 5; bit n: line n.
constexpr std::uint8_t hall_code(int sector) {
  const auto high = [sector](int line) { return (sector - 2 * line + 6) % 6 < 3 ? 1 << line : 0; };
  return static_cast<std::uint8_t>(high(0) | high(1) | high(2));
}

/// The sector of a code; -1 where all lines are alike.
constexpr int hall_sector(unsigned code) {
  for (int sector = 0; sector < 6; ++sector) {
    if (hall_code(sector) == code) return sector;
  }
  return -1;
}

/// Bit-exact and clock-exact with the RTL.
class HallSensor {
 public:
  static constexpr int kGlitch = 50;  ///< clocks for which the lines must stay
  static constexpr unsigned kAlike = 1, kApart = 2, kPassed = 4;  ///< bits of the faults
  struct In {
    std::uint8_t hall = 0;   ///< bit n: line n
    std::uint8_t count = 0;  ///< of the encoder, modulo 4
    std::uint32_t gain = 0;  ///< 2^-32 electrical turn per count; 0: the angle is 0
    bool gates_enable = false;
    bool clear = false;  ///< of the faults
  };
  struct Out {
    std::uint32_t angle = 0;  ///< 2^-32 electrical turn, 0 where line 0 rises
    bool exact = false;       ///< an edge gave it
    std::uint8_t faults = 0;
    bool waits = true;  ///< no sector yet
  };

  explicit HallSensor(int glitch = kGlitch) : glitch_(glitch) { reset(); }
  void reset() { *this = HallSensor(glitch_, 0); }

  void clock(const In& in) {
    const bool alike = !out_.waits && hall_sector(code_) < 0;
    const bool runs = !out_.waits && !alike && in.gain != 0;
    const bool restarts = in.clear && seen_ != 0;
    unsigned seen = 0;
    if (alike && in.gates_enable) seen |= kAlike;
    if (known() && off() > (out_.exact ? kSixth : kQuarter)) seen |= kApart;

    std::uint32_t angle = out_.angle;
    bool exact = false;
    if (runs) {
      const int sector = hall_sector(code_);
      if (!known()) {
        angle = middle_of(sector) << 16;
      } else {
        const int change = (sector - sector_ + 6) % 6;
        if (change != 0 && change != 1 && change != 5) seen |= kPassed;
        const bool edge = change == 1 || change == 5;
        if (edge && !out_.exact) angle = begin_of(change == 1 ? sector : sector_) << 16;
        exact = out_.exact || edge;
      }
      sector_ = sector;
    }
    const int moved = (in.count - count_) & 3;
    angle += moved == 1 ? in.gain : moved == 3 ? 0 - in.gain : 0;
    count_ = in.count & 3;
    out_.angle = in.gain == 0 ? 0 : angle;
    out_.exact = exact && !restarts;
    if (!runs || restarts) sector_ = -1;
    seen_ = (in.clear ? 0 : seen_) | (restarts ? 0 : seen);
    accept(in.hall);
    const bool now = !out_.waits && hall_sector(code_) < 0;
    out_.faults = static_cast<std::uint8_t>(seen_ | (now ? kAlike : 0));
  }

  const Out& out() const { return out_; }

 private:
  static constexpr int kSixth = 10923, kQuarter = 16384;  // 2^-16 turn

  HallSensor(int glitch, int) : glitch_(glitch), wait_(glitch) {}

  bool known() const { return sector_ >= 0; }
  /// 2^-16 turn.
  static std::uint32_t begin_of(int sector) {
    return static_cast<std::uint32_t>((sector * 65536 + 3) / 6);
  }
  static std::uint32_t middle_of(int sector) { return begin_of(sector) + kSixth / 2; }
  /// How far the angle is from the middle of its sector, 2^-16 turn.
  int off() const {
    const auto apart = static_cast<int>(((out_.angle >> 16) - middle_of(sector_)) & 0xffff);
    return apart < 0x8000 ? apart : 0x10000 - apart;
  }
  void accept(std::uint8_t hall) {
    if (sync_ != last_) {
      wait_ = glitch_;
    } else if (wait_ != 0) {
      --wait_;
    } else {
      code_ = last_;
      out_.waits = false;
    }
    last_ = sync_;
    sync_ = meta_;
    meta_ = hall & 7;
  }

  Out out_;
  int glitch_, wait_ = 0, sector_ = -1, count_ = 0;  // sector_: of the angle; -1: there is none
  unsigned meta_ = 0, sync_ = 0, last_ = 0, code_ = 0, seen_ = 0;
};

}  // namespace feltgate
