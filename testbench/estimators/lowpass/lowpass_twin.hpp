// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/estimators/lowpass.sv, clock by clock, by the law of the chain. Documentation:
// docs/blocks/dob.md
#pragma once

#include <cstdint>

#include "feltgate/lowpass.hpp"

namespace feltgate {

/// Clocked twin. CoefficientKey is the format of a1.
template <int StateKey, int OperandKey, int CoefficientKey, Round R = Round::half_up>
class Lowpass {
 public:
  using Law = LowpassLaw<Fixed, StateKey, OperandKey, R>;
  using State = typename Law::State;
  using Product = decltype(typename Law::Operand{} * fixed_of<CoefficientKey>{});

  struct In {
    bool valid = false;   ///< x is new
    bool update = false;  ///< product is a1 * operand
    bool follow = false;  ///< y := x instead of filtering
    std::int64_t x = 0;   ///< held until the new y
    std::int64_t product = 0;
  };
  struct Out {
    std::int64_t operand = 0;
    std::int64_t y = 0;
  };

  void reset() {
    y_ = State{};
    out_ = {};
  }

  void clock(const In& in) {
    const State x = State::from_raw(static_cast<typename State::raw_type>(in.x));
    out_.operand = in.valid ? static_cast<std::int64_t>(Law::operand(x, y_).raw()) : 0;
    if (in.update) y_ = in.follow ? x : Law::next(y_, Product::from_raw(in.product));
    out_.y = static_cast<std::int64_t>(y_.raw());
  }

  const Out& out() const { return out_; }
  State state() const { return y_; }

 private:
  State y_{};
  Out out_;
};

}  // namespace feltgate
