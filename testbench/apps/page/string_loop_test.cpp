// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The page's bowed string: what the docs' table says of slips and pitch, the sawtooth of Helmholtz
// motion in closed form, a hand that the friction holds back, silence. Documentation: docs/page.md
#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "apps/page/law_loops.hpp"
#include "catch.hpp"
#include "law/compile.hpp"
#include "law/read_law.hpp"
#include "sim/backends/backend.hpp"

namespace feltgate::page {
namespace {

const law::Compiled& bowed(double rate_hz = 0) {
  const auto compiled = [](double hz) {
    return law::compile(
        law::read_law(std::string(FELTGATE_ROOT) + "/rtl/laws/bowed_string.law", hz),
        law::target_of(design_named("lever")));
  };
  static const law::Compiled fast = compiled(0), slow = compiled(1000);
  return rate_hz > 0 ? slow : fast;
}

StringLoop loop_of(const law::Compiled& law) {
  return StringLoop(law::text(law.image), state_word(law, "heard"));
}

constexpr double period_s = 1.0 / 196, drop = 0.5, dynamic = 0.3;
constexpr double pi = 3.14159265358979;
const plant::Impedance hand;

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
Stretch played(StringLoop& loop, double bow_m_s) {
  loop.draw(bow_m_s);
  const double dt = loop.law().period_s(), way_s = StringLoop::turn_rad * 0.1 / bow_m_s;
  loop.advance(3 * way_s - 0.25 - 0.01);
  Stretch s;
  const int runs = static_cast<int>(std::lround(0.25 / dt));
  std::vector<double> heard, at_s;
  double first_s = 0, last_s = 0;
  for (int i = 0; i < runs; ++i) {
    loop.advance(1.000001 * dt);
    s.mean_rad_s += loop.speed_rad_s() / runs;
    s.mean_nm += loop.torque_nm() / runs;
    s.mean_behind_rad += (loop.hand_rad() - loop.theta_rad()) / runs;
    for (const float h : loop.heard_m_s()) {
      heard.push_back(static_cast<double>(h));
      at_s.push_back(loop.time_s());
    }
    for (const StringSlip& slip : loop.slips()) {
      if (++s.slips == 1) first_s = slip.time_s;
      last_s = slip.time_s;
      s.shortest_s = std::min(s.shortest_s, slip.since_s);
      s.longest_s = std::max(s.longest_s, slip.since_s);
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

TEST_CASE("page: a bow that draws itself makes one slip a period, as far apart as the docs say") {
  // docs/devices/strings-and-drums.md, at 40 kHz, 0.2 m/s and 1/10: force, least and most between
  // slips.
  struct Row {
    double force_n, least_ms, most_ms;
  };
  const double bow_m_s = 0.2, place = 0.1;
  for (const Row& row :
       {Row{1, 5.125, 5.15}, {1.5, 5.15, 5.15}, {2, 5.2, 5.2}, {2.5, 5.225, 5.3}}) {
    StringLoop loop = loop_of(bowed());
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
    StringLoop loop = loop_of(bowed());
    loop.set("force", 1.8);
    loop.draw(bow_m_s);
    loop.advance(0.45 + 0.25);
    for (double force_n = 1.8; force_n > share * least_n; force_n *= 0.97) {
      loop.set("force", force_n);
      loop.advance(2e-3);
    }
    loop.set("force", share * least_n);
    loop.advance(0.2);
    loop.advance(0.2);
    REQUIRE(loop.time_s() < 1.35);  // the bow turns around then
    bool helmholtz = loop.slips().size() > 37;
    for (const StringSlip& slip : loop.slips()) {
      helmholtz = helmholtz && std::fabs(slip.since_s - period_s) < 0.05 * period_s;
    }
    INFO(share << " of the least force: " << loop.slips().size() << " slips");
    CHECK(helmholtz == (share > 1));
  }
}

TEST_CASE("page: beyond the bow force's upper limit there is not one slip a period") {
  struct Row {
    double place, bow_m_s;
  };
  for (const Row& row : {Row{0.1, 0.2}, {1 / 7.0, 0.2}, {1 / 13.0, 0.1}}) {
    const double force_n = 1.35 * 2 * 0.35 * row.bow_m_s / (row.place * drop);
    StringLoop loop = loop_of(bowed());
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
  const double stiffness = hand.stiffness_n_m * Lever::radius_m * Lever::radius_m;
  for (const double force_n : {1.0, 1.8, 2.5}) {
    StringLoop loop = loop_of(bowed());
    loop.set("force", force_n);
    const Stretch s = played(loop, 0.2);
    INFO(force_n << " N: " << s.mean_nm << " Nm");
    // The second stroke goes back, at 0.2 m/s over 0.1 m; some of the turn's swing is left.
    CHECK(s.mean_rad_s == Approx(-2).epsilon(0.02));
    CHECK(s.mean_behind_rad == Approx(-s.mean_nm / stiffness).margin(2e-3));
    CHECK(s.mean_nm > 0.1 * dynamic * force_n);
    CHECK(s.mean_nm < 0.1 * (dynamic + drop) * force_n);
    // The mean of a longer advance() is that of its runs, which the same loop makes one by one.
    StringLoop again = loop_of(bowed());
    again.set("force", force_n);
    played(again, 0.2);
    double sum_nm = 0;
    for (int i = 0; i < 400; ++i) {
      loop.advance(1.000001 * loop.law().period_s());
      sum_nm += loop.torque_nm();
    }
    again.advance(400.0004 * again.law().period_s());
    CHECK(again.mean_nm() == Approx(sum_nm / 400));
  }
}

TEST_CASE("page: a bow that draws itself goes to and fro between its turns") {
  StringLoop loop = loop_of(bowed());
  loop.lead(1);
  loop.advance(0.5);
  CHECK(loop.hand_rad() == Approx(1));
  // 0.3 m/s over 0.1 m: 3 rad/s. First back from beyond the turn, or on: it never goes further.
  loop.draw(-0.3);
  loop.advance(1.9 / 3);
  CHECK(loop.hand_rad() == Approx(-0.9).margin(1e-3));
  loop.advance(0.6);
  CHECK(loop.hand_rad() == Approx(0.9).margin(1e-3));
  loop.advance(0.3);
  CHECK(loop.hand_rad() == Approx(0).margin(1e-3));
  // By hand again, from where it is; what is no angle is not followed.
  loop.draw(0);
  loop.advance(0.1);
  CHECK(loop.hand_rad() == Approx(0).margin(1e-3));
  loop.lead(NAN);
  loop.lead(5);
  loop.advance(0.1);
  CHECK(loop.hand_rad() == StringLoop::farthest_rad);
}

TEST_CASE("page: a hand at rest is silent, and a string whose bow rests falls silent") {
  StringLoop loop = loop_of(bowed());
  loop.set("force", 2);
  loop.advance(0.5);
  CHECK(loop.heard_m_s().size() == 20000);
  CHECK(loop.slips().empty());
  CHECK(loop.torque_nm() == 0);
  for (const float heard : loop.heard_m_s()) REQUIRE(heard == 0);
  loop.draw(0.2);
  loop.advance(1);
  CHECK(*std::max_element(loop.heard_m_s().begin(), loop.heard_m_s().end()) > 0.8F);
  loop.draw(0);
  loop.advance(1.5);
  loop.advance(0.1);
  CHECK(loop.slips().empty());
  for (const float heard : loop.heard_m_s()) REQUIRE(std::fabs(heard) < 0.01F);
}

TEST_CASE("page: at 1 kHz the pitch is not the string's, and follows the force") {
  double before_s = period_s;
  for (const double force_n : {1.0, 2.5}) {
    StringLoop loop = loop_of(bowed(1000));
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

TEST_CASE("page: the string refuses what is no string, no force and no state") {
  StringLoop loop = loop_of(bowed());
  CHECK_THROWS_AS(loop.set("force", 5), std::invalid_argument);
  CHECK_THROWS_AS(loop.set("rosin", 1), std::invalid_argument);
  CHECK_THROWS_AS(state_word(bowed(), "rosin"), std::invalid_argument);
  const StateWord heard = state_word(bowed(), "heard");
  CHECK_THROWS_AS(StringLoop("nonsense", heard), std::invalid_argument);
  CHECK_THROWS_AS(StringLoop(law::text(bowed().image), {-1, 1}), std::invalid_argument);
  const law::Compiled drums = law::compile_file(std::string(FELTGATE_ROOT) + "/rtl/laws/drums.law",
                                                law::target_of(design_named("lever")));
  CHECK_THROWS_AS(StringLoop(law::text(drums.image), heard), std::invalid_argument);
}

}  // namespace feltgate::page
