// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Random stimulus that reaches every cause of fault, and what must hold of the gates whatever
// comes. Documentation: docs/blocks/supervisor.md
#pragma once

#include <array>
#include <limits>

#include "bus.hpp"

namespace feltgate::test {

/// A scenario that wanders: mostly quiet, so that the motor is armed for a while, with small
/// limits.
class RandomScenario {
 public:
  explicit RandomScenario(std::uint64_t seed) : random_(seed) {}

  /// Of the next tick; everything but the two asynchronous inputs is in force.
  const Scenario& next() {
    s_.clear_faults = random_.one_in(12);
    s_.kick = random_.one_in(15);
    if (random_.one_in(s_.arm ? 40 : 3)) s_.arm = !s_.arm;
    if (random_.one_in(60)) limits();
    if (random_.one_in(30)) signals();
    return s_;
  }

 private:
  void limits() {
    auto& words = s_.words;
    words = Scenario::design_words();
    words.watchdog_ticks = 5 + random_.below(80);
    words.polarity_ticks = random_.below(8);
    words.i2t_budget = random_.below(1U << 17);
    words.nominal_current_squared = random_.below(1U << 10);
    if (random_.one_in(8)) words.i2t_budget = static_cast<std::uint32_t>(random_.bits());
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
    if (random_.one_in(10)) s_.velocity = limit + static_cast<std::int32_t>(random_.below(2));
    if (random_.one_in(10)) s_.velocity = -(limit / 2) * 2 - static_cast<int>(random_.below(2));
    if (random_.one_in(50)) s_.velocity = std::numeric_limits<std::int32_t>::min();
  }

  Random random_;
  Scenario s_;
};

/// RandomScenario with stops and encoder errors at any clock.
class RandomCore {
 public:
  RandomCore(std::uint64_t seed, ResetPlan plan)
      : random_(seed), scenarios_(seed), clock_(seed, plan), bus_(seed) {}

  Twin::In operator()(std::int64_t, const Twin::Out& out) {
    const auto& now = clock_.next();
    if (now.tick || first_) {
      next_ = scenarios_.next();
      storm_ = random_.one_in(300) ? 40 : 0;
    }
    // The request, the commands and the words change at the end of a tick as the registers do.
    if (now.slot_fetch == 0) s_ = next_;
    first_ = false;
    s_.stop = random_.one_in(15000) || (s_.stop && !random_.one_in(100));
    s_.encoder_error = random_.one_in(3000) || (storm_ > 0 && random_.coin());
    if (storm_ > 0) --storm_;
    return bus_.clock(now, s_, out.current_estimate);
  }

 private:
  Random random_;
  RandomScenario scenarios_;
  RunningClock<Design::clocks_per_tick> clock_;
  Bus bus_;
  Scenario s_;
  Scenario next_;
  bool first_ = true;
  int storm_ = 0;
};

/// Watches the RTL alone.
class Watch {
 public:
  Watch(std::array<std::int64_t, 8>* trips, std::int64_t* armings)
      : trips_(trips), armings_(armings) {}

  const char* operator()(const Twin::In& in, const Vsupervisor& rtl, const Twin&, bool in_reset) {
    const bool gates = rtl.gates_enable_o != 0;
    const bool armed = rtl.armed_o != 0;
    const char* broken = nullptr;
    if (in_reset) {
      if (gates || armed || rtl.faults_o != 0) broken = "reset: gates off, no fault";
    } else {
      if (gates && rtl.faults_o != 0) broken = "no gates beside a fault";
      if (gates && !gates_ && (!in.tick || !in.arm)) broken = "gates open on request at a tick";
      if (gates && !armed) broken = "gates only while armed";
      if (armed != armed_ && !in.tick) broken = "armed changes at ticks";
      if (faults_ != 0 && rtl.faults_o != 0 && rtl.first_fault_o != first_ &&
          !(in.clear_faults && !in.arm)) {
        broken = "the first cause stays";
      }
      if ((faults_ & ~rtl.faults_o) != 0 && !(in.clear_faults && !in.arm)) {
        broken = "a fault stays until it is cleared";
      }
      if (rtl.faults_o != 0 && ((rtl.faults_o >> rtl.first_fault_o) & 1) == 0) {
        broken = "the first cause is one of the latched";
      }
      if (gates && !gates_) ++*armings_;
      if (!gates && gates_ && rtl.first_fault_o != 0) ++(*trips_)[rtl.first_fault_o];
    }
    gates_ = gates;
    armed_ = armed;
    faults_ = rtl.faults_o;
    first_ = rtl.first_fault_o;
    return broken;
  }

 private:
  std::array<std::int64_t, 8>* trips_;
  std::int64_t* armings_;
  bool gates_ = false;
  bool armed_ = false;
  unsigned faults_ = 0;
  unsigned first_ = 0;
};

}  // namespace feltgate::test
