// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Random scenarios that reach every cause of fault. Documentation: docs/blocks/supervisor.md
#pragma once

#include <limits>

#include "bus.hpp"

namespace feltgate::test {

/// A random scenario with small limits. It is mostly quiet, so that the motor stays armed for a
/// while.
class RandomScenario {
 public:
  explicit RandomScenario(std::uint64_t seed, bool near = false)
      : random_(seed), axes_(~seed), words_(seed + 1'000), say_(seed + 2'000), near_(near) {
    s_.words.nominal_current_squared = (1U << 31) - 1;  // until the first limits: cold
  }

  /// Returns the scenario of the next tick; it sets all inputs except the two asynchronous ones.
  const Scenario& next() {
    s_.clear_faults = random_.one_in(12);
    s_.kick = random_.one_in(15);
    if (random_.one_in(s_.arm ? 40 : 3)) s_.arm = !s_.arm;
    if (axes_.one_in(s_.axis_blocked ? 2 : 60)) s_.axis_blocked = !s_.axis_blocked;
    if (say_.one_in(s_.host_arm ? 40 : 3)) s_.host_arm = !s_.host_arm;
    if (say_.one_in(60)) s_.host = !s_.host;
    if (say_.one_in(s_.axis_silent ? 2 : 90)) s_.axis_silent = !s_.axis_silent;
    s_.disarm = say_.one_in(90);
    if (random_.one_in(60)) limits();
    if (random_.one_in(30)) signals();
    if (s_.arm && random_.one_in(200))
      s_.velocity = static_cast<std::int32_t>(s_.words.overspeed) + 1;
    if (drift_ != 0) {
      const std::int64_t v = std::int64_t{s_.velocity} + drift_;
      if (v == static_cast<std::int32_t>(v)) s_.velocity = static_cast<std::int32_t>(v);
    }
    if (near_) come_near();
    return s_;
  }

 private:
  /// Sets limits equal to the signals or one bit away, and currents with one bit set or with all
  /// bits below it set.
  void come_near() {
    auto& words = s_.words;
    if (drift_ != 0 && words_.one_in(10)) {  // current against the growing speed
      const std::int32_t bit = 1 << words_.below(Design::f.current.width() - 1);
      const std::int32_t size = words_.coin() ? bit : bit - 1;
      s_.current_ref = drift_ < 0 ? size : -size;
      words.polarity_current = static_cast<std::uint32_t>(size);
      if (size > 0 && !words_.one_in(4)) --words.polarity_current;
      words.polarity_speed = words_.below(1U << 10);
    }
    if (words_.one_in(200)) {  // the heat falls and rises by large steps
      words.inverse_resistance = 0x1ffff;
      words.i2t_budget = static_cast<std::uint32_t>(words_.bits() & 0xffffffff) >> words_.below(12);
      words.nominal_current_squared = 1U << words_.below(31);
      if (words_.coin()) words.nominal_current_squared = words_.below(std::uint64_t{1} << 31);
    }
  }
  void limits() {
    auto& words = s_.words;
    words = Scenario::design_words();
    words.watchdog_ticks = 5 + random_.below(80);
    words.polarity_ticks = random_.below(8);
    words.polarity_speed = random_.below(1U << 22);
    words.polarity_current = random_.below(1U << 18);
    words.i2t_budget = random_.below(1U << 17);
    words.nominal_current_squared = random_.below(1U << 10);
    if (random_.one_in(8)) words.i2t_budget = static_cast<std::uint32_t>(random_.bits());
    if (random_.one_in(10)) words.watchdog_ticks = static_cast<std::uint32_t>(random_.bits());
    if (random_.one_in(10)) {
      words.nominal_current_squared = static_cast<std::uint32_t>(random_.bits());
    }
    if (random_.one_in(20)) words.overspeed = static_cast<std::uint32_t>(random_.bits());
    if (random_.one_in(20)) words.polarity_speed = static_cast<std::uint32_t>(random_.bits());
    if (random_.one_in(20)) words.polarity_current = static_cast<std::uint32_t>(random_.bits());
    if (random_.one_in(20)) {
      words.inverse_resistance = static_cast<std::uint32_t>(random_.bits());
      words.emf_over_resistance = static_cast<std::uint32_t>(random_.bits());
    }
  }
  void signals() {
    constexpr int v_top = (1 << (Design::f.voltage.width() - 1)) - 1;
    constexpr int i_top = (1 << (Design::f.current.width() - 1)) - 1;
    s_.voltage = static_cast<std::int32_t>(random_.between(-v_top - 1, v_top)) >> random_.below(6);
    s_.current_ref =
        static_cast<std::int32_t>(random_.between(-i_top - 1, i_top)) >> random_.below(6);
    s_.velocity = static_cast<std::int32_t>(random_.bits()) >> (1 + random_.below(12));
    const auto limit = static_cast<std::int32_t>(s_.words.overspeed);
    if (random_.one_in(5)) s_.velocity = limit + static_cast<std::int32_t>(random_.below(2));
    if (random_.one_in(10)) s_.velocity = -(limit / 2) * 2 - static_cast<int>(random_.below(2));
    if (random_.one_in(50)) s_.velocity = std::numeric_limits<std::int32_t>::min();
    drift_ = 0;
    if (!random_.one_in(3)) return;
    // The speed grows, mostly against the current.
    drift_ = static_cast<std::int32_t>(random_.bits()) >> (7 + random_.below(6));
    s_.velocity = drift_ * 2;
    const std::int32_t i = s_.current_ref;
    if (!random_.one_in(4)) s_.current_ref = (i < 0) == (drift_ < 0) ? -(i + 1) : i;
  }

  Random random_, axes_, words_, say_;
  bool near_;
  Scenario s_;
  std::int32_t drift_ = 0;  ///< change of the velocity per tick
};

}  // namespace feltgate::test
