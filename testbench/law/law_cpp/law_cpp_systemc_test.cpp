// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The C++ of laws in SystemC's fixed point: every word of `fixed`. Documentation:
// docs/law-compiler.md
#include "catch.hpp"
#include "law_cpp_bench.hpp"
#include "laws/constructs.hpp"
#include "mismatch.hpp"
#include "studies/bench/systemc_numbers.hpp"

namespace feltgate::test {
namespace {

struct AgainstSystemC {
  std::int64_t runs;

  template <template <class> class Law>
  void law() {
    INFO(Law<Fixed>::name);
    Law<Fixed> ours;
    Law<SystemC> theirs;
    Stimulus stimulus(13);
    SplitMix64 random(14);
    for (std::int64_t n = 0; n < runs; ++n) {
      if (stimulus.one_in(20)) {
        for (std::size_t w = 0; w < Law<Fixed>::words.size(); ++w) {
          const law::LawWord& range = Law<Fixed>::words[w];
          const auto word = static_cast<std::int32_t>(
              range.lower + random.below(std::int64_t{range.upper} - range.lower + 1));
          ours.set_word(w, word);
          theirs.set_word(w, word);
        }
      }
      if (stimulus.one_in(100)) {
        ours.enter();
        theirs.enter();
      }
      const law::MachineInputs words = stimulus.inputs();
      typename Law<Fixed>::Inputs in;
      typename Law<SystemC>::Inputs same;
      for (std::size_t i = 0; i < in.size(); ++i) {
        const law::LawInput& of = Law<Fixed>::inputs[i];
        const std::int32_t word = words[static_cast<std::size_t>(3 * of.axis + of.source)];
        in[i] = law::LawOps<Fixed>::word(word);
        same[i] = law::LawOps<SystemC>::word(word);
      }
      ours.run(in);
      theirs.run(same);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        REQUIRE(law::LawOps<Fixed>::raw(ours.output(axis)) ==
                law::LawOps<SystemC>::raw(theirs.output(axis)));
      }
      for (std::size_t e = 0; e < Law<Fixed>::events.size(); ++e) {
        REQUIRE(ours.happened()[e].happened == theirs.happened()[e].happened);
        REQUIRE(law::LawOps<Fixed>::raw(ours.happened()[e].value) ==
                law::LawOps<SystemC>::raw(theirs.happened()[e].value));
      }
    }
  }
};

TEST_CASE("C++ of laws: SystemC's words are those of fixed") {
  visit_shipped(AgainstSystemC{scaled_clocks(2000)});
  laws::visit_constructs(AgainstSystemC{scaled_clocks(1000)});
}

}  // namespace
}  // namespace feltgate::test
