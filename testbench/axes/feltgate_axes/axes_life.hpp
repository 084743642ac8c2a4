// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Axes with a host and a panel that a test controls or that act at random, and the properties
// between axes that must hold for all inputs. Documentation: docs/architecture.md
#pragma once

#include <Vfeltgate_axes.h>
#include <deque>
#include <string>
#include <type_traits>
#include <vector>

#include "../../core/feltgate_core/core_stimulus.hpp"
#include "catch.hpp"
#include "encoder_phase.hpp"
#include "feltgate/feltgate_axes.hpp"
#include "feltgate/generated/lever_law.hpp"
#include "feltgate/generated/pantograph_law.hpp"
#include "lock_step.hpp"
#include "ports.hpp"
#include "sim/backends/rtl_axes_ports.hpp"
#include "twins.hpp"

namespace feltgate::test {

// With the engine, a design whose velocity has fewer bits than the engine's words.
using Design = std::conditional_t<ENGINE != 0, PantographLaw, LeverLaw>;
constexpr int kAxes = AXES;
constexpr bool kEngine = ENGINE != 0;
using AxesTwin = test::AxesOf<Design, kAxes, true, kEngine>;

struct AxesAdapter {
  static constexpr int kTorque = Design::f.torque.width();

  static void drive(Vfeltgate_axes& rtl, const AxesIn<kAxes>& in) {
    drive_axes<kAxes>(rtl, in);
    for (int n = 0; n < kAxes; ++n) {
      const auto& axis = in.axis[static_cast<std::size_t>(n)];
      set_bits(rtl.law_torque_i, kTorque * n, kTorque, static_cast<std::uint64_t>(axis.law_torque));
    }
    rtl.law_late_i = in.law_late;
    rtl.law_restart_i = in.law_restart;
  }
  static void at_edge(Vfeltgate_axes& rtl) { rtl.stop_i = 0; }

  template <class Check>
  static void compare(Check& check, const Vfeltgate_axes& rtl, const AxesOut<kAxes>& out) {
    for (int n = 0; n < kAxes; ++n) {
      const CoreOut& o = out.axis[static_cast<std::size_t>(n)];
      const auto word = [&](const char* const(&name)[3], const auto& port, int width,
                            std::uint32_t twin) {
        check(name[n], bits_of(port, n * width, width), std::uint64_t{twin});
      };
      const auto number = [&](const char* const(&name)[3], const auto& port, Format f,
                              std::int64_t twin) {
        check(name[n], feltgate::sign_extend(bits_of(port, n * f.width(), f.width()), f.width()),
              twin);
      };
      using C = Map::C;
#define FELTGATE_OF_AXIS(name) {name " of axis 0", name " of axis 1", name " of axis 2"}
      word(FELTGATE_OF_AXIS("position"), rtl.position_o, 32,
           static_cast<std::uint32_t>(o.position));
      number(FELTGATE_OF_AXIS("velocity"), rtl.velocity_o, Design::f.velocity, o.velocity);
      number(FELTGATE_OF_AXIS("tau_hat"), rtl.tau_hat_o, Design::f.torque, o.tau_hat);
      number(FELTGATE_OF_AXIS("tau_ref"), rtl.tau_ref_o, Design::f.torque, o.tau_ref);
      number(FELTGATE_OF_AXIS("current_ref"), rtl.current_ref_o, Design::f.current, o.current_ref);
      number(FELTGATE_OF_AXIS("voltage"), rtl.voltage_o, Design::f.voltage, o.voltage);
      number(FELTGATE_OF_AXIS("duty"), rtl.duty_o, Design::f.duty, o.duty);
      number(FELTGATE_OF_AXIS("duty_active"), rtl.duty_active_o, Design::f.duty, o.duty_active);
      word(FELTGATE_OF_AXIS("gate_a_hi"), rtl.gate_a_hi_o, 1, o.gates & 1u);
      word(FELTGATE_OF_AXIS("gate_a_lo"), rtl.gate_a_lo_o, 1, o.gates >> 1 & 1u);
      word(FELTGATE_OF_AXIS("gate_b_hi"), rtl.gate_b_hi_o, 1, o.gates >> 2 & 1u);
      word(FELTGATE_OF_AXIS("gate_b_lo"), rtl.gate_b_lo_o, 1, o.gates >> 3 & 1u);
      word(FELTGATE_OF_AXIS("gates_enable"), rtl.gates_enable_o, 1, o.gates_enable);
      word(FELTGATE_OF_AXIS("scene"), rtl.scene_o, 4, o.scene);
      word(FELTGATE_OF_AXIS("limits"), rtl.limits_o, C::status_limits_width, o.limits);
      word(FELTGATE_OF_AXIS("faults"), rtl.faults_o, C::faults_seen_width, o.faults);
      word(FELTGATE_OF_AXIS("first_fault"), rtl.first_fault_o, C::faults_first_width,
           o.first_fault);
      word(FELTGATE_OF_AXIS("armed"), rtl.armed_o, 1, o.armed);
      word(FELTGATE_OF_AXIS("word_valid"), rtl.word_valid_o, 1, o.word_valid);
      word(FELTGATE_OF_AXIS("word_slot"), rtl.word_slot_o, 6, o.word_slot);
      word(FELTGATE_OF_AXIS("word_data"), rtl.word_data_o, 32, o.word_data);
#undef FELTGATE_OF_AXIS
    }
    const CoreOut& first = out.axis[0];
    FELTGATE_COMPARE(check, rtl, first, tick_count, snapshot_valid);
    check("reg_busy", rtl.reg_busy_o, out.reg_busy);
    if (out.rdata_known) check("reg_rdata", rtl.reg_rdata_o, out.reg_rdata);
    check("event_valid", rtl.event_valid_o, out.event_valid);
    if (!out.event_valid) return;
    check("event_number", rtl.event_number_o, out.event_number);
    check("event_value", rtl.event_value_o, static_cast<std::uint32_t>(out.event_value));
  }
};

using AxesBench = LockStep<Vfeltgate_axes, AxesTwin, AxesAdapter>;

using In = AxesIn<kAxes>;
using A = Design::A;
using C = Design::C;
constexpr int kTick = Design::clocks_per_tick;
inline constexpr std::uint32_t kHost =
    static_cast<std::uint32_t>(Design::control_reset) | 1u << C::control_host;

// Random but plausible stimulus: each axis has a lever, as a single core has; one host mostly
// requests the same from all axes.

/// Inputs clock by clock. All state is inside, so that a copy repeats the run.
template <class D, int N>
class AxesStimulus {
 public:
  /// `patience`: for this many clocks after a request to arm, no other request is written.
  explicit AxesStimulus(std::uint64_t seed, std::int64_t patience = 0)
      : random_(seed), patience_(patience) {
    for (int n = 0; n < N; ++n) levers_.emplace_back(seed + 1000u * static_cast<unsigned>(n));
  }

  AxesIn<N> operator()(std::int64_t clock) {
    if (random_.one_in(30'000)) active_ = random_.below(N);
    in_.reg_write = false;
    if (wait_ > 0) --wait_;
    if (keeps_ > 0) --keeps_;
    for (std::size_t n = 0; n < N; ++n) {
      const CoreIn of = levers_[n](clock);
      auto& axis = in_.axis[n];
      axis.encoder = of.encoder;
      axis.set_zero = of.set_zero;
      axis.scene = of.scene;
      axis.law_torque = of.law_torque;
      if (n == active_) host(of);
      if (n != 0) continue;
      in_.stop = of.stop;
      in_.arm = of.arm;
      in_.law_late = of.law_late;
      in_.law_restart = of.law_restart;
    }
    if (wait_ == 0 && !writes_.empty()) {
      in_.reg_addr = writes_.front().address;
      in_.reg_wdata = writes_.front().word;
      in_.reg_write = true;
      writes_.pop_front();
      wait_ = D::clocks_per_tick + random_.below(20);
    }
    return in_;
  }

 private:
  struct Write {
    std::uint16_t address;
    std::uint32_t word;
  };
  using C = typename D::C;

  static std::uint16_t at(std::size_t n, unsigned address) {
    return static_cast<std::uint16_t>(n * axes_stride + address % axes_stride);
  }
  void host(const CoreIn& of) {
    if (!writes_.empty()) return;
    if (!of.reg_write) {
      in_.reg_addr = random_.one_in(5'000) ? static_cast<std::uint16_t>(random_.bits())
                                           : at(active_, of.reg_addr);
      return;
    }
    const bool control = of.reg_addr == C::control, command = of.reg_addr == C::command;
    if (control && keeps_ > 0) return;
    const bool all = (control && !random_.one_in(12)) || (command && !random_.one_in(4));
    const bool arms = control && (of.reg_wdata >> C::control_arm & 1u) != 0;
    // A request that was refused counts again once it was low.
    if (all && arms && (patience_ > 0 || random_.coin())) {
      for (std::size_t n = 0; n < N; ++n) {
        writes_.push_back({at(n, of.reg_addr), of.reg_wdata & ~(1u << C::control_arm)});
      }
    }
    for (std::size_t n = 0; n < N; ++n) {
      if (!all && n != active_) continue;
      std::uint32_t word = of.reg_wdata;
      if (control && random_.coin()) {
        word &= ~(15u << C::control_scene);
        word |= random_.below(11) << C::control_scene;
        word ^= random_.below(4) << C::control_motor_polarity;
      }
      if (control && patience_ > 0) word |= 1u << C::control_host;
      writes_.push_back({at(n, of.reg_addr), word});
    }
    if (all && arms) keeps_ = patience_;
  }

  Random random_;
  std::vector<CoreStimulus<D>> levers_;
  AxesIn<N> in_;
  std::deque<Write> writes_;
  std::size_t active_ = 0;
  std::uint64_t wait_ = 0;
  std::int64_t patience_, keeps_ = 0;
};

/// Counts of the events in a run, by axis.
struct Tally {
  std::int64_t clocks = 0, armed = 0;
  std::int64_t own[kAxes] = {}, spread[kAxes] = {}, tests[kAxes] = {};
};

/// Properties that must hold for all inputs.
struct Watch {
  Tally* tally;
  bool gates = false;   ///< gates of all axes on in the clock before
  bool faulty = false;  ///< fault of any axis in the clock before
  int testing = -1;     ///< the axis whose self-test pulse runs
  unsigned first[3] = {0, 0, 0};

  const char* operator()(const In&, const Vfeltgate_axes& rtl, const AxesTwin& twin, bool reset) {
    const auto of = [](const auto& port, int n, int width = 1) {
      return static_cast<unsigned>(bits_of(port, n * width, width));
    };
    int armed = 0, enabled = 0, pulses = 0;
    bool any = false;
    for (int n = 0; n < kAxes; ++n) {
      const unsigned fault = of(rtl.first_fault_o, n, C::faults_first_width);
      armed += static_cast<int>(of(rtl.armed_o, n));
      enabled += static_cast<int>(of(rtl.gates_enable_o, n));
      any = any || fault != 0;
      if (fault != 0 && first[n] == 0) {
        const bool spread = fault == static_cast<unsigned>(Fault::axis);
        ++(spread ? tally->spread : tally->own)[n];
        if (spread && !faulty) return "a fault of another axis that has none";
      }
      if (fault != 0 && first[n] != 0 && fault != first[n] && !reset)
        return "the first cause is kept";
      first[n] = fault;
      // A pulse of the self-test: a torque while the test runs.
      const bool pulse = twin.core(n).testing() && twin.core(n).out().tau_ref != 0;
      pulses += pulse ? 1 : 0;
      tally->tests[n] += pulse ? 1 : 0;
      for (int m = 0; m < kAxes; ++m) {
        if (pulse && m != n && twin.core(m).out().snapshot_valid &&
            twin.core(m).out().tau_ref != 0 && !twin.core(m).testing())
          return "a torque beside the pulse of another axis";
      }
    }
    ++tally->clocks;
    tally->armed += armed == kAxes ? 1 : 0;
    // A fault in the clock of arming, or in the last clock of a tick, belongs to only one axis for
    // a tick.
    if (armed != 0 && armed != kAxes && !any) return "armed together";
    // A fault of any axis turns off the gates of the others one clock later.
    if (faulty && any && enabled != 0) return "gates on a clock after a fault";
    if (pulses > 1) return "two tests at once";
    faulty = any;
    return nullptr;
  }
};

/// Axes with a host that a test controls. The twin runs at once; play() then runs the RTL beside a
/// twin.
class Life {
 public:
  In in;

  const CoreOut& out(int n) const { return twin_.out().axis[static_cast<std::size_t>(n)]; }
  AxesTwin& twin() { return twin_; }
  In::Axis& axis(int n) { return in.axis[static_cast<std::size_t>(n)]; }

  void clocks(std::int64_t count) {
    for (; count > 0; --count) {
      inputs_.push_back(in);
      twin_.clock(in);
    }
  }
  void to_clock(int c) { clocks((c - twin_.clock_of_tick() + kTick) % kTick); }
  void ticks(std::int64_t n) {
    to_clock(0);
    clocks(n * kTick);
  }
  /// Moves axis n by one count.
  void turn(int n, bool up) {
    phase_[n] += up ? 1U : 3U;
    axis(n).encoder = pins_at(phase_[n], axis(n).encoder.z);
  }
  void write(int n, int address, std::uint32_t word) {
    to_clock(5);
    in.reg_addr = static_cast<std::uint16_t>(n * axes_stride + address);
    in.reg_wdata = word;
    in.reg_write = true;
    clocks(1);
    in.reg_write = false;
    to_clock(0);
  }
  void write_all(int address, std::uint32_t word) {
    for (int n = 0; n < kAxes; ++n) write(n, address, word);
  }
  std::uint32_t read(int n, int address) {
    in.reg_addr = static_cast<std::uint16_t>(n * axes_stride + address);
    clocks(4);
    return twin_.out().reg_rdata;
  }
  void control(int n, int scene, bool arm) {
    write(n, C::control,
          kHost | static_cast<std::uint32_t>(scene) << C::control_scene |
              std::uint32_t{arm} << C::control_arm);
  }
  /// Arms all axes, without a ramp.
  void arm(int scene, std::uint32_t test_pulse = 0) {
    for (int n = 0; n < kAxes; ++n) control(n, scene, false);
    write_all(A::self_test_pulse, test_pulse);
    write_all(A::ramp_step, 0x7ffffff);
    write_all(C::command, 1u << C::command_clear_faults);
    ticks(2);
    for (int n = 0; n < kAxes; ++n) control(n, scene, true);
    ticks(1);
    for (int n = 0; n < kAxes; ++n) REQUIRE(out(n).armed);
  }
  const std::vector<In>& inputs() const { return inputs_; }
  void play() {
    Tally tally;
    AxesBench bench("feltgate_axes", 1);
    bench.run(Replay{&inputs_}, static_cast<std::int64_t>(inputs_.size()) + AxesBench::kFirstReset,
              {}, Watch{&tally});
  }

 private:
  struct Replay {
    const std::vector<In>* inputs;
    In operator()(std::int64_t cycle) const {
      const std::int64_t k = cycle - AxesBench::kFirstReset;
      return k < 0 ? In{} : (*inputs)[static_cast<std::size_t>(k)];
    }
  };

  AxesTwin twin_;
  std::vector<In> inputs_;
  unsigned phase_[kAxes] = {};
};

inline std::int32_t torque(double nm) {
  return static_cast<std::int32_t>(nm * (1 << Design::f.torque.fraction));
}

}  // namespace feltgate::test
