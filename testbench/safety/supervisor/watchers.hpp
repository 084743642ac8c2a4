// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Three copies of the check for a wrong polarity, each with another limit, beside a core in closed
// loop: they record where each would trip. Documentation: docs/blocks/supervisor.md
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "catch.hpp"
#include "rig.hpp"
#include "sim/loop/loop.hpp"

namespace feltgate::test {

inline constexpr std::array<double, 3> kGrowth = {4.0, 6.0, 8.0};  // rad/s in a window
inline constexpr std::size_t kShipped = 1;

inline const ParameterInfo& word_of(const DesignInfo& d, const char* name) { return *d.find(name); }

/// Runs the check with each limit, beside a core whose own check is disabled.
template <class D>
class Watchers {
 public:
  Watchers() {
    const DesignInfo d = design_info<D>();
    current_ = static_cast<std::uint32_t>(word_of(d, "polarity_current").raw);
    ticks_ = static_cast<std::uint32_t>(word_of(d, "polarity_ticks").raw);
    REQUIRE(std::ldexp(kGrowth[kShipped], D::f.velocity.fraction) ==
            static_cast<double>(word_of(d, "polarity_speed").raw));
  }
  void tick(std::int64_t velocity, std::int64_t current_ref, bool live) {
    const auto v = static_cast<std::int32_t>(velocity);
    const auto i = static_cast<std::int32_t>(before_);
    for (std::size_t n = 0; n < kGrowth.size(); ++n) {
      Runaway<D>& law = laws_[n];
      law.compare_growth(
          law.gain(v), v,
          static_cast<std::uint32_t>(std::ldexp(kGrowth[n], D::f.velocity.fraction)));
      law.compare_current(i, current_);
      law.turn(v, i, ticks_, live);
      if (law.due() && at_[n] < 0) at_[n] = ticks_seen_;
    }
    before_ = current_ref;
    ++ticks_seen_;
  }
  void row(const Row& r) {
    tick(std::llround(std::ldexp(r.velocity_rad_s, D::f.velocity.fraction)),
         std::llround(std::ldexp(r.current_a, D::f.current.fraction)), true);
  }
  /// The tick (from 0) in which limit n tripped, or -1.
  std::int64_t tripped(std::size_t n) const { return at_[n]; }

 private:
  std::array<Runaway<D>, kGrowth.size()> laws_;
  std::array<std::int64_t, kGrowth.size()> at_ = {-1, -1, -1};
  std::uint32_t current_ = 0, ticks_ = 0;
  std::int64_t before_ = 0, ticks_seen_ = 0;
};

/// The number of runs, and for each limit the number of runs in which it tripped.
struct Count {
  std::int64_t runs = 0;
  std::array<std::int64_t, kGrowth.size()> trips{};
  template <class D>
  void add(const Watchers<D>& w) {
    ++runs;
    for (std::size_t n = 0; n < kGrowth.size(); ++n) trips[n] += w.tripped(n) >= 0 ? 1 : 0;
  }
};

}  // namespace feltgate::test
