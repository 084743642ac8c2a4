// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core's shared limiter for a block under test. It gives the block's own result in the clock
// after the limit's word, and results of other blocks in all other clocks, so that a read one clock
// early or late is found. Documentation: docs/blocks/torque_control.md
#pragma once

#include "limiter_twin.hpp"
#include "random.hpp"

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
