// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The page's levers against closed forms: a stick's stroke and rest; what is felt of what a coupled
// lever meets; a bow's slips and sawtooth, as the docs' table has them. Documentation: docs/page.md
#include <algorithm>
#include <complex>
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

/// A bow on the string of the law at this rate; 0: at its own.
LeverLoop bowed(double rate_hz = 0) {
  const law::Compiled law = shipped("bowed_string", "lever", rate_hz);
  LeverLoop loop(law::text(law.image), Lever::bow());
  loop.watched = state_word(law, "heard");
  return loop;
}
constexpr double period_s = 1.0 / 196, drop = 0.5, dynamic = 0.3;
constexpr double pi = 3.14159265358979;

/// A stretch of a stroke with even speed, and what the loop was in it.
struct Stretch {
  int slips = 0;
  double seconds = 0, shortest_s = 1, longest_s = 0;  // between slips
  double mean_rad_s = 0, mean_nm = 0, mean_behind_rad = 0;
  double first_harmonic_m_s = 0;  // of what is heard
  bool helmholtz() const {
    return slips > 1 && shortest_s > 0.95 * period_s && longest_s < 1.05 * period_s;
  }
};

/// The last quarter of a second of the second stroke of a bow that draws itself.
Stretch played(LeverLoop& loop, double bow_m_s) {
  draw(loop, bow_m_s);
  const double dt = loop.law().period_s(), way_s = Lever::turn_rad * 0.1 / bow_m_s;
  loop.advance(3 * way_s - 0.25 - 0.01);
  Stretch s;
  const int runs = static_cast<int>(std::lround(0.25 / dt));
  std::vector<double> heard, at_s;
  double first_s = 0, last_s = 0;
  for (int i = 0; i < runs; ++i) {
    loop.advance(1.000001 * dt);
    s.mean_rad_s += loop.speed() / runs;
    s.mean_nm += loop.force() / runs;
    s.mean_behind_rad += (loop.hand() - loop.at()) / runs;
    for (const float h : loop.seen()) {
      heard.push_back(static_cast<double>(h));
      at_s.push_back(loop.time_s());
    }
    for (const Told& slip : loop.told()) {
      if (++s.slips == 1) first_s = slip.time_s;
      last_s = slip.time_s;
      s.shortest_s = std::min(s.shortest_s, slip.value);
      s.longest_s = std::max(s.longest_s, slip.value);
    }
  }
  if (s.slips < 2) return s;
  s.seconds = last_s - first_s;
  // Over whole periods, slip to slip.
  const double turns = 2 * pi * (s.slips - 1) / s.seconds;
  std::complex<double> sum = 0;
  for (std::size_t i = 0; i < heard.size(); ++i) {
    if (at_s[i] <= first_s || at_s[i] > last_s) continue;
    sum += heard[i] * std::polar(2 * dt / s.seconds, -turns * at_s[i]);
  }
  s.first_harmonic_m_s = std::abs(sum);
  return s;
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

TEST_CASE("page: hand and skin hold the stick where their torques are equal") {
  LeverLoop loop(image_of("drums"), Lever::stick());
  loop.lead(-0.2);
  loop.advance(3);
  double theta = 0;  // 600 (0.3 sin th)^2 = k (th + 0.2)
  while (600 * std::pow(0.3 * std::sin(theta), 2) < hand_nm_rad * (theta + 0.2)) theta -= 1e-6;
  // Between two counts it trembles; a count is 1.5 mrad, and angles are cut.
  double mean_rad = 0, mean_nm = 0;
  constexpr int samples = 2000;
  for (int i = 0; i < samples; ++i) {
    loop.advance(5e-4);
    mean_rad += loop.at() / samples;
    mean_nm += loop.force() / samples;
  }
  CHECK(mean_rad == Approx(theta).margin(0.0016));
  CHECK(mean_nm == Approx(hand_nm_rad * (mean_rad + 0.2)).epsilon(0.005));
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
  const Swing swing(loop.grip.mass_kg + 2 * inertia_kg_m2, loop.grip.stiffness_n_m,
                    loop.grip.damping_ns_m, 0);
  for (int i = 1; i <= 40; ++i) {
    loop.advance(5e-3);
    const double t = 5e-3 * i, theta = 0.3 * (1 - swing.left(t));
    INFO(t << " s");
    CHECK(loop.at().x == Approx(theta).margin(0.005));
    CHECK(loop.at().y == Approx(theta).margin(0.015));
  }
}

TEST_CASE("page: a bow that draws itself makes one slip a period, as far apart as the docs say") {
  // docs/devices/strings-and-drums.md, at 40 kHz, 0.2 m/s and 1/10: force, least and most between
  // slips.
  struct Row {
    double force_n, least_ms, most_ms;
  };
  const double bow_m_s = 0.2, place = 0.1;
  for (const Row& row :
       {Row{1, 5.125, 5.15}, {1.5, 5.15, 5.15}, {2, 5.2, 5.2}, {2.5, 5.225, 5.3}}) {
    LeverLoop loop = bowed();
    CHECK(1 / loop.law().period_s() == Approx(40000));
    loop.set("force", row.force_n);
    loop.set("place", place);
    const Stretch s = played(loop, bow_m_s);
    INFO(row.force_n << " N: " << s.slips << " slips, " << 1e3 * s.shortest_s << " to "
                     << 1e3 * s.longest_s << " ms");
    CHECK(s.helmholtz());
    // A run more or less, for the lever's speed is not as even as the docs' bow.
    CHECK(1e3 * s.shortest_s > row.least_ms - 0.026);
    CHECK(1e3 * s.longest_s < row.most_ms + 0.026);
    CHECK(s.seconds / (s.slips - 1) == Approx(period_s).epsilon(0.04));
    // The velocity wave is a sawtooth as high as speed over place; the corners' rounding at 2.5 kHz
    // takes 0.3 % of its first harmonic, whole runs of the way to the bow up to 2.5 %.
    CHECK(s.first_harmonic_m_s == Approx(bow_m_s / place / pi).epsilon(0.03));
  }
}

TEST_CASE("page: Helmholtz motion that has begun stays at little force, not below Schelleng's") {
  const double z = 0.35, bridge = 20, place = 0.1, bow_m_s = 0.2;
  const double least_n = z * z * bow_m_s / (2 * bridge * place * place * drop);
  for (const double share : {0.5, 2.0}) {
    LeverLoop loop = bowed();
    loop.set("force", 1.8);
    draw(loop, bow_m_s);
    loop.advance(0.45 + 0.25);
    for (double force_n = 1.8; force_n > share * least_n; force_n *= 0.97) {
      loop.set("force", force_n);
      loop.advance(2e-3);
    }
    loop.set("force", share * least_n);
    loop.advance(0.2);
    loop.advance(0.2);
    REQUIRE(loop.time_s() < 1.35);  // the bow turns around then
    bool helmholtz = loop.told().size() > 37;
    for (const Told& slip : loop.told()) {
      helmholtz = helmholtz && std::fabs(slip.value - period_s) < 0.05 * period_s;
    }
    INFO(share << " of the least force: " << loop.told().size() << " slips");
    CHECK(helmholtz == (share > 1));
  }
}

TEST_CASE("page: beyond the bow force's upper limit there is not one slip a period") {
  struct Row {
    double place, bow_m_s;
  };
  for (const Row& row : {Row{0.1, 0.2}, {1 / 7.0, 0.2}, {1 / 13.0, 0.1}}) {
    const double force_n = 1.35 * 2 * 0.35 * row.bow_m_s / (row.place * drop);
    LeverLoop loop = bowed();
    loop.set("force", force_n);
    loop.set("place", row.place);
    const Stretch s = played(loop, row.bow_m_s);
    INFO(force_n << " N at " << row.place << ": " << s.slips << " slips, " << 1e3 * s.shortest_s
                 << " to " << 1e3 * s.longest_s << " ms");
    CHECK_FALSE(s.helmholtz());
    CHECK(s.longest_s > 1.2 * period_s);
  }
}

TEST_CASE("page: friction holds the lever behind the hand as a spring says") {
  for (const double force_n : {1.0, 1.8, 2.5}) {
    LeverLoop loop = bowed();
    loop.set("force", force_n);
    const Stretch s = played(loop, 0.2);
    INFO(force_n << " N: " << s.mean_nm << " Nm");
    // The second stroke goes back, at 0.2 m/s over 0.1 m; some of the turn's swing is left.
    CHECK(s.mean_rad_s == Approx(-2).epsilon(0.02));
    CHECK(s.mean_behind_rad == Approx(-s.mean_nm / hand_nm_rad).margin(2e-3));
    CHECK(s.mean_nm > 0.1 * dynamic * force_n);
    CHECK(s.mean_nm < 0.1 * (dynamic + drop) * force_n);
    // The mean of a longer advance() is that of its runs, which the same loop makes one by one.
    LeverLoop again = bowed();
    again.set("force", force_n);
    played(again, 0.2);
    double sum_nm = 0;
    for (int i = 0; i < 400; ++i) {
      loop.advance(1.000001 * loop.law().period_s());
      sum_nm += loop.force();
    }
    again.advance(400.0004 * again.law().period_s());
    CHECK(again.mean_force() == Approx(sum_nm / 400));
  }
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

TEST_CASE("page: a hand at rest is silent, and a string whose bow rests falls silent") {
  LeverLoop loop = bowed();
  loop.set("force", 2);
  loop.advance(0.5);
  CHECK(loop.seen().size() == 20000);
  CHECK(loop.told().empty());
  CHECK(loop.force() == 0);
  for (const float heard : loop.seen()) REQUIRE(heard == 0);
  draw(loop, 0.2);
  loop.advance(1);
  CHECK(*std::max_element(loop.seen().begin(), loop.seen().end()) > 0.8F);
  draw(loop, 0);
  loop.advance(1.5);
  loop.advance(0.1);
  CHECK(loop.told().empty());
  for (const float heard : loop.seen()) REQUIRE(std::fabs(heard) < 0.01F);
}

TEST_CASE("page: at 1 kHz the pitch is not the string's, and follows the force") {
  double before_s = period_s;
  for (const double force_n : {1.0, 2.5}) {
    LeverLoop loop = bowed(1000);
    CHECK(1 / loop.law().period_s() == Approx(1000));
    loop.set("force", force_n);
    const Stretch s = played(loop, 0.2);
    INFO(force_n << " N: " << 1e3 * s.shortest_s << " to " << 1e3 * s.longest_s << " ms");
    REQUIRE(s.slips > 5);
    CHECK_FALSE(s.helmholtz());
    CHECK(s.seconds / (s.slips - 1) > 1.2 * before_s);
    before_s = s.seconds / (s.slips - 1);
  }
}

TEST_CASE("page: a law refuses what is no force, no parameter, no state and no image") {
  LeverLoop loop = bowed();
  CHECK_THROWS_AS(loop.set("force", 5), std::invalid_argument);
  CHECK_THROWS_AS(loop.set("rosin", 1), std::invalid_argument);
  CHECK_THROWS_AS(state_word(shipped("bowed_string"), "rosin"), std::invalid_argument);
  CHECK_THROWS_AS(loop.load("nonsense"), std::invalid_argument);
}

}  // namespace feltgate::page
