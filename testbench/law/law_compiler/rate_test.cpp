// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The run rate of laws in the engine's twin, clock by clock, against the rate that the compiler
// reports.
#include <catch2/catch.hpp>
#include <filesystem>

#include "engine_rate.hpp"
#include "law/compile.hpp"

namespace feltgate::law {
namespace {

using test::Seen;

/// Number of runs to check: few for a slow law, because the time between its runs is long.
int runs_at(int divider) { return divider < 100 ? 240 : 12; }

template <int Axes>
Seen at_divider(const Compiled& c, int divider) {
  EngineMemory m;
  m.program = c.image.program;
  m.data = c.image.data;
  m.table = c.image.table;
  return test::run<Axes>(m, divider, c.target.clocks_per_tick, 3, runs_at(divider) * divider);
}
Seen at_divider(const Compiled& c, int divider) {
  return c.target.axes == 1   ? at_divider<1>(c, divider)
         : c.target.axes == 2 ? at_divider<2>(c, divider)
                              : at_divider<3>(c, divider);
}

TEST_CASE("shipped laws reach their rate in the twin, and none a higher one") {
  const std::string folder = std::string(FELTGATE_ROOT) + "/rtl/laws";
  int slower = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".law") continue;
    const Compiled c = compile_file(entry.path().string(), Target{});
    INFO(c.law.name << ", divider " << c.divider);
    const Seen seen = at_divider(c, c.divider);
    CHECK_FALSE(seen.overrun);
    CHECK(seen.fresh >= runs_at(c.divider) - 2);
    if (c.divider == 1 || c.law.rate_hz > 0) continue;
    CHECK(at_divider(c, c.divider - 1).overrun);
    ++slower;
  }
  CHECK(slower >= 3);
}

}  // namespace
}  // namespace feltgate::law
