// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Formats that the search must not choose, and the memory that tables need. Documentation:
// docs/laws.md
#include <cmath>

#include "catch.hpp"
#include "law/compile.hpp"
#include "law/measure.hpp"

namespace feltgate::law {
namespace {

/// Checks that the largest difference from the law, in separate runs, is within the bound.
void check_within(const std::string& text) {
  const Compiled c = compile_text(text, "x.law", Target{});
  const Measured m = measure(c, 1, 5000);
  CHECK(c.bound.unproven.empty());
  CHECK(c.bound.output[0] > 0);
  CHECK(c.bound.output[0] < 1e-3);
  CHECK(m.output[0] <= c.bound.output[0] + 1e-8);
}

TEST_CASE("a whole state counts in ones") {
  check_within(
      "state count = 0 in 0 .. 9 whole\n"
      "next count = if count < 5 and not velocity > 1 rad/s then count + 1 else 0\n"
      "out torque = 0.01 Nm * count\n");
}

TEST_CASE("a state has many steps in its range, whatever little is made of it") {
  for (const char* out : {"if big > 5 then 0.2 Nm else 0 Nm", "1e-5 Nm * floor(big)"}) {
    const Compiled c = compile_text(
        std::string("state big = 0 in 0 .. 10\nnext big = clamp(4 * position, 0, 10)\n") +
            "out torque = " + out + "\n",
        "x.law", Target{});
    CHECK(c.program.states[0].scale <= 10 / 256.0);
  }
}

// Laws 60198 and 81752 of the judge.
TEST_CASE("a whole state that no output shows counts in ones as well") {
  const Compiled c = compile_text(
      "rate = 10 kHz\nparam p = 0.616 in 0.1 .. 1.083\nparam q = 0 in -0.936 .. 1\n"
      "param count = 1 in 0 .. 4 whole\nstate stage = 0 in 0 .. 3 whole\n"
      "state side = 1 in -2 .. 2 whole\nline past[2] in -2 .. 2\n"
      "next stage = clamp(stage + (if side != count then 1 else 0) - "
      "(if clamp(position, -0.326, 2.956) < -p then 1 else 0), 0, 3)\n"
      "next side = clamp(side + (if side <= 0 then 1 else 0) - (if stage < count then 1 else 0), "
      "-2, 2)\n"
      "next past = clamp(exp(clamp(past[1] * past[1], -2, 1)), -2, 2)\n"
      "event told(p + q - (1.694 - q)) when side > 2\n"
      "out torque = 1 Nm * clamp(clamp(mod(clamp(past[1], -3, 3) + 0.142, 0.927), -1.5, 1.5)^3, "
      "-4, 4)\n",
      "x.law", Target{});
  int whole = 0;
  for (const Step& s : c.program.steps) {
    if (s.node < 0 || !c.law.nodes[static_cast<std::size_t>(s.node)].whole) continue;
    CHECK(s.scale <= 1);
    ++whole;
  }
  CHECK(whole > 0);
}

TEST_CASE("the word of a whole parameter is a whole number of steps in one") {
  const Compiled c = compile_text(
      "param q = 0 in -1.628 .. 1\nparam count = 1 in 0 .. 4 whole\n"
      "state kept = 0.25 in -2 .. 2\nnext kept = kept + 0.595 * (clamp(sin(2 * position), -2, 2) "
      "- kept)\n"
      "out torque = 1 Nm * (0.3 / (0.48 + abs(cos(7 * position + ((q - 0.917) * kept - "
      "count)))))\n",
      "x.law", Target{});
  int whole = 0;
  for (const ImageWord& w : c.image.words) {
    if (!w.whole || !w.formula.empty()) continue;
    ++whole;
    const double steps = 1 / std::fabs(w.scale);
    CHECK(std::fabs(steps - std::nearbyint(steps)) < 1e-11 * steps);
  }
  CHECK(whole == 1);
}

TEST_CASE("what the host computes ends where its range does") {
  // Its word ended a step later, which left the state's range.
  check_within(
      "param p = 1 in 0 .. 3\nbool t = false\nnext t = p > 2\n"
      "out torque = if t then 0.1 Nm else 0\n");
  check_within(
      "param n = 1 in 0 .. 3\nline a[3] in 0 .. 9\nnext a = clamp(n * n, 0, 9)\n"
      "out torque = a[2] * 0.1 Nm\n");
  check_within(
      "param n = 1 in 0 .. 3 whole\nparam k = 1 in 0 .. 3 whole\nstate t = 0 in 0 .. 9 whole\n"
      "next t = n * k\nout torque = if t == 4 then 0.1 Nm else 0\n");
  // This filter stood still: only formats in which it does kept its range.
  const Compiled c = compile_text(
      "param p = 1 in 0 .. 3\nout torque = lowpass(min(p, 1) * 1 Nm, 10 Hz)\n", "x.law", Target{});
  CHECK(c.bound.states_bounded);
  CHECK(measure(c, 1, 5000, true).output[0] <= c.bound.output[0] + 1e-8);
}

TEST_CASE("no format is taken that holds no value of a phase") {
  check_within(
      "param a = 50 mNm in 0 .. 0.1 Nm\nparam n = 3 in 1 .. 9 whole\n"
      "mailbox goal = 30 deg in -90 .. 90 deg max_age 5 ms\nrate = 20 kHz\n"
      "let q = sin(n * position) + 0.5 * exp(-abs(goal))\n"
      "table f(x) on [0, 2] = x^2 / (1 + x) with 64 segments\n"
      "state count = 0 in 0 .. 9 whole\n"
      "next count = if count < 5 and not velocity > 1 rad/s then count + 1 else 0\n"
      "phase w = 0.25 in -0.5 .. 0.5\nnext w = w + 200 Hz * dt\n"
      "event hit(position) when 0 <= position < 1 or q > 0.5\n"
      "out torque = a * f(clamp(q, 0, 2)) + 0.01 Nm * (count + w) * sgn(q)\n");
}

TEST_CASE("a product with a value that is always 0 has a format") {
  // Its range is 0 and what intervals are rounded by: 5e-324.
  const Compiled c = compile_text(
      "let near = clamp(position, -1, 1)\nlet a = if position > 0.1 then 1 + near else 0.5\n"
      "let b = if position > 0.2 then near else clamp(position, -2, 1)\n"
      "out torque = 1 Nm * clamp(0.25 + a * b * min(0.3 + abs(near), near - near), -4, 4)\n",
      "x.law", Target{});
  CHECK(c.bound.unproven.empty());
  CHECK(c.bound.output[0] < 1e-4);
  CHECK(measure(c, 1, 5000).output[0] <= c.bound.output[0] + 1e-8);
}

TEST_CASE("tables get the segments that they ask for, or are refused") {
  const auto with = [](const std::string& a, const std::string& b) {
    return "table f(x) on [0, 3] = x^2 / 9 with " + a + " segments\n" +
           "table h(x) on [0, 3] = x^3 / 27 with " + b + " segments\n" +
           "out torque = 0.1 Nm * (f(abs(position)) + h(abs(position)))\n";
  };
  CHECK_THROWS_WITH(compile_text(with("300", "300"), "x.law", Target{}),
                    Catch::Contains("602 words of table memory, which has 512") &&
                        Catch::Contains("fewer segments"));
  check_within(with("300", "210"));
  check_within(
      "table f(x) on [0, 3] = x^2 / 9 with 511 segments\n"
      "out torque = 0.1 Nm * f(abs(position))\n");
}

TEST_CASE("noise keeps the bits that its period needs, in every format") {
  // The other states of these laws drift: the search cannot tell from the bound that noise is
  // rounded.
  for (const char* text :
       {"phase ph = 0 in 0 .. 1\nnext ph = ph + 1 Hz * dt\n"
        "out torque = 0.01 Nm * sin(2 * pi * ph) + 1 mNm * noise(1)\n",
        "rate = 1 kHz\nparam f = 10 Hz in 0.001 .. 100 Hz\n"
        "out torque = 0.1 Nm * lowpass(lowpass(clamp(position, -1, 1), f), f) + 0.01 Nm * "
        "noise(77)^3\n"}) {
    INFO(text);
    const Compiled c = compile_text(text, "x.law", Target{});
    for (std::size_t k = 0; k < c.law.states.size(); ++k) {
      if (c.law.states[k].name.rfind("noise", 0) == 0) CHECK(c.program.states[k].scale <= 0x1p-20);
    }
  }
}

}  // namespace
}  // namespace feltgate::law
