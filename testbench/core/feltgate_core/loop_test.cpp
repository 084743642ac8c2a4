// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core with a current loop, RTL against twin in every clock, around a winding that its gates
// switch: a torque step, what tau_hat and I2t take, the over-current, a sensor or a driver that
// fails, the heartbeat, what arming waits for.
// Documentation: docs/blocks/current.md
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

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
constexpr double kFull = 32;                                  // A
const double kLsb = std::ldexp(1.0, -D::f.current.fraction);  // A
constexpr std::int64_t kArmed = 520'000, kSettled = kArmed + 60'000;
constexpr std::int64_t kLate = kArmed - 15'000;  // after an early request
constexpr std::int64_t kPart = kSettled - kArmed;
constexpr double kKt = 0.0302;  // Nm/A

/// A host that arms the set-point after the calibration, and the winding with its modulator. From
/// kSettled on something may happen.
struct Rig {
  enum class Event { none, shorted, stands, driver, unseen, late };
  Event event = Event::none;
  double torque_nm = 0.2, ohm = 0.42;
  std::uint32_t duty_limit = word_of_design(A::duty_limit);
  bool early = false;                                ///< asks to be armed before the calibration
  std::uint32_t control = 0;                         ///< further bits of the control word
  std::vector<std::pair<int, std::uint32_t>> words;  ///< further ones, before arming
  std::vector<std::pair<double, double>> parts;      ///< ohm and Nm, one after the other

  feltgate::plant::SigmaDelta modulator{kFull};
  double current_a = 0;
  CoreIn in;
  bool clock_was = false;

  CoreIn operator()(std::int64_t cycle, const CoreOut& out) {
    if (const auto part = static_cast<std::size_t>((cycle - kArmed) / kPart);
        cycle >= kArmed && part < parts.size()) {
      std::tie(ohm, torque_nm) = parts[part];
    }
    host(cycle);
    const bool happens = cycle > kSettled;
    const double henry = happens && event == Event::shorted ? 4e-6 : 82e-6;
    const double r = happens && event == Event::shorted ? 0.05 : ohm;
    current_a += (bridge_v(out.gates) - r * current_a) * 20e-9 / henry;
    if (out.current_clock && !clock_was)
      in.current_data = modulator.next(happens && event == Event::unseen ? 0 : current_a);
    clock_was = out.current_clock;
    if (happens && event == Event::stands) in.current_data = false;
    if (cycle < kLate && event == Event::late) in.current_data = true;
    in.driver_fault = happens && event == Event::driver && cycle < kSettled + 3;
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
    const auto given = control | static_cast<std::uint32_t>(D::S::setpoint) << C::control_scene;
    const std::int64_t arm_at = early ? kArmed - 20'000 : kArmed;
    const auto write = [&](std::int64_t at, int address, std::uint32_t word) {
      write_at(&in, cycle, at, address, word);
    };
    write(1'000, A::self_test_pulse, 0);
    write(2'000, A::ramp_step, 0x7ffffff);
    const std::uint32_t torque = low(std::llround(std::ldexp(torque_nm, D::f.torque.fraction)));
    write(3'000, A::setpoint_torque, torque);
    write(4'000, C::control, kHost | given);
    write(5'000, A::duty_limit, duty_limit);
    std::int64_t at = 6'000;
    for (const auto& [address, word] : words) write(std::exchange(at, at + 1'000), address, word);
    write(arm_at, C::control, kHost | given | 1u << C::control_arm);
    for (std::size_t n = 0; n < parts.size(); ++n) {
      write(kArmed + kTick + 1 + static_cast<std::int64_t>(n) * kPart, A::setpoint_torque, torque);
    }
  }
};

/// The end of a part.
struct Part {
  double mean_a = 0, reference_a = 0, measured_a = 0;
};

/// Clocks of events; the mean of the current in the 20'000 clocks before `clocks` or, with an
/// event, before it; the sum of its square over the armed ticks.
struct Seen {
  std::vector<Part> parts;
  std::int64_t armed = -1, beyond = -1, off = -1, beats = 0;
  double mean_a = 0, reference_a = 0, peak_a = 0, squares_a2 = 0, tau_hat_nm = 0;
  std::uint32_t faults_word = 0, status_word = 0;
  CoreOut last;
};

Seen run(const Rig& rig, std::int64_t clocks) {
  const std::int64_t until = rig.event == Rig::Event::none ? clocks : kSettled;
  Seen seen;
  beside(rig, clocks, [&](const Rig& live, std::int64_t cycle, const CoreOut& out) {
    const double current_a = live.current_a;
    if (out.armed && seen.armed < 0) seen.armed = cycle;
    if (cycle > kSettled && seen.beyond < 0 && std::abs(current_a) > 24) seen.beyond = cycle;
    if (seen.armed >= 0 && seen.off < 0 && cycle > kSettled && out.gates == 0 &&
        !out.gates_enable) {
      seen.off = cycle;
    }
    seen.peak_a = std::max(seen.peak_a, std::abs(current_a));
    if (cycle >= until - 20'000 && cycle < until) seen.mean_a += current_a / 20'000;
    if (const std::int64_t at = (cycle - kArmed) % kPart; cycle > kArmed && at >= kPart - 20'000) {
      if (at == kPart - 20'000) seen.parts.emplace_back();
      Part& part = seen.parts.back();
      part.mean_a += current_a / 20'000;
      part.reference_a = std::ldexp(out.current_ref, -D::f.current.fraction);
      part.measured_a = out.current * kLsb;
    }
    if (seen.armed >= 0 && seen.off < 0) seen.squares_a2 += current_a * current_a / kTick;
    if (out.heartbeat != seen.last.heartbeat) ++seen.beats;
    if (out.word_valid && out.word_slot == feltgate::Map::R::faults)
      seen.faults_word = out.word_data;
    if (out.word_valid && out.word_slot == feltgate::Map::R::status)
      seen.status_word = out.word_data;
    seen.tau_hat_nm = std::ldexp(out.tau_hat, -D::f.torque.fraction);
    seen.reference_a = std::ldexp(out.current_ref, -D::f.current.fraction);
    seen.last = out;
  });
  return seen;
}

}  // namespace

TEST_CASE("loop: the current is that of the reference, whatever the resistance") {
  Rig rig;
  rig.parts = {{0.42, 0.2}, {0.42, -0.4}, {0.504, 0.2}, {0.504, -0.4}, {0.336, 0.2}, {0.336, -0.4}};
  const Seen seen = run(rig, kArmed + static_cast<std::int64_t>(rig.parts.size()) * kPart);
  REQUIRE(seen.last.armed);
  REQUIRE(seen.parts.size() == rig.parts.size());
  for (std::size_t n = 0; n < rig.parts.size(); ++n) {
    const auto& [ohm, torque_nm] = rig.parts[n];
    const Part& part = seen.parts[n];
    INFO(ohm << " ohm, " << torque_nm << " Nm");
    CHECK(std::abs(part.reference_a - torque_nm / kKt) < 0.01);
    CHECK(std::abs(part.mean_a - part.reference_a) < 0.003 * std::abs(part.reference_a));
    CHECK(std::abs(part.measured_a - part.reference_a) < 0.1);
  }
}

TEST_CASE("loop: a motor that is connected the other way round") {
  Rig rig;
  rig.control = 1u << C::control_motor_polarity;
  const Seen seen = run(rig, kSettled + 100);
  REQUIRE(seen.last.armed);
  CHECK(std::abs(seen.mean_a + seen.reference_a) < 0.003 * seen.reference_a);
  CHECK(std::abs(seen.last.current * kLsb - seen.reference_a) < 0.1);
}

/// Voltage mode at this voltage.
Rig direct(double voltage_v, double ohm) {
  Rig rig;
  rig.ohm = ohm;
  rig.control = static_cast<std::uint32_t>(feltgate::Map::mode_voltage) << C::control_mode;
  rig.words = {
      {A::voltage_setpoint, low(std::llround(std::ldexp(voltage_v, D::f.voltage.fraction)))},
      {A::voltage_step, (1u << (D::f.voltage.width() - 1)) - 1}};
  return rig;
}

TEST_CASE("loop: tau_hat is of the measured current, not of the command") {
  Rig limited;  // to 4 A of 6.6 A
  limited.duty_limit = 95;
  for (const Rig& rig : {limited, direct(2.4, 0.504), direct(-2.4, 0.25)}) {
    const Seen seen = run(rig, kArmed + 700'000);
    REQUIRE(seen.last.armed);
    CHECK(std::abs(seen.mean_a) > 3);
    CHECK(std::abs(seen.mean_a - seen.reference_a) > 0.15 * std::abs(seen.reference_a));
    CHECK(std::abs(seen.tau_hat_nm - kKt * seen.mean_a) < 0.004 * kKt * std::abs(seen.mean_a));
  }
}

TEST_CASE("loop: I2t is of the measured current") {
  Rig rig = direct(2.4, 0.12);  // by the resistance of the design less than the nominal current
  rig.words.emplace_back(A::i2t_budget, static_cast<std::uint32_t>(D::i2t_start));
  const Seen seen = run(rig, kArmed + 260'000);
  REQUIRE(seen.off > 0);
  CHECK(seen.last.faults == fault_bit(Fault::i2t));
  // From the reset on the heat sinks by the nominal square in each tick.
  const double cooled_a2 =
      std::ldexp(word_of_design(A::nominal_current_squared), -D::f.i2t.fraction) *
      static_cast<double>(seen.off) / kTick;
  CHECK(std::abs(seen.squares_a2 / cooled_a2 - 1) < 0.02);  // in the rise a period late
}

TEST_CASE("loop: a fault of the driver closes the gates, and is kept; the heart beats until then") {
  Rig rig;
  rig.event = Rig::Event::driver;
  const Seen seen = run(rig, kSettled + 60'000);
  REQUIRE(seen.off > 0);
  CHECK(seen.off - kSettled <= 6);
  CHECK(seen.last.faults == fault_bit(Fault::current));
  CHECK(seen.faults_word >> C::faults_current == 0);
  CHECK((seen.status_word >> C::status_driver_fault & 1u) == 1);
  CHECK(seen.beats == kSettled / kTick / 512);
}

TEST_CASE("loop: wires off the shunt close the gates") {
  for (const double torque_nm : {0.5, -0.1, 0.005}) {
    Rig rig;
    rig.torque_nm = torque_nm;
    rig.event = Rig::Event::unseen;
    // The integrator grows by 10.5 % of R times the current that is asked for in each period.
    const int periods = 20 + static_cast<int>(2.5 / std::abs(torque_nm));
    const Seen seen = run(rig, kSettled + D::pwm_period * periods);
    CAPTURE(torque_nm, seen.off, seen.peak_a);
    REQUIRE(seen.off > kSettled);
    CHECK(seen.peak_a < 2.5 * 16.6);  // with the ripple of a period
    CHECK(seen.last.faults == fault_bit(Fault::current));
    CHECK(seen.faults_word >> C::faults_current == 0);
    CHECK((seen.status_word >> C::status_current_missing & 1u) == 1);
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

TEST_CASE("loop: a modulator that is plugged in after a request to arm opens no gates") {
  Rig rig;
  rig.early = true;
  rig.event = Rig::Event::late;
  const Seen seen = run(rig, kLate + 540'000);
  CHECK(seen.armed < 0);
  // It has its offset by now. What a line that stands looks like is kept until a clear.
  CHECK(seen.faults_word >> C::faults_current == 1);
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
