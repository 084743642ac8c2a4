// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// rtl/options/mt/velocity_estimator.sv with time stamps of 14 bits, so that rests and their wrap
// come often.
#include "feltgate/axis/velocity_estimator.hpp"

#include "ports/velocity_estimator.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::velocity_estimator> {
  void clock(const In& in) {
    meter.clock(spans, stamps.data(), in.travel, in.sample);
    block.clock(in.sample, [&] { return law.tick(block.state, in.p, spans); });
  }
  Out out(const In&) const {
    return {block.shown().velocity, block.shown().saturated, block.valid(law.latency)};
  }

  /// A hand on the encoder: rests, slow, faster than the format, turns, an edge that chatters;
  /// rarely two counts in a clock, as no decoder gives.
  void legal(In& in, Random& random) {
    if (--left <= 0) {
      left = 1 + random.below(random.one_in(4) ? 40'000 : 4'000);
      per_count = random.one_in(6) ? left : 3 + random.below(2U << random.below(12));
      direction = random.coin() ? 1 : -1;
      chatters = random.one_in(6);
      next = per_count;
      if (random.one_in(20)) position += 2;
    }
    if (--next <= 0) {
      next = per_count - random.below(1 + per_count / 4);
      position += direction;
      if (chatters) direction = -direction;
    }
    in.travel = static_cast<std::int16_t>(position);
    in.sample = clocks == 0;
    if (in.sample) {  // the words hold in a tick, and the division ends in it
      p = in.p;
      clocks = 36 + random.below(random.coin() ? 2 : 30);
    }
    in.p = p;
    --clocks;
  }

  VelocityEstimator<Fixed> law{design()};
  Clocked<VelocityEstimator<Fixed>> block;
  SpanMeter meter{design(), 14};
  SpanMeter::State spans;
  std::vector<std::uint32_t> stamps = std::vector<std::uint32_t>(meter.places);
  decltype(In::p) p;
  std::int64_t left = 0, next = 0, per_count = 1, clocks = 0;
  int position = 0, direction = 1;
  bool chatters = false;
};

}  // namespace

TEST_CASE("velocity by M/T: RTL and twin, every clock") { lock_step(Twin(), {1'600'000}); }
