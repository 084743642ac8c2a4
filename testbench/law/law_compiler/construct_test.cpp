// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Every construct of the language as instructions: the errors are within the bound, and the bound
// is finite.
#include <fmt/format.h>

#include "catch.hpp"

#include "compiled.hpp"
#include "law/engine/machine.hpp"
#include "law/listing.hpp"
#include "law/load.hpp"

namespace feltgate::law {
namespace {

void require_within(const Compiled& c, bool free_running) {
  check_within(c, measure(c, 3, runs_of(4000), free_running));
}

TEST_CASE("a comparison of whole values narrows them: == and != as well as <") {
  for (const char* next :
       {"if n == 9 then 0 else n + 1", "if n != 9 then n + 1 else 0", "if 9 == n then 0 else n + 1",
        "if n < 9 then n + 1 else 0", "if n == 4 then 2 * n + 1 else 0",
        "if 0 <= n and n < 9 then n + 1 else 0", "if n < 0 or n >= 9 then 0 else n + 1"}) {
    INFO(next);
    const std::string count = "state n = 0 in 0 .. 9 whole\nnext n = " + std::string(next) + "\n";
    const Compiled c = compiled(count + "out torque = 1 mNm * n\n");
    require_within(c, true);
    require_within(c, false);
    // Beside a state whose error has no bound, the law's own values count too.
    require_within(compiled("phase p = 0 in 0 .. 1\nnext p = p + 0.01\n" + count +
                            "out torque = 1 mNm * n * p\n"),
                   false);
  }
}

TEST_CASE("a choice has the range of its branches behind their comparisons") {
  const std::string n = "state n = 0 in 0 .. 9 whole\nnext n = clamp(3 * position, 0, 9)\n";
  for (const char* out : {"0.1 Nm / (if n == 0 then 1 else n)",
                          "0.1 Nm / (if position > 0.1 then position else 0.1)"}) {
    const Compiled c = compiled(n + "out torque = " + out + "\n");
    INFO(out);
    CHECK(c.bound.unproven.empty());
    CHECK(c.bound.output[0] < 0.02);
    check_within(c, measure(c, 1, 5000));
  }
  CHECK_THROWS_WITH(compiled(n + "out torque = 0.1 Nm / (if n != 0 then 1 else n)\n"),
                    Catch::Matchers::Contains("division by what goes from"));
}

TEST_CASE("the rest of a whole value is below a whole period") {
  const Compiled c = compiled(
      "state n = 2 in 0 .. 7 whole\nnext n = if position > 0 then mod(n + 1, 8) else n\n"
      "out torque = 0.01 Nm * n\n");
  CHECK(c.bound.unproven.empty());
  CHECK(measure_free(c, 1, 5000).most[0] < 1e-5);
}

TEST_CASE("constructs stay within their bounds, which are small") {
  CHECK(constructs().size() == 22);
  for (const Construct& construct : constructs()) {
    INFO(construct.name);
    const Compiled c = compiled(construct.text);
    CHECK(c.bound.unproven.empty());
    CHECK(static_cast<int>(c.assembled.instructions.size()) <= construct.instructions);
    CHECK(c.bound.output[0] <= construct.bound_nm);
    require_within(c, false);
    if (c.bound.states_bounded) require_within(c, true);
    CHECK(measure_free(c, 1, 1000).unknown.empty());
  }
}

TEST_CASE("an event's value that only depends on parameters keeps its terms") {
  const Compiled c = compiled(
      "param p = 0.5 in -1 .. 1\nevent hit(2 * (sgn(p) * p + 0.25)) when position > 0.5\n"
      "out torque = 0.1 Nm * clamp(position, -1, 1)\n");
  Machine machine(memory(c.image));
  MachineInputs inputs{};
  inputs[0] = 400;
  const MachineRun hit = machine.run(0, inputs);
  REQUIRE(hit.events.size() == 1);
  CHECK(hit.events[0].value * c.image.events[0].scale == Approx(1.5).margin(1e-4));
}

TEST_CASE("a periodic table follows the position without drift, however far") {
  const Compiled c = compiled(
      "table rough(q) periodic on [0, 1 turn / 8] through [10, 30, -20, 10] mNm\n"
      "table wave(q) periodic on [0, 1 turn] = 0.03 Nm * sin(q)^3\n"
      "out torque = rough(position) + wave(position)\n");
  Machine machine(memory(c.image));
  const auto torque = [&](std::int64_t position) {
    MachineInputs inputs{};
    inputs[0] = static_cast<std::int32_t>(position);
    return machine.run(0, inputs).outputs[0];
  };
  for (std::int64_t p = 0; p < 4096; p += 37) {
    for (const std::int64_t turns : {1L, -1L, 12345L, -524288L, 524287L}) {
      CHECK(torque(p + 4096 * turns) == torque(p));
    }
  }
}

TEST_CASE("a sine beside another table follows the position, however far") {
  for (const char* const factor : {"24", "7.3", "p"}) {
    const Compiled c = compiled(fmt::format(
        "param p = 3.3 in 0 .. 100\n"
        "table flat(q) on [0, 1] = exp(-q)\n"
        "out torque = 1 Nm * sin({} * position) * flat(clamp(velocity / (1 rad/s), 0, 1))"
        "+ 0 Nm * p\n",
        factor));
    Machine machine(memory(c.image));
    const double by = factor[0] == 'p' ? c.image.words.at(0).initial * c.image.words.at(0).scale
                                       : std::atof(factor);
    for (const std::int64_t p : {0L, 1000L, 1L << 27, (1L << 28) + 777, -(1L << 30), 2147483647L}) {
      MachineInputs inputs{};
      inputs[0] = static_cast<std::int32_t>(p);
      const double angle = std::fmod(by * static_cast<double>(p) / 4096, 1.0) * 2 * pi;
      INFO(factor << " times " << p);
      CHECK(std::fabs(machine.run(0, inputs).outputs[0] * 0x1p-16 - std::sin(angle)) < 1e-3);
    }
  }
}

TEST_CASE("an event is one run's: where its condition becomes true") {
  const Compiled c = compiled(
      "event hit(velocity) when position > 0.5\nevent low(position) when position < -1\n"
      "out torque = 0.1 Nm * clamp(position, -1, 1)\n");
  Machine machine(memory(c.image));
  const auto run = [&](std::int32_t position) {
    MachineInputs inputs{};
    inputs[0] = position;
    inputs[1] = 12345;
    return machine.run(0, inputs);
  };
  CHECK(run(0).events.empty());
  const MachineRun hit = run(400);
  REQUIRE(hit.events.size() == 1);
  CHECK(hit.events[0].number == 1);
  CHECK(hit.events[0].value * c.image.events[0].scale == Approx(12345 * 0x1p-21));
  CHECK(run(500).events.empty());
  CHECK(run(0).events.empty());
  const MachineRun low = run(-1000);
  REQUIRE(low.events.size() == 1);
  CHECK(low.events[0].number == 2);
  CHECK(run(400).events.size() == 1);
  machine.enter();
  CHECK(run(400).events.size() == 1);
}

TEST_CASE("the first run has the initial values, every entry again") {
  const Compiled c =
      compiled("state n = 3 in 0 .. 10\nnext n = min(n + 1, 10)\nout torque = 0.1 Nm * n\n");
  Machine machine(memory(c.image));
  const auto torque = [&] { return machine.run(0, {}).outputs[0] * 0x1p-16; };
  CHECK(torque() == Approx(0.3).margin(2e-5));
  CHECK(torque() == Approx(0.4).margin(2e-5));
  machine.enter();
  CHECK(torque() == Approx(0.3).margin(2e-5));
}

// The sum of a whole state has a step of 2^-30 here; two products scale it to a step of 1.
TEST_CASE("a whole state keeps its value through a fine sum") {
  const Compiled c = compiled(
      "param count = 1 in 0 .. 4 whole\nstate stage = 0 in 0 .. 3 whole\n"
      "state side = 1 in -2 .. 2 whole\nstate kept = 0.25 in -2 .. 2\nline past[6] in -2 .. 2\n"
      "next stage = clamp(stage + (if 3 >= stage then 1 else 0) - (if stage != count + side then 1 "
      "else 0), 0, 3)\n"
      "next side = clamp(side + (if stage == count + stage then 1 else 0) - (if side != count then "
      "1 else 0), -2, 2)\n"
      "next kept = kept + 0.511 * (clamp(past[2] * side + stage * side, -2, 2) - kept)\n"
      "next past = clamp(0.243 * floor(0.717 * (stage + 0.153)) - exp(clamp(stage, -2, 1)), -2, "
      "2)\n"
      "out torque = 1 Nm * (if 0.02 s * velocity + side < position / 122.417 then 0.947 else "
      "sqrt(0.632 + abs(kept)))\n");
  for (std::size_t i = 0; i < 2; ++i) CHECK(c.bound.state[i] == 0);
}

TEST_CASE("compiling is repeatable") {
  for (const char* name : {"charge", "pantograph"}) {
    const std::string path = std::string(FELTGATE_ROOT) + "/rtl/laws/" + name + ".law";
    CHECK(text(compile_file(path, Target{}).image) == text(compile_file(path, Target{}).image));
  }
}

TEST_CASE("designs with other formats and ticks") {
  Target t;
  t.tick_hz = 100000;
  t.clocks_per_tick = 500;
  t.torque = {1, 4, 18};
  const Compiled c = compile_file(std::string(FELTGATE_ROOT) + "/rtl/laws/pantograph.law", t);
  CHECK(c.divider == 1);
  require_within(c, false);
}

}  // namespace

// The compiler refuses laws that it cannot prove, fit or schedule. The message has the line, the
// reason and a correction.

namespace {

using Catch::Matchers::Contains;

TEST_CASE("a state that can leave its range is refused") {
  const std::string r = refusal(
      "state total = 0 Nm in -1 .. 1 Nm\n"
      "next total = total + 0.001 Nm\n"
      "out torque = total\n");
  CHECK_THAT(
      r, Contains("x.law:1:") && Contains("state total can leave its range") && Contains("clamp"));
}

TEST_CASE("more constants and parameter words than fit are refused at the first beyond") {
  // Each term has a frequency and a phase of its own; the first `params` phases are parameters.
  const auto law = [](int terms, int params) {
    std::string text, sum;
    for (int i = 0; i < params; ++i) {
      text += "param p" + std::to_string(i) + " = 0." + std::to_string(i + 101) + " in 0 .. 1\n";
    }
    for (int i = 0; i < terms; ++i) {
      sum += (i == 0 ? "" : "\n+ ") + std::string("sin(") + std::to_string(i + 1) +
             " * position + " +
             (i < params ? "p" + std::to_string(i) : "0." + std::to_string(i + 101)) + ")";
    }
    return text + "out torque = 1 mNm * (" + sum + ")\n";
  };
  const std::string r = refusal(law(35, 0));
  CHECK_THAT(r, Contains("constants, 64 fit, and here is the first that does not; write ") &&
                    Contains(" of its numbers as a param each") &&
                    Contains("32 of 32 words are free"));
  CHECK_THAT(r, !Contains("x.law:1:"));
  CHECK(refusal(law(35, 8)) == "compiled");
  CHECK_THAT(refusal(law(35, 33)), Contains("x.law:") && !Contains("x.law:1:") &&
                                       Contains("parameter words, 32 fit; write some"));
}

TEST_CASE("a rate that the instructions do not fit is refused with the figures") {
  const std::string r = refusal(
      "rate = 1 MHz\n"
      "out torque = 1 Nm * sin(position) * sin(2*position) * sin(3*position)\n");
  CHECK_THAT(r, Contains("do not fit in 50:") && Contains("500000 Hz"));
}

TEST_CASE("a rate that is no part of the tick is refused") {
  CHECK_THAT(refusal("rate = 300 kHz\nout torque = 0.1 Nm * sin(position)\n"),
             Contains("is no whole part of the tick") && Contains("250000 Hz"));
}

TEST_CASE("a rate of the file stands: no second one, and none below its use") {
  const std::string torque = "out torque = -0.1 Nm * clamp(position, -1, 1)\n";
  CHECK(refusal("rate = 1 kHz\nrate = 2 kHz\n" + torque) == "x.law:2:1: a second rate; write one");
  CHECK(refusal("rate = 1 kHz\nrate = 1 kHz\n" + torque) == "x.law:2:1: a second rate; write one");
  const std::string above = "dt and filters need a rate; write above: rate = 40 kHz";
  CHECK(refusal("out torque = -0.1 Nm * lowpass(clamp(position, -1, 1), 10 Hz)\nrate = 1 kHz\n") ==
        "x.law:1:24: " + above);
  CHECK(refusal("out torque = 1 Nm * velocity * dt\nrate = 2 kHz\n") == "x.law:1:32: " + above);
  CHECK(compiled("rate = 2 kHz\n" + torque).rate_hz == 2000);
}

TEST_CASE("without a rate, dt and filters take the fastest, and the answer says so") {
  const auto answer = [](const std::string& text) {
    const Compiled c = compiled(text);
    return report(c, measure(c, 1, 10));
  };
  const std::string torque = "out torque = 0.1 Nm * lowpass(clamp(position, -1, 1), 10 Hz)\n";
  const std::string says = "the file says no rate: this is the fastest";
  CHECK_THAT(answer(torque), Contains(" 500000 Hz\n" + says));
  CHECK_THAT(answer("rate = 2 kHz\n" + torque), !Contains(says));
  CHECK_THAT(answer("out torque = tau_hat\n"), !Contains(says));
}

TEST_CASE("a max_age that the engine cannot count is refused with what it can") {
  const auto aged = [](const std::string& age) {
    return refusal("mailbox push = 0 Nm in -0.1 .. 0.1 Nm max_age " + age +
                   "\nout torque = push\n");
  };
  CHECK_THAT(aged("0.1 ms"), Contains("x.law:1:") && Contains("write max_age 0.128 ms"));
  CHECK_THAT(aged("10 s"), Contains("write max_age 4194.3 ms"));
  CHECK(aged("0.128 ms") == "compiled");
  CHECK(aged("4194.3 ms") == "compiled");
}

TEST_CASE("a root of what can be negative, a division by what can be zero, a log of either") {
  CHECK_THAT(refusal("out torque = 0.1 Nm * log(abs(position))\n"),
             Contains("x.law:1:") && Contains("log of what can be 0; limit it, e.g. log(max("));
  CHECK_THAT(refusal("out torque = 0.1 Nm * log(clamp(position, -1, 1))\n"),
             Contains("log of what can be -1;"));
  CHECK_THAT(refusal("out torque = 0.1 Nm * sqrt(position)\n"), Contains("x.law:1:"));
  CHECK_THAT(refusal("out torque = 0.1 Nm / position\n"), Contains("x.law:1:"));
  // The length of a vector is never the root of a negative number.
  CHECK(refusal("let lean = clamp(position, -1, 1)\nlet twice = 2 * lean\n"
                "out torque = 0.1 Nm * clamp(sqrt(lean^2 + twice^2), 0, 1)\n") == "compiled");
}

TEST_CASE("a root of what ends at 0 exactly: products, squares and quotients keep their sign") {
  const auto root_of = [](const std::string& x) {
    return refusal(
        "param c = 0.5 in 0 .. 1\nlet a = min(abs(position), 1)\nlet b = clamp(velocity / "
        "(1 rad/s), 0, 1)\nout torque = 0.1 Nm * sqrt(" +
        x + ") + 0 * c * a * b * 1 Nm\n");
  };
  CHECK(refusal("out torque = sqrt(0.01 Nm^2 * min(abs(position), 1))\n") == "compiled");
  CHECK(refusal("let a = min(abs(position), 1)\nlet b = max(-1, -abs(position))\n"
                "out torque = 0.1 Nm * sqrt(-a * b)\n") == "compiled");
  CHECK(root_of("a * b") == "compiled");
  CHECK(root_of("c * a") == "compiled");
  CHECK(root_of("a^3 + b^2") == "compiled");
  CHECK(root_of("c * a * b + 2 * a") == "compiled");
  CHECK_THAT(root_of("a * b - 0.001"), Contains("sqrt of what can be -0.001"));
  CHECK_THAT(root_of("a * (b - 1e-9)"), Contains("sqrt of what can be -1e-09"));
}

TEST_CASE("what does not fit is told with its line, its range and the mend") {
  const std::string ends = "a word with the step 1.53e-05 holds -32768 .. 32768 Nm; ";
  const std::string limit = "limit it with clamp, or narrow the ranges of parameters and states";
  CHECK_THAT(refusal("let x = position\nout torque = 100 Nm * x^8\n"),
             Contains("x.law:2:21: this value goes over 0 .. ") &&
                 Contains(" Nm and does not fit: " + ends + limit));
  CHECK_THAT(refusal("out torque = 1 Nm * exp(position)\n"),
             Contains("x.law:1:19: 1*exp(position) goes over ") && Contains(ends + limit));
  CHECK(refusal("out torque = 40000 Nm\n") ==
        "x.law:1:14: 40000 Nm does not fit: " + ends + "write a smaller number");
  CHECK(refusal("param a = 3 Nm in 0 .. 1e6 Nm\nout torque = a\n") ==
        "x.law:1:7: a goes over 0 .. 1e+06 Nm and does not fit: " + ends + limit);
  CHECK_THAT(
      refusal("rate = 10 kHz\nline past[10] in -1 .. 1\nnext past = position\n"
              "out torque = 1 Nm * past[3]\n"),
      Contains("x.law:2:6: line past can leave its range -1 .. 1: its next value can be -2") &&
          Contains("write clamp(..., -1, 1), or give it a larger range"));
}

TEST_CASE("a larger range is a mend only where one holds, and then it is told") {
  const auto leaves = [](const std::string& next) {
    return refusal("rate = 10 kHz\nstate x = 0 in 0 .. 10\nnext x = " + next +
                   "\nout torque = 0.01 Nm * x\n");
  };
  const auto mend_of = [](const std::string& said) {
    const std::string before = "give it a larger range: ";
    const std::size_t at = said.find(before);
    return at == std::string::npos ? "" : said.substr(at + before.size());
  };
  for (const char* next : {"abs(position)", "0.999 * x + 0.1"}) {
    INFO(next);
    const std::string said = leaves(next), range = mend_of(said);
    CHECK_THAT(said, Contains("end with clamp(..., 0, 10), or "));
    REQUIRE(!range.empty());
    CHECK(refusal("rate = 10 kHz\nstate x = 0 in " + range + "\nnext x = " + next +
                  "\nout torque = 0.01 Nm * x\n") == "compiled");
  }
  for (const char* next : {"x + abs(position)", "2 * x", "x + 1"}) {
    INFO(next);
    CHECK_THAT(leaves(next), Contains(", and in a larger range still more; end with clamp(..., 0, "
                                      "10)") &&
                                 !Contains("or give"));
  }
}

TEST_CASE("a state that leaves its range by little: with the digits that show it") {
  const std::string r = refusal(
      "state q = 0 in 0 .. 1\nnext q = min(q + 0.000001, 1.000001)\nout torque = 1 Nm * q\n");
  CHECK_THAT(r, Contains("state q can leave its range 0 .. 1: its next value can be 1.0000"));
}

TEST_CASE("a value that its word does not hold is told") {
  const Compiled c =
      compiled("param a = 1 in 0 .. 1e12\nout torque = 1 Nm * clamp(a * position, -1, 1)\n");
  CHECK_THAT(report(c, measure(c, 1, 10)),
             Contains("warning: a: 1 of the file becomes 0; its step is 8.54e+07: narrow its "
                      "range, or give it a value of 4.27e+08 or more\n"));
}

TEST_CASE("a filter whose frequency may be 0 is told how to begin above it") {
  const std::string law = "rate = 10 kHz\nparam f = 100 Hz in 0 .. 3000 Hz\nout torque = 0.1 Nm * ";
  CHECK_THAT(refusal(law + "lowpass(clamp(position, -1, 1), f)\n"),
             Contains("keep the filter's frequency above 0, e.g. max(..., 10 Hz)"));
  CHECK(refusal(law + "lowpass(clamp(position, -1, 1), max(f, 10 Hz))\n") == "compiled");
}

TEST_CASE("a delay line that can leave its range, or the table memory") {
  CHECK_THAT(
      refusal("rate = 10 kHz\nline past[100] in -0.1 .. 0.1 Nm\n"
              "next past = 0.2 Nm * sin(position)\nout torque = past[100]\n"),
      Contains("x.law:2:") && Contains("line past can leave its range") && Contains("clamp"));
  CHECK_THAT(refusal("rate = 10 kHz\nline past[400] in -1 .. 1 Nm\nline more[200] in -1 .. 1 Nm\n"
                     "next past = more[3]\nnext more = 0.1 Nm * clamp(position, -1, 1)\n"
                     "out torque = past[100]\n"),
             Contains("table memory"));
}

TEST_CASE("a phase that steps by more than a turn") {
  CHECK_THAT(refusal("rate = 1 kHz\nphase a = 0 in 0 .. 1\nnext a = a + velocity * dt\n"
                     "out torque = 0.1 Nm * sin(2 * pi * a)\n"),
             Contains("x.law:2:") && Contains("more than a whole turn"));
}

}  // namespace
}  // namespace feltgate::law
