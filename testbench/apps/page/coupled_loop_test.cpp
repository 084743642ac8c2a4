// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The page's two levers: what is felt of what the other one meets, against the closed forms of
// docs/devices/pantograph.md, from either lever; and a step of the hand over time.
// Documentation: docs/page.md
#include <cmath>
#include <stdexcept>
#include <string>

#include "apps/page/law_loops.hpp"
#include "catch.hpp"
#include "law/compile.hpp"
#include "sim/backends/backend.hpp"

namespace feltgate::page {
namespace {

const std::string& coupled() {
  static const std::string image =
      law::text(law::compile_file(std::string(FELTGATE_ROOT) + "/rtl/laws/coupled_levers.law",
                                  law::target_of(design_named("lever")))
                    .image);
  return image;
}

constexpr double inertia_kg_m2 = 1.22e-4;  // about that of a lever
constexpr double squared_m2 = Lever::radius_m * Lever::radius_m;
const plant::Impedance hand;
const double hand_nm_rad = hand.stiffness_n_m * squared_m2;
const double count_rad = design_named("lever").count_rad;

/// Means over a trembling of counts.
struct Rest {
  double theta_rad[2]{}, torque_nm[2]{};
};

Rest at_rest(CoupledLoop& loop) {
  loop.advance(4);
  Rest mean;
  constexpr int samples = 1000;
  for (int i = 0; i < samples; ++i) {
    loop.advance(1e-3);
    for (int n = 0; n < 2; ++n) {
      mean.theta_rad[n] += loop.theta_rad(n) / samples;
      mean.torque_nm[n] += loop.torque_nm(n) / samples;
    }
  }
  return mean;
}

void couple(CoupledLoop& loop, double stiffness, double damping, double share) {
  loop.set("stiffness", stiffness);
  loop.set("damping", damping);
  loop.set("share", share);
}

}  // namespace

TEST_CASE("page: a spring at the second lever is felt at the first, by the share of the observer") {
  const double k = 1, coupling = 4, lead = 0.5;
  for (const double share : {0.0, 0.5, 1.0}) {
    CoupledLoop loop(coupled(), inertia_kg_m2);
    couple(loop, coupling, 0.01, share);
    loop.meet(Met::spring, k);
    loop.lead(lead);
    const Rest rest = at_rest(loop);
    const double felt = k * coupling / (coupling + (1 - share) * k);
    const double theta = hand_nm_rad * lead / (hand_nm_rad + felt);
    INFO("share " << share);
    CHECK(rest.theta_rad[0] == Approx(theta).margin(count_rad));
    CHECK(rest.torque_nm[0] == Approx(-felt * rest.theta_rad[0]).margin(coupling * count_rad));
    CHECK(rest.theta_rad[1] == Approx(felt / k * theta).margin(1.5 * count_rad));
    CHECK(rest.torque_nm[1] == Approx(k * rest.theta_rad[1]).margin(1e-3));
  }
}

TEST_CASE("page: a weight at the second lever hangs in the coupling; a wall is met at its face") {
  const double coupling = 4, weight = 0.2;
  CoupledLoop loop(coupled(), inertia_kg_m2);
  couple(loop, coupling, 0.01, 0);
  loop.meet(Met::weight, weight);
  const Rest hangs = at_rest(loop);
  CHECK(hangs.torque_nm[0] == Approx(-weight).margin(2e-3));
  CHECK(hangs.theta_rad[0] == Approx(-weight / hand_nm_rad).margin(count_rad));
  CHECK(hangs.theta_rad[0] - hangs.theta_rad[1] == Approx(weight / coupling).margin(count_rad));

  const double wall = 6, lead = 0.6;
  loop.meet(Met::wall, wall);
  loop.lead(lead);
  const Rest pressed = at_rest(loop);
  // From the face on both levers and the wall are springs in a row.
  const double row = wall * coupling / (wall + coupling);
  const double theta = (hand_nm_rad * lead + row * CoupledLoop::wall_rad) / (hand_nm_rad + row);
  CHECK(pressed.theta_rad[0] == Approx(theta).margin(count_rad));
  CHECK(pressed.torque_nm[0] ==
        Approx(-row * (theta - CoupledLoop::wall_rad)).margin(coupling * count_rad));
  loop.lead(0.2);
  const Rest before = at_rest(loop);
  CHECK(std::abs(before.torque_nm[0]) < coupling * count_rad);
}

TEST_CASE("page: a hand at the second lever leads the first") {
  for (const double share : {0.0, 0.5}) {
    CoupledLoop loop(coupled(), inertia_kg_m2);
    couple(loop, 4, 0.01, share);
    loop.hold(1);
    CHECK(loop.held() == 1);
    loop.lead(0.3);
    const Rest rest = at_rest(loop);
    INFO("share " << share);
    CHECK(rest.theta_rad[0] == Approx(0.3).margin(1.5 * count_rad));
    CHECK(rest.theta_rad[1] == Approx(0.3).margin(1.5 * count_rad));
  }
}

TEST_CASE("page: levers in a stiff coupling swing in the hand as one mass") {
  CoupledLoop loop(coupled(), inertia_kg_m2);
  couple(loop, 20, 0.05, 0);
  loop.lead(0.3);
  loop.advance(loop.law().period_s());
  const double mass = hand.mass_kg * squared_m2 + 2 * inertia_kg_m2;
  const double a = hand.damping_ns_m * squared_m2 / mass / 2;
  const double w = std::sqrt(hand_nm_rad / mass - a * a);
  for (int i = 1; i <= 40; ++i) {
    loop.advance(5e-3);
    // The hand's way of a moment is a step; a damper between hand and lever starts it at a speed.
    const double t = 5e-3 * i;
    const double theta = 0.3 * (1 - std::exp(-a * t) * (std::cos(w * t) - a / w * std::sin(w * t)));
    INFO(t << " s");
    CHECK(loop.theta_rad(0) == Approx(theta).margin(0.005));
    CHECK(loop.theta_rad(1) == Approx(theta).margin(0.015));
  }
}

TEST_CASE("page: levers and strengths that are none are refused") {
  CoupledLoop loop(coupled(), inertia_kg_m2);
  CHECK(loop.torque_nm(0) == 0);  // before the first run, too
  CHECK_THROWS_AS(loop.hold(2), std::invalid_argument);
  CHECK_THROWS_AS(loop.hold(-1), std::invalid_argument);
  CHECK_THROWS_AS(loop.meet(Met::spring, -1), std::invalid_argument);
  CHECK_THROWS_AS(loop.set("stifness", 1), std::invalid_argument);
}

}  // namespace feltgate::page
