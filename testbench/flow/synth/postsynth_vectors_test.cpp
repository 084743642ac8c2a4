// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The ECP5 netlist of the core on the vectors of the lock-step test: the same outputs as the twin,
// which runs armed through all scenes there, where random pins hardly ever arm. docs/synthesis.md
#include <Vpair.h>

#include <cstdint>
#include <iostream>
#include <memory>
#include <set>
#include <string>

#include "../../core/feltgate_core/core_stimulus.hpp"
#include "catch.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/lever.hpp"
#include "mismatch.hpp"
#include "pair_ports.hpp"
#include "twins.hpp"

namespace {

using feltgate::CoreIn;
using feltgate::CoreOut;
using D = feltgate::Lever;

void set_inputs(Vpair& pair, const CoreIn& in) {
  const auto put = [&pair](const char* name, auto value) {
    feltgate::test::set_input(pair.in_i, name, static_cast<std::uint64_t>(value));
  };
  put("enc_a_i", in.encoder.a);
  put("enc_b_i", in.encoder.b);
  put("enc_z_i", in.encoder.z);
  put("encoder_data_i", in.encoder_data);
  put("hall_i", in.hall);
  put("current_data_i", in.current_data);
  put("driver_fault_i", in.driver_fault);
  put("arm_i", in.arm);
  put("stop_i", in.stop);
  put("set_zero_i", in.set_zero);
  put("scene_i", in.scene);
  put("law_torque_i", in.law_torque);
  put("law_late_i", in.law_late);
  put("law_restart_i", in.law_restart);
  put("axis_fault_i", in.axis_fault);
  put("axis_silent_i", in.axis_silent);
  put("axis_blocked_i", in.axis_blocked);
  put("axis_testing_i", in.axis_testing);
  put("axis_waits_i", in.axis_waits);
  put("reg_write_i", in.reg_write);
  put("reg_addr_i", in.reg_addr);
  put("reg_wdata_i", in.reg_wdata);
}

/// The first output of the netlist that is not the twin's, or "".
std::string difference(const Vpair& pair, const feltgate::test::CoreOf<D>& twin, const CoreIn& in) {
  const CoreOut& out = twin.out();
  std::string found;
  const auto same = [&](const char* name, std::int64_t expected) {
    if (!found.empty()) return;
    const Field& f = feltgate::test::named(kFields, name);
    for (int k = 0; k < f.width; ++k) {
      const auto wanted = static_cast<std::uint64_t>(expected) >> k & 1u;
      if (feltgate::test::port_bit(pair.netlist_o, f.first + k) != wanted) {
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
  same("arm_request_o", twin.arm_request(in));
  same("ready_o", twin.ready());
  same("testing_o", twin.testing());
  same("measured_o", twin.measured());
  same("zeroed_o", twin.zeroed());
  return found;
}

}  // namespace

TEST_CASE("post-synthesis: the netlist does on the core's vectors what the twin does") {
  const std::int64_t clocks = feltgate::test::scaled_clocks(120'000);
  std::int64_t armed = 0;
  std::set<int> scenes;
  for (const std::uint64_t seed : {9u, 21u}) {
    const auto pair = std::make_unique<Vpair>();
    feltgate::test::CoreOf<D> twin;
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
      set_inputs(*pair, in);
      pair->clk_i = 0;
      pair->eval();
      feltgate::test::set_input(pair->in_i, "stop_i",
                                0);  // seen since the last edge, and not after this one
      pair->clk_i = 1;
      pair->eval();
      twin.clock(in);
      armed += twin.out().armed;
      if (twin.out().armed) scenes.insert(twin.out().scene);
      const std::string found = difference(*pair, twin, in);
      if (!found.empty())
        FAIL("mismatch at clock " << clock << ", signal " << found << " (seed " << seed << ")");
    }
  }
  std::cout << "the netlist on 2 x " << clocks << " clocks of vectors, 0 mismatches; armed in "
            << armed << ", in " << scenes.size() << " scenes\n";
  REQUIRE(armed > clocks / 5);
  REQUIRE(scenes.size() >= 3);
}
