// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core with a current loop, RTL against twin in every clock, around a winding that its gates
// switch: a torque step, the over-current, a sensor that fails, what arming waits for.
// Documentation: docs/blocks/current_control.md
#include <algorithm>
#include <cmath>

#include "core_life.hpp"
#include "core_stimulus.hpp"

using namespace feltgate::test;
using feltgate::CoreIn;
using feltgate::CoreOut;
using feltgate::Fault;
using feltgate::fault_bit;
using D = feltgate::test::Design;

namespace {

static_assert(D::current_loop != 0);
constexpr double kFull = 32, kLsb = kFull / (1 << 17);
constexpr std::int64_t kArmed = 520'000, kSettled = kArmed + 60'000;

/// A host that arms the set-point after the calibration, and the winding with its modulator. From
/// kSettled on something may happen.
struct Rig {
  enum class Event { none, shorted, stands };
  Event event = Event::none;
  double torque_nm = 0.2, ohm = 0.42;
  std::uint32_t duty_limit = word_of_design(A::duty_limit);
  bool early = false;  ///< asks to be armed before the calibration

  feltgate::plant::SigmaDelta modulator{kFull};
  double current_a = 0;
  CoreIn in;
  bool clock_was = false;

  CoreIn operator()(std::int64_t cycle, const CoreOut& out) {
    host(cycle);
    const bool happens = cycle > kSettled;
    const double henry = happens && event == Event::shorted ? 4e-6 : 82e-6;
    const double r = happens && event == Event::shorted ? 0.05 : ohm;
    current_a += (bridge_v(out.gates) - r * current_a) * 20e-9 / henry;
    if (out.current_clock && !clock_was) in.current_data = modulator.next(current_a);
    clock_was = out.current_clock;
    if (happens && event == Event::stands) in.current_data = false;
    return in;
  }

 private:
  /// A leg without a gate that is on is at the rail to which its diode lets the current flow.
  double bridge_v(unsigned gates) const {
    const auto leg = [this](bool hi, bool lo, bool out) {
      return hi ? 24.0 : lo ? 0.0 : out == (current_a > 0) ? 0.0 : 24.0;
    };
    if (gates == 0 && std::abs(current_a) < 0.01) return 0;
    return leg(gates & 1u, gates & 2u, true) - leg(gates & 4u, gates & 8u, false);
  }
  void host(std::int64_t cycle) {
    constexpr auto scene = static_cast<std::uint32_t>(D::S::setpoint) << C::control_scene;
    const std::int64_t arm_at = early ? kArmed - 20'000 : kArmed;
    const auto write = [&](std::int64_t at, int address, std::uint32_t word) {
      if (cycle == at) in.reg_addr = static_cast<std::uint16_t>(address), in.reg_wdata = word;
      if (cycle >= at && cycle < at + kTick + 1) in.reg_write = cycle == at;
    };
    write(1'000, A::self_test_pulse, 0);
    write(2'000, A::ramp_step, 0x7ffffff);
    write(3'000, A::setpoint_torque,
          low(std::llround(std::ldexp(torque_nm, D::f.torque.fraction))));
    write(4'000, C::control, kHost | scene);
    write(5'000, A::duty_limit, duty_limit);
    write(arm_at, C::control, kHost | scene | 1u << C::control_arm);
  }
};

/// Clocks of events, and the mean of the measured currents from a clock on.
struct Seen {
  std::int64_t armed = -1, beyond = -1, off = -1, results = 0;
  double sum_a = 0, reference_a = 0, peak_a = 0;
  CoreOut last;
};

Seen run(const Rig& rig, std::int64_t clocks) {
  Seen seen;
  std::int64_t cycle = 0;
  double current_a = 0;
  CoreBench bench("feltgate_core", 5);
  const auto stimulus = [rig = rig, &current_a](std::int64_t k, const CoreOut& out) mutable {
    const CoreIn in = rig(k, out);
    current_a = rig.current_a;
    return in;
  };
  bench.run(stimulus, clocks, {}, [&](const CoreIn&, const auto&, const CoreTwin& twin, bool) {
    const CoreOut& out = twin.out();
    if (out.armed && seen.armed < 0) seen.armed = cycle;
    if (cycle > kSettled && seen.beyond < 0 && std::abs(current_a) > 24) seen.beyond = cycle;
    if (seen.armed >= 0 && seen.off < 0 && cycle > kSettled && out.gates == 0 &&
        !out.gates_enable) {
      seen.off = cycle;
    }
    seen.peak_a = std::max(seen.peak_a, std::abs(current_a));
    if (cycle > kSettled - 20'000 && cycle <= kSettled) {
      seen.sum_a += current_a;
      ++seen.results;
    }
    seen.reference_a = std::ldexp(out.current_ref, -D::f.current.fraction);
    seen.last = out;
    ++cycle;
    return static_cast<const char*>(nullptr);
  });
  return seen;
}

}  // namespace

TEST_CASE("loop: the current is that of the reference, whatever the resistance") {
  for (const double ohm : {0.42, 0.504, 0.336}) {
    for (const double torque_nm : {0.2, -0.4}) {
      Rig rig;
      rig.ohm = ohm;
      rig.torque_nm = torque_nm;
      const Seen seen = run(rig, kSettled + 100);
      INFO(ohm << " ohm, " << torque_nm << " Nm");
      REQUIRE(seen.last.armed);
      CHECK(std::abs(seen.reference_a - torque_nm / 0.0302) < 0.01);
      const double mean_a = seen.sum_a / static_cast<double>(seen.results);
      CHECK(std::abs(mean_a - seen.reference_a) < 0.003 * std::abs(seen.reference_a));
      CHECK(std::abs(seen.last.current * kLsb - seen.reference_a) < 0.1);
    }
  }
}

TEST_CASE("loop: a negative limit of the duty is 0") {
  Rig rig;
  rig.duty_limit = 0x80000000;
  const Seen seen = run(rig, kSettled + 100);
  CHECK(seen.last.armed);
  CHECK(seen.peak_a < 0.01);
}

TEST_CASE("loop: a short closes the gates within 5 us of the over-current") {
  for (const double torque_nm : {0.4, -0.4}) {
    Rig rig;
    rig.torque_nm = torque_nm;
    rig.event = Rig::Event::shorted;
    const Seen seen = run(rig, kSettled + 4'000);
    REQUIRE(seen.beyond > 0);
    REQUIRE(seen.off > seen.beyond);
    CHECK(seen.off - seen.beyond <= 250);
    CHECK(seen.last.faults == fault_bit(Fault::current));
    CHECK(seen.last.first_fault == static_cast<unsigned>(Fault::current));
  }
}

TEST_CASE("loop: a line that stands closes the gates") {
  Rig rig;
  rig.event = Rig::Event::stands;
  const Seen seen = run(rig, kSettled + 4'000);
  REQUIRE(seen.off > 0);
  CHECK(seen.off - kSettled < 300 * 4);
  CHECK(seen.last.faults == fault_bit(Fault::current));
}

TEST_CASE("loop: a request waits for the offset, of two averages") {
  constexpr std::int64_t averages = 2 * 256 * D::pwm_period;
  Rig rig;
  rig.early = true;
  const Seen seen = run(rig, kArmed);
  CHECK(seen.armed > averages - 2 * D::pwm_period);
  CHECK(seen.armed < averages + 2 * D::pwm_period);
  CHECK(seen.last.faults == 0);
}
