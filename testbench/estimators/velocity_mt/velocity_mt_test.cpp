// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// velocity_mt: RTL against twin and against the list of all edges on every clock; distance from
// real arithmetic, reversal, and the way to standstill. Documentation: docs/blocks/velocity.md
#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "velocity_mt_bench.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

constexpr int kTick = 50;
/// Clocks without an edge after which nothing moves.
constexpr std::int64_t kRest = std::int64_t{1} << (Velocity::stamp_bits - 3);
/// Rests that a test can wait for.
constexpr std::int64_t kScale = kRest > 100000 ? 100000 : 2 * kRest / 3;

double raw_rad_s(const Moved<Velocity>& m) {
  return std::ldexp(static_cast<double>(m.twin.raw()), -Design::f.velocity.fraction);
}

}  // namespace

TEST_CASE("velocity_mt: random motion, gaps and resets") {
  Worst most;
  Bench bench("velocity_mt", 1);
  bench.run(Waves<RandomMotion>(3, {kScale}, kTick, 30), scaled_clocks(2'500'000), {200'000},
            Reference{&most});
  bench.run(Waves<RandomMotion>(4, {kScale / 4}, kTick, 1), scaled_clocks(2'500'000), {600'000},
            Reference{&most});
  bench.run(Waves<RandomMotion>(5, {kScale}, Velocity::division_clocks, 2),
            scaled_clocks(1'000'000), {3'000}, Reference{&most});
  REQUIRE(most.lowered > 1000);
  REQUIRE(most.longest > 100);
  REQUIRE((most.followed > 10 || kRest > kScale));
  // Real arithmetic on the same edges: an LSB is cut off the raw velocity, the filter rounds.
  const quad unit = lsb(Design::f.velocity.fraction);
  const quad raw_bound = unit + 1024 * lsb(36);
  const ParameterInfo& a1 = parameter(Design::A::velocity_a1);
  const quad bound = raw_bound + (coefficient_error(a1) * most.difference + unit / 2) /
                                     (static_cast<quad>(a1.raw) * lsb(a1.format.fraction));
  INFO("raw off by " << static_cast<double>(most.raw) << " of " << static_cast<double>(raw_bound)
                     << " rad/s, behind the low-pass by " << static_cast<double>(most.filtered)
                     << " of " << static_cast<double>(bound));
  CHECK(most.raw <= raw_bound);
  CHECK(most.raw > raw_bound / 2);
  CHECK(most.filtered <= bound);
  CHECK(most.filtered > bound / 100);
}

TEST_CASE("velocity_mt: a constant speed is right but for one clock in the span") {
  // At the slowest the four cells of a cycle take 3/4 of the time after which the block rests.
  const double slowest = 4 * kCountRad * Design::clock_hz / (3.0 * static_cast<double>(kRest));
  for (const Encoder& encoder : {Encoder::ideal(), Encoder::cheap(), Encoder::cheap(-1)}) {
    for (const double speed : {1.0, 10.0, -10.0, 100.0, -613.0}) {
      if (std::fabs(speed) < slowest) continue;
      Moved<Velocity> m(encoder);
      const double cycle_s = 4 * kCountRad / std::fabs(speed);
      const double begin = std::fmax(20 * cycle_s, 2e-3),
                   end = begin + std::fmax(9 * cycle_s, 1e-3);
      // The longest cycle that is let be one, or the most cycles that are counted.
      const double clocks =
          Design::clock_hz *
          std::fmax(cycle_s, Velocity::doublings == 0
                                 ? 0
                                 : std::fmin(Velocity::window / double{Design::clock_hz},
                                             cycle_s * (1 << Velocity::doublings)));
      const double unit = std::ldexp(1.0, -Design::f.velocity.fraction);
      const double bound = std::fabs(speed) / (clocks - 1) + unit;
      double worst = 0;
      m.run(
          end, [&](double t) { return speed * t; },
          [&](double t) {
            if (t > begin) worst = larger(worst, std::fabs(raw_rad_s(m) - speed));
          });
      INFO("at " << speed << " rad/s off by " << worst << " of " << bound);
      CHECK(worst <= bound);
      CHECK((worst > bound / 20 || std::fabs(speed) < 20));
    }
  }
}

TEST_CASE("velocity_mt: at a turn it is 0, then of the new direction") {
  Moved<Velocity> m(Encoder::cheap());
  constexpr double quarter_s = 0.01, top = 30;
  std::int64_t wrong = 0, zeros = 0, ticks = 0;
  m.run(
      8 * quarter_s, [&](double t) { return top * quarter_s * std::sin(t / quarter_s); },
      [&](double) {
        // Of the edges up to the tick before, which the raw velocity is of.
        if (m.edges_seen < 2) return;
        ++ticks;
        const double raw = raw_rad_s(m);
        wrong += raw * m.direction_seen < 0;
        zeros += m.turned_seen;
        wrong += m.turned_seen && raw != 0;
      });
  CHECK(ticks > 50000);
  CHECK(zeros > 2);
  CHECK(wrong == 0);
}

TEST_CASE("velocity_mt: to standstill under 1.5 counts over the age, then 0, and stays") {
  const double rest_s = static_cast<double>(kRest) / Design::clock_hz;
  const double speed = 8 * kCountRad / rest_s;
  const double unit = std::ldexp(1.0, -Design::f.velocity.fraction);
  Moved<Velocity> m(Encoder::ideal());
  const double stop = 20 * kCountRad / speed + kCountRad / speed / 100;
  double before = 0, last = 0, zero_at = 0;
  std::int64_t above = 0, rises = 0;
  m.run(
      stop + 5 * rest_s + 0.01, [&](double t) { return speed * std::fmin(t, stop); },
      [&](double t) {
        const double raw = raw_rad_s(m);
        if (t < stop) return;
        const double age = static_cast<double>(m.age_seen) / Design::clock_hz;
        above += raw > 1.5 * kCountRad / age + unit && age > 0;
        rises += raw > before && before != 0 && age > 3e-6;
        if (raw == 0 && zero_at == 0) {
          zero_at = age;
          last = before;
        }
        before = raw;
      });
  INFO("0 after " << zero_at << " s, from " << last << " rad/s");
  CHECK(above == 0);
  CHECK(rises == 0);
  CHECK(zero_at == Approx(rest_s).margin(3e-6));
  CHECK(last > 1.5 * kCountRad / rest_s - unit);
  CHECK(last < 1.5 * kCountRad / (rest_s - 3e-6));
  CHECK(m.twin.raw() == 0);
  CHECK(m.twin.out().velocity == 0);  // behind the low-pass too: its dead band is left
}
