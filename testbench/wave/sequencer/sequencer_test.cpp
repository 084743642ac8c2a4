// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// sequencer: RTL against twin on every clock, and both against the definition of a tick.
// Documentation: docs/architecture.md
#include <Vsequencer.h>

#include <set>

#include "catch.hpp"
#include "lock_step.hpp"
#include "ports.hpp"
#include "sequencer_twin.hpp"

using namespace feltgate::test;
using Twin = feltgate::Sequencer<CLOCKS_PER_TICK, RESET_TICKS>;

namespace {

struct Adapter {
  static void drive(Vsequencer&, const Twin::In&) {}
  template <class Check>
  static void compare(Check& check, const Vsequencer& rtl, const Twin::Out& out) {
    FELTGATE_COMPARE(check, rtl, out, tick, slot_fetch, scene_slot_fetch, wave, tick_count);
  }
};
using Bench = LockStep<Vsequencer, Twin, Adapter>;

/// The specified outputs in the n-th clock after a reset, without a state machine.
struct Definition {
  std::int64_t n = 0;

  const char* operator()(const Twin::In&, const Vsequencer& rtl, const Twin&, bool in_reset) {
    static const std::set<std::int64_t> scene_slots = {1, 2, 3, 6, 10};
    n = in_reset ? 0 : n + 1;
    const std::int64_t c = n % CLOCKS_PER_TICK;
    if ((rtl.tick_o != 0) != (c == CLOCKS_PER_TICK - 1)) return "tick in the last clock";
    const std::int64_t slot = c < 64 ? c : 63;
    if (rtl.slot_fetch_o != slot) return "slot c in clock c";
    if ((rtl.scene_slot_fetch_o != 0) != (scene_slots.count(slot) != 0)) return "scene's slots";
    std::uint64_t wave = 0;
    const std::int64_t since = n - 2;  // clocks since the first wave clock 0
    for (std::int64_t t = since % CLOCKS_PER_TICK; t < 50 && t <= since; t += CLOCKS_PER_TICK) {
      if (t >= 0) wave |= std::uint64_t{1} << t;
    }
    if (rtl.wave_o != wave) return "wave clock t is clock t+2";
    const auto count = static_cast<std::uint32_t>(n / CLOCKS_PER_TICK + RESET_TICKS);
    if (rtl.tick_count_o != count) return "ticks are counted";
    return nullptr;
  }
};

constexpr auto nothing = [](std::int64_t) { return Twin::In(); };

}  // namespace

TEST_CASE("sequencer: ticks from reset on, the count across its wrap") {
  Bench bench("sequencer", 1);
  bench.run(nothing, scaled_clocks(5100LL * CLOCKS_PER_TICK), {}, Definition());
}

TEST_CASE("sequencer: resets at random times") {
  for (std::uint64_t seed = 2; seed < 12; ++seed) {
    Bench bench("sequencer", seed);
    bench.run(nothing, scaled_clocks(20000), {130}, Definition());
  }
}
