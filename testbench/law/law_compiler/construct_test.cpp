// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Every construct of the language as instructions: the errors are within the bound, and the bound
// is finite.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <map>

#include "compiled.hpp"
#include "law/diagnostics.hpp"
#include "law/engine/machine.hpp"
#include "law/measure.hpp"

namespace feltgate::law {
namespace {

void require_within(const Compiled& c, bool free_running) {
  const Measured m = measure(c, 3, 20000, free_running);
  REQUIRE(m.runs > m.in_strips);
  for (std::size_t o = 0; o < m.output.size(); ++o) {
    INFO("measured " << m.output[o] << ", bound " << c.bound.output[o]);
    CHECK(m.output[o] <= c.bound.output[o] * (1 + 1e-9) + 1e-8);
  }
}

struct Sample {
  std::string text;
  int instructions;  ///< no more
  double bound_nm;   ///< no more
};

const std::map<std::string, Sample> samples = {
    {"whole parameter, mailbox, phase of both",
     {"param teeth = 12 in 1 .. 100 whole\n"
      "param depth = 20 mNm in 0 .. 0.2 Nm\n"
      "mailbox turned = 0 deg in -180 .. 180 deg max_age 5 ms\n"
      "out torque = -depth * sin(teeth * (position - turned))\n",
      6, 5e-5}},
    {"table of the law, sign of the argument",
     {"param peak = 0.2 Nm in 0 .. 0.5 Nm\n"
      "table bump(x) on [0, 0.2 rad] = (x / 0.1)^2 * exp(1 - (x / 0.1)^2) with 64 segments\n"
      "out torque = -peak * sgn(position) * bump(abs(position))\n",
      6, 6e-4}},
    {"low-pass: its error has an end",
     {"param k = 0.05 Nm s/rad in 0 .. 0.2 Nm s/rad\n"
      "out torque = -k * clamp(lowpass(velocity, 70 Hz), -20 rad/s, 20 rad/s)\n",
      8, 3e-3}},
    {"presliding friction: an anchor in counts",
     {"param k = 5 Nm/rad in 0 .. 20 Nm/rad\n"
      "state anchor = 0 rad in -250 rad .. 250 rad\n"
      "let z = clamp(position - anchor, -0.05, 0.05)\n"
      "next anchor = position - z\n"
      "out torque = -k * z\n",
      8, 2e-5}},
    {"root, quotient, exponential: three tables",
     {"out torque = 0.1 Nm * sqrt(0.5 + abs(clamp(position, -1, 1)))"
      " / (1 + clamp(position, 0, 3)^2) * exp(-clamp(position, 0, 2))\n",
      24, 1e-3}},
    {"a comparison of the condition before is made again after another",
     {"let a = if position > 0.2 rad then 0.1 Nm else 0 Nm\n"
      "let b = if velocity <= 1 rad/s or (position > 0.2 rad and tau_hat > 0.1 Nm) then 0.2 Nm "
      "else 0 Nm\n"
      "out torque = a + b\n",
      12, 1e-5}},
    {"a logarithm of what runs, one of a parameter",
     {"param p = 1 in 0.01 .. 3\n"
      "out torque = 0.1 Nm * (log(p) + log(0.5 + clamp(position, 0, 2)))\n",
      8, 4e-4}},
    {"an odd factor of the position, sine beside another table",
     {"param a = 1 rad in -3 .. 3 rad\n"
      "out torque = 0.1 Nm * sin(7.3 * position + a) * sqrt(1 + cos(position)^2)\n",
      24, 1e-3}},
    {"sine of a speed, torque of the observer",
     {"out torque = 0.01 Nm * sin(velocity * 0.1 s) + tau_hat * 0.3\n", 8, 5e-5}},
    {"an array by number and by index",
     {"array steps = [0.1, -0.2, 0.05, 0.3] Nm\n"
      "let i = clamp(2 + position, 0, 3.9)\n"
      "out torque = steps[i] + 0.1 * sin(position) * 1 Nm\n",
      14, 5e-5}},
    {"a table through points, read twice, by a place that is kept",
     {"table height(q) on [0, 4] through [0.1, -0.2, 0.05, 0.3, 0.1] Nm\n"
      "state place = 0 in 0 .. 4\n"
      "next place = clamp(place + clamp(position - place, -0.5, 0.5), 0, 4)\n"
      "out torque = height(place) + 0.1 * height(4 - place)\n",
      16, 1e-4}},
    {"bools that are the same, and whole values",
     {"bool held = false\nbool was = true\nnext was = held\n"
      "next held = (position > 0.2 rad) != (was == held)\n"
      "out torque = if held == was then 0.1 Nm else 0.02 Nm * clamp(position, -1, 1)\n",
      24, 2e-5}},
    {"time in a ramp, a wave and a comparison",
     {"rate = 50 kHz\nparam f = 3 Hz in 0.1 .. 400 Hz\n"
      "let ramp = clamp(time / (2 s), 0, 1)\n"
      "out torque = 0.1 Nm * ramp * sin(2 * pi * f * time) + (if time > 10 s then 0.01 Nm else "
      "0)\n",
      16, 5e-5}},
    {"rounded to the nearest",
     {"out torque = 0.02 Nm * round(4 * clamp(position, -1, 1))\n", 12, 2e-5}},
    {"conditions: and, or, not",
     {"param a = 0.2 in -1 .. 1\n"
      "let inside = (position > a and position < 2) or (not (velocity < 1 rad/s) and position < "
      "-3)\n"
      "out torque = if inside then 0.2 Nm else -0.1 Nm\n",
      10, 2e-5}},
    {"whole values that are the same, or not",
     {"state n = 3 in -9 .. 9 whole\nmailbox p = 3 in -5 .. 5 whole max_age 1 s\n"
      "next n = if n == p or position > 1 then max(n - 1, -9) else min(n + 1, 9)\n"
      "out torque = (if n != 2 * p - 1 then 0.2 Nm else -0.1 Nm) + 0.01 Nm * clamp(position, -1, "
      "1)\n",
      30, 5e-5}},
    {"a periodic table through points, of the position",
     {"param scale = 1 in 0 .. 1\n"
      "table cogging(q) periodic on [0, 1 turn] through [0, 4, 6, 1, -5, -4, 0, 3, 5, 2, -6, -3, "
      "0] "
      "mNm\n"
      "out torque = scale * cogging(position)\n",
      5, 4e-5}},
    {"periodic tables: an odd number of points, one read twice, a formula beside a sine",
     {"param a = 0.3 rad in -3 .. 3 rad\n"
      "table rough(q) periodic on [-0.3, 0.6] through [10, 30, -20, 10] mNm\n"
      "table wave(q) periodic on [0.1, 0.5] = 0.03 Nm * (q - 0.1) * (0.5 - q) / 0.04\n"
      "out torque = rough(position) + rough(2 * position - a) + wave(position) * sin(7 * "
      "position)\n",
      28, 6e-5}},
    {"a periodic table of a speed",
     {"table wave(q) periodic on [0, 2] = 0.03 Nm * abs(q - 1)\n"
      "out torque = wave(0.1 s * velocity)\n",
      6, 5e-5}},
    {"floor and mod of a position, mod of a whole state",
     {"state n = 3 in 0 .. 9 whole\nnext n = if position > 1 then max(n - 1, 0) else min(n + 1, "
      "9)\n"
      "let x = clamp(position, -2, 2)\n"
      "out torque = 0.01 Nm * floor(5 * x) + 0.1 Nm * mod(x, 20 deg) + 0.01 Nm * mod(n, 3)\n",
      40, 5e-5}},
    {"noise beside a position",
     {"out torque = 0.02 Nm * noise(7) * clamp(position, 0, 1)\n", 20, 5e-5}},
    {"bools: a latch with both thresholds, and one that follows it",
     {"param high = 0.2 in 0.1 .. 1\nparam low = -0.1 in -1 .. 0\n"
      "bool held = true\nbool was = false\nnext was = held\n"
      "next held = position > high or held and position > low\n"
      "out torque = (if held and not was then 0.2 Nm else -0.1 Nm) + 0.01 Nm * clamp(position, -1, "
      "1)\n",
      20, 5e-5}},
    {"two states that change places",
     {"state a = 0.1 in -1 .. 1\nstate b = -0.2 in -1 .. 1\n"
      "next a = b\nnext b = a\n"
      "out torque = a * 1 Nm + 0.01 Nm * clamp(position, -1, 1)\n",
      12, 5e-5}}};

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
    CHECK(measure(c, 1, 5000).output[0] <= c.bound.output[0] + 1e-9);
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

TEST_CASE("the run from the source knows every construct") {
  for (const auto& [name, sample] : samples) {
    INFO(name);
    const Compiled c = compiled(sample.text);
    CHECK(measure_free(c, 1, 1000).unknown.empty());
  }
}

TEST_CASE("constructs stay within their bounds, which are small") {
  for (const auto& [name, sample] : samples) {
    INFO(name);
    const Compiled c = compiled(sample.text);
    CHECK(c.bound.unproven.empty());
    CHECK(static_cast<int>(c.assembled.instructions.size()) <= sample.instructions);
    CHECK(c.bound.output[0] <= sample.bound_nm);
    require_within(c, false);
    if (c.bound.states_bounded) require_within(c, true);
  }
}

TEST_CASE("phases, delay lines and events run on as the law does") {
  const Compiled c = compiled(
      "rate = 40 kHz\n"
      "param ring = 200 Hz in 50 .. 400 Hz\n"
      "phase angle = 0 in 0 .. 1\n"
      "next angle = angle + ring * dt\n"
      "state strength = 0 Nm in 0 .. 0.1 Nm\n"
      "let inside = position > 0.5\n"
      "next strength = if inside then 0.1 Nm else 0.999 * strength\n"
      "line past[400] in -0.11 .. 0.11 Nm\n"
      "next past = strength * sin(2 * pi * angle)\n"
      "event hit(velocity) when inside\n"
      "out torque = past[1] + 0.5 * past[400]\n");
  CHECK(c.rate_hz == 40000);
  CHECK(c.image.line_base == 112);
  REQUIRE(c.bound.states_bounded);
  CHECK(c.bound.output[0] < 1e-3);
  require_within(c, true);
}

// A sum of only parameters, with a condition or an element, is multiplied.
TEST_CASE("what only depends on parameters keeps its terms") {
  const std::string way = "let way = if side < 0 then -1 else 1\n";
  const std::string parameters =
      "param p = 1 in 0.1 .. 1\nparam side = 1 in -1 .. 1\nparam k = 1 in 0 .. 3 whole\n"
      "array steps = [0.1, -0.2, 0.05, 0.3]\n";
  const std::vector<std::string> formulas = {
      "sgn(p) * p + 0.01",
      "sgn(side) * p + 0.1",
      "if position > 0.5 then way * p + 0.1 else 0",
      "if position > 0.5 then 2 * (way * p + 0.1) else -p * (way - 0.25)",
      "p * (steps[k] + 0.1)",
      "steps[k]",
      "steps[k + side] * clamp(position, -1, 1)",
      "clamp(position, -1, 1) * (if p < side and side < 0.9 then p else side - 0.3)",
      "min(clamp(position, -1, 1), 2 * (if not (p < 0.3) or side < 0 then p else way + 0.2))"};
  for (const std::string& formula : formulas) {
    INFO(formula);
    // Every name is used, without an effect on the torque.
    const std::string text = parameters + way + "out torque = 1 Nm * (" + formula +
                             " + 0 * (p + side + k + way + steps[0]))\n";
    const Compiled c = compiled(text);
    CHECK(c.bound.output[0] < 2e-4);
    require_within(c, false);
  }
}

TEST_CASE("an event's value that only depends on parameters keeps its terms") {
  const Compiled c = compiled(
      "param p = 0.5 in -1 .. 1\nevent hit(2 * (sgn(p) * p + 0.25)) when position > 0.5\n"
      "out torque = 0.1 Nm * clamp(position, -1, 1)\n");
  EngineMemory memory;
  memory.program = c.image.program;
  memory.data = c.image.data;
  memory.table = c.image.table;
  Machine machine(memory);
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
  EngineMemory memory;
  memory.program = c.image.program;
  memory.data = c.image.data;
  memory.table = c.image.table;
  Machine machine(memory);
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
  const std::pair<const char*, double> factors[] = {{"24", 1e-3}, {"7.3", 1e-3}, {"p", 1e-3}};
  for (const auto& [factor, most] : factors) {
    const Compiled c = compiled(fmt::format(
        "param p = 3.3 in 0 .. 100\n"
        "table flat(q) on [0, 1] = exp(-q)\n"
        "out torque = 1 Nm * sin({} * position) * flat(clamp(velocity / (1 rad/s), 0, 1))"
        "+ 0 Nm * p\n",
        factor));
    EngineMemory memory;
    memory.program = c.image.program;
    memory.data = c.image.data;
    memory.table = c.image.table;
    Machine machine(memory);
    const double by = factor[0] == 'p' ? c.image.words.at(0).initial * c.image.words.at(0).scale
                                       : std::atof(factor);
    for (const std::int64_t p : {0L, 1000L, 1L << 27, (1L << 28) + 777, -(1L << 30), 2147483647L}) {
      MachineInputs inputs{};
      inputs[0] = static_cast<std::int32_t>(p);
      const double angle = std::fmod(by * static_cast<double>(p) / 4096, 1.0) * 2 * pi;
      INFO(factor << " times " << p);
      CHECK(std::fabs(machine.run(0, inputs).outputs[0] * 0x1p-16 - std::sin(angle)) < most);
    }
  }
}

TEST_CASE("an event is one run's: where its condition becomes true") {
  const Compiled c = compiled(
      "event hit(velocity) when position > 0.5\nevent low(position) when position < -1\n"
      "out torque = 0.1 Nm * clamp(position, -1, 1)\n");
  EngineMemory memory;
  memory.program = c.image.program;
  memory.data = c.image.data;
  memory.table = c.image.table;
  Machine machine(memory);
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
  EngineMemory memory;
  memory.program = c.image.program;
  memory.data = c.image.data;
  Machine machine(memory);
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
}  // namespace feltgate::law
