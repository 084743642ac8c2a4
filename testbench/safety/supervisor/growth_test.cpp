// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The check for a speed that grows against the command, tick by tick.
// Documentation: docs/blocks/supervisor.md
#include "feltgate/runaway.hpp"

#include "catch.hpp"
#include "feltgate/format.hpp"
#include "feltgate/generated/map.hpp"

namespace {

using namespace feltgate;

struct Formats {
  Format velocity;
};
/// A velocity of 21 bits; the check ignores the lowest 7 bits.
struct Design {
  static constexpr Formats f{{1, 8, Map::growth_bits + 7}};
};
using Check = Runaway<Design>;
constexpr std::int32_t kUnit = 128;  ///< smallest step of velocity that the check sees
constexpr std::uint32_t kTicks = 5, kGrowth = 3 * kUnit, kCurrent = 50;
constexpr std::uint32_t kNegative = 0xffffffff;
constexpr int kWindows = Map::runaway_windows;

/// A motor that drives a lever away: the velocity grows every tick, against the current.
struct Motion {
  Check check;
  std::int32_t velocity = 0, current = 100;
  bool live = true;

  /// Runs one tick as the supervisor's twin does.
  bool tick(std::int32_t step) {
    velocity += step;
    check.compare_growth(check.gain(velocity), velocity, kGrowth);
    check.compare_current(current, kCurrent);
    check.turn(velocity, current, kTicks, live);
    return check.due();
  }
  /// Number of ticks until the check trips; 0: not within `most` ticks.
  int due_after(std::int32_t step, int most = 200) {
    for (int k = 1; k <= most; ++k) {
      if (tick(step)) return k;
    }
    return 0;
  }
};

}  // namespace

TEST_CASE("runaway: a magnitude is over a limit, and everything over a negative one") {
  for (const std::int32_t x : {1, 2, 7}) {
    CHECK(Check::over(x, static_cast<std::uint32_t>(x - 1)));
    CHECK(Check::over(-x, static_cast<std::uint32_t>(x - 1)));
    CHECK_FALSE(Check::over(x, static_cast<std::uint32_t>(x)));
    CHECK_FALSE(Check::over(-x, static_cast<std::uint32_t>(x)));
  }
  CHECK_FALSE(Check::over(0, 0));
  CHECK(Check::over(0, kNegative));
  CHECK(Check::over(INT32_MIN, 0x7fffffff));
}

TEST_CASE("runaway: the gain since a window began, without low bits, wraps as the velocity does") {
  Check check;
  CHECK(check.gain(0) == 0);
  CHECK(check.gain(kUnit - 1) == 0);
  CHECK(check.gain(kUnit) == kUnit);
  CHECK(check.gain(-1) == -kUnit);
  check.turn(5 * kUnit + 3, 0, kTicks, false);  // a window begins
  CHECK(check.gain(5 * kUnit) == 0);
  CHECK(check.gain(9 * kUnit + 100) == 4 * kUnit);
  CHECK(check.gain(-kUnit) == -6 * kUnit);
  constexpr std::int32_t most = (1 << 20) - 1;
  check.turn(most, 0, kTicks, false);
  CHECK(check.gain(-most - 1) == kUnit);
}

TEST_CASE("runaway: due after as many windows of growth as are needed, at their ends") {
  const int windows = kWindows * static_cast<int>(kTicks);
  Motion up, down;
  up.current = -100;
  CHECK(up.due_after(kUnit) == windows);
  CHECK(down.due_after(-kUnit) == windows);
  Motion strong_enough;
  strong_enough.current = kCurrent + 1;
  CHECK(strong_enough.due_after(-kUnit) == windows);
  // The check is due again at the end of the next window.
  CHECK(up.due_after(kUnit) == static_cast<int>(kTicks));
}

TEST_CASE("runaway: never due along the current, at a weak one, at a lesser growth, or away") {
  Motion along, weak, slow, away, braking, still;
  along.current = 100;
  CHECK(along.due_after(kUnit) == 0);
  weak.current = kCurrent;
  CHECK(weak.due_after(-kUnit) == 0);
  // A growth equal to the limit does not trip.
  CHECK(slow.due_after(-3 * kUnit / 5) == 0);
  away.live = false;
  CHECK(away.due_after(-kUnit) == 0);
  braking.velocity = -200 * kUnit;
  braking.current = 100;
  CHECK(braking.due_after(kUnit, 190) == 0);
  still.velocity = -200 * kUnit;  // against the current, but no faster
  CHECK(still.due_after(0) == 0);
}

TEST_CASE("runaway: a window without growth, or a tick not against, begins anew") {
  const int windows = kWindows * static_cast<int>(kTicks);
  Motion m;
  for (int k = 1; k < windows; ++k) REQUIRE_FALSE(m.tick(-kUnit));
  SECTION("a tick along the current") {
    m.current = -100;
    CHECK_FALSE(m.tick(-kUnit));
    m.current = 100;
    CHECK(m.due_after(-kUnit) == windows);
  }
  SECTION("a tick away") {
    m.live = false;
    CHECK_FALSE(m.tick(-kUnit));
    m.live = true;
    CHECK(m.due_after(-kUnit) == windows);
  }
  SECTION("a window that does not grow") {
    CHECK_FALSE(m.tick(4 * kUnit));
    CHECK(m.due_after(-kUnit) == windows);
  }
  SECTION("not due while it is away, whatever came before") {
    CHECK(m.tick(-kUnit));
    m.live = false;
    CHECK_FALSE(m.tick(-kUnit));
  }
}

TEST_CASE("runaway: growth and velocity, velocity and current: 0 counts as upward") {
  const auto due = [](std::int32_t gained, std::int32_t velocity, std::int32_t current) {
    Check check;  // limits of -1: every value is over them; a window is one tick
    for (int k = 0; k < kWindows; ++k) {
      check.compare_growth(gained, velocity, kNegative);
      check.compare_current(current, kNegative);
      check.turn(velocity, current, 0, true);
    }
    return check.due();
  };
  for (const std::int32_t gained : {-2, -1, 0, 1}) {
    for (const std::int32_t velocity : {-2, -1, 0, 1}) {
      for (const std::int32_t current : {-2, -1, 0, 1}) {
        INFO(gained << " " << velocity << " " << current);
        const bool grows = (gained < 0) == (velocity < 0);
        CHECK(due(gained, velocity, current) == (grows && (velocity < 0) != (current < 0)));
      }
    }
  }
}

TEST_CASE("runaway: near where the next turn may be due") {
  Motion m;
  const int windows = kWindows * static_cast<int>(kTicks);
  int near = 0;
  for (int k = 1; k <= windows; ++k) {
    const bool said = m.check.near(kTicks);
    near += said ? 1 : 0;
    CHECK(said == (k == windows));
    CHECK(m.tick(-kUnit) == (k == windows));
  }
  CHECK(near == 1);
  CHECK_FALSE(m.check.near(kTicks));
  CHECK_FALSE(Check{}.near(1));
}

TEST_CASE("runaway: before the first tick nothing is due, has grown or is strong") {
  Check check;
  CHECK_FALSE(check.due());
  CHECK(check.gain(0) == 0);
  for (int k = 0; k < kWindows; ++k) check.turn(-1, 1, 0, true);  // nothing was compared
  CHECK_FALSE(check.due());
  Check grown;
  for (int k = 0; k < kWindows; ++k) {
    grown.compare_growth(-1, -1, kNegative);
    grown.turn(-1, 1, 0, true);
  }
  CHECK_FALSE(grown.due());
  Check strong;
  for (int k = 0; k < kWindows; ++k) {
    strong.compare_current(1, kNegative);
    strong.turn(-1, 1, 0, true);
  }
  CHECK_FALSE(strong.due());
}

TEST_CASE("runaway: no window is longer than the counter's end") {
  constexpr std::uint32_t longest = std::uint32_t{1} << Map::runaway_bits;
  Check check;
  bool wrong = false;
  for (int window = 0; window < kWindows; ++window) {
    for (std::uint32_t k = 1; k <= longest; ++k) {
      check.compare_growth(-1, -1, kNegative);
      check.compare_current(1, kNegative);
      const bool last = window == kWindows - 1 && k == longest;
      wrong = wrong || check.near(0xffffffff) != last;
      check.turn(-1, 1, 0xffffffff, true);
      wrong = wrong || check.due() != last;
    }
  }
  CHECK_FALSE(wrong);
  CHECK(check.due());
}
