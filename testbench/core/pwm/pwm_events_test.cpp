// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Compares the twin of the PWM run from event to event, alone and inside the core's twin, with the
// twin run clock by clock. Documentation: docs/blocks/pwm.md
#include <algorithm>
#include <array>

#include "catch.hpp"
#include "feltgate/core_gates.hpp"
#include "random.hpp"

namespace {

using namespace feltgate;
using namespace feltgate::test;

Pwm::In any_input(Random* random, int period) {
  Pwm::In in;
  in.enable = !random->one_in(5);
  in.clear = random->one_in(12);
  in.mode = random->one_in(2);
  in.polarity = random->one_in(2);
  in.duty = static_cast<std::int16_t>(random->between(-period - 3, period + 3));
  if (random->one_in(6)) in.duty = 0;
  return in;
}

std::uint8_t bits_of(const Pwm::Out& g) {
  return static_cast<std::uint8_t>((g.gate_a_hi ? 1 : 0) + (g.gate_a_lo ? 2 : 0) +
                                   (g.gate_b_hi ? 4 : 0) + (g.gate_b_lo ? 8 : 0));
}

/// Runs clock by clock and collects the same data as CoreGates.
struct Clocked {
  Pwm pwm;
  GateCounts on{};  ///< those of a third leg stay 0

  Clocked(int period, int dead) : pwm(period, dead) {}
  void clock(const Pwm::In& in) {
    pwm.clock(in);
    for (std::size_t g = 0; g < on.size(); ++g) on[g] += (bits_of(pwm.out()) >> g) & 1;
  }
  void reset() {
    pwm.reset();
    on = {};
  }
};

bool same(const CoreGates& gates, const Clocked& clocked) {
  return gates.bits() == bits_of(clocked.pwm.out()) &&
         gates.duty_active() == clocked.pwm.out().duty_active && gates.on_clocks() == clocked.on &&
         gates.clocks_to_duty() == clocked.pwm.clocks_to_duty();
}

struct Size {
  int period, dead;
};
constexpr std::array<Size, 4> sizes{{{4, 1}, {24, 3}, {60, 25}, {1000, 25}}};

}  // namespace

TEST_CASE("gates of the core: from event to event as clock by clock") {
  for (const Size& size : sizes) {
    Random random(static_cast<std::uint64_t>(size.period));
    CoreGates gates(size.period, size.dead);
    Clocked clocked(size.period, size.dead);
    std::int64_t passed = 0, clocks = 0;
    for (int stretch = 0; stretch < 4000; ++stretch) {
      const Pwm::In in = any_input(&random, size.period);
      std::int64_t left = random.between(1, random.one_in(3) ? 4 : 3 * size.period);
      clocks += left;
      while (left > 0) {
        const int piece = static_cast<int>(
            std::min(left, random.between(1, random.coin() ? 6 : 2 * size.period)));
        const bool quiet = !in.clear && gates.quiet_for(piece, in.enable);
        const std::uint8_t before = gates.bits();
        if (quiet && random.one_in(2)) {
          gates.pass(piece);
          passed += piece;
        } else {
          gates.advance(in, piece);
        }
        for (int k = 0; k < piece; ++k) {
          clocked.clock(in);
          if (quiet && bits_of(clocked.pwm.out()) != before) FAIL("not as quiet as it said");
        }
        if (!same(gates, clocked)) FAIL("period " << size.period << ", stretch " << stretch);
        left -= piece;
      }
      if (random.one_in(500)) {
        gates.reset();
        clocked.reset();
        if (!same(gates, clocked)) FAIL("reset in stretch " << stretch);
      }
    }
    INFO("period " << size.period << ": " << passed << " of " << clocks);
    // Most pieces are longer than a stretch without an edge; in a period of 4 all are.
    CHECK((passed > clocks / 60 || size.period < 24));
  }
}

TEST_CASE("gates of the core: nothing is said to be quiet before the first clock") {
  const CoreGates gates(1000, 25);
  CHECK_FALSE(gates.quiet_for(1, false));
  CHECK(gates.quiet_for(0, false));
  CHECK(gates.clocks_to_duty() == Pwm(1000, 25).clocks_to_duty());
  CHECK(gates.bits() == 0);
  CHECK(gates.on_clocks() == GateCounts{});
}

TEST_CASE("pwm: a skip is as many clocks, and no output changes on the way") {
  for (const Size& size : sizes) {
    Random random(static_cast<std::uint64_t>(size.period) + 1);
    Pwm pwm(size.period, size.dead), shadow(size.period, size.dead);
    for (int stretch = 0; stretch < 3000; ++stretch) {
      const Pwm::In in = any_input(&random, size.period);
      for (std::int64_t left = random.between(1, 2 * size.period); left > 0; --left) {
        const int quiet = pwm.quiet_clocks(in);
        if (quiet < 0) FAIL("quiet for " << quiet << " in stretch " << stretch);
        if (quiet > 0) {
          const auto skipped = static_cast<int>(random.between(1, quiet));
          Pwm::Out out = shadow.out();
          for (int k = 0; k < skipped; ++k) {
            shadow.clock(in);
            if (!(shadow.out() == out)) FAIL("not quiet in stretch " << stretch);
          }
          pwm.skip(skipped);
        } else {
          pwm.clock(in);
          shadow.clock(in);
        }
        if (!(pwm.out() == shadow.out()) || pwm.clocks_to_duty() != shadow.clocks_to_duty()) {
          FAIL("period " << size.period << ", stretch " << stretch);
        }
      }
    }
  }
}

TEST_CASE("pwm: a steady period has few clocks that are not skipped") {
  for (const bool antiphase : {false, true}) {
    for (const int duty : {-600, -1, 0, 1, 300, 999, 1000}) {
      Pwm::In in;
      in.enable = true;
      in.mode = antiphase;
      in.duty = static_cast<std::int16_t>(duty);
      Pwm pwm(1000, 25);
      for (int k = 0; k < 5000; ++k) pwm.clock(in);
      int steps = 0;
      for (int left = 1000; left > 0;) {
        const int quiet = std::min(left, pwm.quiet_clocks(in));
        if (quiet > 0) {
          pwm.skip(quiet);
        } else {
          pwm.clock(in);
          ++steps;
        }
        left -= std::max(quiet, 1);
      }
      INFO(duty << (antiphase ? " antiphase" : ""));
      CHECK(steps <= 12);
    }
  }
  // When disabled, the twin also skips to the end of the period.
  Pwm::In off;
  Pwm pwm(1000, 25);
  for (int k = 0; k < 1500; ++k) pwm.clock(off);
  CHECK(pwm.quiet_clocks(off) > 400);
}

TEST_CASE("pwm: the duty is taken after as many clocks as it says") {
  for (const Size& size : sizes) {
    Pwm pwm(size.period, size.dead);
    const Pwm::In in;
    int left = pwm.clocks_to_duty();
    for (int k = 0; k < 3 * size.period; ++k) {
      pwm.clock(in);
      if (pwm.out().period_start != (left == 0)) FAIL("period " << size.period << ", clock " << k);
      left = left == 0 ? size.period - 1 : left - 1;
      if (pwm.clocks_to_duty() != left) FAIL("period " << size.period << ", after clock " << k);
    }
  }
}

TEST_CASE("pwm: from reset on, a duty of 0 drives both legs alike") {
  for (const Size& size : sizes) {
    Pwm pwm(size.period, size.dead);
    Pwm::In in;
    in.enable = true;
    int low = 0;
    for (int k = 0; k < 3 * size.period + 64; ++k) {
      pwm.clock(in);
      const Pwm::Out& out = pwm.out();
      if (out.gate_a_hi || out.gate_b_hi || out.gate_a_lo != out.gate_b_lo) FAIL("clock " << k);
      low += out.gate_a_lo ? 1 : 0;
    }
    CHECK(low > 0);
  }
}

TEST_CASE("pwm: the default is a period of 1000 and 25 dead clocks") {
  Pwm as_it_is, said(1000, 25);
  Pwm::In in;
  in.enable = true;
  in.duty = 300;
  for (int k = 0; k < 3000; ++k) {
    as_it_is.clock(in);
    said.clock(in);
    if (!(as_it_is.out() == said.out())) FAIL("clock " << k);
  }
}

TEST_CASE("pwm: inputs and outputs are equal when every member is") {
  const Pwm::In in{true, false, true, false, 7};
  CHECK(in == Pwm::In{true, false, true, false, 7});
  CHECK_FALSE(in == Pwm::In{false, false, true, false, 7});
  CHECK_FALSE(in == Pwm::In{true, true, true, false, 7});
  CHECK_FALSE(in == Pwm::In{true, false, false, false, 7});
  CHECK_FALSE(in == Pwm::In{true, false, true, true, 7});
  CHECK_FALSE(in == Pwm::In{true, false, true, false, 8});
  CHECK_FALSE(in == Pwm::In{false, true, false, true, 7});
  const Pwm::Out out{true, false, true, false, true, 7};
  CHECK(out == Pwm::Out{true, false, true, false, true, 7});
  CHECK_FALSE(out == Pwm::Out{false, false, true, false, true, 7});
  CHECK_FALSE(out == Pwm::Out{true, true, true, false, true, 7});
  CHECK_FALSE(out == Pwm::Out{true, false, false, false, true, 7});
  CHECK_FALSE(out == Pwm::Out{true, false, true, true, true, 7});
  CHECK_FALSE(out == Pwm::Out{true, false, true, false, false, 7});
  CHECK_FALSE(out == Pwm::Out{true, false, true, false, true, 8});
  CHECK_FALSE(out == Pwm::Out{false, true, false, true, false, 7});
}
