// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Random laws: what compiles stays within its bound.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>

#include "law/diagnostics.hpp"
#include "law/measure.hpp"
#include "random_laws.hpp"

namespace feltgate::law {
namespace {

TEST_CASE("random laws stay within their bounds") {
  const char* more = std::getenv("FELTGATE_LONG");
  const int laws = more != nullptr && *more != 0 ? 3000 : 120;
  // FELTGATE_LAW=859: that one alone.
  const char* one = std::getenv("FELTGATE_LAW");
  const int only = one != nullptr && *one != 0 ? std::atoi(one) : -1;
  int compiled = 0;
  for (int i = std::max(only, 0); i < (only < 0 ? laws : only + 1); ++i) {
    const std::string text = RandomLaw(static_cast<std::uint64_t>(i) + 1).text();
    INFO("law " << i << ":\n" << text);
    try {
      const Compiled c = compile_text(text, "random.law", Target{});
      ++compiled;
      CHECK(c.bound.unproven.empty());
      for (const bool free_running : {false, true}) {
        if (free_running && (!c.bound.states_bounded || c.law.states.empty())) continue;
        // A run beside a strip takes the states with it.
        if (free_running && !c.bound.strips.empty()) continue;
        const Measured m = measure(c, 7, 3000, free_running);
        INFO("measured " << m.output[0] << ", bound " << c.bound.output[0]);
        CHECK(m.output[0] <= c.bound.output[0] * (1 + 1e-9) + 1e-8);
      }
    } catch (const LawError& e) {
      INFO(e.what());
      CHECK(std::string(e.what()).find("; ") != std::string::npos);
    }
  }
  INFO(compiled << " of " << laws << " compiled");
  CHECK((only >= 0 || compiled * 10 >= laws * 7));
}

}  // namespace
}  // namespace feltgate::law
