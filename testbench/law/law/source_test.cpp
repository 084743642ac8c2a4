// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The run from a law's text beside the run of its graph: two readings of one language.
// Documentation: docs/laws.md
#include "law/source_law.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include "feltgate/random.hpp"
#include "law_case.hpp"

using namespace feltgate::law;
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
