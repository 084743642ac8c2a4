// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A bound must be useful: it covers most runs and is less than the output's range. Parameters that
// break this are reported.
#include "law/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include "catch.hpp"

#include "compiled.hpp"
#include "feltgate/largest.hpp"
#include "law/listing.hpp"
#include "law/mends.hpp"
#include "law/read_law.hpp"

namespace feltgate::law {
namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("a state that its words cannot move is reported") {
  const auto warnings = [](const std::string& law) {
    const Compiled c = compiled(law);
    return text(verdict(c, measure(c, 1, 2000)));
  };
  const std::string sine = "out torque = 0.01 Nm * sin(2 * pi * ph)\n";
  const std::string dead = "state ph: a run moved it by 2e-06 at most";
  CHECK_THAT(warnings("phase ph = 0 in 0 .. 1\nnext ph = ph + 1 Hz * dt\n" + sine),
             Catch::Contains(dead) && Catch::Contains("give the law a lower rate"));
  CHECK_THAT(warnings("state x = 1 in 0 .. 1\nnext x = x * 0.999995\nout torque = x * 0.1 Nm\n"),
             Catch::Contains("state x: a run moved it by 5e-06 at most"));
  CHECK_THAT(warnings("rate = 1 MHz\nstate t = 0 s in 0 .. 100 s\nnext t = min(t + dt, 100 s)\n"
                      "out torque = if t > 10 s then 0.1 Nm else 0\n"),
             Catch::Contains("state t: a run moved it by 1e-06 at most"));
  // Words that are fine enough, and the mend.
  CHECK(warnings("param f = 1 Hz in 0 .. 400 Hz\nphase ph = 0 in 0 .. 1\nnext ph = ph + f * dt\n" +
                 sine)
            .empty());
  CHECK(
      warnings("rate = 1 kHz\nphase ph = 0 in 0 .. 1\nnext ph = ph + 1 Hz * dt\n" + sine).empty());
}

TEST_CASE("runs that are left out are told from a share on, and fail from another") {
  const Compiled c = compiled("out torque = 0.1 Nm * clamp(position, -1, 1)\n");
  Measured m;
  m.output = {0};
  m.runs = 1000;
  m.in_strips = 50;
  CHECK(text(verdict(c, m)).empty());
  m.in_strips = 51;
  CHECK_THAT(report(c, m), Catch::StartsWith("warning: 5.1 % of the runs (51 of 1000)"));
  CHECK(verdict(c, m).failures.empty());
  m.in_strips = 300;
  CHECK(verdict(c, m).failures.empty());
  m.in_strips = 301;
  CHECK_THAT(report(c, m), Catch::StartsWith("failed: 30.1 % of the runs (301 of 1000)"));
  CHECK(verdict(c, m).failures.size() == 1);
  // Half of all positions are below 0, so that an upper end that is never reached takes 49.7 %.
  const Compiled top = compiled(
      "let at = floor(clamp(2.7 * position, 0, 3))\nout torque = if at >= 3 then 0.1 Nm else 0\n");
  const Measured all = measure_all(top);
  CHECK((all.in_strips * 10 < all.runs) == verdict(top, all).failures.empty());
}

TEST_CASE("a measured error of a tenth of what the law gave fails, whatever the inputs") {
  const Compiled c = compiled("out torque = 0.1 Nm * clamp(position, -1, 1)\n");
  Measured m;
  m.runs = 1000;
  m.reached = {{-0.1, 0.1}};
  const auto failures = [&](double off) {
    m.output = {off};
    Compiled loose = c;
    loose.bound.output = {0.05};
    return verdict(loose, m).failures;
  };
  CHECK(failures(0.0199).empty());
  REQUIRE(failures(0.021).size() == 1);
  CHECK_THAT(failures(0.021)[0],
             Contains("torque: 0.021 Nm from the law was measured, and the law gave -0.1 .. 0.1 "
                      "Nm in these runs: an error of 10.5 %; "));
  // Of a law that always gives the same; one last bit is no error.
  m.reached = {{0.1, 0.1}};
  CHECK(failures(0.0099).empty());
  CHECK(failures(0.0101).size() == 1);
  m.reached = {{0, 0}};
  CHECK(failures(1.5e-5).empty());
  CHECK(failures(1.6e-5).size() == 1);
  // A damper beside it is no excuse.
  const std::string snap =
      "param strength = 0.3 Nm in 0 .. 1 Nm\nlet u = clamp(position / (0.05 rad), -40, 40)\n"
      "out torque = -strength * u / (1 + u^2)^2";
  const std::string damper = " - 1 mNm s/rad * clamp(velocity, -50 rad/s, 50 rad/s)";
  for (const std::string& law : {snap, snap + damper}) {
    const Compiled wrong = compiled(law + "\n");
    Measured seen = measure_all(wrong);
    if (!seen.all_inputs) seen = measure(wrong, 1, 20000);
    const bool off = seen.output[0] > 0.1 * seen.reached[0].width();
    CHECK(off == !verdict(wrong, seen).failures.empty());
  }
}

TEST_CASE("runs that are left out are counted against the rarer side of their comparison") {
  const Compiled c = compiled("out torque = 0.1 Nm * clamp(position, -1, 1)\n");
  Measured m;
  m.output = {0};
  m.runs = 100000;
  m.sides = {{{3, 7}, 100, 99900, 5}, {{4, 2}, 50000, 50000, 0}, {{5, 1}, 0, 100000, 0}};
  CHECK(text(verdict(c, m)).empty());
  m.sides[0].outside = 6;
  CHECK_THAT(report(c, m),
             Catch::StartsWith("warning: line 3, column 7: by the law this comparison "
                               "is true in 100 of 100000 runs; in 6 (6 %) it came"));
  CHECK(verdict(c, m).failures.empty());
  m.sides[0].outside = 50;
  CHECK(verdict(c, m).failures.empty());
  m.sides[0] = {{3, 7}, 99900, 100, 51};
  CHECK_THAT(report(c, m), Catch::StartsWith("failed: line 3, column 7: by the law this comparison "
                                             "is false in 100 of 100000 runs; in 51 (51 %) it"));
  CHECK(verdict(c, m).failures.size() == 1);
  CHECK(verdict(c, m).warnings.empty());
  // The words go where the law never does; the other comparison is one more.
  m.sides[2].outside = 1;
  CHECK_THAT(report(c, m),
             Catch::StartsWith("failed: line 5, column 1: by the law this comparison is true in 0 "
                               "of 100000 runs; in 1 it came out otherwise") &&
                 Contains("; so do 1 more comparisons. Give what is compared finer formats"));
}

TEST_CASE("a law that acts near 0 only, and is rendered wrongly there, is told") {
  const std::string k = "param k = 0.1 Nm in 0 .. 0.5 Nm\n";
  const std::string edge = k + "param edge = 0.7 in 0.2 .. 1.5\n";
  const std::string r = "let r = sqrt(position^2 + 0.001)\n";
  const struct {
    std::string law, begin, left_out;
  } laws[] = {
      {k + "let q = position^4\nout torque = if q < 0.01 then -k else 0\n",
       "failed: line 3, column 19: by the law this comparison is true in 413 of 262145 runs; in "
       "6494 (1572 %) it came out otherwise",
       "6494"},
      {edge + r + "out torque = if r < edge then -k * (edge - r) else 0\n",
       "failed: line 4, column 19: by the law this comparison is true in 911 of 262145 runs; in "
       "911 (100 %)",
       "911"},
      {k + r + "out torque = if r < 0.7 then -k * (0.7 - r) * clamp(position, -1, 1) else 0\n",
       "failed: line 3, column 19: by the law this comparison is true in 911 of 262145 runs; in "
       "910 (99.89 %)",
       "911"},
      {"param k = 0.5 Nm in 0 .. 1 Nm\nlet r = sqrt(position^2 + 0.0001)\nout torque = if r < 1 "
       "then -k * (1 - r) * sgn(position) else if r > 2 then -0.1 Nm * sgn(position) else 0\n",
       "failed: line 3, column 19: by the law this comparison is true in 1303 of 262145 runs; in "
       "1303 (100 %)",
       "1706"},
      {k + "let q = position^2\nout torque = if q < 0.04 then -k else 0\n",
       "warning: line 3, column 19: by the law this comparison is true in 261 of 262145 runs; in "
       "25 (9.579 %)",
       "25"},
  };
  for (const auto& [law, begin, left_out] : laws) {
    INFO(law);
    const Compiled c = compiled(law);
    const Measured m = measure_all(c);
    CHECK_THAT(report(c, m),
               Catch::StartsWith(begin) && Contains("   without " + left_out +
                                                    " of 262145 positions, which are in strips\n"));
    CHECK(verdict(c, m).failures.empty() == (begin[0] == 'w'));
    // The mend that it says.
    std::string mended = law;
    mended.replace(law.find("position^"), 8, "clamp(position, -4, 4)");
    const Compiled again = compiled(mended);
    CHECK_THAT(text(verdict(again, measure_all(again))), !Contains("came out otherwise"));
  }
  // What the bound covers is no matter, whatever its strip: here both ways are nearly equal, and
  // here no run goes another way.
  for (const char* const fine :
       {"if position^4 < 0.01 then 1e-6 Nm else 0", "if position^4 < 1e10 then 0.1 Nm else 0"}) {
    const Compiled c = compiled(std::string("out torque = ") + fine + "\n");
    INFO(fine);
    CHECK(text(verdict(c, measure_all(c))).empty());
  }
}

TEST_CASE("what was measured above the bound, or is no number, fails") {
  const Compiled c = compiled("out torque = 0.1 Nm * clamp(position, -1, 1)\n");
  Measured m;
  m.runs = 1000;
  m.output = {c.bound.output[0] / 2};
  CHECK(verdict(c, m).failures.empty());
  m.output = {c.bound.output[0] * 2 + 1e-8};
  CHECK(verdict(c, m).failures.size() == 1);
  m.output = {std::numeric_limits<double>::quiet_NaN()};
  CHECK(verdict(c, m).failures.size() == 1);
}

TEST_CASE("a run is left out where words and law go different ways, not where both are near") {
  // Without a contact both sides are exactly 0.
  const Compiled c = compiled(
      "param give = 0.1 in 0 .. 1\nlet x = 0.3 * clamp(position, 0, 1)\n"
      "out torque = if x * x > give then 0.1 Nm else 0.2 Nm\n");
  REQUIRE(c.bound.strips.size() == 1);
  CHECK(c.bound.strips[0].width > 0);
  const Measured m = measure(c, 1, 20000);
  CHECK(m.in_strips * 100 < m.runs);
  CHECK(m.output[0] <= c.bound.output[0] + 1e-9);
}

TEST_CASE("a bound as large as its output's range is refused, one of 1 % of it told") {
  CHECK_THAT(refusal("param k = 1 in 0 .. 30\nlet x = velocity / (1 rad/s)\n"
                     "table f(x) on [-10, 30] = exp(x)\n"
                     "out torque = 1 Nm * min(f(clamp(k * x, -10, 30)), 1)\n"),
             Contains("x.law:4:5: the proven bound of torque, 1 Nm, is as large as its range") &&
                 Contains("says nothing") && Contains("the number 1 of line 4 became 0 there"));
  const std::string coarse =
      "table f(x) on [0, 100] = sqrt(x)\nout torque = 0.01 Nm * min(f(abs(position)), 1)\n";
  const Compiled c = compiled(coarse);
  CHECK(c.bound.output[0] > 0.01 * output_ranges(c.law, c.target)[0].width());
  CHECK_THAT(text(verdict(c, {})), Contains("warning: torque: the bound") &&
                                       Contains("narrow what goes into f in line 2"));
  // An error of one LSB gives no warning, even if the torque is small.
  CHECK(verdict(compiled("out torque = 0.0002 Nm * clamp(position, 0, 1)\n"), {}).warnings.empty());
}

TEST_CASE("a bound is also compared with what the law gave in the measured runs") {
  const auto told = [](const std::string& law) {
    const Compiled c = compiled(law);
    return verdict(c, measure_all(c));
  };
  // By intervals both reach the end of the torque's format.
  const Verdict idle = told("out torque = 0.01 Nm * position^2 / (1 + position^2)\n");
  CHECK_THAT(text(idle), Contains("in the measured runs, 0 .. 0.01 Nm: it says nothing"));
  // Where the file's parameters show what the law gives, more tables are tried for it.
  const std::string u = "let u = clamp(100 * position, -10000, 10000)\n";
  const Verdict tried = told(u + "out torque = 0.01 Nm * (u / (1 + abs(u)))\n");
  CHECK(tried.failures.empty());
  const Verdict large = told("out torque = 0.1 Nm * position / sqrt(1 + position^2)\n");
  CHECK(large.failures.empty());
  REQUIRE(large.warnings.size() == 1);
  CHECK_THAT(large.warnings[0], Contains("what the law gave in the measured runs, -0.1 .. 0.1 Nm"));
  const Compiled two = compiled(
      "let v = clamp(velocity / (1 rad/s), -1, 1)\n"
      "out torque = 0.01 Nm * v * (position^2 / (1 + position^2))\n");
  CHECK_THAT(text(verdict(two, measure(two, 1, 20000))),
             Contains("what the law gave in the runs with random inputs, -0.0"));
}

TEST_CASE("a comparison that decides only what is kept is told, with its strip") {
  const char* const radius = "position^4 + position[1]^4 < 0.1";
  const std::string line = std::string("line past[2] in 0 .. 1\nnext past = if ") + radius +
                           " then 1 else 0\nout torque = 0.1 Nm * past[2]\n";
  CHECK_FALSE(compiled(line).bound.strips.empty());
  for (const std::string& decides :
       {std::string("sqrt(position^2 + position[1]^2) > 0.5 or ") + radius,
        std::string("position / (0.01 + abs(position[1])) > 0.5 and ") + radius}) {
    const Compiled c = compiled("bool b = false\nnext b = " + decides +
                                "\nout torque = if b then 0.1 Nm else 0 Nm\n");
    INFO(decides);
    const Measured m = measure(c, 1, 50000);
    bool wide = false;
    for (const Strip& s : c.bound.strips) wide = wide || s.width > 1;
    CHECK((m.kept_otherwise > 0 || !wide));
    const Verdict v = verdict(c, m);
    CHECK((m.kept_otherwise * 20 > m.runs) == (v.warnings.size() + v.failures.size() > 0));
  }
}

TEST_CASE("a mailbox's bound is not compared with runs of its first value") {
  const Compiled c = compiled(
      "mailbox face = 205 rad in -205 rad .. 205 rad max_age 5 ms\n"
      "let deep = max(position - face, 0)\n"
      "out torque = -0.0002 Nm * sin(position) - 5 Nm * deep / (1 + deep)\n");
  CHECK(verdict(c, measure_all(c)).failures.empty());
}

TEST_CASE("the bound at the values that are set, of every shipped law") {
  int smaller = 0;
  for (const std::string& name : shipped_names()) {
    const Compiled& c = compiled_shipped(name);
    INFO(name);
    REQUIRE(c.bound.as_set.size() == c.bound.output.size());
    for (std::size_t o = 0; o < c.bound.output.size(); ++o) {
      CHECK(c.bound.as_set[o] <= c.bound.output[o]);
      smaller += c.bound.as_set[o] < 0.5 * c.bound.output[o] ? 1 : 0;
    }
    const auto within = [&](const Measured& m) {
      for (std::size_t o = 0; o < m.output.size(); ++o) {
        REQUIRE(m.output[o] <= c.bound.as_set[o] * (1 + 1e-9) + 1e-8);
      }
    };
    within(measure_all(c));
    // The first 50 runs use the parameters of the file.
    for (std::uint64_t seed = 1; seed <= 60; ++seed) within(measure(c, seed, 50));
  }
  CHECK(smaller >= 5);
}

TEST_CASE("values of a parameter that its step does not keep are told") {
  const auto warned = [](const std::string& range) {
    return text(verdict(compiled("param tiny = 1 in " + range +
                                 "\nout torque = 0.01 Nm * clamp(tiny * position, -1, 1)\n"),
                        {}));
  };
  CHECK_THAT(warned("1e-6 .. 1000"),
             Contains("warning: tiny: of 1e-06 .. 1e+03 only values from") &&
                 Contains("become 0; its step is"));
  CHECK_THAT(warned("1e-6 .. 1000"), !Contains("of the file becomes"));
  CHECK_THAT(warned("0 .. 1000"), !Contains("tiny: of"));
  CHECK_THAT(warned("0 .. 1e16"), Contains("tiny: 1 of the file becomes 0"));
  CHECK_THAT(warned("0.5 .. 2"), !Contains("tiny"));
  CHECK_THAT(text(verdict(compiled("param tiny = -1 in -1000 .. -1e-6\nout torque = 0.01 Nm * "
                                   "clamp(tiny * position, -1, 1)\n"),
                          {})),
             Contains("tiny: of -1e+03 .. -1e-06 only values from -") &&
                 Contains("those nearer to 0 than -"));
}

TEST_CASE("words that the host computes are told as parameters are") {
  const auto warned = [](const std::string& law) { return text(verdict(compiled(law), {})); };
  // The word of a quotient that reaches to 4e6 has a step of hundreds.
  const std::string quotient =
      " in 0.001 .. 1000\nout torque = 1 mNm * clamp(k / mass * position, -1, 1)\n";
  CHECK_THAT(warned("param k = 0.1 in 0 .. 4000\nparam mass = 1000" + quotient),
             Contains("line 3: k * 1/(mass), which the host computes: 9.99985e-05 becomes 0; "
                      "its step is") &&
                 Contains(": narrow the ranges, or give"));
  CHECK_THAT(
      warned("param k = 4000 in 0.1 .. 4000\nparam mass = 1" + quotient),
      Contains("line 3: k * 1/(mass), which the host computes: of 0.0001 .. 4e+06 only values "
               "from") &&
          Contains("become 0"));
  // The word's ends are 0 and 1, all its values 0.
  CHECK_THAT(
      warned("param a = 0 in 0 .. 1e-9\nparam b = 1 in 0.5 .. 1\nout torque = 1 Nm * a * b\n"),
      Contains("a * b, which the host computes: every value of 0 .. 1e-09") &&
          Contains("becomes 0"));
  CHECK(warned("param k = 1 in 0 .. 40\nparam mass = 1 in 0.5 .. 2\n"
               "out torque = 1 mNm * k / mass * clamp(position, -1, 1)\n")
            .empty());
}

TEST_CASE("a step that is larger than a parameter's range is told, with a mend that works") {
  const auto said = [](const std::string& declared) {
    const std::string law = "param k = " + declared + "\nout torque = k\n";
    const std::string refused = refusal(law);
    return refused == "compiled" ? text(verdict(compiled(law), {})) : refused;
  };
  const std::string mend = ": give it a value of 7.63e+04 nNm or more, and a range with that value";
  CHECK_THAT(said("1 nNm in 0 .. 2 nNm"),
             Contains("k: every value of 0 .. 2 nNm becomes 0; its step is 1.53e+04" + mend));
  CHECK_THAT(said("0 nNm in 0 .. 2 nNm"),
             Contains("k: every value of 0 .. 2 nNm becomes 0; its step is 1.53e+04" + mend));
  CHECK_THAT(
      said("100 nNm in 90 nNm .. 110 nNm"),
      Contains("no word of k lies in its range: its step is 1.53e+04 nNm; " + mend.substr(2)));
  CHECK_THAT(said("-1 nNm in -2 nNm .. 0 nNm"),
             Contains("give it a value of -7.63e+04 nNm or less"));
  CHECK(said("76300 nNm in 0 .. 100000 nNm").empty());
  CHECK_THAT(said("1000001 nNm in 1000000 nNm .. 1000002 nNm"),
             Contains("no word of k lies in its range") &&
                 Contains("make the range wider than that step"));
  CHECK(said("1000001 nNm in 990000 nNm .. 1010000 nNm").empty());
}

TEST_CASE("where no larger value helps a parameter, what makes its step is told") {
  const auto mend = [](const std::string& text, double step) {
    const Law law = read_law_text(text, "x.law", 20e3);
    return finer(law, Target{}, law.parameters[0], step);
  };
  // With a value of five steps the step is larger too, and the torque hundreds of Nm.
  const std::string snap =
      "param strength = 0.3 Nm in -1 .. 1 Nm\nlet u = clamp(10 * position, -20, 20)\n"
      "out torque = -strength * u / (1 + u^2)^2 * 3\n";
  CHECK_THAT(mend(snap, 1.33), Contains("line 3 multiplies it with ") &&
                                   Contains(" which by its ranges goes over -") &&
                                   Contains(": limit that with clamp") && !Contains("give it"));
  CHECK(mend("param k = 1 nNm in 0 .. 2 nNm\nout torque = k * clamp(position, -1, 1)\n", 1.53e-5) ==
        "give it a value of 7.65e+04 nNm or more, and a range with that value");
}

TEST_CASE("names that nothing uses are told, and are no matter for what is used") {
  const std::string used = "out torque = 0.1 Nm * clamp(position, -1, 1)\n";
  for (const char* unused :
       {"param a = 1 Nm in 0 .. 2 Nm\n", "mailbox a = 0 in -1 .. 1 max_age 5 ms\n", "let a = 1\n",
        "let a = 2 * velocity\n", "var a = 1\n", "state a = 0 in -1 .. 1\nnext a = 0.5 * a\n",
        "state a = 0 in -1 .. 1\nnext a = clamp(position, -1, 1)\n",
        "line a[3] in -1 .. 1\nnext a = 0.5 * a[1]\n", "phase a = 0 in 0 .. 1\nnext a = 0.25\n",
        "bool a = true\nnext a = position > 1\n", "table a(x) on [0, 1] = x\n",
        "array a = [1, 2]\n", "line a[3] in -1 .. 1\nnext a = clamp(position, -1, 1)\n",
        "for i in 0 .. 3 { let a = i }\n"}) {
    INFO(unused);
    const Compiled c = compiled(unused + used);
    const Verdict v = verdict(c, measure(c, 1, 1000, false));
    CHECK(v.failures.empty());
    REQUIRE(v.warnings.size() == 1);
    CHECK_THAT(v.warnings[0], Contains("\"a\" is never used; use it, or take it out"));
  }
  // What only events depend on is used, and so is what decides another state.
  CHECK(compiled(used + "state a = 0 in -1 .. 1\nnext a = 0.5 * a\nbool b = false\n"
                        "next b = a > 0.1\nevent e when b\n")
            .law.unused.empty());
  CHECK(compiled("state a = 0 in -1 .. 1\nstate b = 0 in -1 .. 1\nnext a = 0.5 * b\n"
                 "next b = 0.5 * a\n" +
                 used)
            .law.unused.size() == 2);
}

TEST_CASE("torque beyond its format is told with the law's range") {
  const Compiled c = compiled("param a = 1 Nm in 0 .. 100 Nm\nout torque = a\n");
  CHECK_THAT(report(c, {}), Contains("line 2: the law gives 0 .. 100 Nm; torque ends at 16 Nm"));
  const Compiled within = compiled("param a = 1 Nm in 0 .. 16 Nm\nout torque = a\n");
  CHECK_THAT(report(within, {}), !Contains("torque ends"));
}

TEST_CASE("a largest error that is no number stays one, and fails") {
  const double none = std::nan("");
  CHECK(larger(1.0, 2.0) == 2);
  CHECK(larger(2.0, 1.0) == 2);
  CHECK(smaller(1.0, 2.0) == 1);
  CHECK(smaller(2.0, 1.0) == 1);
  for (const double x : {-1.0, 1.0}) {
    CHECK(std::isnan(larger(none, x)));
    CHECK(std::isnan(larger(x, none)));
    CHECK(std::isnan(smaller(none, x)));
    CHECK(std::isnan(smaller(x, none)));
  }
  const Compiled c = compiled("out torque = 0.1 Nm * clamp(position, -1, 1)\n");
  Measured m = measure(c, 1, 100);
  CHECK(verdict(c, m).failures.empty());
  m.output[0] = none;
  CHECK(verdict(c, m).failures.size() == 1);
}

TEST_CASE("a table that an if keeps from what is no number is one") {
  CHECK(refusal("table f(x) on [-1, 1] = if x < 0 then 0 else sqrt(x)\n"
                "out torque = 0.1 Nm * f(position)\n") == "compiled");
}

}  // namespace
}  // namespace feltgate::law
