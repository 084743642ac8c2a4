// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Hand, cord, friction and energy against closed forms. docs/plant.md
#include "catch.hpp"
#include "plant_fixture.hpp"

using namespace feltgate;
using namespace feltgate::plant;
using Kind = HandPhase::Kind;

namespace {

// Mean friction torque while the hand imposes a constant speed, after `seconds`.
double friction_at(const Parameters& p, double rad_s, double seconds) {
  Effects effects = kNoEffects;
  effects.lugre = true;
  Plant plant(p, effects, Drive{}, moving({segment(Segment::Kind::kRamp, 10.0, 10.0 * rad_s)}));
  run(plant, Bridge::off(), seconds);
  // Without a motor the hand gives the torque against friction.
  CHECK(plant.observables().hand_torque_nm == Approx(plant.observables().friction_nm));
  return plant.observables().hand_torque_nm;
}

/// In lever and winding; the bristles have less than 3e-7 J more.
double stored_j(const Parameters& p, const Plant& plant) {
  const Observables& o = plant.observables();
  return 0.5 * p.lever.inertia_kg_m2 * o.omega_rad_s * o.omega_rad_s +
         0.5 * p.motor.inductance_h * o.motor_current_a * o.motor_current_a;
}

}  // namespace

TEST_CASE("cord: natural frequency and damping of the closed form", "[hand]") {
  const Parameters p = shipped("linear");
  const Cord cord;
  const double j = p.lever.inertia_kg_m2;
  const double wn = std::sqrt(cord.stiffness_nm_rad / j);
  const double damping = 0.5 * cord.damping_nm_s_rad / std::sqrt(cord.stiffness_nm_rad * j);
  CHECK(wn == Approx(495.9).epsilon(1e-3));
  CHECK(damping == Approx(0.8265).epsilon(1e-3));
  Hand hand = hand_of(Kind::kCord);
  hand.start_rad = 0.7;
  Plant plant(p, kNoEffects, Drive{}, hand);
  const double torque = 0.2;
  const Bridge bridge = volts(p, torque * 0.42 / 0.0302);
  const double wd = wn * std::sqrt(1.0 - damping * damping);
  while (plant.now() < clocks_of(0.03)) {
    run(plant, bridge, 1e-3);
    const double t = static_cast<double>(plant.now()) / kClockHz;
    const double rest =
        std::exp(-damping * wn * t) * (std::cos(wd * t) + damping * wn / wd * std::sin(wd * t));
    const double expected = torque / cord.stiffness_nm_rad * (1.0 - rest);
    CHECK(plant.observables().theta_rad - 0.7 == Approx(expected).epsilon(1e-7));
  }
  CHECK(plant.observables().hand_torque_nm == Approx(-torque).epsilon(1e-4));
}

TEST_CASE("impedance: static displacement is torque over stiffness", "[hand]") {
  const Parameters p = shipped("linear");
  for (const double radius : {0.1, 0.2}) {
    HandPhase phase;
    phase.kind = Kind::kImpedance;
    phase.profile = {segment(Segment::Kind::kHold, 1.0)};
    Hand hand = hand_of(phase);
    hand.radius_m = radius;
    Plant plant(p, kNoEffects, Drive{}, hand);
    const double torque = 0.3;
    run(plant, volts(p, torque * 0.42 / 0.0302), 3.0, 50);
    const double hand_stiffness = 135.0 * radius * radius;
    const double grip_stiffness = 3000.0 * radius * radius;
    CHECK(hand_stiffness == Approx(radius == 0.1 ? 1.35 : 5.4));
    CHECK(plant.observables().theta_rad ==
          Approx(torque / hand_stiffness + torque / grip_stiffness).epsilon(1e-5));
    CHECK(plant.observables().hand_force_n == Approx(-torque / radius).epsilon(1e-5));
  }
}

TEST_CASE("impedance: the lever follows the equilibrium and phases go on", "[hand]") {
  const Parameters p = shipped("p24");
  HandPhase phase;
  phase.kind = Kind::kImpedance;
  phase.profile = {segment(Segment::Kind::kMinimumJerk, 0.4, 0.5)};
  phase.duration_s = 0.2;
  Hand hand = hand_of(phase);
  phase.profile = {segment(Segment::Kind::kMinimumJerk, 0.4, 0.8)};
  hand.phases.push_back(phase);
  Plant plant(p, p.effects, Drive{}, hand);
  run(plant, Bridge::off(), 0.1995);
  const double before = plant.observables().theta_rad;
  CHECK(before > 0.1);
  run(plant, Bridge::off(), 0.001);
  CHECK(plant.observables().theta_rad == Approx(before).margin(0.01));
  run(plant, Bridge::off(), 4.0, 50);
  // Friction may hold the lever at a distance of up to static/stiffness.
  CHECK(plant.observables().theta_rad == Approx(0.8).margin(4.5e-3 / 1.35));
}

TEST_CASE("friction: presliding stiffness, Stribeck curve and break-away", "[hand]") {
  const Parameters p = shipped("p24");
  // At creeping speed the bristle follows g/sigma0*(1 - exp(-sigma0*theta/g)): 40 Nm/rad at first.
  const double creep = 1e-4;
  CHECK((friction_at(p, creep, 0.02) - 0.02 * creep) / (0.02 * creep) ==
        Approx(40.0).epsilon(0.01));
  for (const double theta : {2e-5, 1e-4, 3e-4}) {
    const double g = p.lugre.static_nm;
    const double expected =
        g * (1.0 - std::exp(-40.0 * theta / g)) + 0.02 * creep * std::exp(-40.0 * theta / g);
    CHECK(friction_at(p, creep, theta / creep) == Approx(expected).epsilon(1e-3));
  }
  for (const double w : {0.05, 0.25, 0.5, 1.0, 10.0, 795.0}) {
    const double g = 3.5e-3 + 1.0e-3 * std::exp(-(w / 0.5) * (w / 0.5));
    CHECK(friction_at(p, w, 0.1) == Approx(g + 1.5e-6 * w).epsilon(1e-6));
    CHECK(friction_at(p, -w, 0.1) == Approx(-g - 1.5e-6 * w).epsilon(1e-6));
  }
  // A slow torque ramp: the lever holds below the static torque and runs away above it.
  HandPhase push;
  push.kind = Kind::kTorque;
  push.profile = {segment(Segment::Kind::kRamp, 0.5, 4.0e-3), segment(Segment::Kind::kHold, 0.5),
                  segment(Segment::Kind::kRamp, 0.2, 5.0e-3)};
  Plant plant(p, p.effects, Drive{}, hand_of(push));
  run(plant, Bridge::off(), 1.0);
  CHECK(plant.observables().theta_rad < 3e-3);
  run(plant, Bridge::off(), 0.5);
  CHECK(plant.observables().theta_rad > 0.1);
}

TEST_CASE("friction, cord and hand only take energy", "[hand]") {
  const Parameters p = shipped("p24");
  // Run-down from 100 rad/s, the motor open or shorted, with bristles and without.
  for (const auto& [shorted, lugre] :
       {std::pair{false, true}, {true, true}, {false, false}, {true, false}}) {
    Effects effects = p.effects;
    effects.viscous = true;
    effects.lugre = lugre;
    Hand hand = moving({segment(Segment::Kind::kRamp, 0.02, 2.0)});
    hand.phases[0].duration_s = 0.01;
    hand.phases.push_back({});
    Plant plant(p, effects, Drive{}, hand);
    const Bridge bridge = shorted ? Bridge::gates(0, 1, 0, 1) : Bridge::off();
    run(plant, bridge, 0.01001);
    double before = stored_j(p, plant);
    CHECK(before == Approx(0.5 * 1.22e-4 * 1e4).epsilon(0.02));
    for (int k = 0; k < 20000; ++k) {
      run(plant, bridge, 1e-5);
      const double now = stored_j(p, plant);
      REQUIRE(now <= before + (lugre ? 3e-7 : 1e-15));
      before = std::min(before, now);
    }
    CHECK(before < 0.2);
  }
  // Closed cycles of a prescribed motion: the hand's work equals the friction loss and is never
  // negative.
  for (const double amplitude : {1e-5, 1e-3, 0.5}) {
    Effects effects = kNoEffects;
    effects.lugre = true;
    Plant plant(p, effects, Drive{}, moving({sine(10.0, amplitude, 10.0, 0.0)}));
    run(plant, Bridge::off(), 0.1);
    double work_j = 0.0;
    double before = plant.observables().theta_rad;
    for (int k = 0; k < 200000; ++k) {
      plant.advance(Bridge::off(), 25);
      const double now = plant.observables().theta_rad;
      work_j += plant.observables().hand_torque_nm * (now - before);
      before = now;
    }
    CHECK(work_j > 0.0);
    // Full sliding: 4*amplitude*coulomb a cycle and at most the static torque.
    CHECK(work_j < 4.0 * amplitude * (4.5e-3 + 0.02 * amplitude * 62.9) + 1e-12);
    if (amplitude == 0.5) CHECK(work_j == Approx(4.0 * 0.5 * 3.5e-3).epsilon(0.03));
  }
  // A torque pulse against the cord, then no motor: the energy stored in lever and cord only falls.
  Effects effects = kNoEffects;
  Plant plant(p, effects, Drive{}, hand_of(Kind::kCord));
  run(plant, volts(p, 4.0), 2e-3);
  double before = 1.0;
  for (int k = 0; k < 1000; ++k) {
    plant.advance(Bridge::averaged(0.0), 25);
    const Observables& o = plant.observables();
    const double now =
        0.5 * 1.22e-4 * o.omega_rad_s * o.omega_rad_s + 0.5 * 30.0 * o.theta_rad * o.theta_rad;
    REQUIRE(now <= before);
    before = now;
  }
}

TEST_CASE("end stops: restitution and contact time of the closed form, at both ends", "[hand]") {
  Parameters p = shipped("p24");
  constexpr double stiffness = 50.0, way = 0.3, speed = 20.0;
  for (const double restitution : {0.0, 0.5, 1.0}) {
    for (const double sign : {1.0, -1.0}) {
      p.end_stops = EndStops{-way, way, stiffness, restitution};
      HandPhase push;
      push.kind = Kind::kTorque;
      push.profile = {segment(Segment::Kind::kStep, 0.1, sign * 0.2)};
      push.duration_s = speed * p.lever.inertia_kg_m2 / 0.2;
      Hand hand = hand_of(push);
      hand.phases.push_back({});
      Plant plant(p, kNoEffects, Drive{}, hand);
      run(plant, Bridge::off(), push.duration_s);
      REQUIRE(plant.observables().omega_rad_s == Approx(sign * speed).epsilon(1e-3));
      double deepest = 0.0, contact_s = 0.0;
      for (Clock n = 0; n < clocks_of(0.03) / 25; ++n) {
        plant.advance(Bridge::off(), 25);
        const double depth = std::fabs(plant.observables().theta_rad) - way;
        deepest = std::max(deepest, depth);
        if (depth > 0.0) contact_s += 25 / kClockHz;
      }
      const double pole = std::sqrt(stiffness / p.lever.inertia_kg_m2);
      CHECK(deepest == Approx(speed / pole).epsilon(2e-3));
      CHECK(plant.observables().omega_rad_s ==
            Approx(-sign * restitution * speed).epsilon(5e-3).margin(1e-2));
      if (restitution > 0.0) {
        CHECK(contact_s == Approx(std::acos(0.0) / pole * (1.0 + 1.0 / restitution)).epsilon(5e-3));
      }
    }
  }
}

TEST_CASE("prescribed motion is imposed and its reaction is Newton's", "[hand]") {
  const Parameters p = shipped("p24");
  Hand hand = moving({segment(Segment::Kind::kMinimumJerk, 0.2, 0.7),
                      segment(Segment::Kind::kHold, 0.1), segment(Segment::Kind::kRamp, 0.1, 0.5)});
  hand.start_rad = 0.3;
  Plant plant(p, kNoEffects, Drive{}, hand);
  run(plant, Bridge::averaged(0.0), 0.1);
  CHECK(plant.observables().theta_rad == Approx(0.5).epsilon(1e-12));
  CHECK(plant.observables().omega_rad_s == Approx(1.875 * 0.4 / 0.2));
  run(plant, Bridge::averaged(0.0), 0.05);
  // Minimum jerk at 3/4: acceleration D/T^2*(60x - 180x^2 + 120x^3).
  const double x = 0.75;
  const double a = 0.4 / 0.04 * (60 * x - 180 * x * x + 120 * x * x * x);
  CHECK(plant.observables().hand_torque_nm == Approx(1.22e-4 * a).epsilon(1e-4));
  run(plant, Bridge::averaged(0.0), 0.2);
  CHECK(plant.observables().theta_rad == Approx(0.6).epsilon(1e-12));
  CHECK(plant.observables().omega_rad_s == Approx(-2.0));
  run(plant, Bridge::averaged(0.0), 1.0);
  CHECK(plant.observables().theta_rad == Approx(0.5).epsilon(1e-12));
}

TEST_CASE("phases change on their clock: blocked for 1 s, then released", "[hand]") {
  const Parameters p = shipped("p24");
  Hand hand;
  hand.start_rad = 0.1;
  HandPhase locked;
  locked.kind = Kind::kLocked;
  locked.duration_s = 1.0;
  hand.phases = {locked, HandPhase{}};
  Plant plant(p, p.effects, Drive{}, hand);
  Clock moved = 0;
  while (plant.now() < clocks_of(1.1)) {
    plant.advance(Bridge::averaged(0.3), 25);
    if (moved == 0 && plant.observables().theta_rad != 0.1) moved = plant.now();
    if (moved == 0) REQUIRE(plant.events().empty());
  }
  CHECK(moved == 50000025);
  CHECK(plant.observables().theta_rad > 0.5);
  CHECK(plant.observables().hand_torque_nm == 0.0);
}

TEST_CASE("a ramp with ease begins and ends at rest, at its own speed between", "[hand]") {
  Segment ramp = segment(Segment::Kind::kRamp, 0.062, 0.9);
  ramp.ease_s = 0.002;
  const auto at = [&](double s) { return ProfileRun({ramp}, 0.0).at(s); };
  CHECK(at(0.0).rate == 0.0);
  CHECK(at(0.001).rate == Approx(7.5));
  CHECK(at(0.001).value == Approx(0.5 * 7.5e-3));
  CHECK(at(0.031).rate == Approx(15.0));
  CHECK(at(0.031).value == Approx(0.45));
  CHECK(at(0.061).rate == Approx(7.5));
  CHECK(at(std::nextafter(0.062, 0.0)).rate == Approx(0.0).margin(1e-9));
  CHECK(at(0.062).value == 0.9);
}

TEST_CASE("phases that end between steps do not drift", "[hand]") {
  const Parameters p = shipped("p24");
  Hand hand;
  HandPhase locked;
  locked.kind = Kind::kLocked;
  locked.duration_s = 35 / kClockHz;
  hand.phases.assign(20, locked);
  HandPhase ramp;
  ramp.kind = Kind::kPrescribed;
  ramp.profile = {segment(Segment::Kind::kRamp, 1.0, 1.0)};
  hand.phases.push_back(ramp);
  Plant plant(p, p.effects, Drive{}, hand);
  run(plant, Bridge::off(), 0.01);
  CHECK(plant.observables().theta_rad == Approx(0.01 - 20 * 35 / kClockHz).epsilon(1e-9));
}

TEST_CASE("a second impedance phase takes over equilibrium and hand", "[hand]") {
  const Parameters p = shipped("linear");
  HandPhase first;
  first.kind = Kind::kImpedance;
  first.duration_s = 1e-3;
  first.profile = {segment(Segment::Kind::kStep, 1.0, 0.5)};
  HandPhase second = first;
  second.profile = {segment(Segment::Kind::kHold, 1.0)};
  Hand hand = hand_of(first);
  hand.phases.push_back(second);
  Plant plant(p, kNoEffects, Drive{}, hand);
  run(plant, Bridge::averaged(0.0), 0.01);
  CHECK(plant.observables().theta_rad < 0.25);
  run(plant, Bridge::averaged(0.0), 3.0, 50);
  CHECK(plant.observables().theta_rad == Approx(0.5).epsilon(1e-4));
}

TEST_CASE("a trace is passed through its samples with continuous velocity", "[hand]") {
  const Trace trace{{0.1, 0.2, 0.25, 0.4, 0.5}, {1.0, 1.5, 1.6, 1.2, 1.2}};
  TraceRun samples(trace);
  for (std::size_t i = 0; i < trace.time_s.size(); ++i) {
    CHECK(samples.at(trace.time_s[i]).value == Approx(trace.theta_rad[i]).margin(1e-12));
  }
  TraceRun fine(trace);
  ProfileSample before = fine.at(0.0);
  for (int k = 1; k < 60000; ++k) {
    const ProfileSample now = fine.at(1e-5 * k);
    REQUIRE(std::abs(now.rate - before.rate) < 0.05);
    REQUIRE(now.value - before.value == Approx(0.5e-5 * (now.rate + before.rate)).margin(1e-7));
    before = now;
  }
  HandPhase phase;
  phase.kind = Kind::kTrace;
  phase.trace = trace;
  const Parameters p = shipped("p24");
  Plant plant(p, p.effects, Drive{}, hand_of(phase));
  CHECK(plant.observables().theta_rad == 1.0);
  run(plant, Bridge::off(), 0.2);
  CHECK(plant.observables().theta_rad == Approx(1.5));
  run(plant, Bridge::off(), 0.5);
  CHECK(plant.observables().theta_rad == Approx(1.2));
}
