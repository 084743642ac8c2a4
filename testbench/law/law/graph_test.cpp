// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What becomes of a formula, and what functions, amounts and tables compute. Documentation:
// docs/laws.md
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "catch.hpp"
#include "compiled.hpp"
#include "feltgate/random.hpp"
#include "feltgate/real_functions.hpp"
#include "law/derive.hpp"
#include "law/source_law.hpp"
#include "law/units.hpp"
#include "law_case.hpp"

using namespace feltgate::law;

namespace {

/// The torque's formula of `out torque = 1 Nm * e` beside parameters a, b, c in 1 .. 2.
std::string shown(const std::string& e) {
  const Law law = law_of(
      "param a = 1 in 1 .. 2\nparam b = 1 in 1 .. 2\nparam c = 1 in 1 .. 2\n"
      "let x = position\nlet y = position[1]\n"
      "out torque[2] = 0 Nm * (a + b + c) * x * y\nout torque = 1 Nm * (" +
      e + ")");
  std::string all = formula(law, law.outputs[1].value);
  for (std::size_t i = 3; i < law.parameters.size(); ++i) {
    if (law.parameters[i].derived >= 0) all += "; " + law.parameters[i].name;
  }
  return all;
}

std::size_t count(const Law& law, Op op) {
  return static_cast<std::size_t>(
      std::count_if(law.nodes.begin(), law.nodes.end(), [&](const Node& n) { return n.op == op; }));
}

}  // namespace

TEST_CASE("formulas get simpler") {
  CHECK(shown("x + 0") == "1*position");
  CHECK(shown("x - x") == "0");
  CHECK(shown("0 * x") == "0");
  CHECK(shown("2 * 3 * x") == "6*position");
  CHECK(shown("x / 4") == "0.25*position");
}

TEST_CASE("every law is in order: arguments first, nothing dead, nothing twice") {
  for (const char* const name : {"ceiling", "charge", "charge_far", "damper", "detent", "gimbal",
                                 "membrane", "spring", "quaternion", "pantograph", "wall",
                                 "wall_tracked", "ceiling_tracked", "drums", "bowed_string"}) {
    const Law law = shipped(name);
    INFO(name);
    std::set<NodeId> used;
    const auto note = [&](NodeId id) {
      CHECK(id < static_cast<NodeId>(law.nodes.size()));
      used.insert(id);
    };
    for (std::size_t i = 0; i < law.nodes.size(); ++i) {
      for (const NodeId a : law.nodes[i].arguments) {
        CHECK(a < static_cast<NodeId>(i));
        used.insert(a);
      }
    }
    for (const Output& o : law.outputs) note(o.value);
    for (const State& s : law.states) note(s.next);
    for (const Line& l : law.lines) note(l.written);
    for (const Event& e : law.events) {
      note(e.condition);
      note(e.value);
    }
    for (const Table& t : law.tables) {
      note(t.body);
      note(t.argument);
    }
    for (const Parameter& p : law.parameters) {
      if (p.derived >= 0) note(p.derived);
      CHECK(p.range.lower <= p.initial);
      CHECK(p.initial <= p.range.upper);
      CHECK(!p.name.empty());
    }
    for (std::size_t i = 0; i < law.nodes.size(); ++i) {
      INFO(i);
      CHECK(used.count(static_cast<NodeId>(i)) == 1);
      for (std::size_t j = 0; j < i; ++j) {
        const Node &m = law.nodes[i], &n = law.nodes[j];
        const bool same = m.op == n.op && m.arguments == n.arguments && m.index == n.index &&
                          m.value == n.value && m.unit == n.unit && m.truth == n.truth;
        CHECK_FALSE(same);
      }
    }
  }
}

TEST_CASE("what only depends on parameters is a word of its own") {
  const Law law = law_of(
      "param a = 2 Nm in 1 .. 3 Nm\nparam b = 4 in 2 .. 5\n"
      "out torque = (a / b - a) * position * exp(-b) + a * position[1]");
  REQUIRE(law.parameters.size() == 3);
  const Parameter& p = law.parameters[2];
  CHECK(p.initial == Approx((0.5 - 2) * std::exp(-4)));
  CHECK(p.range.lower <= (1 / 5.0 - 3) * std::exp(-2));
  CHECK(p.range.upper >= 0.5 * std::exp(-5));
  CHECK(p.unit_text == "Nm");
  CHECK(count(law, Op::reciprocal) == 1);
  CHECK(count(law, Op::exponential) == 1);
  // The run: two products and a sum of words, positions and each other.
  Running<> run(law);
  run.set("a", 3);
  CHECK(run.torque({{"position", 1}}) == Approx((0.75 - 3) * std::exp(-4)));
}

TEST_CASE("a parameter alone is no derived word, and mailboxes are never in one") {
  const Law law = law_of(
      "param a = 2 Nm in 1 .. 3 Nm\nmailbox b = 4 in 2 .. 5 max_age 1 s\n"
      "out torque = a\nout torque[1] = a * b\nout torque[2] = if a < 2 Nm then a * b else tau_hat");
  CHECK(law.parameters.size() == 2);
  CHECK(count(law, Op::parameter) == 2);
  CHECK(count(law, Op::less) == 1);
}

TEST_CASE("derived ranges hold every value of the formula") {
  const std::string e =
      "(a^2 + b) / c - min(a, b) * max(b, c) + abs(a - c) * sqrt(b) + sin(a * b) - "
      "(if a < b then c else a * b) + exp(a - c)";
  Law law = law_of(
      "param a = 1 in -1 .. 2\nparam b = 1 in 0 .. 3\nparam c = 1 in 0.5 .. 2\n"
      "out torque = 1 Nm * position * (" +
      e + ")");
  const Parameter p = law.parameters[3];
  Running<> run(law);
  for (double a = -1; a <= 2; a += 0.25) {
    for (double b = 0; b <= 3; b += 0.25) {
      for (double c = 0.5; c <= 2; c += 0.25) {
        run.set("a", a);
        run.set("b", b);
        run.set("c", c);
        const double value = run.evaluation().parameter(3);
        CHECK(p.range.lower <= value);
        CHECK(value <= p.range.upper);
        const double by_hand = (a * a + b) / c - std::min(a, b) * std::max(b, c) +
                               std::abs(a - c) * std::sqrt(b) + std::sin(a * b) -
                               (a < b ? c : a * b) + std::exp(a - c);
        CHECK(value == Approx(by_hand).margin(1e-12));
      }
    }
  }
}

// The run from a law's text beside the run of its graph: two readings of one language.

using feltgate::SplitMix64;

namespace {

/// The shipped laws, those of constructs.txt, and the examples of the page, by their names.
std::map<std::string, std::string> all_texts() {
  std::map<std::string, std::string> texts;
  for (const std::string& name : shipped_names()) {
    std::ifstream in(FELTGATE_ROOT "/rtl/laws/" + name + ".law");
    texts[name] = std::string(std::istreambuf_iterator<char>(in), {});
  }
  for (const Construct& c : constructs()) texts[c.name] = c.text;
  for (const std::string& text : laws_of_page()) {
    texts["example " + std::to_string(texts.size())] = text;
  }
  return texts;
}

/// The least |x| + |y| of the only atan2 of a law.
double nearest(const Law& law) {
  for (const Node& n : law.nodes) {
    if (n.op != Op::maximum) continue;
    for (const NodeId a : n.arguments) {
      const Node& end = law.nodes[at(a)];
      if (end.op == Op::constant && end.value > 0) return end.value;
    }
  }
  return 0;
}

}  // namespace

TEST_CASE("the run from the text and the run of the graph are the same law") {
  const auto texts = all_texts();
  CHECK(texts.size() >= 70);
  for (const auto& [name, text] : texts) {
    INFO(name << ":\n" << text);
    const Law law = read_law_text(text, name, text.find("rate =") == std::string::npos ? 20000 : 0);
    SourceLaw source(law.source, law.rate_hz, [&law = law](Place) { return nearest(law); });
    Evaluation<long double> graph(law);
    SplitMix64 random(5);
    for (int start = 0; start < 6; ++start) {
      source.reset();
      graph.reset();
      for (std::size_t p = 0; start > 0 && p < law.parameters.size(); ++p) {
        const Parameter& of = law.parameters[p];
        if (of.derived >= 0) continue;
        const double si = random.between(of.range.lower, of.range.upper);
        const double value = of.whole ? std::floor(si) : si;
        source.set_parameter(of.name, value);
        graph.set_parameter(p, value);
      }
      const double size = std::exp2(-2.0 * start);
      double apart = 0;
      for (int k = 0; k < 100; ++k) {
        SourceLaw::Inputs inputs{};
        for (std::size_t i = 0; i < inputs.size(); ++i) {
          inputs[i] = (i % 3 == 0 ? 3 : i % 3 == 1 ? 40 : 1) * size * random.between(-1, 1);
        }
        std::vector<long double> own;
        for (const Input& i : law.inputs) {
          own.push_back(inputs[at(3 * i.axis + static_cast<int>(i.source))]);
        }
        source.run(inputs);
        graph.run(own);
        for (std::size_t o = 0; o < law.outputs.size(); ++o) {
          const long double torque = graph.outputs()[o];
          const long double off = std::fabs(source.torque(law.outputs[o].axis) - torque);
          apart = std::max(apart, static_cast<double>(off / (1 + std::fabs(torque))));
        }
        for (std::size_t e = 0; e < law.events.size(); ++e) {
          REQUIRE(source.happened(e) == graph.happened(e));
        }
      }
      CHECK(apart < 1e-9);
    }
  }
}

TEST_CASE("a run from the text is not misled by the rounding of its own numbers") {
  // 0.1 * 3 is above 0.3 in doubles, and 0.7 / 0.1 below 7.
  SourceLaw law(
      "param p = 3 in 0 .. 9\nparam q = 0.7 in 0 .. 1\n"
      "out torque = (if 0.1 * p > 0.3 then 1 Nm else 0 Nm) + 1 Nm * floor(q / 0.1)\n",
      1000);
  law.run({});
  CHECK(law.torque(0) == 7);
  law.set_parameter("p", 4);
  law.run({});
  CHECK(law.torque(0) == 8);
}

// Functions of binary128 against long double and against each other.

using feltgate::Quad;

namespace {

double off(Quad a, Quad b) { return std::fabs(static_cast<double>(a - b)); }

}  // namespace

TEST_CASE("Quad: as long double, to its digits") {
  for (long double x = -40; x < 40; x += 0.173L) {
    const Quad q = x;
    CHECK(off(sine_of(q), std::sin(x)) < 1e-18);
    CHECK(off(cosine_of(q), std::cos(x)) < 1e-18);
    CHECK(off(exponential_of(q), std::exp(x)) <= 1e-18 * std::exp(static_cast<double>(x)));
    CHECK(off(arctangent_of(q), std::atan(x)) < 1e-18);
    if (x > 0) CHECK(off(logarithm_of(q), std::log(x)) < 1e-18);
    CHECK(off(root_of(Quad{q * q}), std::fabs(x)) < 1e-17);
    CHECK(off(floor_of(q), std::floor(x)) == 0);
  }
}

TEST_CASE("Quad: against each other, to its own digits") {
  for (int i = -300; i < 300; ++i) {
    const Quad x = static_cast<Quad>(i) / 17;
    const Quad s = sine_of(x), c = cosine_of(x);
    CHECK(off(s * s + c * c, 1) < 1e-31);
    CHECK(off(sine_of(2 * x), 2 * s * c) < 1e-31);
    CHECK(off(exponential_of(x) * exponential_of(-x), 1) < 1e-28);
    CHECK(off(logarithm_of(exponential_of(x)), x) < 1e-30);
    const Quad r = root_of(x * x + 1);
    CHECK(off(r * r, x * x + 1) < 1e-30);
  }
  CHECK(floor_of(static_cast<Quad>(-3)) == static_cast<Quad>(-3));
  CHECK(root_of(Quad{0}) == Quad{0});
}

// What users type as a number with a unit. Expected values are written out, not computed by units.

namespace {

using feltgate::law::amount_in;
using feltgate::law::BoardUnits;

constexpr BoardUnits kBoard{2 * 3.14159265358979323846 / 4096, 1e-6};

std::string told(const std::string& text, const std::string& unit, const BoardUnits& board = {}) {
  try {
    amount_in(text, unit, board);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "taken";
}

}  // namespace

TEST_CASE("amounts: a unit is converted, a bare number is in the unit of the parameter") {
  const struct {
    const char *text, *unit;
    double value;
  } cases[] = {
      {"4", "Nm/rad", 4},
      {" -4e-3 ", "Nm/rad", -4e-3},
      {"4Nm/deg", "Nm/rad", 229.183118052329},
      {"4 mNm/deg", "Nm/rad", 0.229183118052329},
      {"180deg", "rad", 3.14159265358979},
      {"0.5 turn/s", "rad/s", 3.14159265358979},
      {"0.1", "1", 0.1},
      {"7", "", 7},
      {"50 1/kohm", "1/ohm", 0.05},
      {"5ms", "s", 0.005},
      {"30 g", "kg", 0.03},
      {"2 g m^2", "kg m^2", 0.002},
      {"10 kHz", "Hz", 10000},
      {"3 count", "count", 3},
      {"90deg", "count", 1024},
      {"1 Nm/turn", "Nm/count", 1.0 / 4096},
      {"1 Nm/count", "Nm/rad", 651.898646904403},
      {"1 Nm rad^2", "Nm count^2", 424971.845835792},
      {"50ms", "tick", 50000},
      {"50 tick", "s", 50e-6},
      {"0.64s", "128 ticks", 5000},
      {"2 V/s", "V/tick", 2e-6},
      {"3 A^2 s", "A^2 tick", 3e6},
      {"9 128 ticks", "128 ticks", 9},
  };
  for (const auto& c : cases) {
    INFO(c.text << " in " << c.unit);
    CHECK(amount_in(c.text, c.unit, kBoard) == Approx(c.value).epsilon(1e-12));
  }
}

TEST_CASE("amounts: what cannot be taken says how to write it") {
  CHECK(told("4Nm", "Nm/rad") == "4Nm is not in Nm/rad; give it in Nm/rad");
  CHECK(told("10 Hz", "rad/s") == "10 Hz is not in rad/s; give it in rad/s");
  CHECK(told("1 Nm mrad^2", "Nm") == "1 Nm mrad^2 is not in Nm; give it in Nm");
  CHECK(told("4 N", "Nm/count", kBoard) ==
        "4 N is not in Nm/count; give it in Nm/count, or in Nm/rad");
  CHECK(told("5V", "128 ticks", kBoard) == "5V is not in 128 ticks; give it in 128 ticks, or in s");
  CHECK(told("5mNms/rad", "Nm s/rad") == "5mNms/rad is not in Nm s/rad; write 5 mNm s/rad");
  CHECK(told("80mN", "Nm") == "80mN is not in Nm; give it in Nm");
  CHECK(told("4 furlong", "rad") == "4 furlong is not in rad; give it in rad");
  CHECK(told("4 rad", "1") == "4 rad takes a number without a unit; give the number alone");
  CHECK(told("4 count", "rad") == "4 count is not in rad; give it in rad");  // no board
  CHECK(told("1/count", "rad") != "taken");
  CHECK(told("5,5", "rad").find("write its point as a point") != std::string::npos);
  CHECK(told("4 N/m s", "N/m").find("read in two ways") != std::string::npos);
  for (const char* text : {"", "x", "nan", "inf", "-inf", "1e999", "Nm", "nan Nm"}) {
    INFO(text);
    CHECK(told(text, "Nm").find("is no number; give one") != std::string::npos);
  }
}

// Tables of a law: what they compute.

TEST_CASE("a table of a number is a number") {
  CHECK(torque_of("table f(x) on [0, 1] = x^2\nout torque = 1 Nm * (f(0.3) + f(7))") ==
        Approx(1.09));
  CHECK(
      torque_of("table f(x) periodic on [0, 1] through [0, 2, 0]\nout torque = 1 Nm * f(-3.75)") ==
      Approx(1));
}

TEST_CASE("tables: exact by their formula, or linear between samples") {
  const std::string text =
      "table f(x) on [0, 2] = x^2 with 4 segments\nout torque = 1 Nm * f(position)";
  Running<> exact(law_of(text)), sampled(law_of(text), Tables::sampled);
  const auto both = [&](double x) {
    return std::make_pair(exact.torque({{"position", x}}), sampled.torque({{"position", x}}));
  };
  CHECK(both(1.25) == std::make_pair(1.5625, 1.625));
  CHECK(both(1.5) == std::make_pair(2.25, 2.25));
  CHECK(both(2) == std::make_pair(4.0, 4.0));
  CHECK(both(7) == std::make_pair(4.0, 4.0));
  CHECK(both(-7) == std::make_pair(0.0, 0.0));
  Running<> scaled(
      law_of("table f(d) on [0, 20 mm] = 3 N/m * d\nout torque = 1 m * f(position * 1 m)"));
  CHECK(scaled.torque({{"position", 0.01}}) == Approx(0.03));
  Running<> nested(
      law_of("table f(x) on [0, 2] = x^2\ntable q(x) on [0, 2] = f(x) + 1\n"
             "let x = position\nout torque = 1 Nm * q(x)"));
  CHECK(nested.torque({{"position", 1.5}}) == Approx(3.25));
}

TEST_CASE("tables through points: linear between them, sampled or not") {
  const std::string text =
      "table f(x) on [1, 2] through [10, 30, 20] mNm\nout torque = f(position)";
  Running<> exact(law_of(text)), sampled(law_of(text), Tables::sampled);
  for (Running<>* one : {&exact, &sampled}) {
    CHECK(one->torque({{"position", 1.0}}) == Approx(0.010));
    CHECK(one->torque({{"position", 1.25}}) == Approx(0.020));
    CHECK(one->torque({{"position", 1.5}}) == Approx(0.030));
    CHECK(one->torque({{"position", 1.75}}) == Approx(0.025));
    CHECK(one->torque({{"position", 2.0}}) == Approx(0.020));
    CHECK(one->torque({{"position", 9.0}}) == Approx(0.020));
    CHECK(one->torque({{"position", -9.0}}) == Approx(0.010));
  }
  Running<> units(law_of("table f(x) on [0, 1] through [1 Nm, 2 Nm]\nout torque = f(position)"));
  CHECK(units.torque({{"position", 0.5}}) == Approx(1.5));
}

TEST_CASE("periodic tables go on as they began") {
  const std::string points =
      "table f(x) periodic on [1, 3] through [10, 30, 20, 0, 10] mNm\nout torque = f(position)";
  Running<> exact(law_of(points)), sampled(law_of(points), Tables::sampled);
  for (Running<>* one : {&exact, &sampled}) {
    for (const double turns : {0.0, 2.0, -2.0, 2000.0, -64.0}) {
      CHECK(one->torque({{"position", 1.0 + turns}}) == Approx(0.010));
      CHECK(one->torque({{"position", 1.25 + turns}}) == Approx(0.020));
      CHECK(one->torque({{"position", 2.75 + turns}}) == Approx(0.005));
    }
  }
  Running<> formula(
      law_of("table f(x) periodic on [-0.5, 0.5] = x^2\ntable q(x) on [-9, 9] = f(x + 0.25)\n"
             "out torque = 1 Nm * (f(position) + 10 * q(position))"));
  for (const double x : {-0.4, 0.1, 0.3, 7.2, -8.9}) {
    const double a = x - std::nearbyint(x), b = x + 0.25 - std::nearbyint(x + 0.25);
    CHECK(formula.torque({{"position", x}}) == Approx(a * a + 10 * b * b));
  }
}
