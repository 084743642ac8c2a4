// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Stops between the cranks: restitution, energy, a hand that leans on them.
// docs/devices/pantograph.md
#include <cstdio>

#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "pantograph_fixture.hpp"

using namespace feltgate;
using namespace feltgate::plant;

namespace {

double between(const LinkageState& s) { return s.theta_rad[1] - s.theta_rad[0]; }

LinkageState closing(const AngleStops& stops, bool low, double rad_s) {
  LinkageState s;
  const double gap = low ? stops.least_rad + 0.02 : stops.most_rad - 0.02;
  // Symmetric about the vertical, so that all the energy goes into the stop.
  s.theta_rad = {90 * kDegree - 0.5 * gap, 90 * kDegree + 0.5 * gap};
  const double w = low ? rad_s : -rad_s;
  s.omega_rad_s = {0.5 * w, -0.5 * w};
  return s;
}

}  // namespace

TEST_CASE("a stop gives back restitution squared of the energy, at both ends", "[stops]") {
  for (const double restitution : {0.1, 0.3, 0.7, 1.0}) {
    for (const bool low : {true, false}) {
      AngleStops stops = pantograph().stops;
      stops.restitution = restitution;
      LinkageMechanics mechanics = frictionless(stops);
      LinkageState s = closing(stops, low, 5.0);
      const double before = mechanics.stored_j(s);
      double deepest = 0.0;
      for (int i = 0; i < 20000; ++i) {
        mechanics.step(s, {}, 1e-6);
        deepest = std::max({deepest, stops.least_rad - between(s), between(s) - stops.most_rad});
      }
      const double after = mechanics.stored_j(s);
      CHECK(after ==
            Approx(restitution * restitution * before).epsilon(1e-4).margin(1e-6 * before));
      CHECK(mechanics.stop_loss_j() == Approx(before - after).epsilon(1e-6).margin(1e-12));
      CHECK(0.5 * stops.stiffness_nm_rad * deepest * deepest == Approx(before).epsilon(1e-4));
      if (restitution > 0.2) CHECK(between(s) > stops.least_rad);
      if (restitution > 0.2) CHECK(between(s) < stops.most_rad);
    }
  }
}

TEST_CASE("steps that end anywhere in a contact keep the energy of an elastic stop", "[stops]") {
  AngleStops stops = pantograph().stops;
  stops.restitution = 1.0;
  for (double dt = 2e-6; dt < 60e-6; dt *= 1.37) {
    LinkageMechanics mechanics = frictionless(stops);
    LinkageState s = closing(stops, true, 5.0);
    const double before = mechanics.stored_j(s);
    for (int i = 0; i < 4000; ++i) mechanics.step(s, {}, dt);
    CHECK(mechanics.stored_j(s) == Approx(before).epsilon(1e-8));
  }
}

TEST_CASE("no contact ever adds energy, whatever the step", "[stops]") {
  for (const double restitution : {0.1, 0.4, 0.95}) {
    for (const double dt : {1e-6, 5e-6, 20e-6}) {
      AngleStops stops = pantograph().stops;
      stops.restitution = restitution;
      LinkageMechanics mechanics = frictionless(stops);
      LinkageState s = closing(stops, false, 20.0);
      s.omega_rad_s[0] += 3.0;
      s.omega_rad_s[1] += 3.0;
      double last = mechanics.stored_j(s), most_gain = 0.0;
      const double begin = last;
      for (int i = 0; i < 20000; ++i) {
        mechanics.step(s, {}, dt);
        const double now = mechanics.stored_j(s);
        most_gain = feltgate::larger(most_gain, now - last);
        last = now;
      }
      CHECK(most_gain < 1e-9 * begin);
      CHECK(last < 0.99 * begin);
    }
  }
}

TEST_CASE("a hand that leans on a stop and trembles gets no energy from it", "[stops]") {
  for (const double restitution : {0.2, 0.7, 1.0}) {
    AngleStops stops = pantograph().stops;
    stops.restitution = restitution;
    LinkageMechanics mechanics = frictionless(stops);
    LinkageState s = closing(stops, true, 0.0);
    LinkageLoad load;
    const double begin = mechanics.stored_j(s);
    double least = 0.0, worst = 0.0;
    bool pressed = false;
    for (int i = 0; i < 100000; ++i) {
      const double t = 5e-6 * i;
      load.force_n = {0.1 * std::sin(900.0 * t), 8.0 + 6.0 * std::sin(2500.0 * t)};
      mechanics.step(s, load, 5e-6);
      least = std::min(least, s.hand_work_j);
      pressed = pressed || between(s) < stops.least_rad;
      // The hand's work equals the stored energy plus the loss in the stop; the stop never adds
      // energy.
      const double there = mechanics.stored_j(s) - begin + mechanics.stop_loss_j();
      worst = feltgate::larger(worst, std::abs(there - s.hand_work_j));
    }
    CHECK(worst < 1e-9);
    CHECK(pressed);
    CHECK(mechanics.stop_loss_j() >= -1e-12);
    CHECK(least > -1e-9);
  }
}

TEST_CASE("a resting stop holds a force at its static depth", "[stops]") {
  AngleStops stops = pantograph().stops;
  LinkageMechanics mechanics = frictionless(stops);
  LinkageState s = closing(stops, true, 0.0);
  LinkageLoad load;
  load.viscous_nm_s_rad = 5e-3;
  load.force_n = {0.0, 5.0};
  for (int i = 0; i < 200000; ++i) mechanics.step(s, load, 5e-6);
  const Joints torque = mechanics.linkage().pose(s.theta_rad).torque(load.force_n);
  // On the way back from a deepest point that was at most twice as deep.
  const double depth = stops.least_rad - between(s), least = torque[0] / stops.stiffness_nm_rad;
  CHECK(depth >= least * (1 - 1e-3));
  CHECK(depth <= least * (2.0 - stops.restitution * stops.restitution) * (1 + 1e-3));
  CHECK(std::abs(s.omega_rad_s[1] - s.omega_rad_s[0]) < 1e-3);
}

TEST_CASE("a drop against the stop, as a table", "[.drop]") {
  const PantographParameters p = pantograph();
  std::puts("time_s,restitution,between_deg,moving_mj,lost_mj");
  for (const double restitution : {1.0, 0.7, 0.4}) {
    AngleStops stops = p.stops;
    stops.restitution = restitution;
    LinkageMechanics mechanics = frictionless(stops);
    LinkageState s;
    s.theta_rad = {30 * kDegree, 150 * kDegree};
    LinkageLoad load;
    load.force_n = {0.0, 1.0};
    for (int i = 0; i <= 100000; ++i) {
      if (i % 100 == 0) {
        std::printf("%.4f,%.1f,%.5f,%.6f,%.6f\n", 5e-6 * i, restitution, between(s) / kDegree,
                    1e3 * mechanics.stored_j(s), 1e3 * mechanics.stop_loss_j());
      }
      mechanics.step(s, load, 5e-6);
    }
    // The work of the force equals the stored energy plus the loss in the stop.
    CHECK(mechanics.stored_j(s) + mechanics.stop_loss_j() == Approx(s.hand_work_j).epsilon(1e-7));
  }
}
