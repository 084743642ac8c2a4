// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A design that requires the watchdog arms only after a kick. The whole core, RTL against twin.
// Documentation: docs/blocks/safety.md
#include "core_script.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using D = Design;
using C = D::C;
using Script = CoreScript;

bool unkicked(Script& s) { return (s.status() >> C::status_unkicked & 1U) != 0; }

}  // namespace

TEST_CASE("watchdog: no motor is armed before the first kick, and the status says why") {
  for (const bool pin : {false, true}) {
    Script s;
    s.ticks(3);
    REQUIRE(unkicked(s));
    const auto ask = [&](bool arm) {
      if (pin) s.in.arm = arm;
      if (!pin) s.control(D::S::free, arm);
      s.ticks(3);
    };
    for (int k = 0; k < 3; ++k) {
      ask(false);
      ask(true);
      REQUIRE_FALSE(s.out().armed);
      REQUIRE(s.out().first_fault == 0);
    }
    // A kick lets the next rising request arm; a request that is already high does not arm.
    s.command(C::command_kick).ticks(4);
    REQUIRE_FALSE(unkicked(s));
    REQUIRE_FALSE(s.out().armed);
    ask(false);
    ask(true);
    REQUIRE(s.out().armed);
    ask(false);
    ask(true);
    REQUIRE(s.out().armed);
    s.play();
  }
}

TEST_CASE("watchdog: other commands are no kick; it trips from the first one on") {
  Script s;
  for (const int bit :
       {C::command_set_zero, C::command_clear_faults, C::command_freeze, C::command_thaw}) {
    s.command(bit).ticks(2);
    s.control(D::S::free, false).ticks(1);
    s.control(D::S::free, true).ticks(2);
    REQUIRE_FALSE(s.out().armed);
  }
  s.write(D::A::watchdog_ticks, 50);
  s.control(D::S::free, false).command(C::command_kick);
  s.control(D::S::free, true).ticks(2);
  REQUIRE(s.out().armed);
  s.ticks(60);
  REQUIRE_FALSE(s.out().armed);
  REQUIRE(s.out().first_fault == static_cast<int>(Fault::watchdog));
  s.play();
}
