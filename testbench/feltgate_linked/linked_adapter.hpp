// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The linked core of a test's design; connects its ports to the twin's. Documentation:
// docs/blocks/feltgate_linked.md
#pragma once

#include <Vfeltgate_linked.h>

#include "encoder_phase.hpp"
#include "feltgate_linked_twin.hpp"
#include "lock_step.hpp"
#ifdef LAW
#include "feltgate/generated/lever_law.hpp"
#else
#include "feltgate/generated/lever.hpp"
#endif

namespace feltgate::test {

#ifdef LAW
using D = LeverLaw;
#else
using D = Lever;
#endif
using Twin = FeltgateLinked<D, BAUD>;

struct LinkedAdapter {
  static void drive(Vfeltgate_linked& rtl, const LinkedIn& in) {
    rtl.enc_a_i = in.encoder.a;
    rtl.enc_b_i = in.encoder.b;
    rtl.enc_z_i = in.encoder.z;
    rtl.arm_i = in.arm;
    rtl.stop_i = in.stop;
    rtl.set_zero_i = in.set_zero;
    rtl.clear_faults_i = in.clear_faults;
    rtl.scene_i = in.scene;
    rtl.uart_rx_i = in.uart_rx;
    rtl.inputs_i = in.inputs;
  }
  static void at_edge(Vfeltgate_linked& rtl) { rtl.stop_i = 0; }
  template <class Check>
  static void compare(Check& check, const Vfeltgate_linked& rtl, const LinkedOut& out) {
    check("uart_tx", rtl.uart_tx_o, out.uart_tx);
    check("gate_a_hi", rtl.gate_a_hi_o, out.core.gates & 1u);
    check("gate_a_lo", rtl.gate_a_lo_o, (out.core.gates >> 1) & 1u);
    check("gate_b_hi", rtl.gate_b_hi_o, (out.core.gates >> 2) & 1u);
    check("gate_b_lo", rtl.gate_b_lo_o, (out.core.gates >> 3) & 1u);
    check("position", static_cast<std::int32_t>(rtl.position_o), out.core.position);
    check("limits", rtl.limits_o, out.core.limits);
    check("faults", rtl.faults_o, out.core.faults);
    check("first_fault", rtl.first_fault_o, out.core.first_fault);
    check("scene", rtl.scene_o, out.core.scene);
    check("armed", rtl.armed_o, out.core.armed);
    check("gates_enable", rtl.gates_enable_o, out.core.gates_enable);
    check("snapshot_valid", rtl.snapshot_valid_o, out.core.snapshot_valid);
  }
};
using Bench = LockStep<Vfeltgate_linked, Twin, LinkedAdapter>;

}  // namespace feltgate::test
