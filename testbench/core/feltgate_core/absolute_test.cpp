// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core with an absolute encoder, RTL against twin in every clock, with a sensor at its pins:
// the position, what arming waits for, and each defect of the sensor. Documentation:
// docs/blocks/absolute_encoder.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "core_life.hpp"
#include "figures_record.hpp"
#include "sim/backends/absolute_sensor.hpp"
#include "twins.hpp"

using namespace feltgate::test;
using feltgate::AbsoluteSensor;
using feltgate::CoreIn;
using feltgate::CoreOut;
using feltgate::Fault;
using feltgate::fault_bit;
using feltgate::Map;
using D = feltgate::test::Design;
using Defect = AbsoluteSensor::Defect;

namespace {

static_assert(D::absolute_encoder != 0);
constexpr std::int64_t kPeriod = D::absolute_period * std::int64_t{D::clocks_per_tick};
constexpr std::int64_t kArm = 6 * kPeriod, kReady = 20 * kPeriod;
constexpr double kClock_s = 1.0 / D::clock_hz;

/// A host that arms the set-point of 0 Nm, and a shaft with a sensor. At `at` the sensor breaks, at
/// `mended` it is mended, and the host clears the faults and arms again.
struct Rig {
  Defect defect = Defect::none;
  std::int64_t at = kReady, arm_at = kArm, mended = -1, zero_at = -1;
  double start_rad = 0, rad_s = 0, turned_meanwhile_rad = 0;
  bool reversed = false;
  std::int64_t host_at = 400;  ///< the host takes control, with the polarity

  AbsoluteSensor sensor{feltgate::test::absolute_parameters<D>()};
  CoreIn in;

  CoreIn operator()(std::int64_t cycle, const CoreOut& out) {
    host(cycle);
    double rad = start_rad + rad_s * static_cast<double>(cycle) * kClock_s;
    if (cycle > at) rad += turned_meanwhile_rad;
    sensor.turn(rad, rad, cycle, 1);
    if (cycle == at) sensor.set(defect);
    if (cycle == mended) sensor.set(Defect::none);
    in.encoder_data = sensor.pin(cycle, out.serial);
    return in;
  }

 private:
  void host(std::int64_t cycle) {
    constexpr auto scene = static_cast<std::uint32_t>(D::S::setpoint) << C::control_scene;
    const std::uint32_t rest = (kHost | scene) ^ (reversed ? 1u << C::control_encoder_polarity : 0);
    const auto write = [&](std::int64_t from, int address, std::uint32_t word) {
      write_at(&in, cycle, from, address, word);
    };
    write(200, A::self_test_pulse, 0);
    write(host_at, C::control, rest);
    write(arm_at, C::control, rest | 1u << C::control_arm);
    in.set_zero = cycle >= zero_at && cycle < zero_at + kTick;
    if (mended < 0) return;
    write(mended + 4 * kPeriod, C::control, rest);
    write(mended + 5 * kPeriod, C::command, 1u << C::command_clear_faults);
    write(mended + 6 * kPeriod, C::control, rest | 1u << C::control_arm);
  }
};

struct Seen {
  std::int64_t armed = -1, off = -1;
  std::uint32_t named = 0;  ///< faults.absolute in the tick after the gates closed
  std::uint32_t state = 0;  ///< faults.absolute, the last
  double fastest_rad_s = 0;
  CoreOut last;

  void add(std::int64_t cycle, const CoreOut& out) {
    if (out.armed && armed < 0) armed = cycle;
    if (armed >= 0 && off < 0 && !out.gates_enable && out.gates == 0) off = cycle;
    if (out.word_valid && out.word_slot == Map::R::faults)
      state = out.word_data >> C::faults_absolute;
    if (off >= 0 && named == 0) named = state;
    fastest_rad_s =
        std::max(fastest_rad_s,
                 std::abs(std::ldexp(static_cast<double>(out.velocity), -D::f.velocity.fraction)));
    last = out;
  }
};

/// RTL and twin.
Seen run(const Rig& rig, std::int64_t clocks) {
  Seen seen;
  beside(rig, clocks,
         [&](const Rig&, std::int64_t cycle, const CoreOut& out) { seen.add(cycle, out); });
  return seen;
}

/// The twin alone; a copy goes on by itself.
struct Alone {
  Rig rig;
  CoreTwin twin;
  Seen seen;
  std::int64_t cycle = 0;

  void run_to(std::int64_t end) {
    for (; cycle < end && seen.named == 0; ++cycle) {
      twin.clock(rig(cycle, twin.out()));
      seen.add(cycle, twin.out());
    }
  }
};

std::int32_t counts(double rad) {
  return static_cast<std::int32_t>(std::floor(rad / D::count_rad));
}

constexpr Defect kDefects[] = {Defect::cut,       Defect::grounded, Defect::magnet_lost,
                               Defect::wrong_bit, Defect::held,     Defect::half_a_turn_off};

}  // namespace

TEST_CASE("absolute: a request waits for the first reading, whose angle is the position") {
  for (const double rad : {1.0, -2.5}) {
    Rig rig;
    rig.start_rad = rad;
    rig.arm_at = 600;
    const Seen seen = run(rig, kReady);
    // Three readings, of which the first two answer nothing and the diagnosis, and a tick or two.
    CHECK(seen.armed > 2 * kPeriod);
    CHECK(seen.armed < 2 * kPeriod + 10 * kTick);
    CHECK(seen.last.armed);
    CHECK(seen.last.faults == 0);
    CHECK(seen.last.position == counts(rad));
    CHECK(seen.fastest_rad_s == 0);  // no motion brought it there
  }
}

TEST_CASE("absolute: a sensor that is plugged in after a request to arm opens no gates") {
  for (const Defect defect : {Defect::cut, Defect::wrong_bit}) {
    Rig rig;
    rig.defect = defect;
    rig.at = 0;
    rig.mended = kReady;
    Seen seen = run(rig, rig.mended);
    CHECK((seen.state & 31u) != 0);  // it is named; nothing is said to start
    CHECK(seen.state < 32);
    seen = run(rig, rig.mended + 10 * kPeriod);
    CHECK(seen.armed > rig.mended + 6 * kPeriod);  // the host has asked anew
    CHECK(seen.last.armed);
  }
}

TEST_CASE("absolute: the position counts turns in both directions, and from its zero on") {
  for (const double rad_s : {60.0, -400.0}) {
    for (const bool reversed : {false, true}) {
      Rig rig;
      rig.rad_s = rad_s;
      rig.reversed = reversed;
      const std::int64_t end = kReady + 60'000;
      const Seen seen = run(rig, end);
      // The newest reading is between one reading's time and a period more old.
      const double sign = reversed ? -1 : 1, now_rad = rad_s * static_cast<double>(end) * kClock_s;
      const double age_s = (now_rad - sign * seen.last.position * D::count_rad) / rad_s;
      const double count_s = D::count_rad / std::abs(rad_s);
      INFO(rad_s << " rad/s, age " << age_s);
      CHECK(age_s > 3e-6 - count_s);
      CHECK(age_s < kPeriod * kClock_s + 6e-6 + count_s);
      CHECK(seen.last.armed);
    }
  }
  Rig rig;
  rig.start_rad = 1;
  rig.zero_at = kReady;
  CHECK(run(rig, kReady + 5'000).last.position == 0);
}

TEST_CASE("absolute: the polarity stays as it was at the first reading") {
  for (const bool before : {false, true}) {
    Rig rig;
    rig.start_rad = 0.7;
    rig.reversed = true;  // from clock 400 on
    if (!before) rig.host_at = 5 * kPeriod;
    const Seen seen = run(rig, 8 * kPeriod);
    CHECK(std::abs(seen.last.position - (before ? -1 : 1) * counts(0.7)) <= 1);
  }
}

TEST_CASE("absolute: each defect closes the gates within 2 ms and is named") {
  const std::map<Defect, std::uint32_t> names{
      {Defect::cut, 4},       {Defect::grounded, 8}, {Defect::magnet_lost, 4},
      {Defect::wrong_bit, 2}, {Defect::held, 16},    {Defect::half_a_turn_off, 8}};
  for (const Defect defect : kDefects) {
    Rig rig;
    rig.defect = defect;
    rig.start_rad = 0.5;
    rig.rad_s = defect == Defect::held ? 20 : 0;
    rig.at = kReady + 9'973;
    const Seen seen = run(rig, rig.at + 100'000);
    INFO(AbsoluteSensor::defects[static_cast<std::size_t>(defect)]);
    REQUIRE(seen.off > rig.at);
    CHECK(seen.off - rig.at < 100'000);
    CHECK(seen.last.faults == fault_bit(Fault::encoder));
    CHECK(seen.last.first_fault == static_cast<unsigned>(Fault::encoder));
    CHECK(seen.named == names.at(defect));
  }
}

TEST_CASE("absolute: a line at ground reads as the angle 0, near which it is a small step") {
  // The over-speed of 613.6 rad/s makes 59 mrad in a reading; two, noise and the table's slope are
  // up to 0.122 rad. The low-pass of 500 rad/s shows a step at rest as no more speed than this.
  for (const auto& [rad, name] : {std::pair{0.1, 4u}, {-0.1, 4u}, {0.14, 8u}, {-0.14, 8u}}) {
    Rig rig;
    rig.defect = Defect::grounded;
    rig.start_rad = rad;
    const Seen seen = run(rig, rig.at + 100'000);
    INFO(rad << " rad");
    CHECK(seen.off - rig.at < 100'000);
    CHECK(seen.named == name);
    CHECK(seen.fastest_rad_s < 500 * 0.122);
    CHECK((seen.fastest_rad_s == 0) == (name == 8));
  }
}

TEST_CASE("absolute: how long until the gates close, the longest of all moments") {
  std::string table = "| defect of the sensor | gates off, ms |\n|---|---|\n";
  for (const Defect defect : kDefects) {
    std::int64_t longest = 0;
    Alone sound;
    sound.rig.defect = defect;
    sound.rig.start_rad = 0.5;
    sound.rig.rad_s = defect == Defect::held ? 20 : 0;
    sound.rig.at = 1LL << 60;
    // Each diagnosis comes once in 16 readings.
    for (std::int64_t at = kReady; at < kReady + 17 * kPeriod; at += 401) {
      sound.run_to(at);
      Alone broken = sound;
      broken.rig.at = at;
      broken.run_to(at + 110'000);
      REQUIRE(broken.seen.off > at);
      longest = std::max(longest, broken.seen.off - at);
    }
    CHECK(longest < 100'000);
    const auto name = AbsoluteSensor::defects[static_cast<std::size_t>(defect)];
    table +=
        fmt::format("| `{}` | {:.2f} |\n", name, 1e3 * static_cast<double>(longest) * kClock_s);
  }
  check_figures("feltgate_core_absolute", table);
}

TEST_CASE(
    "absolute: while a fault stands the core does not arm; a shaft found elsewhere has not moved") {
  Rig rig;
  rig.defect = Defect::cut;
  rig.turned_meanwhile_rad = 1.5;
  rig.mended = kReady + 40 * kPeriod;
  rig.arm_at = kReady + 20 * kPeriod;  // while it is cut
  Seen seen = run(rig, rig.mended);
  CHECK(seen.armed < 0);
  CHECK(seen.last.faults == 0);
  seen = run(rig, rig.mended + 10 * kPeriod);
  CHECK(seen.armed > rig.mended + 6 * kPeriod);
  CHECK(seen.last.armed);
  CHECK(seen.last.position == counts(1.5));
  CHECK(seen.fastest_rad_s == 0);
}

TEST_CASE(
    "absolute: after a jump while disarmed the core does not arm until the faults are cleared") {
  Rig rig;
  rig.defect = Defect::half_a_turn_off;
  rig.arm_at = kReady + 20 * kPeriod;  // the sensor is steady again, half a turn off
  rig.mended = kReady + 40 * kPeriod;
  Seen seen = run(rig, rig.mended);
  CHECK(seen.armed < 0);
  CHECK(seen.last.faults == 0);
  CHECK(seen.state == 8);
  seen = run(rig, rig.mended + 10 * kPeriod);
  CHECK(seen.armed > rig.mended + 6 * kPeriod);
  CHECK(seen.state == 0);
}

TEST_CASE("absolute: what closed the gates is told until the faults are cleared") {
  Rig rig;
  rig.defect = Defect::half_a_turn_off;
  rig.mended = kReady + 20 * kPeriod;
  Seen seen = run(rig, rig.mended + 4 * kPeriod);
  CHECK(seen.last.faults == fault_bit(Fault::encoder));
  CHECK(seen.state == 8);
  seen = run(rig, rig.mended + 8 * kPeriod);
  CHECK(seen.last.armed);
  CHECK(seen.last.faults == 0);
  CHECK(seen.state == 0);
}
