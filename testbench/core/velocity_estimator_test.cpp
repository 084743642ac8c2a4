// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/velocity_estimator.hpp"

#include "ports/velocity_estimator.hpp"

using namespace feltgate::test;

namespace {

struct Twin : TickTwin<ports::velocity_estimator, VelocityEstimator<Fixed>> {
  static void strobes(In& in, int clock) { in.sample = clock == 0; }
  void clock(const In& in) {
    block.clock(in.sample, [&] {
      const auto ticks = static_cast<int>(line.size());
      const std::int16_t counts = window.counts(in.travel);
      window.tick(line.data(), ticks, in.travel);
      return law.tick(block.state, in.p, counts);
    });
  }
  Out out(const In&) const { return {block.shown().velocity, block.shown().saturated, valid()}; }

  TravelWindow window;
  std::vector<std::int16_t> line =
      std::vector<std::int16_t>(static_cast<std::size_t>(design()["M1"]));
};

}  // namespace

TEST_CASE("velocity_estimator: RTL and twin, every clock") { lock_step(Twin(), {800'000}); }
