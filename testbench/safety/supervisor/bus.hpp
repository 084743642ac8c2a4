// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A model of the core around the supervisor's twin: multiplier, parameter bus, and signals that
// change in the same wave clocks as in the real core. Documentation: docs/blocks/supervisor.md
#pragma once

#include "../../wave/sequencer/sequencer_twin.hpp"
#include "feltgate/supervisor.hpp"
#include "ports.hpp"
#include "random.hpp"
#ifdef DESIGN_PAPER
#include "feltgate/generated/paper.hpp"
#else
#include "feltgate/generated/lever.hpp"
#endif

namespace feltgate::test {

#ifdef DESIGN_PAPER
using Design = Paper;
#else
using Design = Lever;
#endif
using Twin = Supervisor<Design>;
using Clock = Sequencer<Design::clocks_per_tick>;

inline bool same(const Twin::Out& a, const Twin::Out& b) {
  return a.current_estimate == b.current_estimate && a.armed == b.armed &&
         a.gates_enable == b.gates_enable && a.faults == b.faults && a.first_fault == b.first_fault;
}

/// The inputs that the core gives to the supervisor from now on.
struct Scenario {
  bool host = false;
  bool host_arm = false;
  bool arm = false;
  bool disarm = false;
  bool stop = false;
  bool clear_faults = false;  ///< clear_faults and kick act at the end of each tick
  bool kick = false;
  bool encoder_error = false;
  bool period_start = false;
  bool axis_silent = false;
  bool axis_blocked = false;
  bool ticks_stand = false;      ///< the tick counter stands: no ticks and no waves
  bool tick_stuck = false;       ///< the tick signal stays high
  std::uint16_t trips = 0;       ///< faults from other blocks
  std::int32_t voltage = 0;      ///< raw; takes effect when the wave brings it
  std::int32_t velocity = 0;     ///< raw; the same
  std::int32_t current_ref = 0;  ///< raw; the same
  Twin::Words words = design_words();

  static Twin::Words design_words() {
    Twin::Words words;
    const auto word = [](int address) {
      for (const auto& p : Design::parameters) {
        if (p.address == address) return static_cast<std::uint32_t>(p.raw);
      }
      return std::uint32_t{0};
    };
    using A = Design::A;
    words.inverse_resistance = word(A::inverse_resistance);
    words.emf_over_resistance = word(A::emf_over_resistance);
    words.nominal_current_squared = word(A::nominal_current_squared);
    words.overspeed = word(A::overspeed);
    words.i2t_budget = word(A::i2t_budget);
    words.polarity_speed = word(A::polarity_speed);
    words.polarity_current = word(A::polarity_current);
    words.polarity_ticks = word(A::polarity_ticks);
    words.watchdog_ticks = word(A::watchdog_ticks);
    return words;
  }
};

/// Drives the strobes of a Verilated supervisor.
template <class Rtl>
void drive_strobes(Rtl& rtl, std::uint64_t wave) {
  FELTGATE_STROBES(rtl, wave, at, T, estimate_part, current_estimate, speed_size, current_squared,
                   nominal, speed, growth_size, heat, strong_size, polarity, watchdog);
  FELTGATE_STROBES(rtl, wave, param_is, W, overspeed, i2t_budget, polarity_speed, polarity_current,
                   polarity_ticks, watchdog_ticks);
}

/// Turns a scenario into the inputs of one clock. The buses carry noise in the clocks of other
/// blocks.
class Bus {
 public:
  explicit Bus(std::uint64_t seed) : noise_(seed) {}

  Twin::In clock(const Clock::Out& now, const Scenario& s, std::int32_t current_estimate) {
    const auto at = [&now](int t) { return ((now.wave >> t) & 1U) != 0; };
    Twin::In in;
    in.tick = (now.tick && !s.ticks_stand) || s.tick_stuck;
    in.period_start = s.period_start;
    in.host = s.host;
    in.host_arm = s.host_arm;
    in.arm = s.arm;
    in.disarm = s.disarm;
    in.stop = s.stop;
    in.clear_faults = s.clear_faults && now.tick;
    in.kick = s.kick && now.tick;
    in.encoder_error = s.encoder_error;
    in.trips = s.trips;
    in.axis_silent = s.axis_silent;
    in.axis_blocked = s.axis_blocked;
    in.wave = s.ticks_stand ? 0 : now.wave;
    in.product = static_cast<std::int64_t>(noise_.bits()) >> 10;
    in.param = static_cast<std::uint32_t>(noise_.bits());
    using W = Map::W;
    using M = Map::M;
    using T = Map::T;
    if (at(W::inverse_resistance))
      v_over_r_ = std::int64_t{voltage} * (s.words.inverse_resistance & 0x1ffffU);
    if (at(W::emf_over_resistance))
      w_over_r_ = std::int64_t{velocity} * (s.words.emf_over_resistance & 0x1ffffU);
    if (at(T::velocity + 1)) velocity = s.velocity;
    if (at(T::current + 1)) current_ref = s.current_ref;
    if (at(T::voltage + 1)) voltage = s.voltage;
    if (at(M::inverse_resistance)) in.product = v_over_r_;
    if (at(M::emf_over_resistance)) in.product = w_over_r_;
    if (at(M::current_square)) in.product = std::int64_t{current_estimate} * current_estimate;
    if (at(W::overspeed)) in.param = s.words.overspeed;
    if (at(W::nominal_current_squared)) in.param = s.words.nominal_current_squared;
    if (at(W::i2t_budget)) in.param = s.words.i2t_budget;
    if (at(W::polarity_speed)) in.param = s.words.polarity_speed;
    if (at(W::polarity_current)) in.param = s.words.polarity_current;
    if (at(W::polarity_ticks)) in.param = s.words.polarity_ticks;
    if (at(W::watchdog_ticks)) in.param = s.words.watchdog_ticks;
    in.velocity = velocity;
    in.current_ref = current_ref;
    return in;
  }

  std::int32_t voltage = 0;
  std::int32_t velocity = 0;
  std::int32_t current_ref = 0;

 private:
  Random noise_;
  std::int64_t v_over_r_ = 0;
  std::int64_t w_over_r_ = 0;
};

}  // namespace feltgate::test
