// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Each lane of a batch against a chain of its own: every result of every tick, lanes with counts
// and parameter words of their own. Documentation: docs/engines.md
#include "batch/batch_chain.hpp"

#include <memory>
#include <vector>

#include "catch.hpp"
#include "chain_life.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/paper.hpp"

namespace {

using namespace feltgate;
using namespace feltgate::test;

template <class D, int Lanes>
ChainResults results_of_lane(const BatchLanes<D, Lanes>& b, std::size_t k) {
  return {b.velocity[k],      b.tau_hat[k],       b.tau_ref[k],      b.current[k],
          b.voltage[k],       b.duty[k],          b.limit_torque[k], b.limit_ramp[k],
          b.limit_current[k], b.limit_voltage[k], b.limit_duty[k],   b.limit_velocity[k],
          b.limit_tau_hat[k]};
}

template <class D, int Lanes>
void compare(std::uint64_t seed, long ticks) {
  auto batch = std::make_unique<BatchChain<D, Lanes>>();
  std::vector<std::unique_ptr<Laws<D, Fixed>>> laws;
  std::vector<ChainLife<D>> lives;
  for (int k = 0; k < Lanes; ++k) {
    laws.push_back(std::make_unique<Laws<D, Fixed>>());
    lives.emplace_back(seed + static_cast<std::uint64_t>(k));
  }
  ChainComparison seen;
  for (long tick = 0; tick < ticks && seen.first_divergence.empty(); ++tick) {
    for (int k = 0; k < Lanes; ++k) {
      const auto lane = static_cast<std::size_t>(k);
      if (const auto word = lives[lane].next()) {
        laws[lane]->write(word->address, word->data);
        batch->set_word(k, word->address, word->data);
      }
      const ChainIn& in = lives[lane].in();
      batch->set_counts(k, in.position, in.travel);
    }
    // The life of lane 0 arms and changes the scene for all.
    const ChainIn common = lives[0].in();
    if (common.restart) batch->restart();
    batch->tick(common.armed, common.scene, static_cast<Mode>(common.mode));
    for (std::size_t k = 0; k < Lanes; ++k) {
      ChainIn in = lives[k].in();
      in.armed = common.armed;
      in.scene = common.scene;
      in.mode = common.mode;
      in.restart = common.restart;
      const ChainResults x = laws[k]->tick(in), y = results_of_lane(batch->results(), k);
      for (std::size_t s = 0; s < chain_results; ++s) {
        seen.seen[s] += x[s] != 0 ? 1 : 0;
        if (x[s] == y[s] || !seen.first_divergence.empty()) continue;
        seen.first_divergence = "lane " + std::to_string(k) + ", tick " + std::to_string(tick) +
                                ", " + chain_result_names[s] + ": " + std::to_string(x[s]) +
                                " alone, " + std::to_string(y[s]) + " in the batch";
      }
    }
  }
  INFO(seen.first_divergence);
  CHECK(seen.first_divergence.empty());
  CHECK(not_exercised(seen, ticks * Lanes).empty());
}

}  // namespace

TEST_CASE("each lane of a batch of lever is a chain of its own") {
  compare<Lever, 32>(71, 120'000);
}

TEST_CASE("each lane of a batch of paper is a chain of its own") { compare<Paper, 8>(72, 120'000); }
