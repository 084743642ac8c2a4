// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// engine: clocks from start to start of a run. Documentation: docs/blocks/engine.md
#include "catch.hpp"
#include "engine_rate.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

template <int Axes>
EngineMemory adds(int instructions) {
  EngineMemory m;
  for (int n = 0; n < instructions; ++n) {
    EngineInstruction i;
    i.op = EngineOp::add;
    i.last = n == instructions - 1;
    i.d = n % Axes;
    i.dst = n < instructions - Axes ? 0 : static_cast<int>(EngineTarget::output);
    m.set_program(n, engine_encode(i));
  }
  return m;
}

template <int Axes>
void exact() {
  constexpr int ticks = 300;
  for (const int n : {4, 5, 6, 7, 8, 9, 20}) {
    const int period = engine_period(n, Axes);
    INFO(Axes << " axes, " << n << " instructions, " << period << " clocks");
    for (int phase = 0; phase < EngineMap::round_clocks; ++phase) {
      const EngineMemory m = adds<Axes>(n);
      for (const int clocks : {period, period + 1, period + 4}) {
        const Seen enough = run<Axes>(m, 1, clocks, phase, ticks);
        REQUIRE_FALSE(enough.overrun);
        REQUIRE(enough.fresh >= ticks - 2);
      }
      const Seen less = run<Axes>(m, 1, period - 1, phase, ticks);
      REQUIRE(less.overrun);
      REQUIRE(less.fresh < ticks - 2);
    }
  }
}

}  // namespace

TEST_CASE("engine: clocks from start to start: as many as the twin needs, and not one less") {
  exact<1>();
  exact<2>();
  exact<3>();
}
