// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core with many seeds: a hundred random runs against the twin, and one run from twenty random
// initial states of the registers. Documentation: docs/testing.md
#include <array>
#include <cstdint>
#include <iostream>
#include <set>
#include <vector>

#include "catch.hpp"
#include "core_adapter.hpp"
#include "core_stimulus.hpp"
#include "sim/backends/rtl_model.hpp"

using feltgate::RtlModel;
using feltgate::test::CoreBench;
using feltgate::test::CoreStimulus;
using feltgate::test::Design;
using feltgate::test::scaled_clocks;

namespace {

/// Returns a hash of the outputs.
std::uint64_t outputs(const Vfeltgate_core& rtl) {
  std::uint64_t hash = 0;
  for (const std::uint64_t port : std::array<std::uint64_t, 25>{
           rtl.tick_count_o,  rtl.position_o,     rtl.velocity_o,       rtl.tau_hat_o,
           rtl.tau_ref_o,     rtl.current_ref_o,  rtl.voltage_o,        rtl.duty_o,
           rtl.duty_active_o, rtl.gate_a_hi_o,    rtl.gate_a_lo_o,      rtl.gate_b_hi_o,
           rtl.gate_b_lo_o,   rtl.scene_o,        rtl.limits_o,         rtl.faults_o,
           rtl.first_fault_o, rtl.armed_o,        rtl.snapshot_valid_o, rtl.reg_busy_o,
           rtl.reg_rdata_o,   rtl.gates_enable_o, rtl.word_valid_o,     rtl.word_slot_o,
           rtl.word_data_o}) {
    hash = (hash ^ port) * 0x9e3779b97f4a7c15U;
    hash ^= hash >> 29;
  }
  return hash;
}

}  // namespace

TEST_CASE("core: a hundred seeds", "[seeds]") {
  constexpr std::uint64_t seeds = 100;
  const std::int64_t clocks = scaled_clocks(10'000);
  std::int64_t total = 0;
  std::int64_t armed = 0;
  std::set<int> scenes;
  for (std::uint64_t seed = 1'000; seed < 1'000 + seeds; ++seed) {
    CoreBench bench("feltgate_core", seed);
    bench.run(CoreStimulus<Design>(seed), clocks, {1'000'000},
              [&](const auto&, const auto&, const auto& twin, bool) -> const char* {
                armed += twin.out().armed;
                if (twin.out().armed) scenes.insert(twin.out().scene);
                return nullptr;
              });
    total += bench.total_clocks();
    if (clocks > 1'000'000)
      std::cout << "seed " << seed << ": " << total << " clocks, 0 mismatches" << std::endl;
  }
  REQUIRE(total == static_cast<std::int64_t>(seeds) * clocks);
  CHECK(armed > total / 100);
  CHECK(scenes.size() > 4);
  std::cout << total << " clocks over " << seeds << " seeds, 0 mismatches; armed in " << armed
            << ", in " << scenes.size() << " scenes"
            << "\n";
}

TEST_CASE("core: what the registers are born with is forgotten by a reset", "[initial]") {
  constexpr std::uint64_t states = 20;
  constexpr int clocks = 60'000;
  std::vector<std::uint64_t> first;
  std::set<std::uint64_t> born;
  for (std::uint64_t seed = 1; seed <= states; ++seed) {
    CAPTURE(seed);
    RtlModel<Vfeltgate_core> rtl(seed);
    born.insert(outputs(*rtl));
    // The gates are off at power-up for every initial state of the other registers.
    REQUIRE((rtl->gate_a_hi_o | rtl->gate_a_lo_o | rtl->gate_b_hi_o | rtl->gate_b_lo_o) == 0);
    rtl.reset(4);
    CoreStimulus<Design> stimulus(9);
    std::vector<std::uint64_t> now;
    now.reserve(clocks);
    for (int k = 0; k < clocks; ++k) {
      feltgate::test::CoreAdapter::drive(*rtl, stimulus(k));
      rtl.low();
      feltgate::test::CoreAdapter::at_edge(*rtl);
      rtl.high();
      now.push_back(outputs(*rtl));
    }
    if (first.empty()) first = now;
    REQUIRE(now == first);
  }
  REQUIRE(born.size() == states);  // all initial states must differ, or the random fill failed
  REQUIRE(std::set<std::uint64_t>(first.begin(), first.end()).size() > clocks / 1000);
}
