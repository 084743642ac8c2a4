// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// supervisor: the twin alone. A tick at once against its clocks, the estimate of the current
// against real arithmetic. Documentation: docs/blocks/supervisor.md
#include <cmath>

#include "catch.hpp"
#include "feltgate/generated/paper.hpp"
#include "random_scenario.hpp"

using namespace feltgate::test;

TEST_CASE("supervisor: a tick at once is its clocks one by one") {
  Twin clocked, at_once;
  Clock clock;
  Bus bus(1);
  RandomScenario scenarios(4);
  Scenario now;
  std::int64_t falls = 0;
  for (int k = 0; k < 60000; ++k) {
    const Scenario before = now;
    now = scenarios.next();
    Twin::Tick tick;
    tick.voltage_before = before.voltage;
    tick.velocity_before = before.velocity;
    tick.current_ref = before.current_ref;
    tick.velocity = now.velocity;
    tick.arm = now.arm;
    tick.clear_faults = now.clear_faults;
    tick.kick = now.kick;
    int fell = -1;
    if (k > 0) {  // in the first the synchroniser settles
      REQUIRE(at_once.steady(false));
      fell = at_once.tick(now.words, tick);
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
  for (int k = 0; k < 100000; ++k) {
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
