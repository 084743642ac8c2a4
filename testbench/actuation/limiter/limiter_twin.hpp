// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/actuation/limiter.sv, clock by clock, by the law of the chain. Documentation:
// docs/blocks/torque_control.md
#pragma once

#include <cstdint>

#include "feltgate/limiter.hpp"
#include "feltgate/words.hpp"
#include "random.hpp"

namespace feltgate {

/// Clocked twin.
template <class D>
class Limiter {
 public:
  using Law = LimiterLaw<D, Fixed>;
  using X = fixed_of<D::f.limiter_input.key()>;
  using Whole = decltype(X{} + X{});  ///< x rounded up
  using Limited = fixed_of<D::f.limiter.key()>;

  struct In {
    bool valid = false;           ///< x comes in the next clock
    std::int64_t early_term = 0;  ///< x, a clock ahead, or 0
    std::int64_t late_term = 0;   ///< x in its clock, or 0
    std::uint32_t param = 0;
    bool torque = false, voltage = false, duty = false;  ///< with valid: what x is
    bool early_up = false, late_up = false;              ///< with its term: x is rounded up
    std::int64_t addend = 0;                             ///< with the result
    bool late_not = false;                               ///< with late_term: its complement is x
  };
  struct Out {
    std::int64_t limited = 0;  ///< the limited value + the addend
    bool over_limit = false;
  };

  /// The registers have no reset; this clears them.
  void reset() { *this = Limiter{}; }

  void clock(const In& in) {
    const std::int64_t late = in.late_not ? ~in.late_term : in.late_term;
    const auto x = Whole::from_raw((early_ | late) + (early_up_ || in.late_up));
    const auto limit = fixed_of<Law::template key<0>>::from_raw(
        static_cast<std::int32_t>(decode_word(D::f.limiter, in.param)));
    const auto limited = Law::template limited<Limited>(x, limit, &out_.over_limit);
    const bool misfit = limit.raw() >= (std::int64_t{1} << (width_ - 1));
    if (misfit) out_.over_limit = true;
    out_.limited = (valid_ && !misfit ? limited.raw() : 0) + in.addend;
    early_ = in.early_term;
    early_up_ = in.early_up;
    valid_ = in.valid;
    width_ = D::f.limiter.width();
    if (in.torque) width_ = D::f.torque.width();
    if (in.voltage) width_ = D::f.voltage.width();
    if (in.duty) width_ = D::f.duty.width();
  }

  const Out& out() const { return out_; }

 private:
  std::int64_t early_ = 0;
  bool valid_ = false, early_up_ = false;
  int width_ = D::f.limiter.width();  ///< of the signal that is limited
  Out out_;
};

}  // namespace feltgate

// The core's shared limiter for a block under test. It gives the block's own result in the clock
// after the limit's word, and results of other blocks in all other clocks, so that a read one clock
// early or late is found.

namespace feltgate::test {

template <class D>
class SharedLimiter {
 public:
  explicit SharedLimiter(std::uint64_t seed) : random_(seed) {}

  /// The result in this clock. Call clock() once after it.
  std::int64_t limited() const { return out_.limited; }
  bool beyond() const { return out_.over_limit; }

  /// `own`: the limit's word of the block under test is on the bus.
  void clock(bool own, const typename Limiter<D>::In& in) {
    limiter_.clock(in);
    out_ = limiter_.out();
    if (!own) {
      constexpr int unused = 64 - D::f.limiter.width();
      out_.limited = static_cast<std::int64_t>(random_.bits()) >> unused;
      out_.over_limit = random_.coin();
    }
  }

 private:
  Random random_;
  Limiter<D> limiter_;
  typename Limiter<D>::Out out_;
};

}  // namespace feltgate::test
