// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Connects the ports of the Verilated axes to their twin's. AXES is the number of axes.
// Documentation: docs/blocks/feltgate_axes.md
#pragma once

#include <Vfeltgate_axes.h>

#include <string>
#include <type_traits>

#include "feltgate/feltgate_axes.hpp"
#include "feltgate/generated/lever_law.hpp"
#include "feltgate/generated/pantograph_law.hpp"
#include "lock_step.hpp"
#include "ports.hpp"
#include "sim/backends/rtl_axes_ports.hpp"

namespace feltgate::test {

// With the engine, a design whose velocity has fewer bits than the engine's words.
using Design = std::conditional_t<ENGINE != 0, PantographLaw, LeverLaw>;
constexpr int kAxes = AXES;
constexpr bool kEngine = ENGINE != 0;
using AxesTwin = FeltgateAxes<Design, kAxes, true, kEngine>;

struct AxesAdapter {
  static constexpr int kTorque = Design::f.torque.width();

  static void drive(Vfeltgate_axes& rtl, const AxesIn<kAxes>& in) {
    drive_axes<Design>(rtl, in);
    for (int n = 0; n < kAxes; ++n) {
      const auto& axis = in.axis[static_cast<std::size_t>(n)];
      set_bits(rtl.law_torque_i, kTorque * n, kTorque, static_cast<std::uint64_t>(axis.law_torque));
    }
    rtl.law_late_i = in.law_late;
    rtl.law_restart_i = in.law_restart;
  }
  static void at_edge(Vfeltgate_axes& rtl) { rtl.stop_i = 0; }

  template <class Check>
  static void compare(Check& check, const Vfeltgate_axes& rtl, const AxesOut<kAxes>& out) {
    for (int n = 0; n < kAxes; ++n) {
      const CoreOut& o = out.axis[static_cast<std::size_t>(n)];
      const auto word = [&](const char* const(&name)[3], const auto& port, int width,
                            std::uint32_t twin) {
        check(name[n], bits_of(port, n * width, width), std::uint64_t{twin});
      };
      const auto number = [&](const char* const(&name)[3], const auto& port, Format f,
                              std::int64_t twin) {
        check(name[n], feltgate::sign_extend(bits_of(port, n * f.width(), f.width()), f.width()),
              twin);
      };
      using C = Map::C;
#define FELTGATE_OF_AXIS(name) {name " of axis 0", name " of axis 1", name " of axis 2"}
      word(FELTGATE_OF_AXIS("position"), rtl.position_o, 32,
           static_cast<std::uint32_t>(o.position));
      number(FELTGATE_OF_AXIS("velocity"), rtl.velocity_o, Design::f.velocity, o.velocity);
      number(FELTGATE_OF_AXIS("tau_hat"), rtl.tau_hat_o, Design::f.torque, o.tau_hat);
      number(FELTGATE_OF_AXIS("tau_ref"), rtl.tau_ref_o, Design::f.torque, o.tau_ref);
      number(FELTGATE_OF_AXIS("current_ref"), rtl.current_ref_o, Design::f.current, o.current_ref);
      number(FELTGATE_OF_AXIS("voltage"), rtl.voltage_o, Design::f.voltage, o.voltage);
      number(FELTGATE_OF_AXIS("duty"), rtl.duty_o, Design::f.duty, o.duty);
      number(FELTGATE_OF_AXIS("duty_active"), rtl.duty_active_o, Design::f.duty, o.duty_active);
      word(FELTGATE_OF_AXIS("gate_a_hi"), rtl.gate_a_hi_o, 1, o.gates & 1u);
      word(FELTGATE_OF_AXIS("gate_a_lo"), rtl.gate_a_lo_o, 1, o.gates >> 1 & 1u);
      word(FELTGATE_OF_AXIS("gate_b_hi"), rtl.gate_b_hi_o, 1, o.gates >> 2 & 1u);
      word(FELTGATE_OF_AXIS("gate_b_lo"), rtl.gate_b_lo_o, 1, o.gates >> 3 & 1u);
      word(FELTGATE_OF_AXIS("gate_c_hi"), rtl.gate_c_hi_o, 1, o.gates >> 4 & 1u);
      word(FELTGATE_OF_AXIS("gate_c_lo"), rtl.gate_c_lo_o, 1, o.gates >> 5 & 1u);
      word(FELTGATE_OF_AXIS("encoder_select_n"), rtl.encoder_select_no, 1, o.serial & 1u);
      word(FELTGATE_OF_AXIS("encoder_clock"), rtl.encoder_clock_o, 1, o.serial >> 1 & 1u);
      word(FELTGATE_OF_AXIS("encoder_command"), rtl.encoder_command_o, 1, o.serial >> 2 & 1u);
      word(FELTGATE_OF_AXIS("gates_enable"), rtl.gates_enable_o, 1, o.gates_enable);
      word(FELTGATE_OF_AXIS("scene"), rtl.scene_o, 4, o.scene);
      word(FELTGATE_OF_AXIS("limits"), rtl.limits_o, C::status_limits_width, o.limits);
      word(FELTGATE_OF_AXIS("faults"), rtl.faults_o, C::faults_seen_width, o.faults);
      word(FELTGATE_OF_AXIS("first_fault"), rtl.first_fault_o, C::faults_first_width,
           o.first_fault);
      word(FELTGATE_OF_AXIS("armed"), rtl.armed_o, 1, o.armed);
      word(FELTGATE_OF_AXIS("word_data"), rtl.word_data_o, 32, o.word_data);
#undef FELTGATE_OF_AXIS
    }
    const CoreOut& first = out.axis[0];
    FELTGATE_COMPARE(check, rtl, first, tick_count, snapshot_valid, word_valid, word_slot);
    check("reg_busy", rtl.reg_busy_o, out.reg_busy);
    if (out.rdata_known) check("reg_rdata", rtl.reg_rdata_o, out.reg_rdata);
    check("event_valid", rtl.event_valid_o, out.event_valid);
    if (!out.event_valid) return;
    check("event_number", rtl.event_number_o, out.event_number);
    check("event_value", rtl.event_value_o, static_cast<std::uint32_t>(out.event_value));
  }
};

using AxesBench = LockStep<Vfeltgate_axes, AxesTwin, AxesAdapter>;

}  // namespace feltgate::test
