// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// pwm: RTL against twin on every clock, on-times against the closed form, and the bridge guarded.
// Documentation: docs/blocks/pwm.md
#include <cstdlib>
#include <vector>

#include "adapter.hpp"
#include "catch.hpp"

using feltgate::Pwm;
using namespace feltgate::test;

namespace {

constexpr int kPeriod = PWM_PERIOD;
constexpr int kDead = PWM_DEAD;
// Every duty of a short period; of a long one the ends, the dead time, odd and even.
std::vector<int> duties() {
  std::vector<int> list;
  for (int d = -kPeriod - 8; d <= kPeriod + 8; ++d) {
    const int m = std::abs(d);
    if (kPeriod < 100 || m < 3 || std::abs(m - kDead) < 3 || m > kPeriod - 3 ||
        std::abs(m + kDead - kPeriod) < 3 || d % 131 == 0) {
      list.push_back(d);
    }
  }
  list.push_back(-4096);
  list.push_back(4095);
  return list;
}

Pwm::In steady(bool mode, bool polarity, int duty) {
  Pwm::In in;
  in.enable = true;
  in.mode = mode;
  in.polarity = polarity;
  in.duty = static_cast<std::int16_t>(duty);
  return in;
}

/// Gates of leg A and B, recorded from the RTL in each clock after the reset.
struct Gates {
  std::vector<bool> a_hi, a_lo, b_hi, b_lo;
  static int count(const std::vector<bool>& gate, int from, int length) {
    int n = 0;
    for (int k = from; k < from + length; ++k) n += gate[static_cast<std::size_t>(k)] ? 1 : 0;
    return n;
  }
};

template <class Stimulus>
Gates record(const Stimulus& stimulus, std::int64_t clocks) {
  Gates gates;
  const auto watch = [&gates](const Pwm::In&, const Vpwm& rtl, const Pwm&, bool in_reset) {
    const char* fine = nullptr;
    if (in_reset) return fine;
    gates.a_hi.push_back(rtl.gate_a_hi_o != 0);
    gates.a_lo.push_back(rtl.gate_a_lo_o != 0);
    gates.b_hi.push_back(rtl.gate_b_hi_o != 0);
    gates.b_lo.push_back(rtl.gate_b_lo_o != 0);
    return fine;
  };
  PwmBench bench("pwm", 1, Pwm(kPeriod, kDead));
  bench.run(stimulus, clocks + PwmBench::kFirstReset, {}, watch);
  return gates;
}

}  // namespace

TEST_CASE("pwm: on-times are exact for every duty, mode and polarity") {
  for (const bool mode : {false, true}) {
    for (const bool polarity : {false, true}) {
      for (const int duty : duties()) {
        const Pwm::In in = steady(mode, polarity, duty);
        const Gates gates = record([in](std::int64_t) { return in; }, 3 * kPeriod);
        const int from = 2 * kPeriod;
        CAPTURE(mode, polarity, duty);
        // Written out from the definition, apart from the twin.
        const int d = std::min(kPeriod, std::max(-kPeriod, polarity ? -duty : duty));
        const int a = mode ? (kPeriod + d - (d & 1)) / 2 : std::max(d, 0);
        const int b = mode ? kPeriod - a : std::max(-d, 0);
        const auto on = [](int share) {
          return share == kPeriod ? kPeriod : std::max(0, share - kDead);
        };
        REQUIRE(Gates::count(gates.a_hi, from, kPeriod) == on(a));
        REQUIRE(Gates::count(gates.a_lo, from, kPeriod) == on(kPeriod - a));
        REQUIRE(Gates::count(gates.b_hi, from, kPeriod) == on(b));
        REQUIRE(Gates::count(gates.b_lo, from, kPeriod) == on(kPeriod - b));
        const Pwm::OnTimes form = Pwm(kPeriod, kDead).on_times(in);
        REQUIRE(form.a_hi == on(a));
        REQUIRE(form.a_lo == on(kPeriod - a));
        REQUIRE(form.b_hi == on(b));
        REQUIRE(form.b_lo == on(kPeriod - b));
      }
    }
  }
}

TEST_CASE("pwm: pulses are centred in the period to half a clock") {
  for (int duty = kDead + 1; duty < kPeriod; duty += kPeriod < 100 ? 1 : 97) {
    const Pwm::In in = steady(false, false, duty);
    const Gates gates = record([in](std::int64_t) { return in; }, 4 * kPeriod);
    const int from = 2 * kPeriod + 3;  // where the gates' period begins
    int first = 0;
    while (!gates.a_hi[static_cast<std::size_t>(from + first)]) ++first;
    const int last = first + Gates::count(gates.a_hi, from, kPeriod) - 1;
    // The dead time is taken from the front: without it first + last would be Period - 1 or Period.
    const int sum = first - kDead + last;
    CAPTURE(duty, first, last);
    REQUIRE((sum == kPeriod - 1 || sum == kPeriod));
    REQUIRE((sum - kPeriod) == (duty % 2 != 0 ? 0 : -1));
  }
}

TEST_CASE("pwm: a new duty waits for the period boundary") {
  const int before = kPeriod / 2 + 1;
  const int after = kPeriod / 4 + 2;
  for (int clock = 0; clock < kPeriod; clock += kPeriod < 100 ? 1 : 49) {
    const auto stimulus = [=](std::int64_t c) {
      return steady(false, false, c - PwmBench::kFirstReset <= kPeriod + clock ? before : after);
    };
    const Gates gates = record(stimulus, 5 * kPeriod);
    const int from = kPeriod + 3;
    CAPTURE(clock);
    REQUIRE(Gates::count(gates.a_hi, from, kPeriod) == before - kDead);
    REQUIRE(Gates::count(gates.a_hi, from + kPeriod, kPeriod) == after - kDead);
  }
}

TEST_CASE("pwm: everything at random, no shoot-through, dead time kept") {
  struct Chaos {
    Random random;
    Pwm::In in;
    std::uint32_t calm;
    Pwm::In operator()(std::int64_t) {
      if (random.one_in(in.enable ? calm : 5)) in.enable = !in.enable;
      if (random.one_in(calm)) in.mode = !in.mode;
      if (random.one_in(calm)) in.polarity = !in.polarity;
      if (random.one_in(kPeriod / 3)) {
        const int span = random.one_in(8) ? 4095 : kPeriod;
        in.duty = static_cast<std::int16_t>(random.between(-span, span));
      }
      return in;
    }
  };
  std::uint64_t seed = 20;
  for (const int calm : {2 * kDead, 3 * kPeriod, 40 * kPeriod}) {
    BridgeGuard::Totals totals;
    const auto watch = [guard = BridgeGuard(kDead), &totals](const Pwm::In& in, const Vpwm& rtl,
                                                             const Pwm&, bool in_reset) mutable {
      const char* broken = guard(in, rtl, in_reset);
      totals = guard.totals;
      return broken;
    };
    PwmBench bench("pwm", ++seed, Pwm(kPeriod, kDead));
    bench.run(Chaos{Random(seed), {}, static_cast<std::uint32_t>(calm)}, scaled_clocks(4'000'000),
              ResetPlan{20'000}, watch);
    REQUIRE(totals.turn_ons > 2000);
    REQUIRE(totals.disables > 30);
    REQUIRE(totals.duties > 1000);
  }
}

TEST_CASE("pwm: the twin skips quiet clocks with the same result") {
  Random random(9);
  Pwm every(kPeriod, kDead);
  Pwm skipping(kPeriod, kDead);
  Pwm::In in;
  std::int64_t skipped = 0;
  std::int64_t total = 0;
  for (int change = 0; change < 20'000; ++change) {
    if (random.one_in(6)) in.enable = !in.enable;
    if (random.one_in(6)) in.mode = !in.mode;
    if (random.one_in(6)) in.polarity = !in.polarity;
    in.duty = static_cast<std::int16_t>(random.between(-kPeriod, kPeriod));
    int left = 1 + static_cast<int>(random.below(2 * kPeriod));
    total += left;
    while (left > 0) {
      const int quiet = std::min(left, skipping.quiet_clocks(in));
      skipping.skip(quiet);
      for (int k = 0; k < quiet; ++k) {
        every.clock(in);
        if (!(every.out() == skipping.out())) FAIL("an output changed in a quiet clock");
      }
      skipped += quiet;
      left -= quiet;
      if (left == 0) break;
      every.clock(in);
      skipping.clock(in);
      --left;
      if (!(every.out() == skipping.out())) FAIL("the skipping twin went astray");
    }
  }
  CAPTURE(skipped, total);
  REQUIRE(4 * skipped > (kPeriod < 100 ? 1 : 3) * total);
}
