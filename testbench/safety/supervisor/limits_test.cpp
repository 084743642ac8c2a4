// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// supervisor: every bit of the signals and counters that are compared with a limit.
// Documentation: docs/blocks/supervisor.md
#include <algorithm>
#include <array>

#include "bench.hpp"
#include "catch.hpp"
#include "random_core.hpp"

using namespace feltgate::test;
using feltgate::Fault;
using feltgate::Map;

namespace {

constexpr std::uint64_t clock_of(int t) { return std::uint64_t{1} << t; }

/// A tick in every clock (no real core does this), with the watchdog's two clocks in each. The
/// motor is armed, runs 100 clocks without a kick at a limit of 3, and is then kicked once, at
/// `limit`.
struct FastTicks {
  std::uint32_t limit;
  Twin::In operator()(std::int64_t k) const {
    Twin::In in;
    in.tick = true;
    in.arm = k >= 20;
    in.kick = k == 120;
    // The limit is not compared near the kick: it would be compared with the time before the kick.
    if (k < 119 || k > 121) in.wave |= clock_of(Map::W::watchdog_ticks);
    if (k < 119 || k > 122) in.wave |= clock_of(Map::T::watchdog);
    in.param = k < 120 ? 3 : limit;
    return in;
  }
  /// The clock at which the watchdog must trip, with the pipeline's uncertainty: at the counter's
  /// end whatever the limit.
  std::int64_t end() const {
    return 120 + std::min(std::int64_t{limit}, std::int64_t{1} << Map::kickless_bits) + 4;
  }
};

/// The gates are open for just as long as the limit lets them be.
void open_to_the_tick(std::uint32_t limit) {
  std::int64_t open = 0;
  const auto note = [&](const Twin::In&, const Vsupervisor& rtl, const Twin&,
                        bool in_reset) -> const char* {
    if (!in_reset) open += rtl.gates_enable_o != 0 ? 1 : 0;
    return nullptr;
  };
  const FastTicks ticks{limit};
  SupervisorBench bench("supervisor", 1);
  bench.run(ticks, ticks.end() + 50, {}, note);
  const std::int64_t ends = ticks.end() - 124;
  INFO("limit " << limit << ", open for " << open);
  CHECK(open > 100 + ends);
  CHECK(open < 110 + ends);
}

}  // namespace

TEST_CASE("supervisor: in each clock of fast ticks, the watchdog's limit to the tick") {
  for (const std::uint32_t limit :
       {1U, 2U, 3U, 4U, 5U, 100U, 127U, 128U, 0x5555U, 0xffffU, 0x155555U, 0x1aaaabU}) {
    open_to_the_tick(limit);
  }
}

TEST_CASE("supervisor: a watchdog's limit of one high bit is not a short one") {
  for (int bit = 20; bit < 31; ++bit) {
    const FastTicks ticks{1U << bit};
    SupervisorBench bench("supervisor", 1);
    bench.run(ticks, 2000);
  }
}

TEST_CASE("supervisor: each bit of the nominal current's square cools") {
  for (int bit = 12; bit < 31; ++bit) {
    for (const std::uint32_t beside : {0U, 1U << 22, 1U << 27}) {
      Script s;
      const std::uint32_t square = 1U << bit | beside;
      s.now.words.nominal_current_squared = square;
      // Of the heat at power-up so much goes that some ticks cool it, or all, whatever is less.
      const std::uint64_t goes = std::uint64_t{square} * 40;
      const std::uint64_t start = Design::i2t_start;
      s.now.words.i2t_budget = static_cast<std::uint32_t>(goes < start ? start - goes : 1);
      for (int k = 0; k < 30; ++k) s.clear();
      INFO("bit " << bit << ", beside " << beside);
      CHECK(s.out().faults == 0);
      s.play();
    }
  }
}

TEST_CASE("supervisor: anything at any time, words at the very signals") {
  std::array<std::int64_t, 16> trips{};
  std::int64_t armings = 0;
  for (std::uint64_t seed = 101; seed < 101 + seeds_of(8); ++seed) {
    SupervisorBench bench("supervisor", seed);
    Watch watch(&trips, &armings);
    bench.run(RandomCore(seed, {}, true), scaled_clocks(400'000), {}, watch);
  }
  if (defects_run()) return;
  for (const Fault cause : {Fault::polarity, Fault::i2t, Fault::watchdog}) {
    INFO("polarity " << trips[3] << ", i2t " << trips[4] << ", watchdog " << trips[5]);
    CHECK(trips[static_cast<std::size_t>(cause)] > 10);
  }
  CHECK(armings >= 100);
}

TEST_CASE("supervisor: the longest watchdog there is bears 2^24 ticks without a kick and ends",
          "[endurance]") {
  constexpr std::uint32_t end = 1U << Map::kickless_bits;
  for (const std::uint32_t limit : {end / 2 + 1, end - 1, 0x7fffffffU}) open_to_the_tick(limit);
}
