// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The self-test on motors in simulation: free levers at random, wired right and wrong; levers that
// are held, pushed or moving. Documentation: docs/blocks/safety.md
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "catch.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/paper.hpp"
#include "feltgate/largest.hpp"
#include "random.hpp"
#include "rig.hpp"

namespace {

using namespace feltgate;
using namespace feltgate::test;
using plant::Hand;
using plant::HandPhase;
using plant::Segment;

/// As the design does with mode = "on".
template <class D>
void switch_on(Rig<D>& rig, double arms = 3) {
  const double units = 5e-3 * static_cast<double>(D::tick_hz) / (1 << Map::self_test_unit_bits);
  rig.device.set("self_test_pulse", std::round(units));
  rig.device.set("self_test_arms", arms);
}

Segment torque(Segment::Kind kind, double to_nm, double duration_s) {
  Segment s;
  s.kind = kind;
  s.to = to_nm;
  s.duration_s = duration_s;
  return s;
}

struct Start {
  plant::Parameters motor = motor_of("p24");
  Hand hand;
};

/// Friction, place, inertia, edges and small pushes at random.
Start random_start(SplitMix64& random) {
  Start s;
  s.motor.effects.encoder_imperfect = true;
  s.motor.encoder.seed = static_cast<std::uint64_t>(random.below(1000000));
  s.motor.lever.inertia_kg_m2 *= random.between(0.85, 1.15);
  const double friction = random.between(0.3, 2.0);
  s.motor.lugre.coulomb_nm *= friction;
  s.motor.lugre.static_nm *= friction;
  s.hand.start_rad = random.between(-3.0, 3.0);
  HandPhase push;
  push.kind = HandPhase::Kind::kTorque;
  const double lasting = random.between(-0.6, 0.6) * s.motor.lugre.coulomb_nm;
  if (random.below(2) ==
      0) {  // a nudge that moves the lever by some counts, before or while it waits
    const double nudge = random.between(-0.015, 0.015);
    push.profile = {torque(Segment::Kind::kHold, 0.0, random.between(1e-4, 20e-3)),
                    torque(Segment::Kind::kStep, nudge, 4e-3)};
  }
  push.profile.push_back(torque(Segment::Kind::kStep, lasting, 1e-4));
  if (random.below(2) == 0) {  // trembling, which dithers where an edge is near
    Segment trembling;
    trembling.kind = Segment::Kind::kSine;
    trembling.amplitude = random.between(0.1, 0.3) * s.motor.lugre.coulomb_nm;
    trembling.frequency_hz = random.between(5.0, 300.0);
    trembling.phase_rad = 1.5708;
    trembling.duration_s = random.below(2) == 0 ? 0.08 : 1.0;
    push.profile.push_back(trembling);
  }
  push.profile.push_back(torque(Segment::Kind::kStep, lasting, 1.0));
  s.hand.phases = {push};
  return s;
}

struct Tally {
  int starts = 0, faults = 0;
  std::array<int, 4> results{};
  double most_rad = 0, most_s = 0;
};

template <class D>
void start(const Start& how, Wiring wiring, Tally& tally) {
  Rig<D> rig(how.motor, how.hand, wiring);
  rig.device.select("setpoint");
  switch_on(rig);
  for (int k = 0; k < 20; ++k) rig.tick();
  rig.device.arm();
  double begin_rad = 0.0;
  std::int64_t pulse_tick = -1;
  bool tested = false;
  for (std::int64_t k = 0; k < 300000; ++k) {
    rig.tick();
    if (rig.out().tau_ref != 0 && pulse_tick < 0) {
      pulse_tick = k;
      begin_rad = rig.lever().theta_rad;
    }
    if (rig.out().faults != 0) break;
    tested = rig.out().armed && !rig.device.core().testing();
    if (tested) break;
  }
  ++tally.starts;
  const bool fault = rig.out().first_fault == static_cast<unsigned>(Fault::self_test);
  REQUIRE((fault || tested));
  REQUIRE((fault || rig.out().faults == 0));
  tally.faults += fault ? 1 : 0;
  ++tally.results[static_cast<std::size_t>(rig.device.core().self_test_result())];
  tally.most_rad = feltgate::larger(tally.most_rad, std::fabs(rig.lever().theta_rad - begin_rad));
  if (fault)
    tally.most_s =
        std::max(tally.most_s,
                 1e-6 * static_cast<double>(rig.device.now() / D::clocks_per_tick - pulse_tick));
}

int starts() { return std::getenv("FELTGATE_LONG") != nullptr ? 1000 : 100; }

template <class D>
void check_random_starts() {
  std::array<Tally, 3> tallies;
  std::printf(
      "| design | wired | starts | faults | right | held | moving | way, rad | time, ms |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  SplitMix64 random(4);
  for (int k = 0; k < starts(); ++k) {
    const Start how = random_start(random);
    for (const Wiring w : {Wiring::right, Wiring::motor_swapped, Wiring::encoder_swapped}) {
      start<D>(how, w, tallies[static_cast<std::size_t>(w)]);
    }
  }
  const char* names[] = {"right", "motor swapped", "encoder swapped"};
  for (std::size_t n = 0; n < tallies.size(); ++n) {
    const Tally& t = tallies[n];
    std::printf("| %s | %s | %d | %d | %d | %d | %d | %.4f | %.1f |\n", D::name, names[n], t.starts,
                t.faults, t.results[1], t.results[2], t.results[3], t.most_rad, 1e3 * t.most_s);
  }
  CHECK(tallies[0].faults == 0);
  CHECK(tallies[0].results[1] + tallies[0].results[3] == tallies[0].starts);
  CHECK(tallies[0].results[1] >= tallies[0].starts * 99 / 100);
  CHECK(tallies[1].faults == tallies[1].starts);
  CHECK(tallies[2].faults == tallies[2].starts);
}

}  // namespace

TEST_CASE("self_test: free levers at random, wired right and wrong") {
  check_random_starts<Lever>();
  check_random_starts<Paper>();
}
