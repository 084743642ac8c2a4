// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// supervisor: the twin alone. The step of a whole tick is compared with the clock-by-clock twin,
// and the estimate of the current with real arithmetic. Documentation: docs/blocks/supervisor.md
#include <cmath>

#include "catch.hpp"
#include "feltgate/generated/paper.hpp"
#include "mismatch.hpp"
#include "random_scenario.hpp"

using namespace feltgate::test;

TEST_CASE("supervisor: a tick at once is its clocks one by one") {
  Twin clocked, at_once;
  Clock clock;
  Bus bus(1);
  RandomScenario scenarios(4);
  Scenario now;
  std::int64_t falls = 0;
  for (std::int64_t k = 0; k < scaled_clocks(60000); ++k) {
    const Scenario before = now;
    now = scenarios.next();
    // The step of a whole tick has no host and no other axes.
    now.host = now.disarm = now.axis_silent = now.axis_blocked = false;
    Twin::Tick tick;
    tick.voltage_before = before.voltage;
    tick.velocity_before = before.velocity;
    tick.current_ref = before.current_ref;
    tick.velocity = now.velocity;
    tick.arm = now.arm;
    tick.clear_faults = now.clear_faults;
    tick.kick = now.kick;
    int fell = -1;
    if (k > 0) {  // the synchroniser settles in the first tick
      REQUIRE(at_once.steady(false));
      const bool near = at_once.near_trip(now.words);
      fell = at_once.tick(now.words, tick);
      REQUIRE((near || (fell != Twin::heat_clock && fell != Twin::polarity_clock)));
    }
    const bool live = clocked.out().gates_enable;
    int fell_clocked = -1;
    for (int c = 0; c < Design::clocks_per_tick; ++c) {
      clocked.clock(bus.clock(clock.out(), now, clocked.out().current_estimate));
      clock.clock({});
      const bool fault = clocked.out().first_fault != 0;
      if (live && fell_clocked < 0 && fault && !clocked.out().gates_enable) fell_clocked = c;
    }
    if (k == 0) at_once = clocked;
    falls += fell >= 0 ? 1 : 0;
    REQUIRE(fell == fell_clocked);
    REQUIRE(same(at_once.out(), clocked.out()));
  }
  CHECK(falls >= 100);
}

TEST_CASE("supervisor: a tick at once at the very budget, which a negative current does not cool") {
  constexpr std::uint32_t start = Design::i2t_start;
  for (const std::uint32_t nominal : {0u, 1u << 31, 0xffffffffu, 1u}) {
    for (const std::uint32_t budget : {start - 1, start, start + 1}) {
      Twin twin;
      Twin::Words words;
      words.nominal_current_squared = nominal;
      words.i2t_budget = 0xffffffffu;
      for (int k = 0; k < 5; ++k) twin.tick(words, {});
      const std::uint32_t heat = nominal == 1 ? start - 5 : start;
      words.i2t_budget = budget;
      const bool hot = heat >= budget;
      REQUIRE(twin.near_trip(words) == hot);
      twin.tick(words, {});
      REQUIRE((twin.out().faults == feltgate::fault_bit(feltgate::Fault::i2t)) == hot);
    }
  }
}

namespace {

struct Kicked : Design {
  static constexpr int require_watchdog = 1;
};

/// Returns whether the gates are open after ten ticks with a watchdog of two ticks. The motor is
/// armed after one tick, with or without a kick before.
template <class D>
bool open_after_ten(bool kicked) {
  feltgate::Supervisor<D> twin;
  typename feltgate::Supervisor<D>::Words words;
  words.overspeed = words.polarity_speed = words.polarity_current = 0x7fffffff;
  words.i2t_budget = 0xffffffffu;
  words.watchdog_ticks = 2;
  typename feltgate::Supervisor<D>::In idle;
  for (int k = 0; k < 6; ++k) twin.clock(idle);
  for (int k = 0; k < 10; ++k) {
    typename feltgate::Supervisor<D>::Tick tick;
    tick.arm = k > 0;
    tick.kick = kicked && k == 0;
    twin.tick(words, tick);
    const bool waits = D::require_watchdog != 0 && !kicked;
    REQUIRE(twin.out().unkicked == waits);
    if (k == 1) REQUIRE(twin.out().gates_enable == !waits);
  }
  return twin.out().gates_enable;
}

}  // namespace

TEST_CASE("supervisor: the watchdog sleeps until a kick, for which a design may wait") {
  CHECK(open_after_ten<Design>(false));
  CHECK_FALSE(open_after_ten<Design>(true));
  CHECK_FALSE(open_after_ten<Kicked>(false));
  CHECK_FALSE(open_after_ten<Kicked>(true));
}

TEST_CASE("supervisor: no watchdog waits longer than its counter does") {
  const auto lasts = [](std::uint32_t limit) {
    Twin twin;
    Twin::Words words;
    words.overspeed = words.polarity_speed = words.polarity_current = 0x7fffffff;
    words.i2t_budget = 0xffffffffu;
    words.watchdog_ticks = limit;
    for (int k = 0; k < 6; ++k) twin.clock({});
    Twin::Tick tick;
    tick.kick = true;
    twin.tick(words, tick);
    tick.kick = false;
    tick.arm = true;
    std::int64_t ticks = 0;
    while (twin.tick(words, tick) < 0 && ticks < std::int64_t{1} << 26) ++ticks;
    return ticks;
  };
  const std::int64_t more = lasts(100) - 100,
                     longest = std::int64_t{1} << feltgate::Map::kickless_bits;
  CHECK(lasts(7) == 7 + more);
  CHECK(lasts((1u << feltgate::Map::kickless_bits) - 1) == longest - 1 + more);
  CHECK(lasts(1u << feltgate::Map::kickless_bits) == longest + more);
  CHECK(lasts(0x7fffffff) == longest + more);
}

TEMPLATE_TEST_CASE("supervisor: the estimate against real arithmetic", "", feltgate::Lever,
                   feltgate::Paper) {
  using D = TestType;
  using Exact = feltgate::SupervisorLaw<feltgate::Real<long double>, D>;
  using Law = feltgate::SupervisorLaw<feltgate::Fixed, D>;
  using V = feltgate::fixed_of<D::f.voltage.key()>;
  using W = feltgate::fixed_of<D::f.velocity.key()>;
  using Pv = feltgate::fixed_of<D::P::inverse_resistance.key()>;
  using Pw = feltgate::fixed_of<D::P::emf_over_resistance.key()>;
  using Real = long double;
  Random random(6);
  for (std::int64_t k = 0; k < scaled_clocks(100000); ++k) {
    const auto v = V::from_raw(random.between(V::min_raw(), V::max_raw()));
    const auto w = W::from_raw(random.between(W::min_raw() / 2, W::max_raw() / 2));
    const auto pv = Pv::from_raw(random.between(0, Pv::max_raw()));
    const auto pw = Pw::from_raw(random.between(0, Pw::max_raw()));
    const auto got = Law::current_estimate(v * pv, w * pw);
    const Real exact = Exact::current_estimate(Real(v.to_double()) * Real(pv.to_double()),
                                               Real(w.to_double()) * Real(pw.to_double()));
    REQUIRE(std::fabs(Real(got.to_double()) - exact) < std::ldexp(Real(1), -8));
  }
}
