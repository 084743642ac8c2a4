// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// pwm_three_phase: RTL against twin on every clock, on-times of all six gates against their
// definition, and checks of states that no bridge may get. Documentation:
// docs/blocks/pwm.md
#include <Vpwm_three_phase.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "catch.hpp"
#include "feltgate/pwm_three_phase.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

using feltgate::PwmThreePhase;
using namespace feltgate::test;

namespace {

constexpr int kPeriod = PWM_PERIOD;
constexpr int kDead = PWM_DEAD;
constexpr int kShortest = PWM_SHORTEST;
constexpr int kGates = 6;  // high and low of A, B, C

struct Adapter {
  static void drive(Vpwm_three_phase& rtl, const PwmThreePhase::In& in) {
    FELTGATE_DRIVE(rtl, in, clear, enable);
    rtl.on_a_i = static_cast<std::uint16_t>(in.on_a);
    rtl.on_b_i = static_cast<std::uint16_t>(in.on_b);
    rtl.on_c_i = static_cast<std::uint16_t>(in.on_c);
  }
  template <class Check>
  static void compare(Check& check, const Vpwm_three_phase& rtl, const PwmThreePhase::Out& out) {
    FELTGATE_COMPARE(check, rtl, out, gate_a_hi, gate_a_lo, gate_b_hi, gate_b_lo, gate_c_hi,
                     gate_c_lo, period_start);
  }
};

using Bench = LockStep<Vpwm_three_phase, PwmThreePhase, Adapter>;

/// Bit 2 leg of the high gate, the next bit of the low one.
unsigned gates_of(const Vpwm_three_phase& rtl) {
  return rtl.gate_a_hi_o | rtl.gate_a_lo_o * 2u | rtl.gate_b_hi_o * 4u | rtl.gate_b_lo_o * 8u |
         rtl.gate_c_hi_o * 16u | rtl.gate_c_lo_o * 32u;
}

PwmThreePhase::In steady(int a, int b, int c) {
  PwmThreePhase::In in;
  in.enable = true;
  in.on_a = static_cast<std::int16_t>(a);
  in.on_b = static_cast<std::int16_t>(b);
  in.on_c = static_cast<std::int16_t>(c);
  return in;
}

/// Gates of the RTL in each clock after the reset.
template <class Stimulus>
std::vector<unsigned> record(const Stimulus& stimulus, std::int64_t clocks) {
  std::vector<unsigned> gates;
  const auto watch = [&gates](const PwmThreePhase::In&, const Vpwm_three_phase& rtl,
                              const PwmThreePhase&, bool in_reset) {
    const char* fine = nullptr;
    if (!in_reset) gates.push_back(gates_of(rtl));
    return fine;
  };
  Bench bench("pwm_three_phase", 1, PwmThreePhase(kPeriod, kDead, kShortest));
  bench.run(stimulus, clocks + Bench::kFirstReset, {}, watch);
  return gates;
}

int count(const std::vector<unsigned>& gates, int gate, int from, int length) {
  int n = 0;
  for (int k = from; k < from + length; ++k) n += gates[static_cast<std::size_t>(k)] >> gate & 1;
  return n;
}

/// Clocks that the high and the low gate are on in a period, from the definition; the mean, where
/// pulses are too short.
std::pair<int, int> defined(int on) {
  int high = std::min(on, kPeriod);
  if (kShortest > 1) high = std::min(high, kPeriod - kDead - kShortest);
  const auto left = [](int share) {
    return share == kPeriod ? kPeriod : std::max(0, share - kDead);
  };
  return {left(high), left(kPeriod - high)};
}

/// Periods in which pulses that are too short make a whole one.
int periods_of(int on) {
  const int clocks = on - kDead;
  return clocks > 0 && clocks < kShortest ? (kShortest + clocks - 1) / clocks : 1;
}

/// Checks the gates of the RTL only, clock by clock.
class BridgeGuard {
 public:
  std::int64_t turn_ons = 0, whole_pulses = 0;

  const char* operator()(const PwmThreePhase::In& in, const Vpwm_three_phase& rtl,
                         const PwmThreePhase&, bool in_reset) {
    const unsigned on = gates_of(rtl);
    ++clock_;
    if (in_reset || !in.enable) last_disabled_ = clock_;
    const bool cuts = in_reset || !in.enable || in.clear;
    if (cuts && on != 0) return "no gate is on in a reset, disabled or cleared";
    for (int leg = 0; leg < kGates / 2; ++leg) {
      if (cuts) pulses_[leg] = 0;
    }
    for (int gate = 0; gate < kGates; ++gate) {
      int& pulses = pulses_[gate / 2];
      if ((on >> gate & 1) != 0) {
        if ((on >> (gate ^ 1) & 1) != 0) return "never both gates of a leg";
        if (on_[gate]++ == 0) {
          ++pulses;
          ++turn_ons;
          if (clock_ - last_on_[gate ^ 1] <= kDead) return "dead time between two gates";
          if (clock_ - last_disabled_ < kDead) return "dead time after enable";
        }
        last_on_[gate] = clock_;
        continue;
      }
      // The first pulse of a leg after its gates open began with them and not with the carrier.
      if (on_[gate] > 0 && !cuts && pulses > 1) {
        if (on_[gate] < kShortest) return "no pulse is too short";
        ++whole_pulses;
      }
      on_[gate] = 0;
    }
    return nullptr;
  }

 private:
  std::int64_t clock_ = 0, last_disabled_ = 0;
  std::int64_t last_on_[kGates] = {-1000, -1000, -1000, -1000, -1000, -1000};
  int on_[kGates] = {}, pulses_[kGates / 2] = {};
};

}  // namespace

TEST_CASE("pwm_three_phase: on-times are exact, of each leg alone") {
  for (int on = 0; on <= kPeriod + 8;
       on += kPeriod < 100 || on > kPeriod - 70 || on < 70 ? 1 : 61) {
    const int b = kPeriod - std::min(on, kPeriod), c = (on * 7 + 3) % (kPeriod + 1);
    const PwmThreePhase::In in = steady(on, b, c);
    const int each[] = {on, b, c};
    const int longest = std::max({periods_of(on), periods_of(b), periods_of(c)});
    const auto gates = record([in](std::int64_t) { return in; }, (2 + longest) * kPeriod);
    CAPTURE(on, b, c);
    for (int leg = 0; leg < 3; ++leg) {
      const auto [high, low] = defined(each[leg]);
      const int periods = periods_of(each[leg]), clocks = periods * kPeriod;
      REQUIRE(count(gates, 2 * leg, 2 * kPeriod, clocks) == periods * high);
      REQUIRE(count(gates, 2 * leg + 1, 2 * kPeriod, clocks) == periods * low);
    }
  }
  const auto gates = record([](std::int64_t) { return steady(4095, 0, 4095); }, 3 * kPeriod);
  CHECK(count(gates, 0, 2 * kPeriod, kPeriod) == defined(kPeriod).first);
}

TEST_CASE("pwm_three_phase: pulses of all legs have one centre, to half a clock") {
  const int most = kShortest == 1 ? kPeriod - 1 : kPeriod - kDead - kShortest;
  for (int on = kDead + kShortest; on <= most; on += kPeriod < 100 ? 1 : 97) {
    const int each[] = {on, kDead + kShortest + (on * 5) % (most - kDead - kShortest), most};
    const PwmThreePhase::In in = steady(each[0], each[1], each[2]);
    const auto gates = record([in](std::int64_t) { return in; }, 4 * kPeriod);
    const int from = 2 * kPeriod + 3;  // start of a period at the gates
    for (int leg = 0; leg < 3; ++leg) {
      int first = 0;
      while ((gates[static_cast<std::size_t>(from + first)] >> (2 * leg) & 1) == 0) ++first;
      const int last = first + count(gates, 2 * leg, from, kPeriod) - 1;
      CAPTURE(on, leg, first, last);
      // Without the dead time at its front the pulse lies around the middle of the period.
      REQUIRE(first - kDead + last == kPeriod - (each[leg] % 2 != 0 ? 0 : 1));
    }
  }
}

TEST_CASE("pwm_three_phase: new on-times wait for the period's end, and come together") {
  const int before = kPeriod - kDead - kShortest - 1, after = kDead + kShortest + 1;
  for (int clock = 0; clock < kPeriod; clock += kPeriod < 100 ? 1 : 49) {
    const auto stimulus = [=](std::int64_t c) {
      const int on = c - Bench::kFirstReset <= kPeriod + clock ? before : after;
      return steady(on, on, on);
    };
    const auto gates = record(stimulus, 5 * kPeriod);
    for (int leg = 0; leg < 3; ++leg) {
      CAPTURE(clock, leg);
      REQUIRE(count(gates, 2 * leg, kPeriod + 3, kPeriod) == defined(before).first);
      REQUIRE(count(gates, 2 * leg, 2 * kPeriod + 3, kPeriod) == defined(after).first);
    }
  }
}

TEST_CASE("pwm_three_phase: everything at random, no shoot-through, dead time kept") {
  struct Chaos {
    Random random;
    PwmThreePhase::In in;
    std::uint32_t calm;
    PwmThreePhase::In operator()(std::int64_t) {
      if (random.one_in(in.enable ? calm : 5)) in.enable = !in.enable;
      if (random.one_in(in.clear ? 4 : calm)) in.clear = !in.clear;
      for (std::int16_t* on : {&in.on_a, &in.on_b, &in.on_c}) {
        if (!random.one_in(kPeriod / 2)) continue;
        const std::int64_t near = random.coin() ? 0 : kPeriod - kDead - kShortest;
        const std::int64_t on_clocks = random.one_in(8) ? random.between(0, 4095)
                                       : random.one_in(3)
                                           ? near + random.between(0, kDead + kShortest)
                                           : random.between(0, kPeriod);
        *on = static_cast<std::int16_t>(on_clocks);
      }
      return in;
    }
  };
  std::uint64_t seed = 20;
  for (const int calm : {2 * kDead, 3 * kPeriod, 40 * kPeriod}) {
    Bench bench("pwm_three_phase", ++seed, PwmThreePhase(kPeriod, kDead, kShortest));
    BridgeGuard guard;
    bench.run(Chaos{Random(seed), {}, static_cast<std::uint32_t>(calm)}, scaled_clocks(2'000'000),
              ResetPlan{20'000}, std::ref(guard));
    REQUIRE(guard.turn_ons > 2000);
    if (calm > kPeriod) REQUIRE(guard.whole_pulses > 500);
  }
}

TEST_CASE("pwm_three_phase: a gate changes with the clock or the clear alone") {
  Random random(3);
  feltgate::RtlModel<Vpwm_three_phase> rtl(3);
  PwmThreePhase::In in;
  Adapter::drive(*rtl, in);
  rtl.reset(2);
  // The inputs change after the edge, before the next edge and with it, like registers with any
  // delay.
  const auto scramble = [&] {
    if (random.one_in(in.enable ? 2 * kDead + 40 : 9)) in.enable = !in.enable;
    for (std::int16_t* on : {&in.on_a, &in.on_b, &in.on_c}) {
      *on = static_cast<std::int16_t>(random.between(0, kPeriod));
    }
    Adapter::drive(*rtl, in);
  };
  unsigned before = gates_of(*rtl);
  std::int64_t moved = 0;
  for (std::int64_t clock = 0; clock < scaled_clocks(500'000); ++clock) {
    scramble();
    rtl->eval();
    if (gates_of(*rtl) != before) FAIL("a gate moved after the edge, at clock " << clock);
    scramble();
    rtl.low();
    if (gates_of(*rtl) != before) FAIL("a gate moved before the edge, at clock " << clock);
    if (random.one_in(200)) {
      rtl->clear_i = 1;
      rtl->eval();
      if (gates_of(*rtl) != 0) FAIL("a gate stayed on through a clear, at clock " << clock);
      rtl->clear_i = 0;
      rtl->eval();
      if (gates_of(*rtl) != 0) FAIL("a gate came back without the clock, at clock " << clock);
    }
    rtl.high();
    moved += gates_of(*rtl) != before;
    before = gates_of(*rtl);
  }
  CHECK(moved > 1000);
}

TEST_CASE("pwm_three_phase: on-times of the last enable never meet the gates of the next") {
  const int high = kPeriod / 2 + 1;
  for (int off = std::max(1, 5 - kDead); off < 3 * kPeriod; off += kPeriod < 100 ? 1 : 83) {
    const int fall = 2 * kPeriod + 3;
    const auto stimulus = [=](std::int64_t c) {
      const auto clock = static_cast<int>(c - Bench::kFirstReset);
      const int on = clock < fall + off ? high : 0;
      PwmThreePhase::In in = steady(on, on, on);
      in.enable = clock < fall || clock >= fall + off;
      return in;
    };
    const auto gates = record(stimulus, fall + off + 4 * kPeriod);
    CAPTURE(off);
    for (int leg = 0; leg < 3; ++leg) {
      REQUIRE(count(gates, 2 * leg, fall + off + 1, 2 * kPeriod) == 0);
    }
  }
}

TEST_CASE("pwm_three_phase: clocks to the sample") {
  PwmThreePhase twin(kPeriod, kDead, kShortest);
  for (int clock = 0; clock < 3 * kPeriod; ++clock) {
    const int left = twin.clocks_to_sample();
    twin.clock({});
    REQUIRE(twin.out().period_start == (left == 0));
  }
}
