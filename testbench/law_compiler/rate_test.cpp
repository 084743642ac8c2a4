// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// How often a law runs, by the compiler's rule and by the engine's twin, clock by clock.
#include <catch2/catch.hpp>
#include <filesystem>

#include "feltgate/engine.hpp"
#include "law/compile.hpp"

namespace feltgate::law {
namespace {

/// Runs of thread 0 and whether a start was missed, in so many ticks.
struct Seen {
  int fresh = 0;
  bool overrun = false;
};

template <int Axes>
Seen run(const EngineMemory& memory, int divider, int clocks_per_tick, int phase, int ticks) {
  using H = EngineMap::H;
  Engine<Axes> engine(0xffff);
  engine.reset();
  engine.memory() = memory;
  typename Engine<Axes>::In in;
  const auto write = [&](int address, int word) {
    in.addr = static_cast<unsigned>(address);
    in.wdata = static_cast<std::uint32_t>(word);
    in.write = true;
    engine.clock(in);
    in.write = false;
    for (int k = 0; k < 40; ++k) engine.clock(in);
  };
  write(H::divider0, divider);
  write(H::run, 1);
  for (int k = 0; k < phase; ++k) engine.clock(in);
  in.addr = static_cast<unsigned>(H::status);
  Seen seen;
  for (int k = 0; k < ticks * clocks_per_tick; ++k) {
    in.tick = k % clocks_per_tick == 0;
    engine.clock(in);
    seen.fresh += engine.out().fresh ? 1 : 0;
  }
  seen.overrun = (engine.out().rdata >> EngineMap::S::status_overrun & 1U) != 0;
  return seen;
}

template <int Axes>
EngineMemory program(int instructions) {
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
  for (int n = 4; n <= 20; ++n) {
    const int period = engine_period(n, Axes);
    INFO(Axes << " axes, " << n << " instructions, " << period << " clocks");
    for (int phase = 0; phase < EngineMap::round_clocks; ++phase) {
      const EngineMemory m = program<Axes>(n);
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

TEST_CASE("clocks from start to start: as many as the twin needs, and not one less") {
  exact<1>();
  exact<2>();
  exact<3>();
}

/// Runs of a law that are looked at: few of a slow one, which has long ticks between.
int runs_at(int divider) { return divider < 100 ? 240 : 12; }

template <int Axes>
Seen at_divider(const Compiled& c, int divider) {
  EngineMemory m;
  m.program = c.image.program;
  m.data = c.image.data;
  m.table = c.image.table;
  return run<Axes>(m, divider, c.target.clocks_per_tick, 3, runs_at(divider) * divider);
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
