// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Connects the core's ports to the lock-step: every output, RTL against twin. Documentation:
// docs/testing.md
#pragma once

#include <cstdint>

#include "Vfeltgate_core.h"
#include "feltgate/design_info.hpp"
#include "feltgate/feltgate_core.hpp"
#include "lock_step.hpp"
#include "ports.hpp"
#include "random.hpp"
#include "sim/backends/rtl_ports.hpp"
#include "twins.hpp"

#ifndef FELTGATE_DESIGN
#define FELTGATE_DESIGN Lever
#include "feltgate/generated/lever.hpp"
#elif defined FELTGATE_DESIGN_HEADER
#include FELTGATE_DESIGN_HEADER
#else
#include "feltgate/generated/paper.hpp"
#endif

namespace feltgate::test {

using Design = FELTGATE_DESIGN;
using CoreTwin = test::CoreOf<Design>;
constexpr bool kPrograms = test::scene_built<Design>(Map::S::law);

struct CoreAdapter {
  static void drive(Vfeltgate_core& rtl, const CoreIn& in) {
    drive_inputs(rtl, feltgate::test::port_bits<Design>(), in);
  }
  static void at_edge(Vfeltgate_core& rtl) { rtl.stop_i = 0; }
  template <class Check>
  static void compare(Check& check, const Vfeltgate_core& rtl, const CoreOut& out) {
    check("tick_count", rtl.tick_count_o, out.tick_count);
    check("position", static_cast<std::int32_t>(rtl.position_o), out.position);
    check("velocity", sign_extend<Design::f.velocity.width()>(rtl.velocity_o), out.velocity);
    check("tau_hat", sign_extend<Design::f.torque.width()>(rtl.tau_hat_o), out.tau_hat);
    check("tau_ref", sign_extend<Design::f.torque.width()>(rtl.tau_ref_o), out.tau_ref);
    check("current_ref", sign_extend<Design::f.current.width()>(rtl.current_ref_o),
          out.current_ref);
    check("voltage", sign_extend<Design::f.voltage.width()>(rtl.voltage_o), out.voltage);
    check("duty", sign_extend<Design::f.duty.width()>(rtl.duty_o), out.duty);
    check("duty_active", sign_extend<Design::f.duty.width()>(rtl.duty_active_o), out.duty_active);
    check("gate_a_hi", rtl.gate_a_hi_o, out.gates & 1u);
    check("gate_a_lo", rtl.gate_a_lo_o, (out.gates >> 1) & 1u);
    check("gate_b_hi", rtl.gate_b_hi_o, (out.gates >> 2) & 1u);
    check("gate_b_lo", rtl.gate_b_lo_o, (out.gates >> 3) & 1u);
    check("gate_c_hi", rtl.gate_c_hi_o, (out.gates >> 4) & 1u);
    check("gate_c_lo", rtl.gate_c_lo_o, (out.gates >> 5) & 1u);
    check("encoder_select_n", rtl.encoder_select_no, out.serial & 1u);
    check("encoder_clock", rtl.encoder_clock_o, (out.serial >> 1) & 1u);
    check("encoder_command", rtl.encoder_command_o, (out.serial >> 2) & 1u);
    check("current", sign_extend<Design::f.current.width()>(rtl.current_o), out.current);
    check("current_clock", rtl.current_clock_o, out.current_clock);
    check("heartbeat", rtl.heartbeat_o, out.heartbeat);
    FELTGATE_COMPARE(check, rtl, out, gates_enable, scene, limits, faults, first_fault, armed,
                     snapshot_valid, reg_busy, reg_rdata, word_valid, word_slot, word_data);
  }
};

using CoreBench = LockStep<Vfeltgate_core, CoreTwin, CoreAdapter>;

}  // namespace feltgate::test
