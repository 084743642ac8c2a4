// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/options/current_sense.sv: a current from a sigma-delta bit stream by a sinc3
// filter in step with the PWM, over-current by a fast one, offset and faults. The sums have 64 bits
// here and wrap like the shorter ones of the RTL. Documentation: docs/blocks/current.md
#pragma once

#include <algorithm>
#include <cstdint>

namespace feltgate {

/// Bit-exact and clock-exact with the RTL.
class CurrentSense {
 public:
  /// Those of the RTL, with its defaults.
  struct Parameters {
    int divider = 4;          ///< clocks of a modulator clock, 3 to 16
    int decimation_log2 = 6;  ///< of the sinc3 for the current, 5 to 7
    int fast_log2 = 3;        ///< of the sinc3 for over-current, 3 or 4
    int hits = 3;             ///< fast results in a row at the threshold or above
    int stuck_clocks = 256;   ///< modulator clocks without a transition
    int offset_log2 = 8;      ///< results in an average, 1 to 12
    int offset_limit = 4096;  ///< LSB of the current
    /// Current of full scale, the modulator's clipping input.
    constexpr std::int64_t full_scale() const {
      return std::int64_t{1} << (3 * decimation_log2 - 1);
    }
    constexpr std::int64_t fast_full_scale() const {
      return std::int64_t{1} << (3 * fast_log2 - 1);
    }
    /// Clocks from a strobe to the centre of its window, and from there to the result, both for a
    /// modulator that shows a current two of its clocks later. The first is that of a strobe in the
    /// clock before one that takes a bit; it is up to divider - 1 clocks more.
    constexpr int centre_clocks() const { return divider * (3 * (1 << decimation_log2) - 3) / 2; }
    constexpr int delay_clocks() const {
      return divider * (3 * (1 << decimation_log2) + 3) / 2 + 7;
    }
  };
  struct In {
    bool data = false;           ///< of the modulator
    bool strobe = false;         ///< a window begins
    bool armed = false;          ///< the offset is kept
    bool clear = false;          ///< of the over-current
    std::int32_t threshold = 0;  ///< LSB of the fast filter, below its full scale
  };
  struct Out {
    bool modulator_clock = false;
    std::int64_t current = 0;  ///< LSB: clipping input / full_scale()
    bool aligned = false;
    bool overcurrent = false;
    bool calibrated = false;
    bool offset_fault = false;
    bool stuck = false;
    bool saturated = false;
  };

  CurrentSense() : CurrentSense(Parameters{}) {}
  explicit CurrentSense(const Parameters& parameters) : p_(parameters) {}

  void reset() { *this = CurrentSense(p_); }

  void clock(const In& in) {
    current(main_.arrives(), in.armed);
    overcurrent(fast_.arrives(), in);
    const bool take = divider_ == 1;
    if (take) bit();
    pending_ = in.strobe || (pending_ && !take);
    out_.modulator_clock = divider_ < p_.divider / 2;
    divider_ = divider_ == p_.divider - 1 ? 0 : divider_ + 1;
    taken_ = captured_;
    captured_ = in.data;
  }

  const Out& out() const { return out_; }

 private:
  /// The combs of a sinc3, and its result on the way to the outputs.
  struct Combs {
    std::uint64_t delays[3] = {};
    std::int64_t value = 0;
    int wait = 0;

    void sample(std::uint64_t sum, bool whole) {
      for (std::uint64_t& delay : delays) {
        const std::uint64_t last = delay;
        delay = sum;
        sum -= last;
      }
      if (!whole) return;
      value = static_cast<std::int64_t>(sum);
      wait = 6;
    }
    bool arrives() { return wait > 0 && --wait == 0; }
  };

  void bit() {
    first_ += taken_ ? 1 : 0;
    second_ += first_;
    third_ += second_;
    const bool due = phase_ == (1 << p_.decimation_log2) - 1;
    const bool restart = pending_ && !due && samples_ == 3;
    if (due || restart) {
      main_.sample(third_, due && samples_ >= 2);
      if (due) aligned_ = strobed_[2];
      strobed_[2] = strobed_[1];
      strobed_[1] = strobed_[0];
      strobed_[0] = pending_;
      samples_ = restart ? 0 : std::min(samples_ + 1, 3);
    }
    phase_ = due || restart ? 0 : phase_ + 1;
    if (++fast_phase_ == 1 << p_.fast_log2) {
      fast_phase_ = 0;
      fast_samples_ = std::min(fast_samples_ + 1, 3);
      fast_.sample(third_, fast_samples_ == 3);
    }
    quiet_ = taken_ != last_bit_ ? 0 : std::min(quiet_ + 1, p_.stuck_clocks);
    last_bit_ = taken_;
    out_.stuck = quiet_ == p_.stuck_clocks;
  }

  void current(bool arrives, bool armed) {
    out_.aligned = arrives && aligned_;
    const std::int64_t value = main_.value - p_.full_scale();
    if (arrives) {
      const std::int64_t end = p_.full_scale() - (std::int64_t{1} << (2 * p_.decimation_log2));
      out_.current = value - offset_;
      out_.saturated = value >= end || value <= -end;
    }
    if (armed) {
      settled_ = false;
      count_ = 0;
      sum_ = 0;
    } else if (arrives) {
      sum_ += value;
      if (++count_ == 1 << p_.offset_log2) average();
    }
  }

  void average() {
    if (settled_) {
      const std::int64_t rounded =
          (sum_ + (std::int64_t{1} << (p_.offset_log2 - 1))) >> p_.offset_log2;
      out_.offset_fault = rounded > p_.offset_limit || rounded < -p_.offset_limit;
      if (!out_.offset_fault) {
        offset_ = rounded;
        out_.calibrated = true;
      }
    }
    settled_ = true;
    count_ = 0;
    sum_ = 0;
  }

  void overcurrent(bool arrives, const In& in) {
    const std::int64_t value = fast_.value - p_.fast_full_scale();
    const bool hit = arrives && (value < 0 ? -value : value) >= in.threshold;
    if (hit && hits_ >= p_.hits - 1) {
      out_.overcurrent = true;
    } else if (in.clear && !hit && !last_hit_) {
      out_.overcurrent = false;
    }
    if (!arrives) return;
    last_hit_ = hit;
    hits_ = hit ? std::min(hits_ + 1, p_.hits) : 0;
  }

  Parameters p_;
  Out out_;
  int divider_ = 0;
  bool captured_ = false, taken_ = false;
  std::uint64_t first_ = 0, second_ = 0, third_ = 0;  // integrators
  Combs main_, fast_;
  bool pending_ = false;  // a strobe since the last bit
  int phase_ = 0, samples_ = 0;
  bool strobed_[3] = {};  // the last samples were at a strobe
  bool aligned_ = false;
  int fast_phase_ = 0, fast_samples_ = 0;
  std::int64_t offset_ = 0, sum_ = 0;
  int count_ = 0;
  bool settled_ = false;  // a whole average since the disarming
  bool last_hit_ = false;
  int hits_ = 0;
  bool last_bit_ = false;
  int quiet_ = 0;
};

}  // namespace feltgate
