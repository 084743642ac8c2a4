// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The bowed string: Helmholtz motion over a range of bow force, and its motion at 1 kHz; four
// strings give no bow more than they took. Documentation: docs/devices/strings-and-drums.md
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "law/compile.hpp"
#include "law/engine/machine.hpp"
#include "law/host_machine.hpp"
#include "law/load.hpp"
#include "law/read_law.hpp"

using namespace feltgate;

namespace {

/// rtl/laws/bowed_string.law, or four_strings.law, in the interpreter of the engine's words: what
/// the engine computes, bit for bit, under a bow that a test leads.
class BowedString {
 public:
  /// Of the law's file, no parameters.
  static constexpr double pitch_hz = 196, impedance_n_s_m = 0.35;

  /// At a rate in Hz; 0: that of the file.
  static law::Compiled compiled(double rate_hz = 0, const std::string& name = "bowed_string") {
    return law::compile(
        law::read_law(std::string(FELTGATE_ROOT) + "/rtl/laws/" + name + ".law", rate_hz),
        law::Target{});
  }
  /// The law must outlive this.
  explicit BowedString(const law::Compiled& law)
      : c_(law), values_(law.image), machine_(law::memory(law.image)) {
    machine_.enter();
  }
  double rate_hz() const { return c_.rate_hz; }

  /// In the file's units, which are SI, as far as the ranges go; in force with the next run.
  void set(std::map<std::string, double> values) {
    for (auto& [name, value] : values) value = values_.within(name, value);
    law::write(machine_, values_.set(values));
  }
  double value(const std::string& name) const { return values_.value(name); }

  /// A run with the bow at this speed, the lever at this angle; the torque, Nm.
  double run(double bow_m_s, double lever_rad = 0) {
    law::MachineInputs inputs{};
    inputs[0] = static_cast<std::int32_t>(std::lround(lever_rad / c_.target.count_rad()));
    const double lever_rad_s = bow_m_s / values_.value("reach");
    inputs[1] = static_cast<std::int32_t>(
        std::lround(std::ldexp(lever_rad_s, c_.target.velocity.fraction)));
    const law::MachineRun& r = machine_.run(c_.target.thread, inputs);
    slipped_ = !r.events.empty();
    if (slipped_) since_s_ = r.events.front().value * c_.image.events.front().scale;
    return std::ldexp(static_cast<double>(r.outputs[0]), -c_.target.torque.fraction);
  }
  /// Whether a slip began in the last run, and the time since the one before it.
  bool slipped() const { return slipped_; }
  double since_s() const { return since_s_; }
  double state(const std::string& name) const {
    for (std::size_t k = 0; k < c_.law.states.size(); ++k) {
      if (c_.law.states[k].name != name) continue;
      const int address =
          c_.target.thread * EngineMap::private_words + c_.assembled.state_address[k];
      return machine_.memory().data_at(address) * c_.program.states[k].scale;
    }
    throw std::runtime_error("no state " + name);
  }

 private:
  const law::Compiled& c_;
  law::LoadedParameters values_;
  law::Machine machine_;
  bool slipped_ = false;
  double since_s_ = 0;
};

/// How a string moves in a stretch of time.
struct Motion {
  int slips = 0;
  double shortest_s = 1, longest_s = 0;  ///< between two of them
  double sliding = 0;                    ///< share of the time
  double heard_m_s = 0;                  ///< largest at the bridge
  double mean_nm = 0, most_nm = 0;       ///< torque; the largest amount
  /// Exactly one slip in every period of the string, to 5 %: much force keeps the corner back.
  bool helmholtz() const {
    const double period_s = 1 / BowedString::pitch_hz;
    return slips > 1 && shortest_s > 0.95 * period_s && longest_s < 1.05 * period_s;
  }
};

/// A bow of even speed after 50 ms, played at `first_n` for 0.25 s, from there to `force_n` within
/// 0.4 s where they differ; the 0.25 s after another 0.25 s.
struct Bowing {
  double place = 0.1, bow_m_s = 0.2, first_n = 2, force_n = 2;
};
Motion play(const law::Compiled& law, const Bowing& b) {
  BowedString string(law);
  string.set({{"place", b.place}, {"force", b.first_n}});
  const bool changes = b.first_n != b.force_n;
  const double from_s = 0.25, way_s = changes ? 0.4 : 0, settle_s = 0.25, seen_s = 0.25;
  const auto runs = [&](double s) { return static_cast<int>(std::lround(s * string.rate_hz())); };
  const int each = std::max(1, runs(1e-3)), watch = runs(from_s + way_s + settle_s),
            end = watch + runs(seen_s);
  Motion m;
  for (int i = 0; i < end; ++i) {
    const double t = i / string.rate_hz(), way = (t - from_s) / 0.4;
    if (changes && i % each == 0 && way > 0 && way < 1.01) {
      string.set({{"force", b.first_n + (b.force_n - b.first_n) * std::min(way, 1.0)}});
    }
    const double torque = string.run(b.bow_m_s * std::min(1.0, t / 0.05));
    if (i < watch) continue;
    if (string.slipped()) {
      ++m.slips;
      m.shortest_s = std::min(m.shortest_s, string.since_s());
      m.longest_s = std::max(m.longest_s, string.since_s());
    }
    m.sliding += string.state("stuck") > 0.5 ? 0 : 1.0 / (end - watch);
    m.heard_m_s = larger(m.heard_m_s, std::fabs(string.state("heard")));
    m.mean_nm += torque / (end - watch);
    m.most_nm = larger(m.most_nm, std::fabs(torque));
  }
  return m;
}

/// Limits of the bow force, N: J. C. Schelleng, The bowed string and the player, Journal of the
/// Acoustical Society of America 53, 26-41, 1973. `drop` is static less dynamic friction.
struct Schelleng {
  double least_n, most_n;
};
Schelleng schelleng(double bow_m_s, double place, double drop, double reflected) {
  const double z = BowedString::impedance_n_s_m, bridge = z * (1 + reflected) / (1 - reflected);
  return {z * z * bow_m_s / (2 * bridge * place * place * drop), 2 * z * bow_m_s / (place * drop)};
}

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
  for (const double force_n : forces(0.15, 2.8, 6)) {
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
    for (const double force_n : forces(1.3 * limits.least_n, 0.7 * limits.most_n, 3)) {
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
  for (const double force_n : {1.0, 1.5, 2.5}) {
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

TEST_CASE("four strings: no bow, however it moves and changes strings, takes more than it gave") {
  const law::Compiled law = BowedString::compiled(0, "four_strings");
  std::mt19937 random(7);
  const auto any = [&](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  };
  double taken_j = 0, most_j = 0;
  for (int play = 0; play < 100; ++play) {
    BowedString violin(law);
    double given_j = 0, bow_m_s = 0, lever_rad = 0;
    const int longest = 1 << (play % 8);
    for (int i = 0, until = 0; i < 600; ++i) {
      if (i == until) {
        until += 1 + static_cast<int>(any(0, longest));
        bow_m_s = any(-1, 1), lever_rad = any(0, 1.2);
        if (any(0, 1) < 0.2) violin.set({{"force", any(0, 4)}});
      }
      given_j -= violin.run(bow_m_s, lever_rad) * bow_m_s / violin.value("reach") / 31250;
      taken_j = feltgate::larger(taken_j, -given_j);
      most_j = feltgate::larger(most_j, given_j);
    }
  }
  CHECK(taken_j < 1e-6);
  CHECK(most_j > 1e-3);
}
