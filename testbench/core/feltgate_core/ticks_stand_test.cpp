// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The tick counter of a core stops, in each clock of a tick and anywhere in a PWM period. The gates
// must go off, although the host's watchdog and the limits no longer run. stand.diff
// makes the counter stop. Documentation: docs/blocks/safety.md
#include <algorithm>
#include <cstdio>

#include "Vfeltgate_core.h"
#include "Vfeltgate_core___024root.h"
#include "catch.hpp"
#include "feltgate/generated/causes.hpp"
#include "sim/backends/rtl_model.hpp"
#include "sim/backends/rtl_ports.hpp"
#ifndef FELTGATE_DESIGN
#define FELTGATE_DESIGN Lever
#include "feltgate/generated/lever.hpp"
#else
#include FELTGATE_DESIGN_HEADER
#endif

using feltgate::CoreIn;
using feltgate::CoreOut;
using feltgate::Fault;
using D = feltgate::FELTGATE_DESIGN;

namespace {

constexpr int kTick = D::clocks_per_tick;
constexpr int kPeriods = (kTick + D::pwm_period - 1) / D::pwm_period;

class Core {
 public:
  Core() : rtl_(5) {
    feltgate::drive_inputs<D>(*rtl_, in_);
    rtl_.reset(4);
  }
  CoreOut out() const { return feltgate::read_outputs<D>(*rtl_); }
  void clocks(int n) {
    for (int k = 0; k < n; ++k) {
      feltgate::drive_inputs<D>(*rtl_, in_);
      rtl_.clock();
    }
  }
  void tick() {
    const std::uint32_t now = out().tick_count;
    while (out().tick_count == now) clocks(1);
  }
  void write(int address, std::uint32_t data) {
    in_.reg_addr = static_cast<std::uint16_t>(address);
    in_.reg_wdata = data;
    in_.reg_write = true;
    clocks(1);
    in_.reg_write = false;
    tick();
  }
  void stand() { rtl_->rootp->feltgate_core__DOT__u_wave__DOT__u_sequencer__DOT__stand = 1; }

 private:
  feltgate::RtlModel<Vfeltgate_core> rtl_;
  CoreIn in_;
};

}  // namespace

TEST_CASE("core: ticks that stand close the gates") {
  const int step = kTick / 50;
  int longest = 0, shortest = 1 << 30;
  for (int clock = 0; clock < kTick; clock += step) {
    for (int period = 0; period < 3; ++period) {
      CAPTURE(clock, period);
      Core core;
      core.tick();
      core.write(D::A::voltage_step, 24u << D::f.voltage.fraction);  // no ramp
      core.write(D::A::voltage_setpoint, 6u << D::f.voltage.fraction);
      core.write(D::C::control, static_cast<std::uint32_t>(D::control_reset) |
                                    1u << D::C::control_host | 1u << D::C::control_arm |
                                    2u << D::C::control_mode);
      for (int k = 0; k < 4 * (kTick + D::pwm_period) && core.out().gates != 9; ++k) core.clocks(1);
      REQUIRE(core.out().gates == 9);
      core.clocks(period * (D::pwm_period / 3 + 1));
      core.tick();
      core.clocks(clock);
      REQUIRE(core.out().gates_enable);
      core.stand();
      // Clocks since the last tick, which was `clock` clocks ago; a tick that is already near may
      // still come.
      int after = clock;
      const int limit = (kPeriods + 1) * D::pwm_period + 2;
      while (core.out().gates_enable && after <= limit + kTick) {
        core.clocks(1);
        ++after;
      }
      core.clocks(1);  // the registers of the gates
      ++after;
      REQUIRE(core.out().gates == 0);
      REQUIRE(core.out().faults != 0);  // a wave that never ends trips other faults sooner
      // If the counter stops in the last clock of a tick, that tick is the last one.
      REQUIRE(after <= limit + (clock >= kTick - 2 ? kTick : 0));
      longest = std::max(longest, after);
      shortest = std::min(shortest, after);
      core.clocks(limit);
      REQUIRE((core.out().faults & 1u << static_cast<unsigned>(Fault::tick)) != 0);
      REQUIRE(core.out().gates == 0);
      REQUIRE_FALSE(core.out().gates_enable);
    }
  }
  std::printf("gates off %d to %d clocks after the last tick, periods of %d clocks\n", shortest,
              longest, D::pwm_period);
}
