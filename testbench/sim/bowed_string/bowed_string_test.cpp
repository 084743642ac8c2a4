// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The bowed string: Helmholtz motion over a range of bow force, and its motion at 1 kHz.
// Documentation: docs/devices/bowed_string.md
#include "bowed_string.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "law/evaluate.hpp"

using namespace feltgate;

namespace {

/// The least and the most of `count` forces at equal ratios, and those between.
std::vector<double> forces(double least_n, double most_n, int count) {
  std::vector<double> all;
  for (int i = 0; i < count; ++i) {
    all.push_back(least_n * std::pow(most_n / least_n, i / (count - 1.0)));
  }
  return all;
}

/// Played first where Helmholtz motion begins by itself.
Bowing kept(double place, double bow_m_s, double force_n) {
  return {place, bow_m_s, 0.7 * schelleng(bow_m_s, place, 0.5, 0.9656).most_n, force_n};
}

}  // namespace

TEST_CASE("Helmholtz motion: exactly one slip a period from 0.15 to 2.8 N") {
  const law::Compiled law = BowedString::compiled();
  CHECK(law.rate_hz == 40000);
  std::vector<double> sliding;
  for (const double force_n : forces(0.15, 2.8, 14)) {
    const Motion m = play(law, kept(0.1, 0.2, force_n));
    INFO(force_n);
    CHECK(m.helmholtz());
    sliding.push_back(m.sliding);
    CHECK(m.most_nm <= 0.1 * 0.8 * force_n * (1 + 1e-3));
    // Friction is between that of a fast bow and the static one; the bow always gives.
    CHECK(-m.mean_nm > 0.1 * 0.3 * force_n);
    CHECK(-m.mean_nm < 0.1 * 0.8 * force_n);
  }
  // Little force leaves the corner round, so that the string slides for longer than the 0.1 of a
  // period for which the corner is beyond the bow.
  CHECK(sliding.back() == Approx(0.1).margin(0.02));
  CHECK(sliding.front() > 0.3);
}

TEST_CASE("Helmholtz motion within Schelleng's limits, none beyond them") {
  const law::Compiled law = BowedString::compiled();
  for (const double place : {1 / 7.0, 0.1, 1 / 13.0}) {
    const Schelleng limits = schelleng(0.2, place, 0.5, 0.9656);
    INFO(place << ": " << limits.least_n << " to " << limits.most_n);
    CHECK_FALSE(play(law, kept(place, 0.2, 0.7 * limits.least_n)).helmholtz());
    for (const double force_n : forces(1.3 * limits.least_n, 0.7 * limits.most_n, 6)) {
      INFO(force_n);
      CHECK(play(law, kept(place, 0.2, force_n)).helmholtz());
    }
    if (1.35 * limits.most_n > 4) continue;  // no host can ask for it
    CHECK_FALSE(play(law, kept(place, 0.2, 1.35 * limits.most_n)).helmholtz());
  }
}

TEST_CASE("what is heard grows with the bow's speed over its place, not with its force") {
  const law::Compiled law = BowedString::compiled();
  const double heard = play(law, kept(0.1, 0.2, 1)).heard_m_s;
  CHECK(play(law, kept(0.1, 0.4, 1)).heard_m_s == Approx(2 * heard).epsilon(0.25));
  CHECK(play(law, kept(1 / 7.0, 0.2, 1)).heard_m_s == Approx(0.7 * heard).epsilon(0.25));
  CHECK(play(law, kept(0.1, 0.2, 2)).heard_m_s == Approx(heard).epsilon(0.25));
}

TEST_CASE("at 1 kHz the string has no pitch of its own: slips come as the force wants") {
  const law::Compiled fast = BowedString::compiled(), slow = BowedString::compiled(1000);
  double least_s = 1, most_s = 0;
  for (const double force_n : {1.0, 1.5, 2.0, 2.5}) {
    const Motion m = play(slow, {0.1, 0.2, force_n, force_n});
    INFO(force_n);
    CHECK_FALSE(m.helmholtz());
    CHECK(m.shortest_s > 1.1 / BowedString::pitch_hz);
    least_s = std::min(least_s, m.shortest_s);
    most_s = feltgate::larger(most_s, m.longest_s);
    CHECK(play(fast, kept(0.1, 0.2, force_n)).helmholtz());
  }
  CHECK(most_s > 1.5 * least_s);
}

TEST_CASE(
    "words and law in double: alike until a slip falls into another run, then alike in kind") {
  const law::Compiled law = BowedString::compiled();
  BowedString words(law);
  law::Evaluation<double> real(law.law);
  for (std::size_t n = 0; n < law.law.parameters.size(); ++n) {
    const law::Parameter& p = law.law.parameters[n];
    if (p.derived < 0) real.set_parameter(n, words.value(p.name));
  }
  int alike = 0, word_slips = 0, real_slips = 0;
  bool same = true;
  double off_nm = 0;
  for (int i = 0; i < 40000; ++i) {
    const double bow_m_s = 0.2 * std::min(1.0, i / 2000.0), reach = words.value("reach");
    const int bits = law.target.velocity.fraction;
    const double torque = words.run(bow_m_s);
    real.run({std::ldexp(std::nearbyint(std::ldexp(bow_m_s / reach, bits)), -bits)});
    same = same && real.happened(0) == words.slipped();
    if (same) {
      ++alike;
      off_nm = feltgate::larger(off_nm, std::fabs(torque - real.outputs()[0]));
    }
    if (i < 20000) continue;
    word_slips += words.slipped() ? 1 : 0;
    real_slips += real.happened(0) ? 1 : 0;
  }
  CHECK(alike > 1000);
  CHECK(off_nm < 1e-4);
  CHECK(word_slips == Approx(0.5 * 196).margin(5));
  CHECK(std::abs(real_slips - word_slips) <= 2);
}

TEST_CASE("the diagram of the page", "[.diagram]") {
  const law::Compiled law = BowedString::compiled();
  fmt::print("place,force_n,least_n,most_n,helmholtz\n");
  for (const double place : forces(0.052, 0.24, 14)) {
    const Schelleng limits = schelleng(0.2, place, 0.5, 0.9656);
    for (const double force_n : forces(0.05, 4, 23)) {
      Bowing bowing = kept(place, 0.2, force_n);
      bowing.first_n = std::min(bowing.first_n, 3.5);
      fmt::print("{:.5f},{:.5f},{:.5f},{:.5f},{:d}\n", place, force_n, limits.least_n,
                 limits.most_n, play(law, bowing).helmholtz());
    }
    std::fflush(stdout);
  }
}

TEST_CASE("the table of the page", "[.table]") {
  const law::Compiled law = BowedString::compiled();
  fmt::print("bow, m/s  place  Schelleng, N      Helmholtz, N\n");
  for (const double bow_m_s : {0.1, 0.2, 0.4}) {
    for (const double place : {1 / 7.0, 0.1, 1 / 13.0}) {
      const Schelleng s = schelleng(bow_m_s, place, 0.5, 0.9656);
      const auto end = [&](double ratio) {
        double n = 0.4 * s.most_n;
        while (n * ratio <= 4 && play(law, kept(place, bow_m_s, n * ratio)).helmholtz()) n *= ratio;
        return n;
      };
      const double least = end(1 / 1.05), most = end(1.05);
      fmt::print("{:8.1f} {:6.4f} {:6.3f} .. {:5.2f}  {:6.3f} .. {:5.2f}\n", bow_m_s, place,
                 s.least_n, s.most_n, least, most);
      std::fflush(stdout);
    }
  }
  fmt::print("rate, Hz  force, N   slips ms apart\n");
  for (const double rate_hz : {1000.0, 2000.0, 5000.0, 10000.0, 20000.0, 40000.0}) {
    const law::Compiled at = BowedString::compiled(rate_hz);
    for (const double force_n : {0.5, 1.0, 1.5, 2.0, 2.5}) {
      const Motion m = play(at, {0.1, 0.2, 2, force_n});
      fmt::print("{:8.0f} {:6.1f} {:10.3f} .. {:6.3f} heard {:.3f} {}\n", rate_hz, force_n,
                 1e3 * m.shortest_s, 1e3 * m.longest_s, m.heard_m_s,
                 m.helmholtz() ? "Helmholtz" : "");
    }
  }
}
