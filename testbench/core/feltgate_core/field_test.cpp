// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core with three phases and two measured currents, RTL against twin in every clock, around the
// plant of the gimbal motor that its six gates switch: a torque step, the torque of a turn, direct
// voltage, a phase that opens, sensors that fail. Documentation: docs/blocks/three_phase.md
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "../../sim/plant/three_phase_fixture.hpp"
#include "core_life.hpp"
#include "core_stimulus.hpp"
#include "figures_record.hpp"
#include "twins.hpp"

using namespace feltgate::test;
using namespace feltgate::plant;
using feltgate::AbsoluteSensor;
using feltgate::CoreIn;
using feltgate::CoreOut;
using feltgate::Fault;
using feltgate::fault_bit;
using D = feltgate::test::Design;

namespace {

static_assert(D::phases == 3 && D::current_loop != 0);
constexpr double kFullA = 2, kNmA = 0.0585, kOhm = 2.9;
const double kLsb = std::ldexp(1.0, -D::f.current.fraction);  // A
constexpr double kClockS = 1.0 / D::clock_hz;
constexpr int kPeriod = D::pwm_period;
/// Armed after the calibration, whose two averages take 512 periods.
constexpr std::int64_t kArm = 520'000, kSettled = kArm + 40'000;
/// Until then the plant waits: its gates are off.
constexpr std::int64_t kMoves = kArm - 5'000;

Parameters motor(double resistance) {
  Parameters p = shipped("gimbal_motor");
  p.effects.lugre = false;
  p.end_stops.reset();
  p.phases->resistance_ohm *= resistance;
  return p;
}

/// A host that arms the set-point or direct voltage; the motor, its sensor, and two modulators.
struct Rig {
  double torque_nm = 0.03, direct_v = 0;
  bool reversed = false;                             ///< B and C change places
  std::vector<std::pair<int, std::uint32_t>> words;  ///< further ones, before arming
  std::int64_t event_at = 1LL << 60, moves_at = kMoves;
  std::function<void(Rig&)> event = [](Rig&) {};  ///< in each clock from then on

  Parameters p;
  ThreePhasePlant plant;
  AbsoluteSensor sensor{feltgate::test::absolute_parameters<D>()};
  std::array<double, 2> reads{1, 1};  ///< part of its current that a modulator sees
  std::array<SigmaDelta, 2> modulators{SigmaDelta{kFullA}, SigmaDelta{kFullA}};
  CoreIn in;
  bool clock_was = false;

  explicit Rig(const Hand& hand, double resistance = 1)
      : p(motor(resistance)), plant(p, *p.phases, p.effects, drive_50khz(0.5e-6), hand) {}

  double shaft_rad() const { return plant.observables().theta_rad; }
  double torque() const { return plant.motor().torque_nm(shaft_rad()); }
  CoreIn operator()(std::int64_t cycle, const CoreOut& out) {
    host(cycle);
    const auto gate = [&out](int n) { return static_cast<double>(out.gates >> n & 1); };
    const int b = reversed ? 4 : 2, c = reversed ? 2 : 4;
    const double before_rad = shaft_rad();
    if (cycle >= moves_at) {
      plant.advance(Legs::gates(gate(0), gate(1), gate(b), gate(b + 1), gate(c), gate(c + 1)), 1);
    }
    sensor.turn(before_rad, shaft_rad(), cycle, 1);
    in.encoder_data = sensor.pin(cycle, out.serial);
    const bool rises = out.current_clock && !clock_was;
    clock_was = out.current_clock;
    if (rises) {
      const Phases& amperes = plant.motor().phase_a();
      const bool first = modulators[0].next(reads[0] * amperes[0]);
      const bool second = modulators[1].next(reads[1] * amperes[reversed ? 2 : 1]);
      in.current_data = static_cast<std::uint8_t>(first | second << 1);
    }
    if (cycle >= event_at) event(*this);
    return in;
  }

 private:
  void host(std::int64_t cycle) {
    const bool direct = direct_v != 0;
    std::uint32_t given = kHost | static_cast<std::uint32_t>(D::S::setpoint) << C::control_scene;
    if (direct) given |= static_cast<std::uint32_t>(feltgate::Map::mode_voltage) << C::control_mode;
    if (reversed) given ^= 1u << C::control_motor_polarity;
    const auto write = [&](std::int64_t at, int address, std::uint32_t word) {
      write_at(&in, cycle, at, address, word);
    };
    const auto fixed = [](double v, int fraction) {
      return low(std::llround(std::ldexp(v, fraction)));
    };
    write(1'000, A::self_test_pulse, 0);
    write(2'000, A::ramp_step, (1u << (D::P::ramp_step.width() - 1)) - 1);
    write(3'000, A::setpoint_torque, fixed(torque_nm, D::f.torque.fraction));
    write(4'000, A::voltage_step, (1u << (D::f.voltage.width() - 1)) - 1);
    write(5'000, A::voltage_setpoint, fixed(direct_v, D::f.voltage.fraction));
    write(6'000, C::control, given);
    std::int64_t at = 7'000;
    for (const auto& [address, word] : words) write(std::exchange(at, at + 1'000), address, word);
    write(kArm, C::control, given | 1u << C::control_arm);
  }
};

/// One run; periods are those from the first torque reference on.
struct Seen {
  std::vector<double> torque_nm, shaft_rad;  ///< means over periods; at their ends
  std::int64_t began = -1, off = -1;  ///< clocks of the first reference, and of the gates off
  double event_rad = 0, off_rad = 0, current_a = 0, reference_a = 0;
  CoreOut last;
};

Seen run(const Rig& given, std::int64_t clocks) {
  Seen seen;
  double sum = 0;
  int n = 0;
  beside(given, clocks, [&](const Rig& rig, std::int64_t cycle, const CoreOut& out) {
    const double rad = rig.shaft_rad();
    if (seen.began < 0 && out.gates_enable && (out.tau_ref != 0 || out.voltage != 0)) {
      seen.began = cycle;
    }
    if (seen.began >= 0 && seen.off < 0) {
      sum += rig.torque();
      if (++n == kPeriod) {
        seen.torque_nm.push_back(sum / n);
        seen.shaft_rad.push_back(rad);
        sum = n = 0;
      }
    }
    if (cycle == given.event_at) seen.event_rad = rad;
    if (seen.began >= 0 && seen.off < 0 && !out.gates_enable) seen.off = cycle, seen.off_rad = rad;
    seen.current_a = out.current * kLsb;
    seen.reference_a = std::ldexp(out.current_ref, -D::f.current.fraction);
    seen.last = out;
  });
  return seen;
}

double mean_of_last(const std::vector<double>& all, std::size_t n) {
  double sum = 0;
  for (std::size_t k = all.size() - n; k < all.size(); ++k) sum += all[k] / static_cast<double>(n);
  return sum;
}

}  // namespace

TEST_CASE("field: a step of the torque at rest") {
  std::string table =
      "| step at stall, through the core | 2 %, ms | overshoot, % | settled at, % |\n"
      "|---|---|---|---|\n";
  for (const auto& [name, nm, resistance, rad] :
       {std::tuple("R as the gains have it", 0.005, 1.0, 0.05),
        std::tuple("R as the gains have it", 0.015, 1.0, 0.41),
        std::tuple("R as the gains have it", -0.03, 1.0, 0.17),
        std::tuple("R +20 %", 0.015, 1.2, 0.41), std::tuple("R -20 %", 0.015, 0.8, 0.41)}) {
    Rig rig(held_at(rad), resistance);
    rig.torque_nm = nm;
    const Seen seen = run(rig, kSettled + 20'000);
    CAPTURE(name, nm);
    REQUIRE(seen.last.armed);
    REQUIRE(seen.torque_nm.size() > 40);
    double settled_ms = 0, over = 0;
    for (std::size_t k = 0; k < seen.torque_nm.size(); ++k) {
      const double part = seen.torque_nm[k] / nm;
      over = std::max(over, part - 1);
      if (std::abs(part - 1) > 0.02) {
        settled_ms = 1e3 * kClockS * kPeriod * static_cast<double>(k + 1);
      }
    }
    const double error = mean_of_last(seen.torque_nm, 10) / nm - 1;
    CHECK(std::abs(seen.current_a - nm / kNmA) < 0.003);
    CHECK(std::abs(seen.reference_a - nm / kNmA) < 0.001);
    CHECK(std::abs(error) < 0.01);
    CHECK(settled_ms < 0.7);
    table += fmt::format("| {}, {:g} mNm | {:.2f} | {:.1f} | {:+.2f} |\n", name, 1e3 * nm,
                         settled_ms, 100 * over, 100 * error);
  }
  table +=
      "\n| an electrical turn, through the core | mean error, % | ripple p-p, % |\n|---|---|---|\n";
  for (const auto& [rad_s, nm, resistance] :
       {std::array{20.0, 0.03, 1.0}, std::array{-40.0, -0.015, 1.2}}) {
    Rig rig(turning(rad_s), resistance);
    rig.torque_nm = nm;
    rig.moves_at = kArm - 300'000;  // else it is armed before its speed is known
    const auto turn = static_cast<std::int64_t>(kTwoPi / 11 / std::abs(rad_s) / kClockS);
    const Seen seen = run(rig, kSettled + 100 * kPeriod + turn);  // the turn begins settled
    REQUIRE(seen.last.armed);
    const auto periods = static_cast<std::size_t>(turn / kPeriod);
    REQUIRE(seen.torque_nm.size() > periods + 20);
    const double mean = mean_of_last(seen.torque_nm, periods);
    const auto ends = std::minmax_element(
        seen.torque_nm.end() - static_cast<std::ptrdiff_t>(periods), seen.torque_nm.end());
    CAPTURE(rad_s, nm, resistance, mean);
    CHECK(std::abs(mean / nm - 1) < 0.01);
    table += fmt::format("| {:g} mNm, {:g} rad/s, R {:+.0f} % | {:+.2f} | {:.2f} |\n", 1e3 * nm,
                         rad_s, 100 * (resistance - 1), 100 * (mean / nm - 1),
                         100 * (*ends.second - *ends.first) / std::abs(nm));
  }
  if (!defects_run()) check_figures("feltgate_core_field", table);
}

TEST_CASE("field: a motor whose phases B and C change places") {
  Rig rig(held_at(0.41));
  rig.reversed = true;
  rig.torque_nm = 0.02;
  const Seen seen = run(rig, kSettled + 10'000);
  REQUIRE(seen.last.armed);
  // Mirrored, the angle is too: only the sensor can put it right, so at 0 the torques are the same.
  CHECK(std::abs(seen.current_a - 0.02 / kNmA) < 0.003);
}

TEST_CASE("field: an offset of the angle lowers the torque by its cosine, not the current") {
  Rig rig(held_at(0.41));
  rig.words = {{A::commutation_offset, 1u << 29}};  // an eighth of a turn
  rig.torque_nm = 0.02;
  const Seen seen = run(rig, kSettled + 10'000);
  REQUIRE(seen.last.armed);
  CHECK(std::abs(seen.current_a - 0.02 / kNmA) < 0.003);
  CHECK(std::abs(mean_of_last(seen.torque_nm, 10) - 0.02 * std::sqrt(0.5)) < 0.0004);
}

TEST_CASE("field: direct voltage is the resistance's, and its current is measured") {
  for (const double volt : {1.2, -0.8}) {
    Rig rig(held_at(0.41));
    rig.direct_v = volt;
    const Seen seen = run(rig, kSettled + 80'000);
    REQUIRE(seen.last.armed);
    // The dead time takes 4/pi of a diode drop and the supply's share: docs/blocks/three_phase.md.
    const double lost_v = 4 / M_PI * 0.025 * (5 + 2 * 0.7);
    const double wanted_a = (std::abs(volt) - lost_v) / kOhm * (volt > 0 ? 1 : -1);
    CAPTURE(volt, wanted_a, seen.current_a);
    CHECK(std::abs(seen.current_a - wanted_a) < 0.03);
    CHECK(std::abs(mean_of_last(seen.torque_nm, 10) - kNmA * seen.current_a) < 0.0003);
  }
}

TEST_CASE("field: a phase that opens closes the gates within an electrical turn") {
  double most = 0;
  for (const auto& [rad_s, phase] : {std::pair(40.0, 0), std::pair(-30.0, 1), std::pair(40.0, 2)}) {
    for (const int part : {0, 1}) {
      Rig rig(turning(rad_s));
      rig.torque_nm = rad_s > 0 ? 0.02 : -0.02;
      const auto turn = static_cast<std::int64_t>(kTwoPi / 11 / std::abs(rad_s) / kClockS);
      rig.event_at = kSettled + turn * part / 4;
      rig.event = [n = phase](Rig& r) { r.plant.open_phase(static_cast<std::size_t>(n)); };
      const Seen seen = run(rig, rig.event_at + turn / 2);
      REQUIRE(seen.off > rig.event_at);
      CHECK(seen.last.faults == fault_bit(Fault::current));
      const double electrical = 11 * std::abs(seen.off_rad - seen.event_rad) / kTwoPi;
      CAPTURE(rad_s, phase, part, electrical);
      CHECK(electrical < 0.5);
      most = std::max(most, electrical);
    }
  }
  INFO("most " << most << " of an electrical turn");
  CHECK(most > 0.02);
}

TEST_CASE("field: a sensor that fails closes the gates, whichever it is") {
  for (const int line : {0, 1}) {
    for (const bool over : {false, true}) {
      Rig rig(held_at(0.41));
      rig.torque_nm = 0.02;
      rig.event_at = kSettled;
      // Ones are the greatest current, and a line that stands; every ninth bit a zero is no
      // standing line.
      rig.event = [line, over, n = 0](Rig& r) mutable {
        const bool one = !over || ++n % 36 >= 4;
        const auto bit = static_cast<std::uint8_t>(1u << line);
        r.in.current_data =
            static_cast<std::uint8_t>(one ? r.in.current_data | bit : r.in.current_data & ~bit);
      };
      const Seen seen = run(rig, kSettled + 4'000);
      REQUIRE(seen.off > kSettled);
      CHECK(seen.off - kSettled < 300 * 4);
      CHECK(seen.last.faults == fault_bit(Fault::current));
    }
  }
}

TEST_CASE("field: wires off a shunt, or off both, close the gates at rest") {
  for (const int shunts : {1, 2, 3}) {
    for (const double rad : {0.17, 0.41}) {
      Rig rig(held_at(rad));
      rig.torque_nm = 0.02;
      rig.event_at = kSettled;
      rig.event = [shunts](Rig& r) { r.reads = {shunts & 1 ? 0.0 : 1.0, shunts & 2 ? 0.0 : 1.0}; };
      const Seen seen = run(rig, kSettled + 100'000);
      CAPTURE(shunts, rad, seen.off);
      CHECK(seen.off > kSettled);
      CHECK(seen.last.faults == fault_bit(Fault::current));
    }
  }
  // Where phase B has little current anyway the error stays within the margin.
  Rig rig(held_at(0.05));
  rig.torque_nm = 0.02;
  rig.event_at = kSettled;
  rig.event = [](Rig& r) { r.reads[1] = 0; };
  const Seen seen = run(rig, kSettled + 100'000);
  CHECK(seen.off < 0);
  const double wrong_nm = std::abs(mean_of_last(seen.torque_nm, 10) - 0.02);
  CHECK(wrong_nm > 0.001);
  CHECK(wrong_nm < 0.01);
}
