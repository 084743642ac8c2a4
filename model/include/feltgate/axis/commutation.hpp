// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/options/commutation.sv with electrical_angle.sv and space_vector.sv: three on-times
// from a position and an amplitude. A result is computed as its sample is taken, and shown 42
// clocks after it. docs/blocks/three_phase.md
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace feltgate::axis {

/// Bit-exact and clock-exact with the RTL.
class Commutation {
 public:
  static constexpr int latency = 42;  ///< clocks from sample to valid
  struct In {
    bool sample = false;         ///< one clock: takes all; ignored while a result is computed
    std::int32_t position = 0;   ///< counts; wraps
    std::uint32_t gain = 0;      ///< 2^-32 electrical turn per count
    std::uint32_t offset = 0;    ///< 2^-32 electrical turn
    std::int16_t amplitude = 0;  ///< clocks, -4096..4095; saturates at +-period
    bool polarity = false;       ///< true: legs B and C change places
  };
  struct Out {
    std::int16_t on_a = 0;  ///< clocks of the high switch in a period, 0 to period
    std::int16_t on_b = 0;
    std::int16_t on_c = 0;
    bool valid = false;  ///< one clock: the on-times are new
  };

  /// `period` in clocks: even, 4 to 4094.
  explicit Commutation(int period = 1000) : half_(period / 2) { reset(); }

  void reset() {
    left_ = 0;
    out_.on_a = out_.on_b = out_.on_c = static_cast<std::int16_t>(half_);
    out_.valid = false;
  }

  void clock(const In& in) {
    out_.valid = left_ == 1;
    if (out_.valid) {
      out_.on_a = next_[0];
      out_.on_b = next_[1];
      out_.on_c = next_[2];
    }
    if (left_ > 0) {
      --left_;
    } else if (in.sample) {
      left_ = latency - 1;
      next_ = on_times(in);
    }
  }

  const Out& out() const { return out_; }

  /// What the inputs give, legs A, B and C.
  std::array<std::int16_t, 3> on_times(const In& in) const {
    const std::uint32_t angle = in.gain * static_cast<std::uint32_t>(in.position) + in.offset;
    const std::uint32_t sixth = (angle >> 14) * 3 >> 4;  // 2^-13 of a sixth of a turn
    const std::uint32_t sector = sixth >> 13;
    const bool below = (sixth & 0x1000) == 0;  // the sector's middle
    const auto size = static_cast<int>(below ? ~sixth & 0xfff : sixth & 0xfff);
    const int amplitude = std::clamp<int>(in.amplitude, -2 * half_, 2 * half_);

    const int outer = scaled(cosine(), size, amplitude, kHalf / 2) >> 16;
    const bool odd = (outer & 1) != 0;
    const bool falls = (sector & 1) != (below ? 1U : 0U);
    const int sign = falls ? -1 : 1;
    const int middle = sign * (scaled(sine(), size, amplitude, odd ? 0 : kHalf) >> 17);
    const int lower = (outer - (odd ? 1 : 0)) / 2;
    const int highest = half_ + lower + (odd && falls ? 1 : 0);
    const int lowest = half_ - lower - (odd && !falls ? 1 : 0);

    std::array<std::int16_t, 3> legs{};
    for (std::uint32_t leg = 0; leg < 3; ++leg) {
      const std::uint32_t own = (sector + (in.polarity ? 2 : 4) * leg) % 6;
      const int on = own == 1 || own == 4   ? half_ + middle
                     : own == 0 || own == 5 ? highest
                                            : lowest;
      legs[leg] = static_cast<std::int16_t>(on);
    }
    return legs;
  }

 private:
  using Table = std::array<std::int32_t, 17>;
  static constexpr int kHalf = 1 << 16;  // of a clock, in 2^-17
  /// `curve` at nodes 30/16 degrees apart, in 2^-17; docs/blocks/three_phase.md has the factors.
  template <class Curve>
  static Table nodes(const Curve& curve) {
    const double step_rad = std::acos(-1.0) / 6 / 16;
    Table table{};
    for (std::size_t n = 0; n < table.size(); ++n) {
      const double value = curve(static_cast<double>(n) * step_rad);
      const double raised = (1 + step_rad * step_rad / 16) * 256 / 255;
      table[n] = static_cast<std::int32_t>(std::lround(std::ldexp(value, 17) * raised + 0.5));
    }
    return table;
  }

  static const Table& cosine() {
    static const Table table = nodes([](double x) { return std::cos(x) / 2; });
    return table;
  }
  static const Table& sine() {
    static const Table table = nodes([](double x) { return std::sin(x) * std::sqrt(3) / 2; });
    return table;
  }
  /// Amplitude times the table at `size`, 2^-12 of 30 degrees; in 2^-17 clocks.
  static int scaled(const Table& table, int size, int amplitude, int rounding) {
    const auto node = static_cast<std::size_t>(size >> 8);
    const int part = size & 0xff;
    const int word = (table[node] * (255 - part) + table[node + 1] * part) >> 8;
    return amplitude * word + rounding;
  }

  int half_;      // a period, clocks
  int left_ = 0;  // clocks to the result
  std::array<std::int16_t, 3> next_{};
  Out out_;
};

}  // namespace feltgate::axis
