// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The position of the core's twin with an absolute encoder: what rtl/core/encoder/encoder.sv has
// with the option ABSOLUTE_ENCODER, clock by clock. It takes the place of QuadDecoder.
// Documentation: docs/blocks/absolute_encoder.md
#pragma once

#include <cstdint>

#include "feltgate/absolute_encoder.hpp"
#include "feltgate/encoder_monitor.hpp"
#include "feltgate/generated/map.hpp"
#include "feltgate/quad_decoder.hpp"

namespace feltgate {

/// Parameters of the block in design D.
template <class D>
constexpr AbsoluteEncoder::Parameters absolute_parameters() {
  AbsoluteEncoder::Parameters p;
  p.framing = D::absolute_framing;
  p.bits = D::absolute_bits;
  p.half_clocks = D::absolute_half_clocks;
  p.gap_clocks = D::absolute_gap_clocks;
  p.jump_step = D::absolute_jump_step;
  p.diag_address = D::absolute_diagnosis;
  return p;
}

template <class D>
class AbsolutePosition {
 public:
  struct In {
    bool data = false;      ///< of the sensor
    bool sample = false;    ///< EVENT_AT_SAMPLE: a reading may begin
    bool levels = false;    ///< EVENT_AT_LEVELS
    bool polarity = false;  ///< true: counts the other way
    bool set_zero = false;
    bool gates_enable = false;
    bool clear = false;  ///< of the faults
  };
  using Out = QuadDecoder::Out;  ///< edges, errors and index stay 0

  explicit AbsolutePosition(std::int32_t = 0, std::uint32_t = 0) {}
  void reset() { *this = AbsolutePosition(); }

  void clock(const In& in) {
    const AbsoluteEncoder::Out read = encoder_.out();
    const bool begins = in.sample && wait_ == 0;
    if (in.sample) wait_ = begins ? D::absolute_period - 1 : wait_ - 1;
    out_.position = static_cast<std::int32_t>(count_ - zero_);
    if (in.set_zero) zero_ = count_;
    if (in.levels) {
      moved_ = changed_;
      changed_ = false;
    }
    if (reads(read)) {
      const std::uint32_t change = in.polarity ? last_ - reading_ : reading_ - last_;
      last_ = reading_;
      count_ += change;
      if (!found_) out_.travel = static_cast<std::uint16_t>(out_.travel + change);
      changed_ |= change != 0;
      waits_ = false;
    }
    // After a jump the angle may be wrong for ever, so it is kept with the gates closed as well.
    seen_ |= in.gates_enable ? read.faults : read.faults & AbsoluteEncoder::kJump;
    if (in.clear) seen_ = 0;
    faults_ = read.faults;
    encoder_.clock({begins, in.data});
  }

  const Out& out() const { return out_; }
  /// The count, whatever its zero: modulo a turn the angle.
  std::int32_t count() const { return static_cast<std::int32_t>(count_); }
  /// CoreOut::serial.
  std::uint8_t serial() const {
    const AbsoluteEncoder::Out& o = encoder_.out();
    return static_cast<std::uint8_t>(o.select_n | o.serial_clock << 1 | o.command << 2);
  }
  /// faults.absolute: why the position is not to be relied on; the core arms only with 0.
  std::uint32_t state() const {
    constexpr std::uint32_t starts = 1u << (Map::C::faults_absolute_width - 1);
    const auto faults = static_cast<std::uint32_t>(encoder_.out().faults | seen_);
    constexpr std::uint32_t missing = AbsoluteEncoder::kMissing;
    if (!waits_) return faults;
    return encoder_.out().starts ? (faults & ~missing) | starts : faults | missing;
  }
  /// The first reading was made: the polarity holds from then on.
  bool has_read() const { return !waits_; }
  /// A reading since the tick before differs from the one before it.
  bool moved() const { return moved_; }

  /// It reads at all times: no clock may be skipped.
  static bool settled(const In&) { return false; }
  static bool index_rests(const In&) { return true; }

 private:
  /// In the clock in which a reading is in reading_. With a table this is correction_clocks()
  /// later.
  bool reads(const AbsoluteEncoder::Out& read) {
    if constexpr (D::absolute_table != 0) {
      const bool ends = left_ != 0 && --left_ == 0;
      if (read.valid) {
        left_ = correction_clocks(D::absolute_bits);
        found_ = faults_ != 0;
        reading_ = static_cast<std::uint32_t>(
            corrected(read.position, D::absolute_corrections, D::absolute_bits));
      }
      return ends;
    } else {
      found_ = faults_ != 0;
      reading_ = static_cast<std::uint32_t>(read.position);
      return read.valid;
    }
  }

  AbsoluteEncoder encoder_{absolute_parameters<D>()};
  Out out_;
  int wait_ = 0;  // ticks to the next reading
  int faults_ = AbsoluteEncoder::kMissing, seen_ = 0;
  std::uint32_t last_ = 0, count_ = 0, zero_ = 0;
  std::uint32_t reading_ = 0;
  int left_ = 0;        // clocks until it is taken
  bool found_ = false;  // it ends a fault
  bool changed_ = false, moved_ = false;
  bool waits_ = true;  // no reading yet
};

}  // namespace feltgate
