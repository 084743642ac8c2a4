// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/actuation/limiter.sv, clock by clock, by the law of the chain. Documentation:
// docs/blocks/limiter.md
#pragma once

#include <cstdint>

#include "feltgate/limiter.hpp"
#include "feltgate/words.hpp"

namespace feltgate {

/// Clocked twin.
template <class D>
class Limiter {
 public:
  using Law = LimiterLaw<D, Fixed>;
  using X = fixed_of<D::f.limiter_input.key()>;
  using Limited = fixed_of<D::f.limiter.key()>;

  struct In {
    bool valid = false;           ///< x comes in the next clock
    std::int64_t early_term = 0;  ///< x, a clock ahead, or 0
    std::int64_t late_term = 0;   ///< x in its clock, or 0
    std::uint32_t param = 0;
    bool torque = false, voltage = false, duty = false;  ///< with valid: what x is
  };
  struct Out {
    std::int64_t limited = 0;
    bool over_limit = false;
  };

  /// The registers have no reset; this clears them.
  void reset() { *this = Limiter{}; }

  void clock(const In& in) {
    const auto x = X::from_raw(early_ | in.late_term);
    const auto limit = fixed_of<Law::template key<0>>::from_raw(
        static_cast<std::int32_t>(decode_word(D::f.limiter, in.param)));
    const auto limited = Law::template limited<Limited>(x, limit, &out_.over_limit);
    const bool misfit = limit.raw() >= (std::int64_t{1} << (width_ - 1));
    if (misfit) out_.over_limit = true;
    out_.limited = valid_ && !misfit ? limited.raw() : 0;
    early_ = in.early_term;
    valid_ = in.valid;
    width_ = D::f.limiter.width();
    if (in.torque) width_ = D::f.torque.width();
    if (in.voltage) width_ = D::f.voltage.width();
    if (in.duty) width_ = D::f.duty.width();
  }

  const Out& out() const { return out_; }

 private:
  std::int64_t early_ = 0;
  bool valid_ = false;
  int width_ = D::f.limiter.width();  ///< of the signal that is limited
  Out out_;
};

}  // namespace feltgate
