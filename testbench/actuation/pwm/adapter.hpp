// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Connects the Verilated pwm's ports to its twin's, and checks for gate states that no bridge may
// get. Documentation: docs/blocks/pwm.md
#pragma once

#include <Vpwm.h>

#include "feltgate/pwm.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

namespace feltgate::test {

struct PwmAdapter {
  static void drive(Vpwm& rtl, const Pwm::In& in) {
    FELTGATE_DRIVE(rtl, in, clear, enable, mode, polarity);
    rtl.duty_i = port_bits<13, std::uint16_t>(in.duty);
  }
  template <class Check>
  static void compare(Check& check, const Vpwm& rtl, const Pwm::Out& out) {
    FELTGATE_COMPARE(check, rtl, out, gate_a_hi, gate_a_lo, gate_b_hi, gate_b_lo, period_start);
    check("duty_active", sign_extend<13>(rtl.duty_active_o), out.duty_active);
  }
};

using PwmBench = LockStep<Vpwm, Pwm, PwmAdapter>;

/// Checks the gates of the RTL only, clock by clock.
class BridgeGuard {
 public:
  BridgeGuard(int dead_clocks, int shortest_clocks)
      : dead_clocks_(dead_clocks), shortest_clocks_(shortest_clocks) {}

  struct Totals {
    std::int64_t turn_ons = 0, disables = 0, duties = 0, whole_pulses = 0;
  };

  const char* operator()(const Pwm::In& in, const Vpwm& rtl, bool in_reset) {
    const bool on[4] = {rtl.gate_a_hi_o != 0, rtl.gate_a_lo_o != 0, rtl.gate_b_hi_o != 0,
                        rtl.gate_b_lo_o != 0};
    ++clock_;
    if (in_reset || !in.enable) {
      last_disabled_ = clock_;
      totals.disables += was_enabled_ ? 1 : 0;
    }
    was_enabled_ = in.enable && !in_reset;
    // Inputs that turn the gates on or off, or change mode or polarity, may cut a running pulse.
    const bool cuts =
        in_reset || !in.enable || in.clear || in.mode != mode_ || in.polarity != polarity_;
    if (cuts) last_cut_ = clock_;
    mode_ = in.mode;
    polarity_ = in.polarity;
    for (int gate = 0; gate < 4; ++gate) {
      if (!on[gate]) {
        // Such a change is used from the next period on; the gates follow a few clocks and a dead
        // time later.
        if (was_on_[gate] && on_since_[gate] > last_cut_ + 2 * period_ + dead_clocks_) {
          if (clock_ - on_since_[gate] < shortest_clocks_) return "no pulse is too short";
          ++totals.whole_pulses;
        }
        was_on_[gate] = false;
        continue;
      }
      if (in_reset) return "no gate is on during reset";
      if (!in.enable) return "no gate is on while disabled";
      if (in.clear) return "no gate is on while cleared";
      if (on[gate ^ 1]) return "never both gates of a leg";
      if (!was_on_[gate]) {
        ++totals.turn_ons;
        on_since_[gate] = clock_;
        if (clock_ - last_on_[gate ^ 1] <= dead_clocks_) return "dead time between two gates";
        if (clock_ - last_disabled_ < dead_clocks_) return "dead time after enable";
      }
      was_on_[gate] = true;
      last_on_[gate] = clock_;
    }
    const auto duty = sign_extend<13>(rtl.duty_active_o);
    if (!in_reset && !in.enable && duty != 0) return "no duty is in force while disabled";
    if (duty != duty_ && !rtl.period_start_o && !in_reset && in.enable) {
      return "a duty begins with a period";
    }
    totals.duties += duty != duty_ ? 1 : 0;
    duty_ = duty;
    return nullptr;
  }

  Totals totals;

 private:
  static constexpr int period_ = PWM_PERIOD;
  int dead_clocks_, shortest_clocks_;
  bool mode_ = false, polarity_ = false;
  std::int64_t clock_ = 0, last_cut_ = 0;
  std::int64_t on_since_[4] = {};
  std::int64_t last_on_[4] = {-1000, -1000, -1000, -1000};
  bool was_on_[4] = {};
  std::int64_t last_disabled_ = 0;
  bool was_enabled_ = false;
  std::int64_t duty_ = 0;
};

}  // namespace feltgate::test
