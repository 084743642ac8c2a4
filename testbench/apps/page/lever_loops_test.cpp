// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The page's levers against closed forms: a stick's stroke and rest; what is felt of what a coupled
// lever meets; a bow's slips and friction. Documentation: docs/page.md
#include <algorithm>
#include <vector>

#include "law_loops.hpp"

namespace feltgate::page {
namespace {

constexpr double inertia_kg_m2 = 1.22e-4;  // about that of a lever

CoupledLoop levers(double stiffness, double damping, double share) {
  CoupledLoop loop(image_of("coupled_levers"), TwoLevers(inertia_kg_m2));
  loop.set("stiffness", stiffness);
  loop.set("damping", damping);
  loop.set("share", share);
  return loop;
}
void meet(CoupledLoop& loop, Met what, double strength) {
  loop.met = what;
  loop.strength = strength;
}
void lead_held(CoupledLoop& loop, double rad) {
  loop.lead(loop.second_is_held ? shape::Point{0, rad} : shape::Point{rad, 0});
}

/// Means over a trembling of counts.
struct Rest {
  shape::Point rad, nm;
};
Rest at_rest(CoupledLoop& loop) {
  loop.advance(4);
  Rest mean;
  constexpr int samples = 1000;
  for (int i = 0; i < samples; ++i) {
    loop.advance(1e-3);
    mean.rad = mean.rad + 1.0 / samples * loop.at();
    mean.nm = mean.nm + 1.0 / samples * loop.force();
  }
  return mean;
}

LeverLoop bowed() {
  const law::Compiled law = shipped("bowed_string");
  LeverLoop loop(law::text(law.image), Lever::bow());
  loop.watched = state_word(law, "heard");
  return loop;
}

}  // namespace

TEST_CASE("page: a stroke is told by the drum under the wrist, with the tip's speed and place") {
  const std::string drums = image_of("drums");
  // From 0.3 to -0.3 rad at once; the tip is at the skins where half of that is left.
  const Swing swing(hand.mass_kg);
  double t = 0;
  while (swing.left(t) > 0.5) t += 1e-6;
  const double rad_s = 0.6 * (swing.left(t) - swing.left(t + 1e-6)) / 1e-6;
  for (const int drum : {1, 2, 3}) {
    LeverLoop loop(drums, Lever::stick());
    CHECK(1 / loop.law().period_s() == Approx(20000));
    loop.set("across", 0.3 * (drum - 2) + 0.06);
    loop.lead(-0.3);
    loop.advance(loop.law().period_s());
    loop.advance(t + 5e-3);
    INFO("drum " << drum << ", " << rad_s << " rad/s after " << t << " s");
    REQUIRE(loop.told().size() == 2);
    const Told hit = loop.told()[0], place = loop.told()[1];
    CHECK(hit.name == "hit" + std::to_string(drum));
    CHECK(place.name == "place" + std::to_string(drum));
    // Words of the law: the length is rounded to 2^-9 m. A run is 50 us.
    CHECK(hit.value == Approx(0.3 * rad_s).epsilon(0.005));
    CHECK(hit.time_s == Approx(t).margin(2e-4));
    CHECK(place.value == Approx(0.5).margin(0.002));
  }
  LeverLoop beside(drums, Lever::stick());
  beside.set("across", 0.15);
  beside.lead(-0.3);
  beside.advance(0.5);
  CHECK(beside.told().empty());
}

TEST_CASE("page: a spring at the second lever is felt at the first, by the share of the observer") {
  const double k = 1, coupling = 4, lead = 0.5;
  for (const double share : {0.0, 0.5, 1.0}) {
    CoupledLoop loop = levers(coupling, 0.01, share);
    meet(loop, Met::spring, k);
    lead_held(loop, lead);
    const Rest rest = at_rest(loop);
    const double felt = k * coupling / (coupling + (1 - share) * k);
    const double theta = hand_nm_rad * lead / (hand_nm_rad + felt);
    INFO("share " << share);
    CHECK(rest.rad.x == Approx(theta).margin(count_rad));
    CHECK(rest.nm.x == Approx(-felt * rest.rad.x).margin(coupling * count_rad));
    CHECK(rest.rad.y == Approx(felt / k * theta).margin(1.5 * count_rad));
    CHECK(rest.nm.y == Approx(k * rest.rad.y).margin(1e-3));
  }
}

TEST_CASE("page: a weight at the second lever hangs in the coupling; a wall is met at its face") {
  const double coupling = 4, weight = 0.2;
  CoupledLoop loop = levers(coupling, 0.01, 0);
  meet(loop, Met::weight, weight);
  const Rest hangs = at_rest(loop);
  CHECK(hangs.nm.x == Approx(-weight).margin(2e-3));
  CHECK(hangs.rad.x == Approx(-weight / hand_nm_rad).margin(count_rad));
  CHECK(hangs.rad.x - hangs.rad.y == Approx(weight / coupling).margin(count_rad));

  const double wall = 6, lead = 0.6;
  meet(loop, Met::wall, wall);
  lead_held(loop, lead);
  const Rest pressed = at_rest(loop);
  // From the face on both levers and the wall are springs in a row.
  const double row = wall * coupling / (wall + coupling);
  const double theta = (hand_nm_rad * lead + row * TwoLevers::wall_rad) / (hand_nm_rad + row);
  CHECK(pressed.rad.x == Approx(theta).margin(count_rad));
  CHECK(pressed.nm.x == Approx(-row * (theta - TwoLevers::wall_rad)).margin(coupling * count_rad));
  lead_held(loop, 0.2);
  const Rest before = at_rest(loop);
  CHECK(std::abs(before.nm.x) < coupling * count_rad);
}

TEST_CASE("page: a hand at the second lever leads the first") {
  for (const double share : {0.0, 0.5}) {
    CoupledLoop loop = levers(4, 0.01, share);
    hold(loop, true);
    lead_held(loop, 0.3);
    const Rest rest = at_rest(loop);
    INFO("share " << share);
    CHECK(rest.rad.x == Approx(0.3).margin(1.5 * count_rad));
    CHECK(rest.rad.y == Approx(0.3).margin(1.5 * count_rad));
  }
}

TEST_CASE("page: levers in a stiff coupling swing in the hand as one mass") {
  CoupledLoop loop = levers(20, 0.05, 0);
  lead_held(loop, 0.3);
  loop.advance(loop.law().period_s());
  const Swing swing(hand.mass_kg + 2 * inertia_kg_m2 / (Lever::radius_m * Lever::radius_m));
  for (int i = 1; i <= 40; ++i) {
    loop.advance(5e-3);
    const double t = 5e-3 * i, theta = 0.3 * (1 - swing.left(t));
    INFO(t << " s");
    CHECK(loop.at().x == Approx(theta).margin(0.005));
    CHECK(loop.at().y == Approx(theta).margin(0.015));
  }
}

TEST_CASE("page: a bow that draws itself is heard, slips once a period and lags as friction says") {
  const double force_n = 1.8, bow_m_s = 0.2, period_s = 1 / 196.0;
  LeverLoop loop = bowed();
  const double dt = loop.law().period_s();
  CHECK(1 / dt == Approx(40000));
  loop.set("force", force_n);
  loop.advance(0.10001);
  CHECK(loop.seen() == std::vector<float>(4000));  // a bow at rest
  CHECK(loop.told().empty());
  draw(loop, bow_m_s);
  loop.advance(3 * Lever::turn_rad * 0.1 / bow_m_s - 0.26);  // late in the second stroke
  double sum_rad_s = 0, sum_nm = 0, sum_behind_rad = 0;
  constexpr int runs = 5000;
  for (int i = 0; i < runs; ++i) {
    loop.advance(1.000001 * dt);
    sum_rad_s += loop.speed();
    sum_nm += loop.force();
    sum_behind_rad += loop.hand() - loop.at();
    for (const Told& slip : loop.told()) {
      CHECK(slip.name == "slip");
      CHECK(slip.value == Approx(period_s).epsilon(0.05));
    }
  }
  CHECK(sum_rad_s / runs == Approx(-10 * bow_m_s).epsilon(0.02));  // it goes back
  CHECK(sum_behind_rad / runs == Approx(-sum_nm / runs / hand_nm_rad).margin(2e-3));
  CHECK(sum_nm / runs > 0.1 * 0.3 * force_n);  // between dynamic and static friction
  CHECK(sum_nm / runs < 0.1 * 0.8 * force_n);
  // The mean of a longer advance() is that of its runs, which the same loop makes one by one.
  LeverLoop again = bowed();
  again.set("force", force_n);
  again.advance(0.10001);
  draw(again, bow_m_s);
  again.advance(3 * Lever::turn_rad * 0.1 / bow_m_s - 0.26);
  again.advance(1.000001 * dt * runs);
  CHECK(again.mean_force() == Approx(sum_nm / runs));
  loop.advance(20 * period_s);
  CHECK(loop.told().size() == Approx(20).margin(1.5));
  CHECK(*std::max_element(loop.seen().begin(), loop.seen().end()) > 0.8F);
}

TEST_CASE("page: a bow that draws itself goes to and fro between its turns") {
  LeverLoop loop = bowed();
  loop.lead(1);
  loop.advance(0.5);
  CHECK(loop.hand() == Approx(1));
  // 0.3 m/s over 0.1 m: 3 rad/s. First back from beyond the turn, or on: it never goes further.
  draw(loop, -0.3);
  loop.advance(1.9 / 3);
  CHECK(loop.hand() == Approx(-0.9).margin(1e-3));
  loop.advance(0.6);
  CHECK(loop.hand() == Approx(0.9).margin(1e-3));
  loop.advance(0.3);
  CHECK(loop.hand() == Approx(0).margin(1e-3));
  // By hand again, from where it is; what is no angle is not followed.
  draw(loop, 0);
  loop.advance(0.1);
  CHECK(loop.hand() == Approx(0).margin(1e-3));
  loop.lead(NAN);
  loop.lead(5);
  loop.advance(0.1);
  CHECK(loop.hand() == loop.most_rad);
}

TEST_CASE("page: a law refuses what is no force, no parameter, no state and no image") {
  LeverLoop loop = bowed();
  CHECK_THROWS_AS(loop.set("force", 5), std::invalid_argument);
  CHECK_THROWS_AS(loop.set("rosin", 1), std::invalid_argument);
  CHECK_THROWS_AS(state_word(shipped("bowed_string"), "rosin"), std::invalid_argument);
  CHECK_THROWS_AS(loop.load("nonsense"), std::invalid_argument);
}

}  // namespace feltgate::page
