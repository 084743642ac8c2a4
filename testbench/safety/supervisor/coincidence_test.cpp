// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// supervisor: two events in one clock, and the largest limit of the watchdog.
// Documentation: docs/blocks/supervisor.md
#include <set>
#include <utility>

#include "bench.hpp"
#include "catch.hpp"

using namespace feltgate::test;
using feltgate::Fault;

namespace {

constexpr int kForgiveTicks = 1 << feltgate::Map::forgive_bits;

/// Arms and prepares the fault `fixed`, which trips at its fixed clock of this or a later tick.
/// Returns that clock.
int provoke(Script& s, Fault fixed) {
  const auto design = Scenario::design_words();
  switch (fixed) {
    case Fault::speed:
      s.arm();
      s.now.velocity = static_cast<std::int32_t>(design.overspeed) + 1;
      return Twin::speed_clock;
    case Fault::i2t:
      s.arm();
      s.now.words.i2t_budget = 0;
      return Twin::heat_clock;
    case Fault::polarity:
      s.now.words.polarity_ticks = 1;
      s.now.words.polarity_speed = 0;
      s.now.velocity = 0;
      s.now.current_ref = -static_cast<std::int32_t>(design.polarity_current) - 1;
      s.arm().ticks(2);
      for (int k = 1; k <= 2; ++k) {  // a window is one tick
        s.now.velocity = k << Design::f.velocity.fraction;
        if (k == 1) s.ticks(1);
      }
      return Twin::polarity_clock;
    default:
      s.now.words.watchdog_ticks = 3;
      s.now.kick = true;
      s.arm();
      s.now.kick = false;
      s.ticks(3);
      return Twin::watchdog_clock;
  }
}

/// Makes the fault `free` visible in clock c of the running tick, which is at clock 0.
void join(Script& s, Fault free, int c) {
  const auto to = [&s](int clock) {
    if (clock > s.clock_of_tick()) s.until(clock);
  };
  switch (free) {
    case Fault::encoder:
      s.errors(feltgate::Map::errors_borne);
      to(c);
      s.errors(1);
      return;
    case Fault::stop:
      to(c - 2);
      s.now.stop = true;
      s.clocks(1);
      s.now.stop = false;
      s.clocks(2);
      return;
    case Fault::tick:
      // More PWM periods begin than one tick can contain.
      s.now.period_start = true;
      s.clocks((kTick + Design::pwm_period - 1) / Design::pwm_period);
      s.now.period_start = false;
      to(c);
      s.now.period_start = true;
      s.clocks(1);
      s.now.period_start = false;
      return;
    default:
      to(c);
      s.now.trips = static_cast<std::uint16_t>(fault_bit(free));
      s.clocks(1);
      s.now.trips = 0;
      return;
  }
}

}  // namespace

TEST_CASE("supervisor: two causes in one clock are both latched, the lower is the first") {
  std::set<std::pair<Fault, Fault>> reached;
  for (const Fault fixed : {Fault::speed, Fault::i2t, Fault::polarity, Fault::watchdog}) {
    for (const Fault free : {Fault::encoder, Fault::stop, Fault::tick, Fault::current}) {
      CAPTURE(static_cast<int>(fixed), static_cast<int>(free));
      Script s;
      const int clock = provoke(s, fixed);
      REQUIRE(s.out().gates_enable);
      Script alone = s;
      alone.until(clock);
      REQUIRE(alone.out().faults == 0);
      alone.clocks(1);
      REQUIRE(only(alone, fixed));  // and it trips in this clock
      join(s, free, clock);
      REQUIRE(s.clock_of_tick() == (clock + 1) % kTick);
      REQUIRE(s.out().faults == (fault_bit(fixed) | fault_bit(free)));
      const Fault first = fixed < free ? fixed : free;
      REQUIRE(s.out().first_fault == static_cast<unsigned>(first));
      REQUIRE_FALSE(s.out().gates_enable);
      reached.insert({fixed, free});
      s.play();
    }
  }
  REQUIRE(reached.size() == 16);
}

TEST_CASE("supervisor: another cause in the clock of the clear is then the first") {
  Script s;
  s.arm();
  s.now.velocity = std::numeric_limits<std::int32_t>::max();
  s.ticks(1);
  REQUIRE(only(s, Fault::speed));
  s.now.velocity = 0;
  s.now.arm = false;
  s.ticks(2);
  s.now.clear_faults = true;
  s.until(kTick - 1);
  REQUIRE(only(s, Fault::speed));
  s.now.trips = static_cast<std::uint16_t>(fault_bit(Fault::current));
  s.clocks(1);
  s.now.trips = 0;
  s.now.clear_faults = false;
  REQUIRE(only(s, Fault::current));
  s.arm();  // arming is refused while a fault is latched
  REQUIRE_FALSE(s.out().armed);
  s.clear();
  s.arm();
  REQUIRE(s.out().armed);
  s.play();
}

TEST_CASE(
    "supervisor: an encoder error in the clock that forgives one counts, and none is forgiven") {
  for (const int before : {0, 1, 6, 7}) {
    Script s;
    s.arm();
    s.errors(before);
    s.until(0).ticks(kForgiveTicks - 5).clocks(kTick - 1);  // five of these ticks have passed
    s.errors(1);  // in the last clock of the tick that removes an error
    CAPTURE(before);
    REQUIRE(s.out().faults == (before == 7 ? fault_bit(Fault::encoder) : 0));
    if (before == 7) s.clear().arm();  // starts again at 0 errors
    s.errors(before == 7 ? 7 : 6 - before);
    REQUIRE(s.out().gates_enable);
    s.errors(1);
    REQUIRE(only(s, Fault::encoder));
    s.play();
  }
}

TEST_CASE(
    "supervisor: causes of any clock beside a fault, in the clock of a clear, and as it arms") {
  for (const Fault cause : {Fault::encoder, Fault::stop, Fault::tick, Fault::word}) {
    CAPTURE(static_cast<int>(cause));
    Script s;
    const auto trip = [&s, cause] {
      s.now.trips = static_cast<std::uint16_t>(fault_bit(cause));
      s.clocks(1);
      s.now.trips = 0;
    };
    s.arm();
    s.now.velocity = std::numeric_limits<std::int32_t>::max();
    s.ticks(1);
    REQUIRE(only(s, Fault::speed));
    s.now.velocity = 0;
    s.now.arm = false;
    s.ticks(2);
    trip();
    REQUIRE(s.out().faults == (fault_bit(Fault::speed) | fault_bit(cause)));
    REQUIRE(s.out().first_fault == static_cast<unsigned>(Fault::speed));
    s.now.clear_faults = true;
    s.until(kTick - 1);
    trip();
    s.now.clear_faults = false;
    REQUIRE(only(s, cause));
    s.clear();
    REQUIRE(s.out().faults == 0);
    s.now.arm = true;
    s.until(kTick - 1);
    trip();
    REQUIRE(only(s, cause));
    REQUIRE_FALSE(s.out().armed);
    REQUIRE_FALSE(s.out().gates_enable);
    s.clear().arm();
    REQUIRE(s.out().gates_enable);
    s.play();
  }
}
