// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core with Hall lines beside an encoder by A and B, around a motor with three phases that its
// six gates switch; RTL against twin in every clock of some runs. Torque from any angle at
// power-up, lines and encoders that are broken. Documentation: docs/blocks/three_phase.md
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>

#include "../../sim/plant/three_phase_fixture.hpp"
#include "core_life.hpp"
#include "encoder_phase.hpp"
#include "figures_record.hpp"

using namespace feltgate::test;
using namespace feltgate::plant;
using feltgate::CoreIn;
using feltgate::CoreOut;
using feltgate::Fault;
using feltgate::fault_bit;
using D = feltgate::test::Design;

namespace {

static_assert(D::phases == 3 && D::hall != 0);
constexpr double kPairs = 7, kClockS = 1.0 / D::clock_hz, kHallRad = -1.2, kTorqueNm = 0.2;
constexpr int kPeriod = D::pwm_period;
constexpr double kDegree = kTwoPi / 360;
/// Armed; the torque is there; the hand begins to turn; it has turned, and the speed is forgotten.
constexpr std::int64_t kArm = 8'000, kHeld = kArm + 30'000, kTurned = kHeld + 150'000;

PhaseParameters motor() {
  PhaseParameters p;
  p.resistance_ohm = 0.42;
  p.inductance_h = 20e-6;
  p.pole_pairs = static_cast<int>(kPairs);
  p.back_emf_v_s_rad = 0.0201;
  return p;
}

/// At rest until kHeld, then by `electrical_rad` in `seconds`, then at rest.
Hand turned(double start_rad, double electrical_rad, double seconds) {
  const double end_rad = start_rad + electrical_rad / kPairs;
  Hand hand =
      moving({segment(Segment::Kind::kHold, static_cast<double>(kHeld) * kClockS),
              segment(Segment::Kind::kRamp, seconds, end_rad), segment(Segment::Kind::kHold, 1)});
  hand.start_rad = start_rad;
  return hand;
}

/// A host that arms the set-point and writes nothing of the commutation; motor, encoder, lines.
struct Rig {
  ThreePhasePlant plant;
  HallLines lines{kHallRad, {}};
  std::function<unsigned(const Rig&, unsigned)> harm = [](const Rig&, unsigned code) {
    return code;
  };
  std::int64_t event_at = 1LL << 60, now = 0;
  bool encoder_stands = false;  ///< from the event on
  double torque_nm = kTorqueNm;
  std::function<void(Rig&, std::int64_t)> more = [](Rig&, std::int64_t) {};  ///< of the host
  CoreIn in;

  explicit Rig(const Hand& hand)
      : plant(shaft_on(24, 0.7), motor(), shaft_on(24).effects, drive_50khz(0.04e-6), hand) {}

  double shaft_rad() const { return plant.observables().theta_rad; }
  double electrical_rad() const { return plant.motor().electrical_rad(shaft_rad()); }
  double torque() const { return plant.motor().torque_nm(shaft_rad()); }
  void write(std::int64_t at, int address, std::uint32_t word) {
    write_at(&in, now, at, address, word);
  }
  CoreIn operator()(std::int64_t cycle, const CoreOut& out) {
    now = cycle;
    constexpr std::uint32_t given = kHost | static_cast<std::uint32_t>(D::S::setpoint)
                                                << C::control_scene;
    write(1'000, A::self_test_pulse, 0);
    write(2'000, A::ramp_step, (1u << (D::P::ramp_step.width() - 1)) - 1);
    write(3'000, A::setpoint_torque,
          low(std::llround(std::ldexp(torque_nm, D::f.torque.fraction))));
    write(4'000, A::voltage_step, (1u << (D::f.voltage.width() - 1)) - 1);
    write(6'000, C::control, given);
    write(kArm, C::control, given | 1u << C::control_arm);
    more(*this, cycle);
    const auto gate = [&out](int n) { return static_cast<double>(out.gates >> n & 1); };
    plant.advance(Legs::gates(gate(0), gate(1), gate(2), gate(3), gate(4), gate(5)), 1);
    if (!encoder_stands || cycle < event_at) {
      const double counts = std::floor(shaft_rad() / D::count_rad);
      in.encoder = pins_at(static_cast<unsigned>(static_cast<std::int64_t>(counts)));
    }
    const unsigned code = lines.code(electrical_rad());
    in.hall = static_cast<std::uint8_t>(cycle >= event_at ? harm(*this, code) : code);
    return in;
  }
};

struct Seen {
  double before_nm = 0, after_nm = 0;  ///< means over ten periods before the turn, and at the end
  double event_rad = 0, off_rad = 0;   ///< electrical
  std::int64_t off = -1;               ///< clock in which the gates close
  bool armed = false;
  std::uint32_t faults_word = 0;
  CoreOut last;
};

Seen run(Rig rig, std::int64_t clocks, bool rtl) {
  Seen seen;
  const std::int64_t meter = 10 * kPeriod;
  const auto look = [&](const Rig& r, std::int64_t cycle, const CoreOut& out) {
    const double share = r.torque() / static_cast<double>(meter);
    if (cycle >= kHeld - meter && cycle < kHeld) seen.before_nm += share;
    if (cycle >= clocks - meter) seen.after_nm += share;
    if (cycle == r.event_at) seen.event_rad = r.electrical_rad();
    if (seen.armed && seen.off < 0 && !out.gates_enable) {
      seen.off = cycle;
      seen.off_rad = r.electrical_rad();
    }
    seen.armed = seen.armed || out.armed;
    if (out.word_valid && out.word_slot == feltgate::Map::R::faults)
      seen.faults_word = out.word_data;
    seen.last = out;
  };
  if (!rtl) {
    CoreTwin twin;
    for (std::int64_t cycle = 0; cycle < clocks; ++cycle) {
      twin.clock(rig(cycle, twin.out()));
      look(rig, cycle, twin.out());
    }
    return seen;
  }
  beside(rig, clocks, look);
  return seen;
}

unsigned absolute(std::uint32_t word) { return word >> C::faults_absolute; }

}  // namespace

TEST_CASE("hall: torque from any angle at power-up, and the whole torque after an edge") {
  double least = 1, most = 0, misplaced_least = 1, misplaced_most = 0;
  for (const bool misplaced : {false, true}) {
    for (int k = 0; k < 24; k += misplaced ? 4 : 1) {
      // A fourth of the angles is half a degree beside an edge.
      const double from_rad = kHallRad + (15 * k + (misplaced ? 2.5 : 0.5)) * kDegree;
      Rig rig(turned(from_rad / kPairs, (k % 8 < 4 ? 1 : -1) * 70 * kDegree, 1e-3));
      if (misplaced) rig.lines.error_rad = {3 * kDegree, -3 * kDegree, 2 * kDegree};
      const Seen seen = run(rig, kTurned, k == 5 && !misplaced);
      CAPTURE(misplaced, k, seen.before_nm, seen.after_nm, seen.last.faults);
      REQUIRE(seen.last.gates_enable);
      const double before = seen.before_nm / kTorqueNm, after = seen.after_nm / kTorqueNm;
      REQUIRE(std::isfinite(before + after));
      CHECK(before < 1.01);
      CHECK(after < 1.01);
      double& low = misplaced ? misplaced_least : least;
      double& error = misplaced ? misplaced_most : most;
      low = std::min(low, before);
      error = std::max(error, std::abs(after - 1));
    }
  }
  const std::string table = fmt::format(
      "| sensors | torque at power-up, at least, % | after an edge, off by at most, % |\n"
      "|---|---|---|\n| in place, 24 angles | {:.1f} | {:.2f} |\n"
      "| off by 3, -3 and 2 degrees, 6 angles | {:.1f} | {:.2f} |\n",
      100 * least, 100 * most, 100 * misplaced_least, 100 * misplaced_most);
  INFO(table);
  CHECK(least > 0.865);  // cos 29.5 degrees is 0.870
  CHECK(least < 0.88);
  CHECK(most < 0.01);
  CHECK(misplaced_least > 0.84);
  CHECK(misplaced_most < 0.015);
  if (!defects_run()) check_figures("feltgate_core_hall", table);
}

TEST_CASE("hall: a line that is cut closes the gates within an electrical turn") {
  double most = 0;
  for (int k = 0; k < 6; ++k) {
    const int line = k % 3;
    const bool high = k % 2 == 0;  // a pull-up, or a short to ground
    Rig rig(turned(0.1 + 30 * k * kDegree / kPairs, (k < 3 ? 1 : -1) * 800 * kDegree, 12e-3));
    rig.event_at = kHeld + 40'000 + 9'000 * k;
    rig.harm = [line, high](const Rig&, unsigned code) {
      return high ? code | 1u << line : code & ~(1u << line);
    };
    const Seen seen = run(rig, rig.event_at + 280'000, k == 1);
    const double turns = std::abs(seen.off_rad - seen.event_rad) / kTwoPi;
    CAPTURE(k, turns, seen.off);
    REQUIRE(seen.off > rig.event_at);
    CHECK(seen.last.faults == fault_bit(Fault::encoder));
    CHECK(absolute(seen.faults_word) != 0);
    CHECK(turns < 1);
    most = std::max(most, turns);
  }
  CHECK(most > 0.3);
}

TEST_CASE("hall: two lines that change places close the gates within an electrical turn") {
  for (int k = 0; k < 3; ++k) {
    const unsigned a = static_cast<unsigned>(k) % 3, b = (a + 1) % 3;
    Rig rig(turned(0.2 + 25 * k * kDegree / kPairs, (k < 2 ? 1 : -1) * 360 * kDegree, 6e-3));
    rig.event_at = 0;
    rig.harm = [a, b](const Rig&, unsigned code) {
      const unsigned differ = (code >> a ^ code >> b) & 1u;
      return code ^ (differ << a | differ << b);
    };
    const Seen seen = run(rig, kHeld + 300'000, false);
    REQUIRE(seen.off > kHeld);
    CHECK(seen.last.faults == fault_bit(Fault::encoder));
    CHECK(absolute(seen.faults_word) == 2);
  }
}

TEST_CASE("hall: an encoder that stands while the motor turns, and lines that stand") {
  for (const bool encoder : {true, false}) {
    Rig rig(turned(0.35, 720 * kDegree, 10e-3));
    rig.event_at = kHeld + 120'000;
    rig.encoder_stands = encoder;
    if (!encoder) {
      rig.harm = [first = ~0u](const Rig&, unsigned code) mutable {
        return first = first == ~0u ? code : first;
      };
    }
    const Seen seen = run(rig, rig.event_at + 250'000, encoder);
    CAPTURE(encoder, seen.off, seen.off_rad - seen.event_rad);
    REQUIRE(seen.off > rig.event_at);
    CHECK(seen.last.faults == fault_bit(Fault::encoder));
    CHECK(absolute(seen.faults_word) == 2);
    CHECK(seen.off_rad - seen.event_rad < 150 * kDegree);
  }
}

TEST_CASE("hall: a plug that is off refuses to arm, and the next arming knows the angle") {
  Rig rig(held_at(0.4));
  rig.event_at = 0;
  rig.harm = [](const Rig& r, unsigned code) { return r.now < kHeld ? 7u : code; };
  rig.more = [](Rig& r, std::int64_t) {
    r.write(kHeld + 5'000, C::control, kHost);
    r.write(kHeld + 6'000, C::control,
            kHost | 1u << C::control_arm |
                static_cast<std::uint32_t>(D::S::setpoint) << C::control_scene);
  };
  const Seen refused = run(rig, kHeld, true);
  CHECK_FALSE(refused.armed);
  CHECK(absolute(refused.faults_word) == 1);
  const Seen seen = run(rig, kHeld + 40'000, true);
  CHECK(seen.last.gates_enable);
  CHECK(seen.after_nm > 0.86 * kTorqueNm);
}

TEST_CASE("hall: an angle at fault begins anew once the faults are cleared") {
  Rig rig(turned(0.35, 360 * kDegree, 9e-3));
  rig.event_at = kHeld + 100'000;
  rig.encoder_stands = true;
  rig.more = [](Rig& r, std::int64_t cycle) {
    r.write(kHeld + 460'000, C::control, kHost);
    r.write(kHeld + 461'000, C::command, 1u << C::command_clear_faults);
    r.write(kHeld + 462'000, C::control,
            kHost | 1u << C::control_arm |
                static_cast<std::uint32_t>(D::S::setpoint) << C::control_scene);
    if (cycle > kHeld + 461'000) r.encoder_stands = false;
  };
  const Seen seen = run(rig, kHeld + 520'000, false);
  REQUIRE(seen.off > rig.event_at);
  CHECK(seen.last.gates_enable);
  CHECK(seen.after_nm > 0.83 * kTorqueNm);
}
