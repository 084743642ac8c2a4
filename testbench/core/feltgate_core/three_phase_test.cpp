// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core with three phases, RTL against twin in every clock, with a sensor at its pins. What the
// gates do is judged by vectors in double from the shaft's angle. Documentation:
// docs/blocks/three_phase.md
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>

#include "core_life.hpp"
#include "figures_record.hpp"
#include "sim/backends/absolute_sensor.hpp"
#include "sim/backends/rtl_model.hpp"
#include "twins.hpp"

using namespace feltgate::test;
using feltgate::AbsoluteSensor;
using feltgate::CoreIn;
using feltgate::CoreOut;
using feltgate::Fault;
using feltgate::fault_bit;
using D = feltgate::test::Design;
using Vector = std::complex<double>;

namespace {

static_assert(D::phases == 3);
constexpr int kPeriod = D::pwm_period;
constexpr double kPi = 3.14159265358979323846, kPairs = 11, kSupply_v = 5.0;
/// Armed, and the first reading, sample and period are over.
constexpr std::int64_t kArm = 3'000, kReady = kArm + 3 * kPeriod;
constexpr double kClock_s = 1.0 / D::clock_hz;

Vector turned(double rad) { return std::polar(1.0, rad); }
std::uint32_t turns(double t) {
  return static_cast<std::uint32_t>(std::llround(std::ldexp(t, 32)));
}

/// What the six gates of all clocks of one PWM period say.
struct Period {
  std::array<int, 6> on{};
  /// Clocks of a leg's high switch without its dead time; both edges lose as much.
  double leg(std::size_t l) const { return 0.5 * (on[2 * l] - on[2 * l + 1] + kPeriod); }
  /// Amplitude and angle of the voltages, in clocks; of a phase to the star point.
  Vector vector() const {
    return 2.0 / 3 * (leg(0) + leg(1) * turned(2 * kPi / 3) + leg(2) * turned(4 * kPi / 3));
  }
};

/// A host that arms direct voltage, a shaft with a sensor, and a meter at the gates.
struct Rig {
  double volt = 1.5, start_rad = 0, rad_s = 0, offset_turns = 0;
  bool gain = true, reversed = false;
  std::int64_t zero_at = -1;
  std::function<void(Rig&, std::int64_t)> more = [](Rig&, std::int64_t) {};  ///< of the host

  AbsoluteSensor sensor{feltgate::test::absolute_parameters<D>()};
  CoreIn in;

  static constexpr std::uint32_t kRest = kHost | 2u << C::control_mode;
  std::uint32_t rest() const { return kRest ^ (reversed ? 1u << C::control_motor_polarity : 0); }
  static std::uint32_t word(double v) {
    return low(std::llround(std::ldexp(v, D::f.voltage.fraction)));
  }
  void write(std::int64_t cycle, std::int64_t from, int address, std::uint32_t data) {
    if (cycle == from) {
      in.reg_addr = static_cast<std::uint16_t>(address);
      in.reg_wdata = data;
      in.reg_write = true;
    }
    if (cycle == from + kTick) in.reg_write = false;
  }
  CoreIn operator()(std::int64_t cycle, const CoreOut& out) {
    write(cycle, 100, A::self_test_pulse, 0);
    write(cycle, 300, A::voltage_step, word(4));
    write(cycle, 500, A::voltage_setpoint, word(volt));
    write(cycle, 700, A::commutation_offset, turns(offset_turns));
    if (!gain) write(cycle, 900, A::commutation_gain, 0);
    write(cycle, 1100, C::control, rest());
    write(cycle, kArm, C::control, rest() | 1u << C::control_arm);
    more(*this, cycle);
    in.set_zero = zero_at >= 0 && cycle >= zero_at && cycle < zero_at + kTick;
    const double rad = shaft_rad(cycle);
    sensor.turn(rad, rad, cycle, 1);
    in.encoder_data = sensor.pin(cycle, out.serial);
    return in;
  }
  double shaft_rad(std::int64_t cycle) const {
    return start_rad + rad_s * static_cast<double>(cycle) * kClock_s;
  }
};

using Each = std::function<void(std::int64_t, const CoreOut&)>;

/// RTL and twin.
void run(const Rig& rig, std::int64_t clocks, const Each& each) {
  beside(rig, clocks,
         [&](const Rig&, std::int64_t cycle, const CoreOut& out) { each(cycle, out); });
}

/// The last whole PWM period's worth of clocks.
Period last_period(const Rig& rig, std::int64_t clocks, CoreOut* last = nullptr) {
  Period p;
  run(rig, clocks, [&](std::int64_t cycle, const CoreOut& out) {
    if (cycle >= clocks - kPeriod) {
      for (std::size_t g = 0; g < 6; ++g) p.on[g] += (out.gates >> g) & 1;
    }
    if (last != nullptr) *last = out;
  });
  return p;
}

/// Half a clock of rounding, and a bit of the table: docs/blocks/three_phase.md.
double allowed(double length) { return 0.5 + 3e-4 * length; }

}  // namespace

TEST_CASE("three: the voltages' vector is that of shaft, offset and duty") {
  const double whole_v = kSupply_v / std::sqrt(3.0);  // of a duty of a whole period, at a phase
  int turn = 0;
  for (const double volt : {2.0, -1.3, 0.7}) {
    for (const bool reversed : {false, true}) {
      for (const double offset : {0.0, 0.37}) {
        Rig rig;
        rig.volt = volt;
        rig.reversed = reversed;
        rig.offset_turns = offset;
        rig.start_rad = -3.0 + 0.53 * turn++;
        CoreOut last;
        const Vector seen = last_period(rig, kReady + 2 * kPeriod, &last).vector();
        CAPTURE(volt, reversed, offset, rig.start_rad, seen);
        REQUIRE(last.armed);
        CHECK(std::abs(last.duty_active - volt / whole_v * kPeriod) <= 1);
        // The angle is that of the sensor's count.
        const double shown_rad = std::floor(rig.start_rad / D::count_rad) * D::count_rad;
        Vector wanted =
            last.duty_active / std::sqrt(3.0) * turned(kPairs * shown_rad + 2 * kPi * offset);
        if (reversed) wanted = std::conj(wanted);  // B and C change places
        CHECK(std::abs(seen - wanted) < allowed(std::abs(wanted)));
      }
    }
  }
}

TEST_CASE("three: with a gain of 0 the angle is the offset, wherever the shaft is") {
  for (const double rad : {0.4, 2.9}) {
    Rig rig;
    rig.gain = false;
    rig.start_rad = rad;
    rig.offset_turns = 0.6;
    CoreOut last;
    const Vector seen = last_period(rig, kReady + 2 * kPeriod, &last).vector();
    const Vector wanted = last.duty_active / std::sqrt(3.0) * turned(2 * kPi * 0.6);
    CHECK(std::abs(seen - wanted) < allowed(std::abs(wanted)));
  }
}

TEST_CASE("three: a new offset acts while armed") {
  Rig rig;
  rig.start_rad = 1;
  rig.more = [](Rig& r, std::int64_t cycle) {
    r.write(cycle, kReady, A::commutation_offset, turns(0.8));
  };
  CoreOut last;
  const Vector seen = last_period(rig, kReady + 4 * kPeriod, &last).vector();
  const Vector wanted = last.duty_active / std::sqrt(3.0) *
                        turned(kPairs * std::floor(1 / D::count_rad) * D::count_rad + 1.6 * kPi);
  CHECK(std::abs(seen - wanted) < allowed(std::abs(wanted)));
}

TEST_CASE("three: how old the angle is that the voltages have") {
  // From the start of a reading to the middle of the PWM period that has its angle: 300 clocks of
  // reading, up to the time between two to the sample, 85 to the on-times, 3 to the gates, and half
  // a period.
  constexpr int kReadings = D::absolute_period * D::clocks_per_tick;
  std::string table =
      "| speed, rad/s | the angle is old by, us | electrical degrees |\n|---|---|---|\n";
  for (const double rad_s : {60.0, -60.0}) {
    Rig rig;
    rig.volt = rad_s > 0 ? 2.4 : -2.4;
    rig.rad_s = rad_s;
    constexpr int kPeriods = 48;
    static_assert(kPeriods * kPeriod % kReadings == 0);
    Period p;
    double sum = 0;
    int n = 0;
    run(rig, kReady + kPeriod * (kPeriods + 1), [&](std::int64_t cycle, const CoreOut& out) {
      if (cycle < kReady) return;
      for (std::size_t g = 0; g < 6; ++g) p.on[g] += (out.gates >> g) & 1;
      if ((cycle - kReady) % kPeriod != kPeriod - 1) return;
      const double middle_rad = kPairs * rig.shaft_rad(cycle - kPeriod / 2);
      const double sign = rad_s > 0 ? 1 : -1;
      const double behind = std::arg(sign * turned(middle_rad) / p.vector());
      if (n++ > 0) sum += behind;
      p = {};
      REQUIRE(out.armed);
    });
    const double age_s = sum / (n - 1) / (kPairs * rad_s), age_clocks = age_s / kClock_s;
    CAPTURE(rad_s, age_clocks);
    // Half a count is 0.0105 electrical degrees of truncation: up to 290 clocks at this speed.
    const double count_clocks = D::count_rad / std::abs(rad_s) / kClock_s;
    const double truncation = rad_s > 0 ? 0.5 * count_clocks : -0.5 * count_clocks;
    CHECK(age_clocks - truncation > 300 + 85 + 3 + kPeriod / 2);
    CHECK(age_clocks - truncation < 300 + kReadings + 85 + 3 + kPeriod / 2 + 30);
    table += fmt::format(
        "| {:g} | {:.1f} | {:.2f} |\n", rad_s, 1e6 * (age_clocks - truncation) * kClock_s,
        (age_clocks - truncation) * kClock_s * std::abs(rad_s) * kPairs * 180 / kPi);
  }
  check_figures("feltgate_core_three", table);
}

TEST_CASE("three: a zero of the position does not move the voltages") {
  Rig rig;
  rig.start_rad = 2;
  CoreOut before, after;
  const Vector was = last_period(rig, kReady + 4 * kPeriod, &before).vector();
  rig.zero_at = kReady;
  const Vector is = last_period(rig, kReady + 4 * kPeriod, &after).vector();
  CHECK(before.position != 0);
  CHECK(after.position == 0);
  CHECK(is == was);
}

TEST_CASE("three: arming again begins without the last arming's voltages") {
  for (int k = 0; k < 40; ++k) {
    Rig rig;
    const std::int64_t at = kReady + 26 * k;
    rig.more = [at](Rig& r, std::int64_t cycle) {
      r.write(cycle, at, A::voltage_setpoint, 0);
      r.write(cycle, at + 2 * kTick, C::control, r.rest());
      r.write(cycle, at + 3 * kTick, C::control, r.rest() | 1u << C::control_arm);
    };
    bool disarmed = false, again = false;
    run(rig, at + 4 * kTick + 3 * kPeriod, [&](std::int64_t cycle, const CoreOut& out) {
      if (cycle < at) return;
      disarmed = disarmed || !out.armed;
      again = again || (disarmed && out.armed);
      if (!again) return;
      // All low or all high but for the dead time: no leg differs from another.
      const unsigned hi = out.gates & 21u, lo = out.gates & 42u;
      REQUIRE((hi == 0 || hi == 21u));
      REQUIRE((lo == 0 || lo == 42u));
      REQUIRE(out.duty_active == 0);
    });
    REQUIRE(again);
  }
}

TEST_CASE("three: a stop between the edges closes all six gates, and needs no clock") {
  unsigned seen = 0;
  for (int later = 0; later < 2 * kPeriod; later += 90) {
    Rig rig;
    rig.start_rad = 0.7;
    feltgate::RtlModel<Vfeltgate_core> rtl(3);
    feltgate::drive_inputs(*rtl, feltgate::test::port_bits<D>(), {});
    rtl.reset(4);
    CoreOut out;
    for (std::int64_t cycle = 0; cycle < kReady + later; ++cycle) {
      const CoreIn in = rig(cycle, out);
      feltgate::drive_inputs(*rtl, feltgate::test::port_bits<D>(), in);
      rtl.clock();
      out = feltgate::read_outputs(*rtl, feltgate::test::port_bits<D>());
    }
    REQUIRE(out.armed);
    seen |= out.gates;
    rtl->stop_i = 1;
    rtl->eval();
    CHECK(feltgate::read_outputs(*rtl, feltgate::test::port_bits<D>()).gates == 0);
    rtl->stop_i = 0;
    rtl->eval();
    CHECK(feltgate::read_outputs(*rtl, feltgate::test::port_bits<D>()).gates == 0);  // latched
    for (int k = 0; k < 100; ++k) {
      rtl.clock();
      CHECK(feltgate::read_outputs(*rtl, feltgate::test::port_bits<D>()).gates == 0);
    }
    CHECK(feltgate::read_outputs(*rtl, feltgate::test::port_bits<D>()).faults ==
          fault_bit(Fault::stop));
  }
  CHECK(seen == 63u);
}

TEST_CASE("three: a cut sensor closes the gates") {
  Rig rig;
  rig.more = [](Rig& r, std::int64_t cycle) {
    if (cycle == kReady) r.sensor.set(AbsoluteSensor::Defect::cut);
  };
  std::int64_t off = -1;
  run(rig, kReady + 20'000, [&](std::int64_t cycle, const CoreOut& out) {
    if (cycle > kReady && off < 0 && out.gates == 0 && !out.gates_enable) {
      off = cycle;
      CHECK(out.faults == fault_bit(Fault::encoder));
    }
    if (off >= 0) REQUIRE(out.gates == 0);
  });
  CHECK(off > kReady);
}
