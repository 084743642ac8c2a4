// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What becomes of a formula: constants folded, equal nodes once, derived words. Documentation:
// docs/laws.md
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "catch.hpp"
#include "feltgate/random.hpp"
#include "law/derive.hpp"
#include "law/source_law.hpp"
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

/// The shipped laws, the laws of constructs.txt, and the examples of the page, by their names.
std::map<std::string, std::string> all_texts() {
  std::map<std::string, std::string> texts;
  for (const auto& entry : std::filesystem::directory_iterator(FELTGATE_ROOT "/rtl/laws")) {
    if (entry.path().extension() != ".law") continue;
    std::ifstream in(entry.path());
    texts[entry.path().stem().string()] = std::string(std::istreambuf_iterator<char>(in), {});
  }
  std::ifstream constructs(FELTGATE_ROOT "/testbench/law/law_cpp/constructs.txt");
  std::ifstream page(FELTGATE_ROOT "/docs/laws.md");
  std::string name, example;
  for (std::string line; std::getline(constructs, line);) {
    if (line.rfind("== ", 0) == 0) {
      name = line.substr(3);
    } else if (!name.empty()) {
      texts[name] += line + "\n";
    }
  }
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("```", 0) == 0) {
      example = line == "```law" ? "example " + std::to_string(texts.size()) : "";
    } else if (!example.empty()) {
      texts[example] += line + "\n";
    }
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
  CHECK(texts.size() >= 50);
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
