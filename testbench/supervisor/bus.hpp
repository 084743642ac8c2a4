// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Ports of the Verilated supervisor and a core around it: multiplier, parameter bus and signals
// that change in the wave clocks in which the real ones do. Documentation:
// docs/blocks/supervisor.md
#pragma once

#include <Vsupervisor.h>

#include "../sequencer/running_clock.hpp"
#include "feltgate/supervisor.hpp"
#include "lock_step.hpp"
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

struct SupervisorAdapter {
  static constexpr int kCurrentBits = Design::f.current.width();
  static constexpr int kEstimateBits = Design::f.current_estimate.width();
  static constexpr int kProductBits = Design::product_bits;

  static void drive(Vsupervisor& rtl, const Twin::In& in) {
    rtl.tick_i = in.tick;
    rtl.arm_i = in.arm;
    rtl.stop_i = in.stop;
    rtl.clear_faults_i = in.clear_faults;
    rtl.kick_i = in.kick;
    rtl.encoder_error_i = in.encoder_error;
    rtl.velocity_i = static_cast<std::uint32_t>(in.velocity);
    rtl.current_ref_i = port_bits<kCurrentBits>(in.current_ref);
    rtl.wave_i = in.wave;
    rtl.param_i = in.param;
    rtl.product_i = port_bits<kProductBits, std::uint64_t>(in.product);
  }
  template <class Check>
  static void compare(Check& check, const Vsupervisor& rtl, const Twin::Out& out) {
    check("current_estimate", sign_extend<kEstimateBits>(rtl.current_estimate_o),
          std::int64_t{out.current_estimate});
    check("armed", rtl.armed_o, out.armed);
    check("gates_enable", rtl.gates_enable_o, out.gates_enable);
    check("faults", rtl.faults_o, out.faults);
    check("first_fault", rtl.first_fault_o, out.first_fault);
  }
};
using SupervisorBench = LockStep<Vsupervisor, Twin, SupervisorAdapter>;

inline bool same(const Twin::Out& a, const Twin::Out& b) {
  return a.current_estimate == b.current_estimate && a.armed == b.armed &&
         a.gates_enable == b.gates_enable && a.faults == b.faults && a.first_fault == b.first_fault;
}

/// What the core would do around the supervisor from now on.
struct Scenario {
  bool arm = false;
  bool stop = false;
  bool clear_faults = false;  ///< these two at the end of each tick
  bool kick = false;
  bool encoder_error = false;
  std::int32_t voltage = 0;      ///< raw; in force once the wave has brought it
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

/// Turns a scenario into the inputs of one clock. Buses carry noise in clocks that are not ours.
class Bus {
 public:
  explicit Bus(std::uint64_t seed) : noise_(seed) {}

  Twin::In clock(const Clock::Out& now, const Scenario& s, std::int32_t current_estimate) {
    const auto at = [&now](int t) { return ((now.wave >> t) & 1U) != 0; };
    Twin::In in;
    in.tick = now.tick;
    in.arm = s.arm;
    in.stop = s.stop;
    in.clear_faults = s.clear_faults && now.tick;
    in.kick = s.kick && now.tick;
    in.encoder_error = s.encoder_error;
    in.wave = now.wave;
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

/// Runs the twin through changes of a scenario, and afterwards the RTL beside it.
class Script {
 public:
  Scenario now;

  Script() { twin_.reset(); }

  const Twin::Out& out() const { return twin_.out(); }
  const Twin& twin() const { return twin_; }
  int clock_of_tick() const { return clock_.clock_of_tick(); }

  Script& clocks(std::int64_t n) {
    parts_.push_back({n, now});
    for (; n > 0; --n) {
      twin_.clock(bus_.clock(clock_.out(), now, twin_.out().current_estimate));
      clock_.clock({});
    }
    return *this;
  }
  Script& ticks(std::int64_t n) { return clocks(n * Design::clocks_per_tick); }
  /// On to clock c of a tick, of the next one if that clock has passed or is now.
  Script& until(int c) {
    const int left = c - clock_of_tick();
    return clocks(left > 0 ? left : left + Design::clocks_per_tick);
  }
  /// n clocks with an illegal transition each.
  Script& errors(std::int64_t n) {
    now.encoder_error = true;
    clocks(n);
    now.encoder_error = false;
    return *this;
  }
  /// The request falls, rises, and a tick ends: armed, if all is well.
  Script& arm() {
    now.arm = false;
    until(0).ticks(1);
    now.arm = true;
    return ticks(1);
  }
  /// Disarmed and without a fault at the start of a tick.
  Script& clear() {
    now.arm = false;
    now.clear_faults = true;
    until(0).ticks(1);
    now.clear_faults = false;
    return *this;
  }
  /// Clock by clock until the gates fall; the clocks it took, or -1 after `limit`.
  std::int64_t clocks_to_fall(std::int64_t limit) {
    std::int64_t n = 0;
    while (out().gates_enable && n <= limit) {
      clocks(1);
      ++n;
    }
    return n > limit ? -1 : n;
  }
  void play() {
    SupervisorBench bench("supervisor", 1);
    std::int64_t total = 0;
    for (const Part& part : parts_) total += part.clocks;
    bench.run(Replay{&parts_, {}, Bus(1), 0, 0}, total + SupervisorBench::kFirstReset);
  }

 private:
  struct Part {
    std::int64_t clocks;
    Scenario scenario;
  };
  struct Replay {
    const std::vector<Part>* parts;
    Clock clock;
    Bus bus;
    std::size_t part;
    std::int64_t done;

    Twin::In operator()(std::int64_t cycle, const Twin::Out& out) {
      if (cycle < SupervisorBench::kFirstReset) return {};
      while (done == (*parts)[part].clocks) {
        ++part;
        done = 0;
      }
      ++done;
      const auto in = bus.clock(clock.out(), (*parts)[part].scenario, out.current_estimate);
      clock.clock({});
      return in;
    }
  };

  Clock clock_;
  Bus bus_{1};
  Twin twin_;
  std::vector<Part> parts_;
};

// Clocks from the start of a tick until the gates have fallen.
inline constexpr int kSpeed = Twin::speed_clock + 1;
inline constexpr int kHeat = Twin::heat_clock + 1;
inline constexpr int kPolarity = Twin::polarity_clock + 1;
inline constexpr int kWatchdog = Twin::watchdog_clock + 1;

constexpr unsigned bit(Fault cause) { return 1U << static_cast<unsigned>(cause); }

/// This cause and no other.
inline bool only(const Script& script, Fault cause) {
  return script.out().faults == bit(cause) &&
         script.out().first_fault == static_cast<unsigned>(cause);
}

}  // namespace feltgate::test
