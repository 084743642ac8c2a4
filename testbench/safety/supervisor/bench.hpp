// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Ports of the Verilated supervisor, scripts for RTL and twin, and the properties of the gates that
// must hold for all inputs. Documentation: docs/blocks/supervisor.md
#pragma once

#include <Vsupervisor.h>

#include <array>
#include <vector>

#include "bus.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

namespace feltgate::test {

constexpr int kTick = Design::clocks_per_tick;
constexpr std::int32_t kRadS = 1 << Design::f.velocity.fraction;   ///< raw 1 rad/s
constexpr std::int32_t kVolt = 1 << Design::f.voltage.fraction;    ///< raw 1 V
constexpr std::int32_t kAmpere = 1 << Design::f.current.fraction;  ///< raw 1 A

/// The twin with all outputs of the RTL, also those that depend on the inputs of the same clock.
class WholeTwin : public Twin {
 public:
  struct Seen : Twin::Out {
    bool arm_request, arms, ready, clear;
    bool stopped;  ///< the latch of the stop; the pin itself may be low again at the edge
  };
  Seen peek(const In& in) const {
    In last = in;  // were this the last clock of a tick
    last.tick = true;
    Twin after = *this;
    after.clock(last);
    return {out(),
            asks(in),
            after.out().armed,
            ready(in.host),
            in.clear_faults && !in.arm_request(),
            Twin::stopped(false)};
  }
};

struct SupervisorAdapter {
  static constexpr int kCurrentBits = Design::f.current.width();
  static constexpr int kEstimateBits = Design::f.current_estimate.width();
  static constexpr int kProductBits = Design::product_bits;

  static void drive(Vsupervisor& rtl, const Twin::In& in) {
    FELTGATE_DRIVE(rtl, in, tick, period_start, host, host_arm, arm, disarm, stop, clear_faults,
                   kick, encoder_error);
    rtl.velocity_i = static_cast<std::uint32_t>(in.velocity);
    rtl.current_ref_i = port_bits<kCurrentBits>(in.current_ref);
    FELTGATE_DRIVE(rtl, in, trips, axis_silent, axis_blocked, param);
    drive_strobes(rtl, in.wave);
    rtl.product_i = port_bits<kProductBits, std::uint64_t>(in.product);
  }
  static void at_edge(Vsupervisor& rtl) { rtl.stop_i = 0; }  // the pulse ends before the edge
  template <class Check>
  static void compare(Check& check, const Vsupervisor& rtl, const WholeTwin::Seen& out) {
    check("current_estimate", sign_extend<kEstimateBits>(rtl.current_estimate_o),
          std::int64_t{out.current_estimate});
    FELTGATE_COMPARE(check, rtl, out, armed, gates_enable, unkicked, faults, first_fault,
                     arm_request, ready, clear);
    if (rtl.clk_i == 0) check("arms", rtl.arms_o, out.arms);  // of trips that end with the clock
    if (rtl.rst_ni != 0) check("gates_clear", rtl.gates_clear_o, out.stopped || rtl.stop_i != 0);
  }
};
using SupervisorBench = LockStep<Vsupervisor, WholeTwin, SupervisorAdapter>;

/// Runs the twin through the changes of a scenario; afterwards the RTL runs the same inputs beside
/// a twin.
class Script {
 public:
  Scenario now;

  Script() { twin_.reset(); }

  const Twin::Out& out() const { return twin_.out(); }
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
  /// Runs to clock c of this tick, or of the next tick if that clock is now or has passed.
  Script& until(int c) {
    const int left = c - clock_of_tick();
    return clocks(left > 0 ? left : left + Design::clocks_per_tick);
  }
  /// Runs n clocks with one illegal transition in each.
  Script& errors(std::int64_t n) {
    now.encoder_error = true;
    clocks(n);
    now.encoder_error = false;
    return *this;
  }
  /// Lowers and raises the request and runs to the end of a tick: the supervisor is then armed if
  /// no fault prevents it.
  Script& arm() {
    now.arm = false;
    until(0).ticks(1);
    now.arm = true;
    return ticks(1);
  }
  /// Disarms and clears the faults; ends at the start of a tick.
  Script& clear() {
    now.arm = false;
    now.clear_faults = true;
    until(0).ticks(1);
    now.clear_faults = false;
    return *this;
  }
  /// Runs clock by clock until the gates fall. Returns the number of clocks, or -1 after `limit`
  /// clocks.
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

/// Removes the heat of power-up at once.
inline void cool(Script& s) {
  const std::uint32_t nominal = s.now.words.nominal_current_squared;
  s.now.words.nominal_current_squared = (1U << 31) - 1;
  s.ticks(2);
  s.now.words.nominal_current_squared = nominal;
}

// Clocks from the start of a tick until the gates have fallen.
inline constexpr int kSpeed = Twin::speed_clock + 1;
inline constexpr int kHeat = Twin::heat_clock + 1;
inline constexpr int kPolarity = Twin::polarity_clock + 1;
inline constexpr int kWatchdog = Twin::watchdog_clock + 1;

/// True if this cause is latched and no other.
inline bool only(const Script& script, Fault cause) {
  return script.out().faults == fault_bit(cause) &&
         script.out().first_fault == static_cast<unsigned>(cause);
}

/// Checks the properties on the RTL alone.
class Watch {
 public:
  Watch(std::array<std::int64_t, 16>* trips, std::int64_t* armings)
      : trips_(trips), armings_(armings) {}

  const char* operator()(const Twin::In& in, const Vsupervisor& rtl, const Twin&, bool in_reset) {
    const bool gates = rtl.gates_enable_o != 0;
    const bool armed = rtl.armed_o != 0;
    const char* broken = nullptr;
    if (in_reset) {
      if (gates || armed || rtl.faults_o != 0) broken = "reset: gates off, no fault";
    } else {
      if (gates && rtl.faults_o != 0) broken = "no gates beside a fault";
      // The pin may be low again since the edge, but the stop that it set remains.
      if (in.stop && gates_ && rtl.gates_clear_o == 0)
        broken = "a stop clears the gates until it is dealt with";
      // After a stop just before the gates open, the fault may need some clocks to close them.
      on_ = gates ? on_ + 1 : 0;
      stopped_ = in.stop ? 4 : stopped_ - (stopped_ > 0 ? 1 : 0);
      if (on_ > 4 && stopped_ == 0 && rtl.gates_clear_o != 0) broken = "open gates are not cleared";
      if (gates && !gates_ && (!in.tick || !in.arm_request()))
        broken = "gates open on request at a tick";
      if (gates && !armed) broken = "gates only while armed";
      if (armed != armed_ && !in.tick) broken = "armed changes at ticks";
      if (faults_ != 0 && rtl.faults_o != 0 && rtl.first_fault_o != first_ &&
          !(in.clear_faults && !in.arm_request())) {
        broken = "the first cause stays";
      }
      if ((faults_ & ~rtl.faults_o) != 0 && !(in.clear_faults && !in.arm_request())) {
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
  std::array<std::int64_t, 16>* trips_;
  std::int64_t* armings_;
  bool gates_ = false;
  bool armed_ = false;
  unsigned faults_ = 0;
  unsigned first_ = 0;
  std::int64_t on_ = 0;  ///< clocks with the gates open
  int stopped_ = 0;      ///< clocks for which a stop need not have closed the gates yet
};

}  // namespace feltgate::test
