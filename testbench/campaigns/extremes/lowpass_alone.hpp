// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The low-pass alone at its default widths, RTL and twin. Each rounding mode has its own RTL class.
// One sample takes six clocks. Documentation: docs/extremes.md
#pragma once

#include <Vlowpass.h>
#include <Vlowpass_convergent.h>
#include <Vlowpass_truncate.h>

#include <cstdint>

#include "feltgate/lowpass.hpp"
#include "sim/backends/rtl_model.hpp"

namespace feltgate::extremes {

constexpr Format lowpass_state{1, 31, 0}, lowpass_operand{1, 32, 0}, lowpass_a1{0, -10, 27};

/// The twin's law.
template <Round R>
class LowpassTwin {
 public:
  void start(std::int64_t y) { y_ = y; }
  std::int64_t sample(std::int64_t x, std::int64_t a1) {
    using Law = LowpassLaw<Fixed, lowpass_state.key(), lowpass_operand.key(), R>;
    using A1 = fixed_of<lowpass_a1.key()>;
    const auto word = [](std::int64_t raw) {
      return Law::State::from_raw(static_cast<typename Law::State::raw_type>(raw));
    };
    y_ = Law::template step<lowpass_a1.key()>(word(x), word(y_),
                                              A1::from_raw(static_cast<typename A1::raw_type>(a1)))
             .raw();
    return y_;
  }

 private:
  std::int64_t y_ = 0;
};

/// Rtl is Verilator's class of lowpass with one rounding mode.
template <class Rtl>
class LowpassAlone {
 public:
  LowpassAlone() { rtl_.reset(1); }

  /// Sets the state to `y`.
  void start(std::int64_t y) { sample(y, 0, true); }
  /// Runs one sample; returns the new state.
  std::int64_t sample(std::int64_t x, std::int64_t a1, bool follow = false) {
    rtl_->x_i = static_cast<std::uint32_t>(x);
    rtl_->follow_i = follow;
    rtl_->valid_i = 1;
    edge();
    rtl_->valid_i = 0;
    // 33 bits of difference times the coefficient, as the shared multiplier computes it.
    const std::int64_t operand = static_cast<std::int64_t>(rtl_->operand_o << 31) >> 31;
    for (int k = 0; k < 4; ++k) edge();
    rtl_->product_i = static_cast<std::uint64_t>(operand * a1) & ((std::uint64_t{1} << 53) - 1);
    rtl_->update_i = 1;
    edge();
    rtl_->update_i = 0;
    return static_cast<std::int32_t>(rtl_->y_o);
  }
  double seconds() const { return static_cast<double>(clocks_) * 20e-9; }

 private:
  void edge() {
    rtl_.clock();
    ++clocks_;
  }

  RtlModel<Rtl> rtl_{1};
  std::int64_t clocks_ = 0;
};

using LowpassRtl = LowpassAlone<Vlowpass>;  ///< half up, as in every shipped design

}  // namespace feltgate::extremes
