// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Functions over wide ranges, in pieces: the law in real numbers stays the same, and the bound is
// useful.
#include "law/pieces.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <ctime>
#include <string>

#include "compiled.hpp"
#include "feltgate/random.hpp"
#include "law/evaluate.hpp"
#include "law/measure.hpp"
#include "law/read_law.hpp"
#include "law/verdict.hpp"

namespace feltgate::law {
namespace {

const char* const wide_laws[] = {
    "out torque = 0.1 Nm * clamp(sqrt(abs(position)), 0, 1)\n",
    "out torque = 0.1 Nm * min(3, max(sqrt(abs(position)), 2))\n",
    "param k = 3 in 0.1 .. 100\nout torque = 1 Nm * exp(-k * abs(position))\n",
    "param gap = 0.01 in 0.001 .. 1\n"
    "out torque = 1 Nm * clamp(0.01 / (gap + abs(position)), 0.001, 1)\n",
    "out torque = 0.01 Nm * max(1 / min(position, -0.01), -20)\n",
    "out torque = 0.1 Nm * clamp(log(0.001 + abs(position)), -5, 5)\n",
    "out torque = 0.1 Nm * max(log(max(position, 0.0001)) + 2, -3)\n",
    "let x = velocity / (1 rad/s)\n"
    "out torque = 0.1 Nm * clamp(2 * exp(clamp(x, -100, 20)) - 1, -0.5, 0.5)\n",
    "let x = clamp(position, -20, 20)\nlet y = clamp(position[1], -20, 20)\n"
    "let r = sqrt(x^2 + y^2)\n"
    "out torque = 0.05 Nm * clamp(r / (10 rad), 0, 1)\nout torque[1] = 0.01 Nm * min(r, 5)\n",
    "let x = 0.1 m * clamp(position, -1, 1)\nlet y = 0.1 m * clamp(position[1], -1, 1)\n"
    "out torque = 1 N * clamp(sqrt(x^2 + y^2) - 20 mm, -50 mm, 50 mm)\n",
    "let r = sqrt(clamp(position, -10, 10)^2)\nout torque = 0.1 Nm * clamp(1 / (r + 0.1) - 3, -1, "
    "0.5)\n"};

/// Laws whose bounds stay large: limits that are no numbers, within tables, behind conditions and
/// in states.
const char* const other_laws[] = {
    "param q = 0 in -1 .. 1\n"
    "out torque = 0.1 Nm * min(sqrt(abs(position)) / 30, max(q, velocity / (100 rad/s)))\n",
    "table t(x) on [0, 2] = min(x, 0.5) + 0.1 * max(1, x)\n"
    "out torque = 0.001 Nm * sqrt(abs(position)) * t(abs(position))\n",
    "let r = sqrt(abs(position))\nlet c = clamp(r, 0, 3)\n"
    "out torque = 0.1 Nm * (if velocity > 1 rad/s then min(c, 2) else max(r, c) / 100)\n",
    "state kept = 0.25 in -2 .. 2\nnext kept = clamp(sqrt(abs(position)) - kept, -2, 2)\n"
    "out torque = 0.1 Nm * min(max(0.1 - kept, velocity / (100 rad/s)), clamp(4 * position, -2, "
    "2))\n"};

void check_same_law(const char* text) {
  const Law law = read_law_text(text, "x.law", 0);
  const Target target;
  int tried = 0;
  const Program program = choose_formats(law, target, ranges(law, whole_cell(law, target)), &tried);
  const Bound b = bound(law, target, program, 0);
  std::size_t most = 0;
  for (int pieces = 1; pieces <= kMostPieces; ++pieces) {
    INFO(text << pieces << " pieces");
    const Law made = in_pieces(law, target, program, b, pieces);
    most = std::max(most, needed(made).size());
    Evaluation<double> one(law), other(made);
    SplitMix64 random(5);
    for (int i = 0; i < 3000; ++i) {
      std::vector<double> in;
      for (std::size_t k = 0; k < law.inputs.size(); ++k) {
        const auto any = static_cast<double>(random.below(20001) - 10000);
        in.push_back(std::ldexp(any * 0.02, -static_cast<int>(random.below(20))));
      }
      one.run(in);
      other.run(in);
      for (std::size_t o = 0; o < law.outputs.size(); ++o) {
        REQUIRE(std::fabs(one.outputs()[o] - other.outputs()[o]) < 1e-11);
      }
    }
  }
  CHECK(most > needed(law).size());
}

TEST_CASE("a law in pieces is the same law in real numbers") {
  for (const char* text : wide_laws) check_same_law(text);
  for (const char* text : other_laws) check_same_law(text);
}

TEST_CASE("functions over wide ranges have bounds that say something") {
  for (const char* text : wide_laws) {
    INFO(text);
    const Compiled c = compile_text(text, "x.law", Target{});
    // A root inside a quotient has the errors of both.
    const bool both = std::string(text).find("r + 0.1") != std::string::npos;
    CHECK(largest_share(output_ranges(c.law, c.target), c.target, c.bound) < (both ? 0.1 : 0.02));
    for (std::uint64_t seed = 1; seed < 4; ++seed) {
      const Measured m = measure(c, seed, 20000);
      CHECK(m.in_strips == 0);
      for (std::size_t o = 0; o < m.output.size(); ++o) {
        CHECK(m.output[o] <= c.bound.output[o] * (1 + 1e-9) + 1e-9);
      }
    }
  }
}

TEST_CASE("a radius needs no limits of its own where only a part of it matters") {
  const std::string radius =
      "param k = 2 Nm/rad in 0 Nm/rad .. 10 Nm/rad\n"
      "let r = sqrt(position^2 + position[1]^2)\nlet q = sqrt(position^2 + (0.01 s * "
      "velocity)^2)\n";
  struct Case {
    const char* torque;
    double least;
  };
  // Before limits went below the root, each of these was refused.
  for (const Case& k : {Case{"k * clamp(0.5 rad - r, 0 rad, 0.2 rad)", 3e-3},
                        Case{"1 Nm/rad * min(q, 1 rad)", 0.006},
                        Case{"if q < 0.5 rad then 0 Nm else -k * min(q - 0.5 rad, 0.2 rad)", 0.1},
                        Case{"0.001 Nm/rad^2 * position^2", 5e-4}}) {
    INFO(k.torque);
    const Compiled c = compile_text(radius + "out torque = " + k.torque + "\n", "x.law", Target{});
    CHECK(c.bound.output[0] < k.least);
    for (std::uint64_t seed = 1; seed < 4; ++seed) {
      const Measured m = measure(c, seed, 20000);
      CHECK(m.output[0] <= c.bound.output[0] * (1 + 1e-9));
      CHECK(m.in_strips * 50 < m.runs);
    }
  }
}

TEST_CASE("the known range of x / r stays that of its own node when limits move") {
  const Compiled c = compile_text(
      "let x = clamp(position[1], -1, 1)\nlet y = clamp(position[2], -1, 1)\n"
      "let w = sqrt(abs(tau_hat) / 1 Nm)\nlet q = sqrt(position^2 + (0.01 s * velocity)^2)\n"
      "let r = sqrt(x^2 + y^2 + 0.3^2)\nlet d = min(q, 1)\n"
      "let p = sum(i in 1 .. 8: 0.0001 * i * tau_hat)\n"
      "out torque = (if d > 0.5 then 4 Nm * w else 1 Nm * d) + p + 0.1 Nm * x / r\n",
      "x.law", Target{});
  CHECK(c.bound.output[0] > 0.05);  // 0.0245 was printed, 0.0442 measured
  CHECK(measure(c, 1, 50000).output[0] <= c.bound.output[0]);
  CHECK(output_ranges(c.law, c.target)[0].hi > 15);  // to 0.474 Nm, it said
}

TEST_CASE("a table whose domain ends inside a segment is the function there") {
  // With a flat line from the end of the domain on, the bounds were 34, 79 and 109 uNm.
  for (const char* text :
       {"table f(x) on [0.1, 0.73] = exp(x)\nout torque = 0.1 Nm * f(position)\n",
        "table f(x) on [-0.37, 1.21] = 1 + 0.4 * x - 0.2 * x^3 with 24 segments\n"
        "out torque = 0.1 Nm * f(velocity * 0.1 s)\n",
        "param k = 2 in 1 .. 3\ntable f(x) on [0.07, 1.33] = 1 + x with 8 segments\n"
        "out torque = 0.1 Nm * f(k * position)\n"}) {
    INFO(text);
    const Compiled c = compile_text(text, "x.law", Target{});
    CHECK(c.bound.output[0] < 1e-5);
    CHECK(measure(c, 3, 20000).output[0] <= c.bound.output[0]);
  }
}

TEST_CASE("a quotient by a radius near 0") {
  const std::string axes =
      "param e = 0.05 in 0.02 .. 1\n"
      "let x = clamp(position, -3, 3)\nlet y = clamp(position[1], -3, 3)\n"
      "let u = clamp(x, -1, 1)\nlet v = clamp(y, -1, 1)\n";
  struct Case {
    const char* torque;
    double least;
  };
  // With flat ends of tables the bounds were 0.0172, 1.86 and 3.31 Nm.
  for (const Case& k : {Case{"0.1 Nm * clamp(0.1 / sqrt(x^2 + y^2 + 0.01), 0, 1)", 0.0035},
                        Case{"0.1 Nm * u / sqrt(u^2 + v^2 + 0.0001)", 0.13},
                        Case{"0.1 Nm * u / sqrt(u^2 + v^2 + e^2)", 3}}) {
    INFO(k.torque);
    const Compiled c = compile_text(axes + "out torque = " + k.torque + "\n", "x.law", Target{});
    CHECK(c.bound.output[0] < k.least);
    for (std::uint64_t seed = 1; seed < 4; ++seed) {
      CHECK(measure(c, seed, 20000).output[0] <= c.bound.output[0]);
    }
  }
}

TEST_CASE("a law whose bound is small stays as it is written") {
  const std::string text = "out torque = 0.1 Nm * sqrt(min(abs(position), 1))\n";
  const Law law = read_law_text(text, "x.law", 0);
  CHECK(compile_text(text, "x.law", Target{}).law.nodes.size() == law.nodes.size());
}

TEST_CASE("a sum that reads its own terms again and again is looked at once") {
  for (const char* next : {"r + min(r, 1)", "r + r", "max(r, r + abs(position))"}) {
    const std::string law =
        std::string("var r = abs(position) + 0.5\nfor i in 0 .. 29 { set r = min(") + next +
        ", 1000) }\nout torque = 1 mNm * clamp(position, -1, 1) / r\n";
    INFO(law);
    const auto began = std::clock();
    try {
      compiled(law);
    } catch (const LawError&) {  // what does not fit is refused, as soon
    }
    CHECK(std::clock() - began < 20 * CLOCKS_PER_SEC);
  }
}

}  // namespace
}  // namespace feltgate::law
