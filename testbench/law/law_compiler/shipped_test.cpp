// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Every shipped law is proven, small and fast, and its runs stay within the bound.
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include "catch.hpp"

#include "compiled.hpp"
#include "law/listing.hpp"
#include "law/verdict.hpp"

namespace feltgate::law {
namespace {

struct Goal {
  int instructions;
  double rate_hz;
};

TEST_CASE("shipped laws are proven, fit their rate and stay within their bounds") {
  const std::map<std::string, Goal> goals = {
      {"detent", {4, 1e6}},  {"wall", {6, 1e6}},          {"spring", {6, 1e6}},
      {"damper", {6, 1e6}},  {"ceiling", {6, 1e6}},       {"membrane", {8, 5e5}},
      {"charge", {14, 5e5}}, {"quaternion", {27, 2.5e5}}, {"pantograph", {33, 2.5e5}}};
  for (const std::string& name : shipped_names()) {
    INFO(name);
    const Compiled& c = compiled_shipped(name);
    CHECK(c.bound.unproven.empty());
    const auto goal = goals.find(name);
    if (goal != goals.end()) {
      CHECK(static_cast<int>(c.assembled.instructions.size()) <= goal->second.instructions);
      CHECK(c.rate_hz >= goal->second.rate_hz);
    }
    check_within(c, measure(c, 1, runs_of(3000)));
    if (c.bound.states_bounded) check_within(c, measure(c, 2, runs_of(3000), true));
  }
}

TEST_CASE("what the page says of the strips and bounds of shipped laws") {
  for (const char* name : {"wall", "membrane", "charge", "charge_far"}) {
    INFO(name);
    const Compiled& c = compiled_shipped(name);
    CHECK(c.bound.strips.empty());
    CHECK_FALSE(c.bound.sharp.empty());
  }
  for (const char* name : {"charge", "charge_far"}) {
    CHECK(compiled_shipped(name).bound.output[0] < 0.27e-3);
  }
  for (const auto& [name, width] :
       std::map<std::string, double>{{"quaternion", 1.95e-6}, {"gimbal", 4.45e-4}}) {
    INFO(name);
    const Compiled& c = compiled_shipped(name);
    REQUIRE_FALSE(c.bound.strips.empty());
    for (const Strip& s : c.bound.strips) CHECK(s.width < width);
  }
  CHECK(compiled_shipped("detent").bound.sharp.empty());
}

TEST_CASE("a law of one input and no state is run over all of its positions") {
  const Compiled& c = compiled_shipped("detent");
  const Measured m = measure_all(c);
  CHECK(m.all_inputs);
  CHECK(m.runs == 262145);
  check_within(c, m);
  // One LSB of torque, as docs/laws.md promises.
  CHECK(m.output[0] <= std::ldexp(1.0, -16));
  CHECK_FALSE(measure_all(compiled_shipped("damper")).all_inputs);
}

}  // namespace

// Words beside the law as its text says it, each by itself; drift, words of one value, ends, and
// bounds that say nothing.

namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

const char* const kStage =
    "state stage = 0 in 0 .. 7 whole\nnext stage = clamp(4 * position, 0, 7)\n"
    "out torque = if stage == 7 then 0.1 Nm else 0 Nm\n";

TEST_CASE("free runs begin with the file's values and go on as its text says") {
  const Compiled c = compiled(kStage);
  const FreeRuns free = measure_free(c, 1, 20000);
  CHECK(free.acting > 20);
  CHECK(free.left == 0);
  CHECK(free.most[0] < 1e-5);
  // Words of another law: the state is set to what the words say before each run of measure(), so
  // that only free runs see this.
  Compiled other = c;
  other.law.source = std::string(kStage).replace(std::string(kStage).find("== 7"), 4, "== 6");
  const FreeRuns wrong = measure_free(other, 1, 20000);
  CHECK(wrong.left * 10 > 3 * wrong.acting);
  CHECK(wrong.most[0] > 0.09);
  CHECK(measure(other, 1, 5000).output[0] < 1e-5);
  Measured m = measure(other, 1, 5000);
  m.free = wrong;
  REQUIRE(verdict(other, m).failures.size() == 1);
  CHECK_THAT(verdict(other, m).failures[0], Contains("starts the words leave the law"));
  m.free.left = m.free.acting / 5;
  CHECK(verdict(other, m).failures.empty());
  CHECK_THAT(text(verdict(other, m)), StartsWith("warning: in "));
  CHECK_THAT(report(other, m), Contains("free runs: ") && Contains("starts left the law"));
  // A law that was not read from a text has no free runs.
  other.law.source.clear();
  CHECK(measure_free(other, 1, 1000).runs == 0);
}

TEST_CASE("a large drift of a state fails, with its reason") {
  const auto failed = [](const std::string& law) {
    const Compiled c = compiled(law);
    return text(verdict(c, measure(c, 1, 2000)));
  };
  const std::string v = "rate = 50 kHz\nlet v = clamp(velocity, -50 rad/s, 50 rad/s)\n";
  const std::string f = "state f = 0 Nm in -0.2 .. 0.2 Nm\nnext f = clamp(f + ";
  CHECK_THAT(failed(v + "let big = (v / (0.1 rad/s))^2 * (position / (0.001 rad))\n" + f +
                    "0.001 Nm * clamp(big, -9, 9), -0.2 Nm, 0.2 Nm)\nout torque = -f\n"),
             StartsWith("failed: state f: a run adds an error of up to") &&
                 Contains("% of its range, -0.2 .. 0.2: what it does is no longer the law's; the "
                          "number ") &&
                 Contains(" of line 5 became 0 there: 0 words of step"));
  // A friction whose level falls with the speed: its limit is moved before the square.
  const Compiled c = compiled(v +
                              "param stribeck = 0.5 rad/s in 0.1 .. 5 rad/s\n"
                              "let level = 0.1 Nm + 0.1 Nm * exp(-min((v / stribeck)^2, 9))\n" +
                              f + "dt * 10 Nm/rad * v, -level, level)\nout torque = -f\n");
  CHECK(verdict(c, measure(c, 1, 2000)).failures.empty());
  CHECK(c.bound.drift[0] < 0.002 * 0.4);
  CHECK(measure_free(c, 1, 20000).most[0] < 0.001);
}

TEST_CASE("a parameter or an output of one value fails where the law has many") {
  const std::string magnet =
      "param strength = 0.3 Nm in -1 .. 1 Nm\nparam width = 0.1 rad in 0.05 .. 0.5 rad\n"
      "let u = clamp(position / width, -20, 20)\n"
      "out torque = -strength * u / (1 + u^2)^2 * 3\n";
  // No format makes the torque 0, and the error with it.
  const Compiled c = compiled(magnet);
  const auto step = std::find_if(c.image.words.begin(), c.image.words.end(),
                                 [](const ImageWord& w) { return w.name == "strength"; });
  REQUIRE(step != c.image.words.end());
  CHECK(std::fabs(step->scale) < 0.1);
  CHECK(!verdict(c, measure_all(c)).failures.empty());
  const Compiled one = compiled("param k = 1 nNm in 0 .. 2 nNm\nout torque = k\n");
  REQUIRE(verdict(one, {}).failures.size() == 1);
  CHECK_THAT(verdict(one, {}).failures[0], Contains("k: every value of 0 .. 2 nNm becomes 0"));
  Compiled dead = compiled("out torque = 0.1 Nm * clamp(position, -1, 1)\n");
  for (Span& words : dead.bound.words) words = {0, 0};
  REQUIRE(verdict(dead, {}).failures.size() == 1);
  CHECK_THAT(verdict(dead, {}).failures[0],
             Contains("torque: the words always give 0 Nm, where the law gives -0.1 .. 0.1 Nm"));
}

TEST_CASE(
    "a state's word at an end of a clamp stands for that end, though its step does not divide it") {
  const auto law = [](const char* range, const char* end) {
    return fmt::format(
        "param p = 0.7 in 0.1 .. 1.7\nstate kept = 0 in -{0} .. {0}\n"
        "next kept = clamp(p * position, -{1}, {1})\n"
        "out torque = if kept >= {1} then 0.2 Nm else if kept < -{1} then -0.2 Nm else 0.01 Nm * "
        "kept\n",
        range, end);
  };
  for (const std::string& text : {law("10", "9"), law("6", "6")}) {
    const Compiled c = compiled(text);
    const Measured m = measure(c, 1, 20000);
    INFO(text);
    CHECK(verdict(c, m).failures.empty());
    CHECK(m.in_strips < 20);
    check_within(c, m);
    CHECK(measure_free(c, 1, 20000).left == 0);
  }
}

TEST_CASE("a bound far above every error is no useful bound") {
  const Compiled c = compiled("out torque = 0.1 Nm * clamp(position, -1, 1)\n");
  Measured m = measure(c, 1, 1000);
  CHECK_THAT(report(c, m), !Contains("no useful bound"));
  Compiled wide = c;
  wide.bound.output = {101 * m.output[0]};
  CHECK_THAT(report(wide, m), !Contains("no useful bound"));  // less than 1 % of what the law gave
  wide.bound.output = {0.05};
  CHECK(useful_bounds(wide, m) == std::vector<bool>{false});
  CHECK_THAT(report(wide, m), StartsWith("warning: torque: no useful bound: 0.05 Nm, where") &&
                                  Contains("   no useful bound\n"));
  m.free.most = {0.001};
  CHECK(useful_bounds(wide, m) == std::vector<bool>{true});
}

TEST_CASE("the seams of a table count where they are") {
  // The seams of 1/x are largest at its small end, where the factor is small too.
  const Compiled c = compiled(
      "rate = 20 kHz\nparam least = 0.02 Nm in 0.01 .. 0.2 Nm\n"
      "let t = clamp(tau_hat, -0.5 Nm, 0.5 Nm)\nlet level = lowpass(abs(t), 20 Hz)\n"
      "out torque = -t * level / (level + least)\n");
  CHECK(c.bound.output[0] < 0.005);  // 0.072 with the largest seam everywhere
}

}  // namespace
}  // namespace feltgate::law
