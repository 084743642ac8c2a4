// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/link/uart_tx.sv: transmitter of a UART, 8N1. The start bit is at tx in the clock
// after a byte is taken. clock() advances one clock, skip() several quiet ones. Documentation:
// docs/link.md
#pragma once

#include <cstdint>

#include "feltgate/uart_rx.hpp"

namespace feltgate {

/// The transmitter; `step` as from uart_step().
class UartTx {
 public:
  struct In {
    std::uint8_t byte = 0;
    bool valid = false;  ///< must be held until ready
  };
  struct Out {
    bool ready = true;  ///< the next clock takes a byte if it is valid
    bool tx = true;
  };

  explicit UartTx(std::uint32_t step) : step_(step) {}
  void reset() { *this = UartTx(step_); }

  void clock(const In& in) {
    const std::uint32_t next = phase_ + step_;
    phase_ = busy_ ? next & (kBit - 1) : 0;
    if (out_.ready) {
      busy_ = in.valid;
      left_ = 9;
      bits_ = in.valid ? static_cast<unsigned>(in.byte) << 1 : 0x1ffU;
    } else if (next >= kBit) {
      --left_;
      bits_ = bits_ >> 1 | 0x100U;
    }
    out_.ready = !busy_ || (left_ == 0 && phase_ + step_ >= kBit);
    out_.tx = (bits_ & 1U) != 0;
  }

  const Out& out() const { return out_; }
  /// Whether a byte is being sent.
  bool busy() const { return busy_; }

  /// Number of clocks, without a byte to take, that skip() may pass.
  std::int64_t quiet() const {
    if (!busy_) return phase_ == 0 ? UartRx::kForever : 0;
    return (kBit - 1 - phase_) / step_;  // then a bit ends; ready may rise first
  }
  /// Equals `clocks` calls of clock() without a byte; `clocks` must not exceed quiet().
  void skip(std::int64_t clocks) {
    if (!busy_) return;
    phase_ += static_cast<std::uint32_t>(clocks) * step_;
    out_.ready = left_ == 0 && phase_ + step_ >= kBit;
  }

 private:
  static constexpr std::uint32_t kBit = 1U << 16;

  std::uint32_t step_;
  std::uint32_t phase_ = 0;
  unsigned bits_ = 0x1ff, left_ = 0;
  bool busy_ = false;
  Out out_;
};

}  // namespace feltgate
