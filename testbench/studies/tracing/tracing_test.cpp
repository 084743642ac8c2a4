// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The study of hidden shapes without people: a blind robot on the twin. docs/devices/shapes.md
#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <tuple>

#include "catch.hpp"
#include "guesses.hpp"
#include "mismatch.hpp"

using namespace feltgate::test;

namespace {

/// What was traced once: the twin does the same again.
class Traces {
 public:
  const Trace& of(std::size_t shape, const Cues& cues, std::size_t start) {
    const double k = cues.stiffness ? kShapes[shape].stiffness_n_m : kHard_n_m;
    const double b = cues.damping ? kShapes[shape].damping_ns_m : kSlippery_ns_m;
    const auto [at, is_new] = known_.try_emplace({shape, k, b, start});
    if (is_new) at->second = traced(static_cast<int>(shape), k, b, kStarts.at(start));
    return at->second;
  }

 private:
  std::map<std::tuple<std::size_t, double, double, std::size_t>, Trace> known_;
};

/// A hundred lives of each trace.
Confusion lives(const Guesser& guesser, Traces& traces, const Cues& cues, const Memory& memory) {
  std::mt19937_64 random(1);
  Confusion guesses{};
  for (std::size_t shape = 0; shape < kShapes.size(); ++shape) {
    for (std::size_t start = 0; start < 2; ++start) {
      const Trace& trace = traces.of(shape, cues, start);
      for (int life = 0; life < 100; ++life) {
        ++guesses[shape][static_cast<std::size_t>(guesser.guess(trace, cues, memory, random))];
      }
    }
  }
  return guesses;
}

std::string paging_script(const std::string& name) {
  std::ifstream in(FELTGATE_SOURCE_DIR "/scripts/web_page/" + name);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("tracing: the shapes' materials are those of the page's game") {
  const std::string pen = paging_script("pen.js"), game = paging_script("game.js");
  const auto value = [&](const std::string& name) {
    std::smatch found;
    REQUIRE(std::regex_search(pen, found, std::regex("\\b" + name + " = ([0-9.]+)")));
    return std::stod(found[1]);
  };
  for (const Shape& shape : kShapes) {
    INFO(shape.name);
    std::smatch found;
    const std::regex entry(std::string(shape.name) + R"(: \[(\w+), (\w+)\])");
    REQUIRE(std::regex_search(game, found, entry));
    CHECK(value(found[1]) == shape.stiffness_n_m);
    CHECK(value(found[2]) == shape.damping_ns_m);
  }
}

TEST_CASE("tracing: every shape is walked around and named, its material felt") {
  const Guesser guesser;
  std::mt19937_64 random(1);
  Traces traces;
  const Cues cues{true, true};
  for (std::size_t shape = 0; shape < kShapes.size(); shape += whole_run() ? 1 : 3) {
    INFO(kShapes[shape].name);
    const Trace& trace = traces.of(shape, cues, shape % kStarts.size());
    CHECK(trace.closed);
    const Material felt = felt_material(trace);
    CHECK(felt.stiffness_n_m == Approx(kShapes[shape].stiffness_n_m).epsilon(0.1));
    CHECK(felt.damping_ns_m == Approx(kShapes[shape].damping_ns_m).margin(0.01));
    CHECK(guesser.guess(trace, {}, {}, random) == static_cast<int>(shape));
    CHECK(guesser.guess(trace, cues, {}, random) == static_cast<int>(shape));
  }
}

TEST_CASE("tracing: how often the robot is right, with cues and without", "[.table]") {
  const Guesser guesser;
  Traces traces;
  const std::array<Cues, 4> all{{{false, false}, {true, false}, {false, true}, {true, true}}};
  std::string text = "degrees per root cm  none  stiffness  damping  both, % right\n";
  for (const double error : {0.0, 5.0, 10.0, 15.0, 20.0, 30.0, 40.0}) {
    text += fmt::format("{:>4}", error);
    for (const Cues& cues : all) {
      text += fmt::format("  {:>6.1f}", 100 * right(lives(guesser, traces, cues, {error})));
    }
    text += "\n";
  }
  for (const Cues& cues : {all.front(), all.back()}) {
    const Confusion guesses = lives(guesser, traces, cues, {kLikePeople});
    text += fmt::format("\n{} degrees, cues {}\n", kLikePeople, cues.damping ? "both" : "none");
    for (std::size_t shape = 0; shape < kShapes.size(); ++shape) {
      text += fmt::format("{:<10}", kShapes[shape].name);
      for (const int n : guesses[shape]) text += fmt::format("{:>6}", n);
      text += fmt::format("   {:.1f} s\n", traces.of(shape, cues, 0).seconds);
    }
  }
  text += "\nfelt from each start, N/m and Ns/m\n";
  for (std::size_t shape = 0; shape < kShapes.size(); ++shape) {
    text += fmt::format("{:<10}", kShapes[shape].name);
    for (std::size_t start = 0; start < 2; ++start) {
      const Material felt = felt_material(traces.of(shape, all.back(), start));
      text += fmt::format("  {:>5.1f} {:>7.4f}", felt.stiffness_n_m, felt.damping_ns_m);
    }
    text += "\n";
  }
  std::fputs(text.c_str(), stdout);
}
