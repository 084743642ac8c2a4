// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A sensor at the pins of a core with an absolute encoder: it sees select, clock and command, and
// sends frames of the angle that the shaft has when a reading begins. It can be broken.
// Documentation: docs/blocks/absolute_encoder.md
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "feltgate/absolute_encoder.hpp"
#include "feltgate/encoder_source.hpp"

namespace feltgate {

/// The CRC of the bits above the lowest six: x^k modulo x^6 + x + 1 for each bit that is 1.
inline std::uint64_t crc6(std::uint64_t word, int length) {
  std::uint64_t crc = 0, power = 3;  // x^6
  for (int k = 6; k < length; ++k) {
    if ((word >> k & 1) != 0) crc ^= power;
    power = (power & 0x20) != 0 ? (power << 1 ^ 0x43) & 0x3f : power << 1;
  }
  return crc;
}

inline bool odd(std::uint64_t word) {
  bool result = false;
  for (; word != 0; word >>= 1) result ^= (word & 1) != 0;
  return result;
}

/// A frame: what a sensor says, closed by its parity or CRC.
inline std::uint64_t closed(const AbsoluteEncoder::Parameters& p, std::uint64_t said) {
  if (p.framing == AbsoluteEncoder::kSpi) return odd(said) ? said | 0x8000 : said;
  return said << 6 | crc6(said << 6, p.bits + 10);
}

/// What a sensor shows at an angle, before rounding. Its error is a sum of terms_rad, cosine 1,
/// sine 1, cosine 2, ... of what it shows.
inline double shown_angle(double rad, const std::vector<double>& terms_rad) {
  double shown = rad;
  for (int round = 0; round < 8 && !terms_rad.empty(); ++round) {
    double sum = 0;
    for (std::size_t k = 0; k < terms_rad.size(); ++k) {
      const double x = static_cast<double>(k / 2 + 1) * shown;
      sum += terms_rad[k] * (k % 2 == 0 ? std::cos(x) : std::sin(x));
    }
    shown = rad + sum;
  }
  return shown;
}

/// One sensor, clock by clock of the core.
class AbsoluteSensor {
 public:
  enum class Defect { none, cut, grounded, magnet_lost, wrong_bit, held, half_a_turn_off };
  static constexpr std::array<std::string_view, 7> defects{
      "none", "cut", "grounded", "magnet_lost", "wrong_bit", "held", "half_a_turn_off"};

  explicit AbsoluteSensor(const AbsoluteEncoder::Parameters& parameters) : p_(parameters) {}

  void set(Defect defect) { defect_ = defect; }
  /// From now on a bit of its angle is 0 or 1 in frames that are valid.
  void stick(int bit, bool high) {
    stuck_ = std::int64_t{1} << bit;
    stuck_high_ = high;
  }
  /// See shown_angle().
  void set_error(std::vector<double> terms_rad) { error_rad_ = std::move(terms_rad); }
  /// What it shows at an angle, before rounding.
  double shown_rad(double rad) const { return shown_angle(rad, error_rad_); }
  /// The shaft turns from one angle to another in the `clocks` from `begin` on.
  void turn(double from_rad, double to_rad, Clock begin, Clock clocks) {
    from_rad_ = from_rad;
    begin_ = begin;
    slope_ = (to_rad - from_rad) / static_cast<double>(clocks);
  }
  /// The data pin in clock `now`; `lines`: CoreOut::serial after the clock before.
  bool pin(Clock now, unsigned lines) {
    const bool selected = (lines & 1u) == 0, high = (lines & 2u) != 0;
    if (selected && !reads_) begin(now);
    if (high != high_) edge(high, (lines & 4u) != 0);
    high_ = high;
    if (!selected) reads_ = false;
    if (defect_ == Defect::cut) return true;  // pulled up
    if (defect_ == Defect::grounded) return false;
    if (!reads_) return true;
    const int bit = edges_ - 1;
    if (bit < 0) return true;
    return bit < p_.frame_bits() && (word_ >> (p_.frame_bits() - 1 - bit) & 1) != 0;
  }

  /// The count at an angle, of a sensor with 2^bits in a turn.
  static std::int64_t count_of(double rad, int bits) {
    constexpr double turn_rad = 6.283185307179586;
    return static_cast<std::int64_t>(std::floor(std::ldexp(rad / turn_rad, bits)));
  }

 private:
  void begin(Clock now) {
    reads_ = true;
    edges_ = command_ = 0;
    if (defect_ != Defect::held) {
      count_ = count_of(shown_rad(from_rad_ + slope_ * static_cast<double>(now - begin_)), p_.bits);
    }
    word_ = word();
  }
  void edge(bool high, bool command) {
    if (high) ++edges_;
    if (high) return;
    command_ = command_ << 1 | (command ? 1 : 0);
    if (edges_ == 16) answers_ = command_ & 0x3fff;
  }
  std::uint64_t word() const {
    const std::int64_t turn = std::int64_t{1} << p_.bits;
    const std::int64_t off = defect_ == Defect::half_a_turn_off ? turn / 2 : 0;
    const std::int64_t count = stuck_high_ ? (count_ + off) | stuck_ : (count_ + off) & ~stuck_;
    const auto position = static_cast<std::uint64_t>(count & (turn - 1));
    const bool ill = defect_ == Defect::magnet_lost;
    std::uint64_t said = position << 4 | (ill ? 2U : 0U);
    if (p_.framing == AbsoluteEncoder::kSpi) {
      said = answers_ == p_.diag_address ? (ill ? 0x900U : 0x180U)
             : answers_ == 0x3fff        ? position
                                         : 0U;
    }
    return closed(p_, said) ^ (defect_ == Defect::wrong_bit ? 0x10U : 0U);
  }

  AbsoluteEncoder::Parameters p_;
  Defect defect_ = Defect::none;
  std::vector<double> error_rad_;
  double from_rad_ = 0, slope_ = 0;  // per clock
  Clock begin_ = 0;
  bool reads_ = false, high_ = false;
  int edges_ = 0, command_ = 0, answers_ = -1;
  std::int64_t count_ = 0, stuck_ = 0;
  bool stuck_high_ = false;
  std::uint64_t word_ = 0;
};

}  // namespace feltgate
