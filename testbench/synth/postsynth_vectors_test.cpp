// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The ECP5 netlist of the core on the vectors of the lock-step test: the same outputs as the twin,
// which runs armed through all scenes there, where random pins hardly ever arm. docs/synthesis.md
#include <Vpair.h>

#include <cstdint>
#include <cstring>
#include <iostream>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>

#include "../feltgate_core/core_stimulus.hpp"
#include "catch.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/lever.hpp"
#include "mismatch.hpp"
#include "pair_fields.hpp"

namespace {

using feltgate::CoreIn;
using feltgate::CoreOut;
using D = feltgate::Lever;

static_assert(kInputBits <= 64, "the inputs are one integer in Verilator's class");

template <int N>
const Field& named(const Field (&fields)[N], const char* name) {
  for (const Field& f : fields) {
    if (std::strcmp(f.name, name) == 0) return f;
  }
  throw std::runtime_error(name);
}

std::uint64_t word_of(const CoreIn& in) {
  std::uint64_t word = 0;
  const auto put = [&word](const char* name, std::uint64_t value) {
    const Field& f = named(kInputs, name);
    word |= (value & ((std::uint64_t{1} << f.width) - 1)) << f.first;
  };
  put("enc_a_i", in.encoder.a);
  put("enc_b_i", in.encoder.b);
  put("enc_z_i", in.encoder.z);
  put("arm_i", in.arm);
  put("stop_i", in.stop);
  put("set_zero_i", in.set_zero);
  put("scene_i", in.scene);
  put("reg_write_i", in.reg_write);
  put("reg_addr_i", in.reg_addr);
  put("reg_wdata_i", in.reg_wdata);
  return word;
}

/// The first output of the netlist that is not the twin's, or "".
std::string difference(const Vpair& pair, const CoreOut& out) {
  std::string found;
  const auto same = [&](const char* name, std::int64_t expected) {
    if (!found.empty()) return;
    const Field& f = named(kFields, name);
    for (int k = 0; k < f.width; ++k) {
      const auto n = static_cast<unsigned>(f.first + k);
      const auto wanted = static_cast<std::uint64_t>(expected) >> k & 1u;
      if ((pair.netlist_o[n / 32] >> n % 32 & 1u) != wanted) {
        found = std::string(name) + "[" + std::to_string(k) + "]";
        return;
      }
    }
  };
  same("tick_count_o", out.tick_count);
  same("position_o", out.position);
  same("velocity_o", out.velocity);
  same("tau_hat_o", out.tau_hat);
  same("tau_ref_o", out.tau_ref);
  same("current_ref_o", out.current_ref);
  same("voltage_o", out.voltage);
  same("duty_o", out.duty);
  same("duty_active_o", out.duty_active);
  same("gate_a_hi_o", out.gates & 1u);
  same("gate_a_lo_o", out.gates >> 1 & 1u);
  same("gate_b_hi_o", out.gates >> 2 & 1u);
  same("gate_b_lo_o", out.gates >> 3 & 1u);
  same("gates_enable_o", out.gates_enable);
  same("scene_o", out.scene);
  same("limits_o", out.limits);
  same("faults_o", out.faults);
  same("first_fault_o", out.first_fault);
  same("armed_o", out.armed);
  same("snapshot_valid_o", out.snapshot_valid);
  same("reg_busy_o", out.reg_busy);
  same("reg_rdata_o", out.reg_rdata);
  same("word_valid_o", out.word_valid);
  same("word_slot_o", out.word_slot);
  same("word_data_o", out.word_data);
  return found;
}

}  // namespace

TEST_CASE("post-synthesis: the netlist does on the core's vectors what the twin does") {
  const std::int64_t clocks = feltgate::test::scaled_clocks(120'000);
  const std::uint64_t stop = std::uint64_t{1} << named(kInputs, "stop_i").first;
  std::int64_t armed = 0;
  std::set<int> scenes;
  for (const std::uint64_t seed : {9u, 21u}) {
    const auto pair = std::make_unique<Vpair>();
    feltgate::FeltgateCore<D> twin;
    feltgate::test::CoreStimulus<D> stimulus(seed);
    twin.reset();
    pair->rst_ni = 1;
    pair->eval();
    for (int k = 0; k < 4; ++k) {
      pair->rst_ni = 0;
      pair->clk_i = 0;
      pair->eval();
      pair->clk_i = 1;
      pair->eval();
    }
    pair->rst_ni = 1;
    for (std::int64_t clock = 0; clock < clocks; ++clock) {
      const CoreIn in = stimulus(clock);
      pair->in_i = word_of(in);
      pair->clk_i = 0;
      pair->eval();
      pair->in_i &= ~stop;  // seen since the last edge, and not after this one
      pair->clk_i = 1;
      pair->eval();
      twin.clock(in);
      armed += twin.out().armed;
      if (twin.out().armed) scenes.insert(twin.out().scene);
      const std::string found = difference(*pair, twin.out());
      if (!found.empty())
        FAIL("mismatch at clock " << clock << ", signal " << found << " (seed " << seed << ")");
    }
  }
  std::cout << "the netlist on 2 x " << clocks << " clocks of vectors, 0 mismatches; armed in "
            << armed << ", in " << scenes.size() << " scenes\n";
  REQUIRE(armed > clocks / 5);
  REQUIRE(scenes.size() >= 3);
}
