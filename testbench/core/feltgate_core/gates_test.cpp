// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The gates at the pins of the whole core: a stop between the edges of the clock, a stop without a
// clock, and the duty after arming again. The test samples the raw pins 20 times per clock; a
// comparison from edge to edge cannot do this. Documentation: docs/blocks/safety.md
#include "Vfeltgate_core.h"
#include "catch.hpp"
#include "feltgate/feltgate_core.hpp"
#include "sim/backends/lock_step_core.hpp"
#include "sim/backends/rtl_model.hpp"
#include "sim/backends/rtl_ports.hpp"
#include "twins.hpp"
#ifndef FELTGATE_DESIGN
#define FELTGATE_DESIGN Lever
#include "feltgate/generated/lever.hpp"
#elif defined FELTGATE_DESIGN_HEADER
#include FELTGATE_DESIGN_HEADER
#else
#include "feltgate/generated/paper.hpp"
#endif

using feltgate::CoreIn;
using feltgate::Fault;
using D = feltgate::FELTGATE_DESIGN;

namespace {

constexpr int kPhases = 20;  // phases of a clock: rise before phase 0, fall before phase 10
constexpr unsigned kStop = 1u << static_cast<unsigned>(Fault::stop);

/// RTL and twin with one panel and one host; the twin gets the changes of the stop since the last
/// edge.
class Bridge {
 public:
  Bridge() : rtl_(7) {
    drive();
    rtl_.reset(4);
  }

  unsigned gates() const {
    return unsigned{rtl_->gate_a_hi_o} | rtl_->gate_a_lo_o * 2u | rtl_->gate_b_hi_o * 4u |
           rtl_->gate_b_lo_o * 8u;
  }
  const feltgate::CoreOut& twin() const { return twin_.out(); }

  /// Runs one phase: first the clock edge, if one is due, then the stop.
  void phase(bool stop) {
    if (phase_ == 0) rise();
    if (phase_ == kPhases / 2) {
      drive();
      rtl_.low();
    }
    set_stop(stop || held_);
    phase_ = (phase_ + 1) % kPhases;
  }
  void phases(int n, bool stop = false) {
    for (int k = 0; k < n; ++k) phase(stop);
  }
  void clocks(int n) { phases(n * kPhases); }
  void set_stop(bool stop) {
    seen_ = seen_ || stop;
    rtl_->stop_i = stop;
    rtl_->eval();
  }
  /// Keeps the stop on in all phases until it is released.
  void hold_stop(bool hold) {
    held_ = hold;
    set_stop(hold);
  }
  void write(int address, std::uint32_t data) {
    while (twin_.out().reg_busy) clocks(1);
    in_.reg_addr = static_cast<std::uint16_t>(address);
    in_.reg_wdata = data;
    in_.reg_write = true;
    clocks(1);
    in_.reg_write = false;
    clocks(1);  // the write is accepted at the first edge
    while (twin_.out().reg_busy) clocks(1);
  }
  void control(bool arm) {
    write(D::C::control, static_cast<std::uint32_t>(D::control_reset) | 1u << D::C::control_host |
                             static_cast<std::uint32_t>(arm) << D::C::control_arm |
                             2u << D::C::control_mode);
  }
  /// Arms in voltage mode and stops in the middle of a pulse of the high switch of leg A.
  void arm() {
    control(true);
    for (int k = 0; k < 4 * D::pwm_period && gates() != 9; ++k) clocks(1);
    CAPTURE(twin_.out().duty_active, twin_.out().armed, twin_.out().faults);
    REQUIRE(gates() == 9);
    clocks(2);
  }
  void disarm() {
    control(false);
    clocks(2 * D::clocks_per_tick);
  }

 private:
  void drive() {
    const bool stop = rtl_->stop_i != 0;
    driven_ = in_;
    feltgate::drive_inputs(*rtl_, feltgate::test::port_bits<D>(), driven_);
    rtl_->stop_i = stop;
  }
  void rise() {
    const bool stop = rtl_->stop_i != 0;
    rtl_.high();
    CoreIn in = driven_;
    in.stop = seen_;
    twin_.clock(in);
    seen_ = stop;
    const feltgate::CoreOut rtl = feltgate::read_outputs(*rtl_, feltgate::test::port_bits<D>());
    if (!(rtl == twin_.out())) {
      FAIL("RTL and twin differ in " << feltgate::difference(rtl, twin_.out()));
    }
  }

  feltgate::RtlModel<Vfeltgate_core> rtl_;
  feltgate::test::CoreOf<D> twin_;
  CoreIn in_, driven_;  ///< inputs wanted, and inputs at the pins since the clock fell
  int phase_ = 0;
  bool seen_ = false, held_ = false;
};

std::uint32_t volts(double v) {
  return static_cast<std::uint32_t>(v * (1 << D::f.voltage.fraction));
}

}  // namespace

TEST_CASE("core: a stop between the edges closes the gates at once and is a fault") {
  Bridge bridge;
  bridge.write(D::A::voltage_step, volts(24));  // no ramp
  bridge.write(D::A::voltage_setpoint, volts(6));
  bridge.disarm();
  for (const int width : {0, 1, 7, 20, 45}) {  // in phases; 0: ends before the next sample
    for (int phase = 0; phase < kPhases; ++phase) {
      CAPTURE(width, phase);
      bridge.arm();
      bridge.phases(phase);
      REQUIRE(bridge.gates() == 9);
      bridge.set_stop(true);
      REQUIRE(bridge.gates() == 0);
      bridge.set_stop(width > 0);
      for (int k = 0; k < 4 * kPhases; ++k) {
        bridge.phase(k < width);
        REQUIRE(bridge.gates() == 0);
      }
      REQUIRE(bridge.twin().faults == kStop);
      REQUIRE(bridge.twin().first_fault == static_cast<unsigned>(Fault::stop));
      REQUIRE_FALSE(bridge.twin().gates_enable);
      bridge.disarm();
      bridge.write(D::C::command, 1u << D::C::command_clear_faults);
      bridge.clocks(D::clocks_per_tick);
      REQUIRE(bridge.twin().faults == 0);
    }
  }
}

TEST_CASE("core: a stop closes the gates of a core whose clock stands") {
  for (int phase = 0; phase < kPhases; ++phase) {
    Bridge bridge;
    bridge.write(D::A::voltage_step, volts(24));  // no ramp
    bridge.write(D::A::voltage_setpoint, volts(6));
    bridge.disarm();
    bridge.arm();
    bridge.phases(phase);
    bridge.set_stop(true);  // no clock edges from here on
    CAPTURE(phase);
    REQUIRE(bridge.gates() == 0);
    bridge.set_stop(false);
    REQUIRE(bridge.gates() == 0);
    bridge.set_stop(true);
    bridge.set_stop(false);
    REQUIRE(bridge.gates() == 0);
    for (int k = 0; k < 5 * kPhases; ++k) {  // clock edges again
      bridge.phase(false);
      REQUIRE(bridge.gates() == 0);
    }
    REQUIRE(bridge.twin().faults == kStop);
  }
}

TEST_CASE("core: a stop while disarmed keeps it disarmed and is no fault") {
  Bridge bridge;
  bridge.write(D::A::voltage_step, volts(24));  // no ramp
  bridge.write(D::A::voltage_setpoint, volts(6));
  bridge.disarm();
  for (int phase = 0; phase < 3 * kPhases; ++phase) {
    bridge.phases(phase);
    bridge.set_stop(true);
    bridge.set_stop(false);
    bridge.clocks(D::clocks_per_tick);
    REQUIRE(bridge.twin().faults == 0);
    bridge.arm();  // the earlier stop pulse has no effect
    REQUIRE(bridge.twin().armed);
    bridge.disarm();
    bridge.hold_stop(true);
    bridge.control(true);  // a request during a stop is lost
    bridge.clocks(2 * D::clocks_per_tick);
    REQUIRE_FALSE(bridge.twin().armed);
    bridge.hold_stop(false);
    bridge.clocks(2 * D::clocks_per_tick);
    REQUIRE_FALSE(bridge.twin().armed);
    REQUIRE(bridge.twin().faults == 0);
    bridge.disarm();
  }
}

TEST_CASE("core: arming again begins with a duty of 0, not with that of the last arming") {
  Bridge bridge;
  for (int offset = 0; offset < D::pwm_period; offset += 61) {
    CAPTURE(offset);
    bridge.write(D::A::voltage_step, volts(24));  // no ramp
    bridge.write(D::A::voltage_setpoint, volts(6));
    bridge.arm();
    REQUIRE(bridge.twin().duty_active > 0);
    bridge.clocks(offset);
    bridge.write(D::A::voltage_setpoint, 0);
    bridge.control(false);
    bridge.control(true);
    bridge.clocks(D::clocks_per_tick);  // two ticks after the last tick of the old arming
    REQUIRE(bridge.twin().armed);
    REQUIRE(bridge.twin().duty_active == 0);
    for (int k = 0; k < 2 * D::pwm_period; ++k) {
      bridge.clocks(1);
      REQUIRE((bridge.gates() & 5u) == 0);  // no high switch
    }
    REQUIRE(bridge.gates() == 10);  // both low switches: at 0 V
    bridge.disarm();
  }
}
