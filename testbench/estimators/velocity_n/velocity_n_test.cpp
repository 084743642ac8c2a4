// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// velocity_n: RTL against twin and plain integers on every clock; gain error of the N-method, first
// ticks after reset, counter wrap, and distance from quad precision. docs/blocks/velocity_n.md
#include "feltgate/largest.hpp"
#include "velocity_bench.hpp"

#include <cmath>

#include "catch.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

/// One count every `ticks` ticks; where `ticks` divides m1 the counts in the window never change.
struct Uniform {
  std::int64_t ticks;
  int direction = 1;
  std::int64_t operator()(std::int64_t tick) const { return direction * (tick / ticks); }
};

/// The fastest speed whose counts in the window are exact and which fits the format.
constexpr int exact_ticks() {
  for (int ticks = 2;; ++ticks) {
    if (Design::m1 % ticks == 0) return ticks;
  }
}

/// Gain error as the literature and the docs round it.
constexpr double stated_percent() {
  if (Design::velocity_gain != 0) return -0.0003;  // what is left is its quantisation
  return kIsPaper ? 0.653 : Design::m1 == Shortest::m1 ? 0.132 : 0.0013;
}

double rad_s(std::int64_t raw) { return static_cast<double>(raw) / (1 << 21); }

/// |velocity - low-pass of the same raw values| <= this: coefficient error over the largest
/// difference that reached the filter, half an LSB of rounding, both over a1.
quad error_bound(quad largest_difference) {
  const ParameterInfo& a1 = parameter(Design::A::velocity_a1);
  const quad quantised = static_cast<quad>(a1.raw) * lsb(a1.format.fraction);
  return (coefficient_error(a1) * largest_difference + lsb(21) / 2) / quantised;
}

}  // namespace

TEST_CASE("velocity_n: before the first tick nothing has saturated") {
  const EstimatorStep<Design, Fixed> step;
  CHECK_FALSE(step.limit);
  CHECK(step.velocity.raw() == 0);
}

TEST_CASE("velocity_n: random motion, gaps and resets") {
  Tally tally;
  Bench bench("velocity_n", 1);
  bench.run(Waves<RandomMotion>(3, {}, 30), scaled_clocks(1000000), {60000}, Reference{&tally});
  bench.run(Waves<RandomMotion>(4, {}, 1), scaled_clocks(1000000), {200000}, Reference{&tally});
  bench.run(Waves<RandomMotion>(5, {}, 41), scaled_clocks(200000), {3000}, Reference{&tally});
  INFO("ticks " << tally.ticks << ", saturated " << tally.saturated << ", line not full "
                << tally.unfilled << ", across the wrap " << tally.wrapped);
  REQUIRE(tally.saturated * 100 > tally.ticks);
  REQUIRE(tally.saturated * 5 < tally.ticks);
  REQUIRE(tally.unfilled > 5 * Design::m1);
  REQUIRE(tally.unfilled < tally.ticks / 2);
  REQUIRE(tally.wrapped > Design::m1 / 2);
}

TEST_CASE("velocity_n: gain error of the N-method at a constant speed") {
  for (const int direction : {1, -1}) {
    Tally tally;
    Bench bench("velocity_n", 6);
    constexpr int ticks = exact_ticks();
    bench.run(Waves<Uniform>(6, {ticks, direction}, 1), 700000, {}, Reference{&tally});
    // One count in `ticks` microseconds, 4096 counts per turn.
    const double turn = 2 * std::acos(-1.0);
    const double truth = direction * turn / 4096 / (ticks * 1e-6);
    // 2^n against the exact factor 2*pi / (4096 * tick * m1).
    const double expected = kRadSPerCount * 4096e-6 * Design::m1 / turn - 1;
    const double gain_error = rad_s(tally.last_velocity) / truth - 1;
    const double dead_band = 1001.0 / (1 << 21) / std::fabs(truth);
    INFO("true " << truth << " rad/s, gain error " << 100 * gain_error << " %");
    REQUIRE(tally.saturated == 0);
    REQUIRE(std::fabs(gain_error - expected) < dead_band);
    REQUIRE(std::fabs(100 * gain_error - stated_percent()) < 5e-4);
  }
}

TEST_CASE("velocity_n: the counter's wrap does not show") {
  for (const int direction : {1, -1}) {
    std::int64_t settled = 0, ticks = 0, changes = 0;
    Bench bench("velocity_n", 7);
    constexpr std::int64_t per_count = exact_ticks();
    const std::int64_t last = 32768 * per_count + 3000;
    const auto watch = [&](const Twin::In& in, const Vvelocity_n& rtl, const Twin&, bool in_reset) {
      if (in_reset || !sampled(in)) return static_cast<const char*>(nullptr);
      const std::int64_t velocity = sign_extend<32>(rtl.velocity_o);
      if (++ticks == 60000) settled = velocity;
      if (ticks > 60000 && velocity != settled) ++changes;
      return static_cast<const char*>(nullptr);
    };
    bench.run(Waves<Uniform>(7, {per_count, direction}, 1), 10 * last, {}, watch);
    REQUIRE(ticks >= last - 10);
    REQUIRE(settled * direction > 0);
    REQUIRE(changes == 0);
  }
}

TEST_CASE("velocity_n: right from the first tick after reset") {
  // From rest before reset to a constant speed: raw rises by steps until the window is full, and
  // velocity is the low-pass of just that, though the line holds another run's positions.
  constexpr int ticks = exact_ticks();
  quad worst = 0, exact_velocity = 0;
  std::int64_t tick = 0;
  const quad a1 = static_cast<quad>(parameter(Design::A::velocity_a1).si);
  const auto watch = [&](const Twin::In& in, const Vvelocity_n& rtl, const Twin&, bool in_reset) {
    if (in_reset) {
      tick = 0;
      exact_velocity = 0;
    } else if (sampled(in)) {
      // The velocity on the port belongs to the tick before.
      const quad error = magnitude(exact_velocity - quad{rad_s(sign_extend<32>(rtl.velocity_o))});
      worst = feltgate::larger(worst, error);
      const std::int64_t begun = tick < Design::m1 ? 0 : (tick - Design::m1) / ticks;
      const auto counts = static_cast<quad>(tick / ticks - begun);
      exact_velocity += a1 * (counts * static_cast<quad>(kRadSPerCount) - exact_velocity);
      ++tick;
    }
    return static_cast<const char*>(nullptr);
  };
  Bench bench("velocity_n", 8);
  bench.run(Waves<Uniform>(8, {ticks}, 1), 400000, {25000}, watch);
  REQUIRE(worst <= error_bound(1024));
  REQUIRE(worst > 0);
}

TEST_CASE("velocity_n: distance from quad precision") {
  using Law = VelocityLaw<Design, Real<quad>>;
  Ticks chain;
  RandomMotion motion;
  motion.random = Random(21);
  std::vector<std::int64_t> counts;
  quad state = 0, worst = 0, largest = 0;
  std::int64_t saturated = 0;
  const quad a1 = static_cast<quad>(parameter(Design::A::velocity_a1).si);
  const std::int64_t ticks = scaled_clocks(100000);
  for (std::int64_t tick = 0; tick < ticks; ++tick) {
    counts.push_back(motion(tick));
    chain.tick(wrapped_travel(counts.back()));
    const auto now = static_cast<std::size_t>(tick);
    const std::int64_t oldest = now >= Design::m1 ? counts[now - Design::m1] : 0;
    bool unused = false;
    quad raw =
        Law::raw(travel_difference(wrapped_travel(counts.back()), wrapped_travel(oldest)), &unused);
    if (chain.step.limit) {
      ++saturated;
      raw = raw < 0 ? quad{-1024} : 1024 - lsb(21);
    }
    const quad difference = Law::Filter::operand(raw, state);
    if (magnitude(difference) > largest) largest = magnitude(difference);
    state = Law::Filter::next(state, a1 * difference);
    const quad error = magnitude(exact(chain.step.velocity) - state);
    worst = feltgate::larger(worst, error);
  }
  INFO("worst " << static_cast<double>(worst) << " rad/s, bound "
                << static_cast<double>(error_bound(largest)));
  REQUIRE(saturated > ticks / 100);
  REQUIRE(worst <= error_bound(largest));
  REQUIRE(worst > error_bound(largest) / 100);
  REQUIRE(error_bound(largest) < quad{1} / 64);
}
