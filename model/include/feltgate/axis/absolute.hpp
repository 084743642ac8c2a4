// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/options/absolute.sv, an encoder socket: an absolute encoder, read once in
// ABSOLUTE_PERIOD ticks. AbsoluteEncoder is the twin of absolute_encoder.sv and serial_frame.sv.
// docs/blocks/absolute_encoder.md
#pragma once

#include "feltgate/absolute_encoder.hpp"
#include "feltgate/axis/signals.hpp"
#include "feltgate/axis/words.hpp"

namespace feltgate::axis {

class Absolute {
 public:
  static AbsoluteEncoder::Parameters parameters(const Design& d) {
    AbsoluteEncoder::Parameters p;
    p.framing = d["ABSOLUTE_FRAMING"];
    p.bits = d["ABSOLUTE_BITS"];
    p.half_clocks = d["ABSOLUTE_HALF_CLOCKS"];
    p.gap_clocks = d["ABSOLUTE_GAP_CLOCKS"];
    p.jump_step = d["ABSOLUTE_JUMP_STEP"];
    p.diag_address = d["ABSOLUTE_DIAGNOSIS"];
    return p;
  }
  explicit Absolute(const Design& d) : encoder_(parameters(d)), period_(d["ABSOLUTE_PERIOD"]) {}

  Position out() const {  // it has no edges and no index
    constexpr unsigned missing = AbsoluteEncoder::kMissing;
    const AbsoluteEncoder::Out& read = encoder_.out();
    const bool starts = !q_.known && read.starts;
    Position s;
    s.position = static_cast<std::int32_t>(q_.place);
    s.count = static_cast<std::int32_t>(q_.count);
    s.travel = q_.travel;
    s.moved = q_.moved;
    s.polarity_holds = q_.known;  // the count began with a polarity
    s.why = static_cast<unsigned>(read.faults) | q_.seen;
    if (!q_.known) s.why = starts ? (s.why & ~missing) | 1U << 5 : s.why | missing;
    return s;
  }
  Rotor rotor() const { return {static_cast<std::int32_t>(q_.count), 0}; }
  /// The sensor's pins: bit 0 select, low active; 1 clock; 2 command.
  unsigned lines() const {
    const AbsoluteEncoder::Out& o = encoder_.out();
    return unsigned{o.select_n} | unsigned{o.serial_clock} << 1 | unsigned{o.command} << 2;
  }
  void clock(const Pins& pins, const Encoder& e, const Words<std::int64_t>&) {
    const AbsoluteEncoder::Out& read = encoder_.out();
    const auto faults = static_cast<unsigned>(read.faults);
    const bool begins = e.sample && q_.wait == 0;
    q_.place = q_.count - q_.zero;
    if (e.set_zero) q_.zero = q_.count;
    if (e.sample) {
      q_.wait = begins ? period_ - 1 : q_.wait - 1;
      q_.moved = q_.changed;
      q_.changed = false;
    }
    if (read.valid) {
      const auto reading = static_cast<std::uint32_t>(read.position);
      const std::uint32_t change = e.polarity ? q_.last - reading : reading - q_.last;
      q_.known = true;
      q_.last = reading;
      q_.count += change;
      // An angle that was found again, after a fault, is no motion.
      if (q_.faults == 0) q_.travel = static_cast<std::uint16_t>(q_.travel + change);
      q_.changed = q_.changed || change != 0;
    }
    // What closed the gates; a jump also while they are closed, since the angle may be wrong for
    // ever after it.
    constexpr unsigned jump = AbsoluteEncoder::kJump;
    q_.seen = e.clear ? 0 : q_.seen | (e.gates_enable ? faults : faults & jump);
    q_.faults = faults;
    encoder_.clock({begins, pins.encoder_data});
  }
  void reset() {
    encoder_.reset();
    q_ = {};
  }

 private:
  struct Registers {
    int wait = 0;  ///< ticks to the next reading
    std::uint32_t last = 0, count = 0, zero = 0, place = 0;
    std::uint16_t travel = 0;
    bool known = false;  ///< there was a reading
    bool changed = false, moved = false;
    unsigned faults = AbsoluteEncoder::kMissing, seen = 0;
  };
  AbsoluteEncoder encoder_;
  int period_;
  Registers q_;
};

}  // namespace feltgate::axis
