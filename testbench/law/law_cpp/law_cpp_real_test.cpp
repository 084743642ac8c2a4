// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The C++ of laws in double and binary128: the law's own evaluation. Documentation:
// docs/law-compiler.md
#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "feltgate/quad.hpp"
#include "law/evaluate.hpp"
#include "law_cpp_bench.hpp"
#include "laws/constructs.hpp"

namespace feltgate::test {
namespace {

/// Largest distance from Evaluation<T>, of a torque or an event's value.
template <class T>
struct AgainstGraph {
  int runs;
  double limit_nm;

  template <template <class> class Law>
  void law() {
    using Own = Law<Real<T>>;
    const law::Compiled& c = compiled_law(Own::name);
    INFO(c.law.name);
    Own own;
    law::Evaluation<T> graph(c.law);
    Stimulus stimulus(3, true);
    SplitMix64 random(4);
    // The image's values are rounded to words, the file's are not.
    set(c, stimulus, random, &own, &graph);
    double worst = 0;
    for (int n = 0; n < runs; ++n) {
      if (stimulus.one_in(100)) set(c, stimulus, random, &own, &graph);
      if (n > 0 && stimulus.one_in(500)) {
        own.enter();
        graph.reset();
      }
      const law::MachineInputs words = stimulus.inputs();
      typename Own::Inputs in{};
      std::vector<T> si;
      for (std::size_t i = 0; i < in.size(); ++i) {
        const law::LawInput& of = Own::inputs[i];
        in[i] = static_cast<T>(words[static_cast<std::size_t>(3 * of.axis + of.source)]);
        si.push_back(in[i] * static_cast<T>(of.scale));
      }
      own.run(in);
      graph.run(si);
      for (std::size_t o = 0; o < Own::outputs.size(); ++o) {
        const law::LawOutput& of = Own::outputs[o];
        const T torque = own.output(static_cast<std::size_t>(of.axis)) * static_cast<T>(of.scale);
        worst = larger(worst, std::fabs(static_cast<double>(torque - graph.outputs()[o])));
      }
      for (std::size_t e = 0; e < Own::events.size(); ++e) {
        REQUIRE(own.happened()[e].happened == graph.happened(e));
        if (!graph.happened(e)) continue;
        const T value = own.happened()[e].value * static_cast<T>(Own::events[e].scale);
        worst = larger(worst, std::fabs(static_cast<double>(value - graph.event_value(e))));
      }
      REQUIRE(worst <= limit_nm);
    }
  }

  template <class Own>
  static void set(const law::Compiled& c, Stimulus& stimulus, SplitMix64& random, Own* own,
                  law::Evaluation<T>* graph) {
    const std::vector<double> values = stimulus.values(c.image);
    std::array<T, Own::parameters> all{};
    std::size_t next = 0;
    for (const law::ImageWord& w : c.image.words) {
      if (!w.formula.empty()) continue;
      // Between words: a comparison then never meets its own edge.
      const double off = w.whole ? 0 : random.between(0.2, 0.8) * w.scale;
      const double value = values[next] + (values[next] >= w.upper * w.scale ? -off : off);
      for (std::size_t p = 0; p < c.law.parameters.size(); ++p) {
        if (c.law.parameters[p].name == w.name) graph->set_parameter(p, static_cast<T>(value));
      }
      all[next++] = static_cast<T>(value);
    }
    own->set_values(all);
  }
};

TEST_CASE("C++ of laws in double is the law in double") {
  visit_shipped(AgainstGraph<double>{20000, 1e-10});
  laws::visit_constructs(AgainstGraph<double>{20000, 1e-10});
}

TEST_CASE("C++ of laws in binary128 is the law in binary128, but for constants of the program") {
  visit_shipped(AgainstGraph<Quad>{1000, 1e-11});
  laws::visit_constructs(AgainstGraph<Quad>{1000, 1e-11});
}

}  // namespace
}  // namespace feltgate::test
