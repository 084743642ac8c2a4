// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/link/uart_rx.sv: receiver of a UART, 8N1. A level counts if two of three clocks have
// it; each bit is sampled in its middle. clock() advances one clock, skip() several quiet ones.
// Documentation: docs/link.md
#pragma once

#include <cstdint>
#include <limits>

namespace feltgate {

/// Step of the phase accumulator per clock, rounded to nearest; 2^16 is one bit time.
constexpr std::uint32_t uart_step(std::int64_t clock_hz, std::int64_t baud) {
  return static_cast<std::uint32_t>(((baud << 16) + clock_hz / 2) / clock_hz);
}

/// The receiver; `step` as from uart_step().
class UartRx {
 public:
  struct In {
    bool rx = true;
  };
  struct Out {
    std::uint8_t byte = 0;  ///< valid in the clock of `valid` or `error`
    bool valid = false;     ///< one clock: a byte has come
    bool error = false;     ///< one clock: a byte with a low stop bit has come
  };

  explicit UartRx(std::uint32_t step) : step_(step) {}
  void reset() { *this = UartRx(step_); }

  void clock(const In& in) {
    const bool level = line();
    seen_ = (seen_ << 1 | (in.rx ? 1U : 0U)) & 15U;
    const std::uint32_t next = phase_ + step_;
    const bool sample = busy_ && next >= kBit;
    phase_ = busy_ ? next & (kBit - 1) : (kBit / 2 + step_) & (kBit - 1);
    out_.valid = sample && bit_ == 9 && level;
    out_.error = sample && bit_ == 9 && !level;
    if (!busy_) {
      busy_ = ready_ && !level;
      ready_ = level;
      bit_ = 0;
    } else if (sample) {
      ready_ = level;
      if (bit_ != 0 && bit_ != 9) {
        out_.byte = static_cast<std::uint8_t>(out_.byte >> 1 | (level ? 0x80U : 0U));
      }
      if (bit_ == 9 || (bit_ == 0 && level)) busy_ = false;
      ++bit_;
    }
  }

  const Out& out() const { return out_; }

  /// Number of clocks, with the line held at `rx`, that skip() may pass.
  std::int64_t quiet(bool rx) const {
    if (out_.valid || out_.error || seen_ != (rx ? 15U : 0U)) return 0;
    if (busy_) return (kBit - 1 - phase_) / step_;
    return ready_ == rx && phase_ == ((kBit / 2 + step_) & (kBit - 1)) && bit_ == 0 ? kForever : 0;
  }
  /// Equals `clocks` calls of clock() with the line held; `clocks` must not exceed quiet().
  void skip(std::int64_t clocks) {
    if (busy_) phase_ += static_cast<std::uint32_t>(clocks) * step_;
  }
  /// At least so many clocks pass before a byte has come.
  std::int64_t clocks_to_byte() const {
    return out_.valid || out_.error ? 0 : (busy_ ? 9 - bit_ : 9) * std::int64_t{kBit} / step_;
  }
  /// More clocks than any run has.
  static constexpr std::int64_t kForever = std::numeric_limits<std::int64_t>::max() / 2;

 private:
  static constexpr std::uint32_t kBit = 1U << 16;
  /// Majority of the three oldest levels.
  bool line() const {
    const unsigned a = seen_ >> 1 & 1U, b = seen_ >> 2 & 1U, c = seen_ >> 3 & 1U;
    return a + b + c >= 2;
  }

  std::uint32_t step_;
  unsigned seen_ = 15;  ///< bit 0 is the newest level
  std::uint32_t phase_ = 0;
  bool busy_ = false, ready_ = false;
  int bit_ = 0;
  Out out_;
};

}  // namespace feltgate
