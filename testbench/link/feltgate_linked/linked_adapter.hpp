// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The linked core of a test's design; connects its ports to the twin's. Documentation:
// docs/link.md
#pragma once

#include <Vfeltgate_linked.h>

#include "encoder_phase.hpp"
#include "feltgate_linked_twin.hpp"
#include "lock_step.hpp"
#include "ports.hpp"
#if defined(LAW)
#include "feltgate/generated/lever_law.hpp"
#elif defined(CURRENT)
#include "feltgate/generated/lever_current.hpp"
#elif defined(ABSOLUTE)
#include "feltgate/generated/lever_absolute.hpp"
#elif defined(GIMBAL_MOTOR)
#include "feltgate/generated/gimbal_motor.hpp"
#elif defined(GIMBAL_CURRENT)
#include "feltgate/generated/gimbal_current.hpp"
#elif defined(HALL_MOTOR)
#include "feltgate/generated/hall_motor.hpp"
#else
#include "feltgate/generated/lever.hpp"
#endif

namespace feltgate::test {

#if defined(LAW)
using D = LeverLaw;
#elif defined(CURRENT)
using D = LeverCurrent;
#elif defined(ABSOLUTE)
using D = LeverAbsolute;
#elif defined(GIMBAL_MOTOR)
using D = GimbalMotor;
#elif defined(GIMBAL_CURRENT)
using D = GimbalCurrent;
#elif defined(HALL_MOTOR)
using D = HallMotor;
#else
using D = Lever;
#endif
using Twin = FeltgateLinked<D, BAUD>;

struct LinkedAdapter {
  static void drive(Vfeltgate_linked& rtl, const LinkedIn& in) {
    rtl.enc_a_i = in.encoder.a;
    rtl.enc_b_i = in.encoder.b;
    rtl.enc_z_i = in.encoder.z;
    FELTGATE_DRIVE(rtl, in, encoder_data, current_data, driver_fault, hall, arm, stop, set_zero);
    FELTGATE_DRIVE(rtl, in, clear_faults, scene, uart_rx, inputs);
  }
  static void at_edge(Vfeltgate_linked& rtl) { rtl.stop_i = 0; }
  template <class Check>
  static void compare(Check& check, const Vfeltgate_linked& rtl, const LinkedOut& out) {
    check("uart_tx", rtl.uart_tx_o, out.uart_tx);
    check("gate_a_hi", rtl.gate_a_hi_o, out.core.gates & 1u);
    check("gate_a_lo", rtl.gate_a_lo_o, (out.core.gates >> 1) & 1u);
    check("gate_b_hi", rtl.gate_b_hi_o, (out.core.gates >> 2) & 1u);
    check("gate_b_lo", rtl.gate_b_lo_o, (out.core.gates >> 3) & 1u);
    check("gate_c_hi", rtl.gate_c_hi_o, (out.core.gates >> 4) & 1u);
    check("gate_c_lo", rtl.gate_c_lo_o, (out.core.gates >> 5) & 1u);
    check("encoder_select_n", rtl.encoder_select_no, out.core.serial & 1u);
    check("encoder_clock", rtl.encoder_clock_o, (out.core.serial >> 1) & 1u);
    check("encoder_command", rtl.encoder_command_o, (out.core.serial >> 2) & 1u);
    check("position", static_cast<std::int32_t>(rtl.position_o), out.core.position);
    FELTGATE_COMPARE(check, rtl, out.core, current_clock, heartbeat);
    FELTGATE_COMPARE(check, rtl, out.core, limits, faults, first_fault, scene, armed, gates_enable,
                     snapshot_valid);
  }
};
using Bench = LockStep<Vfeltgate_linked, Twin, LinkedAdapter>;

}  // namespace feltgate::test
