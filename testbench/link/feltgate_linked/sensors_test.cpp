// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate_linked of a design with a current loop, with an absolute encoder, with that and three
// phases or both, or with Hall lines: RTL against twin on every clock with a modulator and a
// winding, a sensor, that and two modulators, or the lines at its pins.
// What happens is judged in plain numbers. Documentation: docs/link.md
#include <array>
#include <cmath>
#include <complex>

#include "catch.hpp"
#include "feltgate_linked_twin.hpp"
#include "sim/backends/absolute_sensor.hpp"
#include "sim/plant/parameters.hpp"
#include "sim/plant/sigma_delta.hpp"
#include "twins.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

/// Clock, counted from power-up, of the first and the last time; -1: never.
struct When {
  std::int64_t first = -1, last = -1;
  void at(std::int64_t clock) {
    if (first < 0) first = clock;
    last = clock;
  }
};

/// What was seen at the twin's pins, which are the RTL's.
struct Seen {
  When enabled, fault, current_clock, beat, select, serial, command;
  unsigned first_fault = 0;
  std::int64_t modulator_clocks = 0, beats = 0, third_leg = 0;
  std::int32_t position = 0;
  double current = 0;  ///< measured, at the end; share of full scale
};

struct Watch {
  Seen* seen;
  bool clock_was = false, beat_was = false, serial_was = false;
  int third_was = 0;
  std::int64_t cycle = 0;

  const char* operator()(const LinkedIn&, const Vfeltgate_linked&, const Twin& twin, bool) {
    const CoreOut& out = twin.out().core;
    if (out.gates_enable) seen->enabled.at(cycle);
    seen->current = std::ldexp(out.current, 1 - D::f.current.width());
    if (out.first_fault != 0) seen->fault.at(cycle), seen->first_fault = out.first_fault;
    if (out.current_clock && !clock_was) ++seen->modulator_clocks, seen->current_clock.at(cycle);
    if (out.heartbeat != beat_was) ++seen->beats, seen->beat.at(cycle);
    if ((out.serial & 1U) == 0) seen->select.at(cycle);
    if (((out.serial >> 1 & 1U) != 0) != serial_was) seen->serial.at(cycle);
    if ((out.serial >> 2 & 1U) != 0) seen->command.at(cycle);
    clock_was = out.current_clock;
    beat_was = out.heartbeat;
    serial_was = (out.serial >> 1 & 1U) != 0;
    if (out.gates >> 4 != third_was) ++seen->third_leg;
    third_was = out.gates >> 4;
    seen->position = out.position;
    ++cycle;
    return nullptr;
  }
};

template <class Rig>
Seen seen_of(const Rig& rig, std::int64_t clocks) {
  Seen seen;
  Bench bench("feltgate_linked", 5);
  bench.run(rig, clocks, {}, Watch{&seen});
  return seen;
}

/// What a panel does: it arms the damper at `arm_at`.
struct Panel {
  std::int64_t arm_at = 0;
  LinkedIn in;
  void press(std::int64_t cycle) {
    in.scene = static_cast<std::uint8_t>(D::S::damper);
    in.arm = cycle >= arm_at;
  }
};

}  // namespace

#ifdef CURRENT
static_assert(D::current_loop != 0);
namespace {

constexpr std::int64_t kArm = 520'000, kEvent = kArm + 60'000, kEnd = kEvent + 10'000;

/// A winding that the gates switch, with its modulator. From `at` on something may happen.
struct Rig : Panel {
  enum class Event { none, cut, grounded, driver, driver_unplugged };
  Event event = Event::none;
  std::int64_t at = kEvent;
  plant::SigmaDelta modulator{32.0};
  double shown_a = 0;  ///< if not 0, what the modulator shows from `at` on
  double current_a = 0;
  bool clock_was = false;

  explicit Rig(Event e = Event::none, std::int64_t when = kEvent) : event(e), at(when) {
    arm_at = kArm;
  }
  LinkedIn operator()(std::int64_t cycle, const LinkedOut& out) {
    press(cycle);
    const unsigned gates = out.core.gates;
    const auto leg = [&](unsigned hi, unsigned lo, bool outwards) {
      return (gates & hi) != 0                                  ? 24.0
             : (gates & lo) != 0 || outwards == (current_a > 0) ? 0.0
                                                                : 24.0;
    };
    const bool off = gates == 0 && std::abs(current_a) < 0.01;
    const double volts = off ? 0 : leg(1, 2, true) - leg(4, 8, false);
    current_a += (volts - 0.42 * current_a) * 20e-9 / 82e-6;
    const bool happens = cycle >= at;
    const double seen_a = happens && shown_a != 0 ? shown_a : current_a;
    if (out.core.current_clock && !clock_was) in.current_data = modulator.next(seen_a);
    clock_was = out.core.current_clock;
    if (happens && event == Event::cut) in.current_data = true;  // pulled up
    if (happens && event == Event::grounded) in.current_data = false;
    in.driver_fault =
        happens && (event == Event::driver_unplugged || (event == Event::driver && cycle < at + 3));
    in.encoder_data = (cycle / 7 & 1) != 0;  // not an option of this design
    return in;
  }
};

}  // namespace

TEST_CASE("sensors: the modulator's bits are the current, the heart beats") {
  const Seen seen = seen_of(Rig(), kEnd);
  CHECK(seen.enabled.first > kArm);
  CHECK(seen.enabled.first < kArm + 2'000);
  CHECK(seen.enabled.last == kEnd - 1);
  CHECK(seen.fault.first < 0);
  // 12.5 MHz of 50 MHz; a beat in 512 ticks of 50 clocks.
  CHECK(std::abs(seen.modulator_clocks - kEnd / 4) <= 2);
  CHECK(std::abs(seen.beats - kEnd / (512 * 50)) <= 1);
  CHECK(32 * seen.current == Approx(0).margin(0.1));
  for (const double shown_a : {5.0, -3.0}) {
    Rig rig;
    rig.shown_a = shown_a;
    CHECK(32 * seen_of(rig, kEnd).current == Approx(shown_a).epsilon(0.02));
  }
}

TEST_CASE("sensors: a modulator that is cut or grounded is a fault, and cannot be armed") {
  for (const Rig::Event event : {Rig::Event::cut, Rig::Event::grounded}) {
    const Seen seen = seen_of(Rig(event), kEnd);
    CHECK(seen.enabled.first > 0);
    CHECK(seen.first_fault == static_cast<unsigned>(Fault::current));
    CHECK(seen.enabled.last - kEvent < 1'100);  // 20.5 us, and some
    CHECK(kEnd - seen.beat.last > 5'000);       // the heart stands in a fault
  }
  CHECK(seen_of(Rig(Rig::Event::cut, 0), kEnd).enabled.first < 0);
}

TEST_CASE("sensors: a fault of the driver closes the gates, an unplugged driver cannot be armed") {
  const Seen seen = seen_of(Rig(Rig::Event::driver), kEnd);
  CHECK(seen.enabled.first > 0);
  CHECK(seen.first_fault == static_cast<unsigned>(Fault::current));
  CHECK(seen.enabled.last - kEvent <= 6);
  CHECK(seen_of(Rig(Rig::Event::driver_unplugged, 0), kEnd).enabled.first < 0);
}
#elif defined(GIMBAL_CURRENT)
static_assert(D::current_loop != 0 && D::phases == 3 && D::absolute_encoder != 0);
namespace {

constexpr std::int64_t kArm = 520'000, kEvent = kArm + 20'000, kEnd = kEvent + 10'000;
constexpr double kRad = 0.9;

/// A shaft at rest with its sensor, and two modulators, which show something from kEvent on.
struct Rig : Panel {
  std::array<double, 2> shown{};  ///< shares of full scale, of A and of B
  unsigned high = 0, low = 0;     ///< lines that stand, by the bits of current_data
  AbsoluteSensor sensor{test::absolute_parameters<D>()};
  std::array<plant::SigmaDelta, 2> modulators{plant::SigmaDelta(), plant::SigmaDelta()};
  bool clock_was = false;

  LinkedIn operator()(std::int64_t cycle, const LinkedOut& out) {
    arm_at = kArm;
    press(cycle);
    sensor.turn(kRad, kRad, cycle, 1);
    in.encoder_data = sensor.pin(cycle, out.core.serial);
    const bool happens = cycle >= kEvent;
    if (out.core.current_clock && !clock_was) {
      const bool a = modulators[0].next(happens ? shown[0] : 0);
      const bool b = modulators[1].next(happens ? shown[1] : 0);
      in.current_data = static_cast<std::uint8_t>(a | b << 1);
    }
    clock_was = out.core.current_clock;
    if (happens) in.current_data = static_cast<std::uint8_t>((in.current_data | high) & ~low);
    return in;
  }
};

}  // namespace

TEST_CASE("sensors: the bits of both modulators are the current along the rotor's axis") {
  const double e = 11 * kRad;  // pole pairs
  for (const auto& shown : {std::array{0.3, 0.1}, std::array{-0.1, 0.25}}) {
    Rig rig;
    rig.shown = shown;
    const Seen seen = seen_of(rig, kEnd);
    CHECK(seen.enabled.first > kArm);
    CHECK(seen.enabled.last == kEnd - 1);
    const double across = (shown[0] + 2 * shown[1]) / std::sqrt(3.0);
    const double along = shown[0] * std::cos(e) + across * std::sin(e);
    CHECK(seen.current == Approx(along).margin(0.005));
  }
}

TEST_CASE("sensors: either modulator that is cut or grounded is a fault") {
  for (const unsigned line : {1U, 2U}) {
    Rig rig;
    (line == 1 ? rig.high : rig.low) = line;
    const Seen seen = seen_of(rig, kEnd);
    CHECK(seen.enabled.first > 0);
    CHECK(seen.first_fault == static_cast<unsigned>(Fault::current));
    CHECK(seen.enabled.last - kEvent < 1'100);
  }
}
#elif defined(HALL_MOTOR)
static_assert(D::hall != 0 && D::phases == 3);
namespace {

constexpr std::int64_t kArm = 20'000, kEvent = 60'000, kTurn = 196'350, kEnd = kEvent + kTurn;
constexpr double kPairs = 8, kRad_s = 200, kBegin = -2.0943951;

/// A shaft that turns by itself, its encoder and its Hall lines, which something happens to.
struct Rig : Panel {
  unsigned high = 0, low = 0;  ///< lines that stand from `at` on
  bool exchanged = false;      ///< lines 1 and 2
  std::int64_t at = kEvent;
  double from_rad = 0.3;                   ///< electrical
  std::complex<double>* vector = nullptr;  ///< of the legs, turned back by the rotor's angle

  LinkedIn operator()(std::int64_t cycle, const LinkedOut& out) {
    arm_at = kArm;
    press(cycle);
    const double turned_rad = kRad_s * static_cast<double>(cycle) * 20e-9;
    const double e = from_rad + kPairs * turned_rad;
    in.encoder = pins_at(static_cast<unsigned>(turned_rad / D::count_rad));
    unsigned code = plant::HallLines{kBegin, {}}.code(e);
    if (exchanged) code = (code & 1u) | (code & 2u) << 1 | (code & 4u) >> 1;
    if (cycle >= at) code = (code | high) & ~low;
    in.hall = static_cast<std::uint8_t>(code);
    for (unsigned leg = 0; vector != nullptr && cycle >= kEvent && leg < 3; ++leg) {
      const double third = 2 * 3.14159265358979 / 3 * leg;
      const double share = (out.core.gates >> 2 * leg & 1u) / static_cast<double>(kTurn);
      *vector += std::polar(share, third - e);
    }
    return in;
  }
};

}  // namespace

TEST_CASE("sensors: Hall lines turn the voltage with the rotor, from any angle at power-up") {
  for (const double from_rad : {0.3, 2.0, 4.4}) {
    Rig rig;
    rig.from_rad = from_rad;
    std::complex<double> vector;
    rig.vector = &vector;
    const Seen seen = seen_of(rig, kEnd);
    CAPTURE(from_rad, vector.real(), vector.imag());
    CHECK(seen.enabled.first > kArm);
    CHECK(seen.enabled.last == kEnd - 1);
    CHECK(seen.fault.first < 0);
    CHECK(seen.position == Approx(kRad_s * kEnd * 20e-9 / D::count_rad).margin(2));
    // Ke w, 4.46 V, less R I at the begin of the ramp and what the dead times give; 1.5 of that
    // over the supply.
    CHECK(vector.real() > 0.18);
    CHECK(vector.real() < 0.22);
    CHECK(std::abs(vector.imag()) < 0.05 * vector.real());
  }
}

TEST_CASE("sensors: a Hall line that is cut or grounded, or two that change places, is a fault") {
  for (unsigned k = 0; k < 4; ++k) {
    Rig rig;
    if (k < 3) (k == 1 ? rig.low : rig.high) = 1u << k;
    rig.exchanged = k == 3;
    const Seen seen = seen_of(rig, kEnd);
    CAPTURE(k, seen.enabled.last);
    CHECK(seen.enabled.first > 0);
    CHECK(seen.first_fault == static_cast<unsigned>(Fault::encoder));
    CHECK(seen.enabled.last < kEnd - 1);
  }
}

TEST_CASE("sensors: without the plug of the Hall lines it cannot be armed") {
  Rig rig;
  rig.high = 7;
  rig.at = 0;
  CHECK(seen_of(rig, 2 * kEvent).enabled.first < 0);
}
#else
static_assert(D::absolute_encoder != 0);
namespace {

using Defect = AbsoluteSensor::Defect;
constexpr std::int64_t kPeriod = 96 * 50, kArm = 6 * kPeriod, kEvent = 30 * kPeriod;
constexpr std::int64_t kEnd = 50 * kPeriod;

/// A shaft that turns by itself, with its sensor, which breaks at `at`.
struct Rig : Panel {
  Defect defect = Defect::none;
  std::int64_t at = kEvent;
  AbsoluteSensor sensor{test::absolute_parameters<D>()};

  explicit Rig(Defect d = Defect::none, std::int64_t when = kEvent) : defect(d), at(when) {
    arm_at = kArm;
  }
  LinkedIn operator()(std::int64_t cycle, const LinkedOut& out) {
    press(cycle);
    const double rad = 1.0 + 5.0 * static_cast<double>(cycle) * 20e-9;
    sensor.turn(rad, rad, cycle, 1);
    if (cycle == at) sensor.set(defect);
    in.encoder_data = sensor.pin(cycle, out.core.serial);
    in.driver_fault = (cycle / 7 & 1) != 0;  // not options of this design
    in.current_data = in.driver_fault;
    in.encoder = pins_at(static_cast<unsigned>(cycle / 999));  // nor is this
    return in;
  }
};

}  // namespace

TEST_CASE("sensors: the sensor's angle is the position") {
  const Seen seen = seen_of(Rig(), kEnd);
  CHECK(seen.enabled.first > kArm);
  CHECK(seen.enabled.last == kEnd - 1);
  CHECK(seen.fault.first < 0);
  // The angle, at most 0.2 ms old (a diagnosis is read now and then), in counts of 2^-14 turn.
  const double counts = (1.0 + 5.0 * kEnd * 20e-9) * 16384 / (2 * 3.14159265358979);
  CHECK(seen.position < counts + 1);
  CHECK(seen.position > counts - 1 - 5.0 * 0.2e-3 * 16384 / 6.2832);
  CHECK(kEnd - seen.select.last <= kPeriod);
  CHECK(kEnd - seen.serial.last <= kPeriod);
  if (D::absolute_framing == 0) CHECK(kEnd - seen.command.last <= kPeriod);
  // Four changes in each period of the PWM, once armed; without such a leg none.
  const double changes = 4.0 * static_cast<double>(kEnd - seen.enabled.first) / D::pwm_period;
  CHECK(static_cast<double>(seen.third_leg) <= (D::phases == 3 ? changes + 8 : 0));
  CHECK(static_cast<double>(seen.third_leg) >= (D::phases == 3 ? changes - 8 : 0));
}

TEST_CASE("sensors: a cable that is cut or grounded is a fault, and cannot be armed") {
  for (const Defect defect : {Defect::cut, Defect::grounded}) {
    const Seen seen = seen_of(Rig(defect), kEnd);
    CHECK(seen.enabled.first > 0);
    CHECK(seen.first_fault == static_cast<unsigned>(Fault::encoder));
    CHECK(seen.enabled.last - kEvent < 90'000);  // 1.8 ms
  }
  CHECK(seen_of(Rig(Defect::cut, 0), kEnd).enabled.first < 0);
}
#endif
