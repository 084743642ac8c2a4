// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// pwm: RTL against twin on every clock, on-times against the closed form, and checks of forbidden
// bridge states. Documentation: docs/blocks/pwm.md
#include <Vpwm.h>

#include <cstdlib>
#include <vector>

#include "catch.hpp"
#include "feltgate/pwm.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

// Connects the Verilated pwm's ports to its twin's, and checks for gate states that no bridge may
// get.

namespace feltgate::test {

struct PwmAdapter {
  static void drive(Vpwm& rtl, const Pwm::In& in) {
    FELTGATE_DRIVE(rtl, in, clear, enable, mode, polarity);
    rtl.duty_i = port_bits<13, std::uint16_t>(in.duty);
  }
  template <class Check>
  static void compare(Check& check, const Vpwm& rtl, const Pwm::Out& out) {
    FELTGATE_COMPARE(check, rtl, out, gate_a_hi, gate_a_lo, gate_b_hi, gate_b_lo, period_start);
    check("duty_active", sign_extend<13>(rtl.duty_active_o), out.duty_active);
  }
};

using PwmBench = LockStep<Vpwm, Pwm, PwmAdapter>;

/// Checks the gates of the RTL only, clock by clock.
class BridgeGuard {
 public:
  BridgeGuard(int dead_clocks, int shortest_clocks)
      : dead_clocks_(dead_clocks), shortest_clocks_(shortest_clocks) {}

  const char* operator()(const Pwm::In& in, const Vpwm& rtl, bool in_reset) {
    const bool on[4] = {rtl.gate_a_hi_o != 0, rtl.gate_a_lo_o != 0, rtl.gate_b_hi_o != 0,
                        rtl.gate_b_lo_o != 0};
    ++clock_;
    if (in_reset || !in.enable) last_disabled_ = clock_;
    // Inputs that turn the gates on or off, or change mode or polarity, may cut a running pulse.
    const bool cuts =
        in_reset || !in.enable || in.clear || in.mode != mode_ || in.polarity != polarity_;
    if (cuts) last_cut_ = clock_;
    mode_ = in.mode;
    polarity_ = in.polarity;
    for (int gate = 0; gate < 4; ++gate) {
      if (!on[gate]) {
        // Such a change is used from the next period on; the gates follow a few clocks and a dead
        // time later.
        if (was_on_[gate] && on_since_[gate] > last_cut_ + 2 * period_ + dead_clocks_) {
          if (clock_ - on_since_[gate] < shortest_clocks_) return "no pulse is too short";
        }
        was_on_[gate] = false;
        continue;
      }
      if (in_reset) return "no gate is on during reset";
      if (!in.enable) return "no gate is on while disabled";
      if (in.clear) return "no gate is on while cleared";
      if (on[gate ^ 1]) return "never both gates of a leg";
      if (!was_on_[gate]) {
        on_since_[gate] = clock_;
        if (clock_ - last_on_[gate ^ 1] <= dead_clocks_) return "dead time between two gates";
        if (clock_ - last_disabled_ < dead_clocks_) return "dead time after enable";
      }
      was_on_[gate] = true;
      last_on_[gate] = clock_;
    }
    const auto duty = sign_extend<13>(rtl.duty_active_o);
    if (!in_reset && !in.enable && duty != 0) return "no duty is in force while disabled";
    if (duty != duty_ && !rtl.period_start_o && !in_reset && in.enable) {
      return "a duty begins with a period";
    }
    duty_ = duty;
    return nullptr;
  }

 private:
  static constexpr int period_ = PWM_PERIOD;
  int dead_clocks_, shortest_clocks_;
  bool mode_ = false, polarity_ = false;
  std::int64_t clock_ = 0, last_cut_ = 0;
  std::int64_t on_since_[4] = {};
  std::int64_t last_on_[4] = {-1000, -1000, -1000, -1000};
  bool was_on_[4] = {};
  std::int64_t last_disabled_ = 0;
  std::int64_t duty_ = 0;
};

}  // namespace feltgate::test

using feltgate::Pwm;
using namespace feltgate::test;

namespace {

constexpr int kPeriod = PWM_PERIOD;
constexpr int kDead = PWM_DEAD;
constexpr int kShortest = PWM_SHORTEST;
// All duties of a short period; for a long period the ends and values near the dead time, odd and
// even.
std::vector<int> duties() {
  std::vector<int> list;
  for (int d = -kPeriod - 8; d <= kPeriod + 8; ++d) {
    const int m = std::abs(d);
    if (kPeriod < 100 || m < 3 || std::abs(m - kDead) < 3 || m > kPeriod - 3 ||
        (m > kDead && m < kDead + kShortest && m % 3 == 0) || std::abs(m + kDead - kPeriod) < 3 ||
        d % 131 == 0) {
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
  PwmBench bench("pwm", 1, Pwm(kPeriod, kDead, kShortest));
  bench.run(stimulus, clocks + PwmBench::kFirstReset, {}, watch);
  return gates;
}

}  // namespace

TEST_CASE("pwm: on-times are exact for every duty, mode and polarity") {
  for (const bool mode : {false, true}) {
    for (const bool polarity : {false, true}) {
      for (const int duty : duties()) {
        const Pwm::In in = steady(mode, polarity, duty);
        // Computed from the definition, independent of the twin. A pulse that is too short waits
        // until several make a whole one; their mean is exact.
        const int short_clocks = std::abs(duty) - kDead;
        const bool waits = !mode && short_clocks > 0 && short_clocks < kShortest;
        const int periods = waits ? (kShortest + short_clocks - 1) / short_clocks : 1;
        const Gates gates = record([in](std::int64_t) { return in; }, (2 + 2 * periods) * kPeriod);
        CAPTURE(mode, polarity, duty);
        const int d = std::min(kPeriod, std::max(-kPeriod, polarity ? -duty : duty));
        const auto whole = [mode](int high) {
          if (kShortest == 1) return high;
          const int least = mode ? kDead + kShortest : 0;
          return std::max(least, std::min(high, kPeriod - kDead - kShortest));
        };
        const int a = whole(mode ? (kPeriod + d - (d & 1)) / 2 : std::max(d, 0));
        const int b = mode ? kPeriod - a : whole(std::max(-d, 0));
        const auto on = [](int share) {
          return share == kPeriod ? kPeriod : std::max(0, share - kDead);
        };
        for (const int from : {2 * kPeriod, (2 + periods) * kPeriod}) {
          const auto counted = [&](const std::vector<bool>& gate) {
            return Gates::count(gate, from, periods * kPeriod);
          };
          REQUIRE(counted(gates.a_hi) == periods * on(a));
          REQUIRE(counted(gates.a_lo) == periods * on(kPeriod - a));
          REQUIRE(counted(gates.b_hi) == periods * on(b));
          REQUIRE(counted(gates.b_lo) == periods * on(kPeriod - b));
        }
      }
    }
  }
}

TEST_CASE("pwm: clocks that wait are given up with the direction, the mode and the enable") {
  if (kShortest < 3) return;
  // Half of a whole pulse waits; then it may not make one with the half of another direction.
  const int half = kDead + (kShortest + 1) / 2;
  for (const int change : {0, 1, 2, 3}) {
    const auto stimulus = [=](std::int64_t c) {
      const auto period = (c - PwmBench::kFirstReset) / kPeriod;
      Pwm::In in = steady(false, false, half);
      if (period >= 1) in.duty = 0;
      if (period == 1 && change == 2) in.mode = true;
      if (period == 1 && change == 3) in.enable = false;
      if (period == 2) in.duty = static_cast<std::int16_t>(change == 1 ? -half : half);
      return in;
    };
    const Gates gates = record(stimulus, 5 * kPeriod);
    CAPTURE(change);
    const int from = 2 * kPeriod + 3;
    CHECK(Gates::count(gates.a_hi, from, kPeriod) == (change == 0 ? 2 * (half - kDead) : 0));
    CHECK(Gates::count(gates.b_hi, from, kPeriod) == 0);
  }
}

TEST_CASE("pwm: pulses are centred in the period to half a clock") {
  const int most = kShortest == 1 ? kPeriod - 1 : kPeriod - kDead - kShortest;
  for (int duty = kDead + kShortest; duty <= most; duty += kPeriod < 100 ? 1 : 97) {
    const Pwm::In in = steady(false, false, duty);
    const Gates gates = record([in](std::int64_t) { return in; }, 4 * kPeriod);
    const int from = 2 * kPeriod + 3;  // start of a period at the gates
    int first = 0;
    while (!gates.a_hi[static_cast<std::size_t>(from + first)]) ++first;
    const int last = first + Gates::count(gates.a_hi, from, kPeriod) - 1;
    // The dead time shortens the front of a pulse: without it first + last would be Period - 1 or
    // Period.
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
      if (random.one_in(in.clear ? 4 : calm)) in.clear = !in.clear;
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
    const auto watch = [guard = BridgeGuard(kDead, kShortest)](const Pwm::In& in, const Vpwm& rtl,
                                                               const Pwm&, bool in_reset) mutable {
      return guard(in, rtl, in_reset);
    };
    PwmBench bench("pwm", ++seed, Pwm(kPeriod, kDead, kShortest));
    bench.run(Chaos{Random(seed), {}, static_cast<std::uint32_t>(calm)}, scaled_clocks(4'000'000),
              ResetPlan{20'000}, watch);
  }
}

TEST_CASE("pwm: a gate changes with the clock or the clear, and no pulse is shorter than a clock") {
  Random random(3);
  feltgate::RtlModel<Vpwm> rtl(3);
  Pwm::In in;
  PwmAdapter::drive(*rtl, in);
  rtl.reset(2);
  const auto gates = [&rtl] {
    return unsigned{rtl->gate_a_hi_o} | rtl->gate_a_lo_o * 2u | rtl->gate_b_hi_o * 4u |
           rtl->gate_b_lo_o * 8u;
  };
  // The inputs change after the edge, before the next edge and with it, like registers with any
  // delay.
  const auto scramble = [&] {
    if (random.one_in(in.enable ? 2 * kDead + 40 : 9)) in.enable = !in.enable;
    if (random.one_in(kPeriod)) in.mode = !in.mode;
    if (random.one_in(kPeriod)) in.polarity = !in.polarity;
    if (random.one_in(kPeriod)) {
      in.duty = static_cast<std::int16_t>(random.between(-kPeriod, kPeriod));
    }
    if (random.one_in(2)) in.duty = static_cast<std::int16_t>(kDead + 1);
    PwmAdapter::drive(*rtl, in);
  };
  unsigned before = gates();
  int on[4] = {};
  int shortest = kPeriod;
  for (std::int64_t clock = 0; clock < scaled_clocks(2'000'000); ++clock) {
    scramble();
    rtl->eval();
    if (gates() != before) FAIL("a gate moved after the edge, at clock " << clock);
    scramble();
    rtl.low();
    if (gates() != before) FAIL("a gate moved before the edge, at clock " << clock);
    if (random.one_in(200)) {  // only the clear acts at once; a pulse that it cuts is not counted
      rtl->clear_i = 1;
      rtl->eval();
      if (gates() != 0) FAIL("a gate stayed on through a clear, at clock " << clock);
      rtl->clear_i = 0;
      rtl->eval();
      if (gates() != 0) FAIL("a gate came back without the clock, at clock " << clock);
      for (int& clocks : on) clocks = 0;
    }
    rtl.high();
    before = gates();
    for (int gate = 0; gate < 4; ++gate) {
      const bool is_on = (before >> gate & 1u) != 0;
      if (!is_on && on[gate] > 0) shortest = std::min(shortest, on[gate]);
      on[gate] = is_on ? on[gate] + 1 : 0;
    }
  }
  REQUIRE(shortest == 1);  // from a falling enable
}

TEST_CASE("pwm: the duty of the last enable never meets the gates of the next") {
  const int high = kPeriod / 2 + 1;
  for (const bool mode : {false, true}) {
    for (int off = std::max(1, 5 - kDead); off < 3 * kPeriod; off += kPeriod < 100 ? 1 : 83) {
      const int fall = 2 * kPeriod + 3;
      const auto stimulus = [=](std::int64_t c) {
        const auto clock = static_cast<int>(c - PwmBench::kFirstReset);
        Pwm::In in = steady(mode, false, clock < fall + off ? high : 0);
        in.enable = clock < fall || clock >= fall + off;
        return in;
      };
      const Gates gates = record(stimulus, fall + off + 4 * kPeriod);
      CAPTURE(mode, off);
      // After the second enable the duty is 0: no voltage in any whole period.
      for (int from = fall + off + 1; from < fall + off + 3 * kPeriod; ++from) {
        const auto at = static_cast<std::size_t>(from);
        if (!mode && (gates.a_hi[at] || gates.b_hi[at])) FAIL("a high switch at " << from);
      }
      const int a = Gates::count(gates.a_hi, fall + off + kDead + 4, kPeriod);
      REQUIRE(a <= (mode ? kPeriod / 2 : 0));
    }
  }
}
