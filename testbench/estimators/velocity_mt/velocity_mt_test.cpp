// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// velocity_mt: RTL against twin and against the list of all edges on every clock; distance from
// real arithmetic, reversal, and the way to standstill. Documentation: docs/blocks/velocity_mt.md
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

}  // namespace

TEST_CASE("velocity_mt: random motion, gaps and resets") {
  Tally tally;
  Bench bench("velocity_mt", 1);
  bench.run(Waves<RandomMotion>(3, {kScale}, kTick, 30), scaled_clocks(1'500'000), {200'000},
            Reference{&tally});
  bench.run(Waves<RandomMotion>(4, {kScale / 4}, kTick, 1), scaled_clocks(1'500'000), {600'000},
            Reference{&tally});
  bench.run(Waves<RandomMotion>(5, {kScale}, Velocity::division_clocks, 2), scaled_clocks(500'000),
            {3'000}, Reference{&tally});
  INFO("ticks " << tally.ticks << ", values " << tally.values << ", saturated " << tally.saturated
                << ", lowered " << tally.lowered << ", standstill " << tally.standstill
                << ", stopped " << tally.stopped << ", of part of a cycle " << tally.partial
                << ", turned " << tally.turned << ", of the most cycles " << tally.longest
                << ", negative " << tally.negative);
  CHECK(tally.values > tally.ticks / 100);
  CHECK(tally.saturated > 100);
  CHECK(tally.saturated < tally.values / 2);
  CHECK(tally.lowered > 1000);
  CHECK(tally.partial > 100);
  CHECK(tally.turned > 100);
  CHECK(tally.longest > 100);
  CHECK(tally.longest < tally.values * (Velocity::doublings > 0 ? 3 : 4) / 4);
  CHECK(tally.negative > tally.values / 5);
  CHECK((tally.standstill > 10 || kRest > kScale));
  CHECK((tally.stopped > 10 || kRest > kScale));
  // Real arithmetic on the same edges: an LSB is cut off the raw velocity, the filter rounds.
  const quad unit = lsb(Design::f.velocity.fraction);
  const quad raw_bound = unit + 1024 * lsb(36);
  const ParameterInfo& a1 = parameter(Design::A::velocity_a1);
  const quad bound = raw_bound + (coefficient_error(a1) * tally.largest + unit / 2) /
                                     (static_cast<quad>(a1.raw) * lsb(a1.format.fraction));
  INFO("raw off by " << static_cast<double>(tally.worst_raw) << " of "
                     << static_cast<double>(raw_bound) << " rad/s, behind the low-pass by "
                     << static_cast<double>(tally.worst) << " of " << static_cast<double>(bound));
  CHECK(tally.worst_raw <= raw_bound);
  CHECK(tally.worst_raw > raw_bound / 2);
  CHECK(tally.worst <= bound);
  CHECK(tally.worst > bound / 100);
}
