// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// supervisor: a speed that grows against the commanded current, cause 3.
// Documentation: docs/blocks/supervisor.md

#include <algorithm>
#include <array>

#include "bench.hpp"
#include "catch.hpp"

using namespace feltgate::test;
using feltgate::Fault;
using feltgate::Map;

TEST_CASE("supervisor: the speed grows against the commanded current, window after window") {
  Script s;
  s.now.words.polarity_ticks = 12;
  constexpr std::int32_t base = 3 * kRadS;
  constexpr std::int32_t bit_of_growth =
      1 << std::max(Design::f.velocity.fraction - Map::growth_bits, 0);
  const auto most = static_cast<std::int32_t>(s.now.words.polarity_speed);
  const auto current = static_cast<std::int32_t>(s.now.words.polarity_current);
  const std::int32_t enough = most + bit_of_growth;
  s.arm();
  for (const int sign : {1, -1}) {
    const auto set = [&](std::int32_t w, std::int32_t i) {
      s.now.velocity = sign * w;
      s.now.current_ref = -sign * i;
    };
    // Two windows, from a tick without current on; the last of their ticks is left out. A current
    // is seen in the tick after.
    const auto windows = [&](std::int32_t first, std::int32_t second, std::int32_t i) {
      set(base, 0);
      s.ticks(2);
      set(base, i);
      s.ticks(1);
      set(base + first, i);
      s.ticks(12);
      set(base + first + second, i);
      s.ticks(11);
    };
    for (const auto& [first, second, i] :
         {std::array{most, enough, current + 1}, std::array{enough, most, current + 1},
          std::array{enough, enough, current}, std::array{-enough, -enough, current + 1},
          std::array{enough, -enough, current + 1}, std::array{enough, enough, -2 * current}}) {
      windows(first, second, i);
      s.ticks(1);
      REQUIRE(s.out().gates_enable);
    }
    // After a gap of one tick the windows count from the first again.
    windows(enough, 0, current + 1);
    s.now.current_ref = 0;
    s.ticks(1);
    set(base, 0);
    s.ticks(1);
    windows(enough, 0, current + 1);
    set(base + enough, 0);
    s.ticks(1);
    set(base + enough, current + 1);
    s.ticks(1);
    set(base + 2 * enough, current + 1);
    s.ticks(12);
    REQUIRE(s.out().gates_enable);
    windows(enough, enough, current + 1);
    REQUIRE(s.clocks_to_fall(20 * kTick) == kPolarity);
    REQUIRE(only(s, Fault::polarity));
    s.clear();
    windows(enough, enough, current + 1);  // windows do not count while disarmed
    s.ticks(30);
    REQUIRE(s.out().faults == 0);
    s.arm();
  }
  s.play();
}

TEST_CASE("supervisor: a window has all its ticks, a hundred or thousands") {
  for (const std::uint32_t ticks : {70u, 300u, 2500u}) {
    Script s;
    s.now.words.polarity_ticks = ticks;
    const auto enough = static_cast<std::int32_t>(s.now.words.polarity_speed) + kRadS;
    const auto current = static_cast<std::int32_t>(s.now.words.polarity_current) + 1;
    s.arm();
    s.now.velocity = 3 * kRadS;
    s.ticks(2);
    s.now.current_ref = -current;
    s.ticks(1);
    s.now.velocity += enough;
    s.ticks(static_cast<int>(ticks));
    s.now.velocity += enough;
    s.ticks(static_cast<int>(ticks) - 1);
    INFO(ticks << " ticks");
    REQUIRE(s.out().gates_enable);
    REQUIRE(s.clocks_to_fall(20 * kTick) == kPolarity);
    REQUIRE(only(s, Fault::polarity));
    s.play();
  }
}

TEST_CASE("supervisor: a speed that stays or falls is no wrong polarity, whatever it is") {
  Script s;
  s.now.words.polarity_ticks = 3;
  s.now.current_ref = -10 * kAmpere;
  s.now.velocity = 600 * kRadS;
  s.arm().ticks(100);
  for (int k = 0; k < 59; ++k) {
    s.now.velocity -= 10 * kRadS;
    s.ticks(1);
  }
  REQUIRE(s.out().gates_enable);
  REQUIRE(s.out().faults == 0);
  s.play();
}
