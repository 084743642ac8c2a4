// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Ports of the Verilated axes against their twin, AXES of them. Documentation:
// docs/blocks/feltgate_axes.md
#pragma once

#include <Vfeltgate_axes.h>

#include <string>
#include <type_traits>

#include "engines/rtl_ports.hpp"
#include "feltgate/feltgate_axes.hpp"
#include "feltgate/generated/lever_law.hpp"
#include "lock_step.hpp"

namespace feltgate::test {

using Design = LeverLaw;
constexpr int kAxes = AXES;
constexpr bool kEngine = ENGINE != 0;
using AxesTwin = FeltgateAxes<Design, kAxes, true, kEngine>;

/// Bits [first, first + width) of a port, however Verilator keeps it; width up to 33.
template <class Port>
std::uint64_t bits_of(const Port& port, int first, int width) {
  std::uint64_t word = 0;
  if constexpr (std::is_integral<Port>::value) {
    word = static_cast<std::uint64_t>(port) >> first;
  } else {
    word = std::uint64_t{port[first / 32]} >> first % 32;
    if (first % 32 + width > 32) {
      word |= std::uint64_t{port[first / 32 + 1]} << (32 - first % 32);
    }
  }
  return word & ((std::uint64_t{1} << width) - 1);
}
template <class Port>
void set_bits(Port& port, int first, int width, std::uint64_t value) {
  for (int k = 0; k < width; ++k) {
    const int at = first + k;
    const std::uint64_t bit = value >> k & 1u;
    if constexpr (std::is_integral<Port>::value) {
      const std::uint64_t mask = std::uint64_t{1} << at;
      port = static_cast<Port>((static_cast<std::uint64_t>(port) & ~mask) | bit << at);
    } else {
      const std::uint32_t mask = 1u << at % 32;
      port[at / 32] = (port[at / 32] & ~mask) | static_cast<std::uint32_t>(bit << at % 32);
    }
  }
}

struct AxesAdapter {
  static constexpr int kTorque = Design::f.torque.width();

  static void drive(Vfeltgate_axes& rtl, const AxesIn<kAxes>& in) {
    for (int n = 0; n < kAxes; ++n) {
      const auto& axis = in.axis[static_cast<std::size_t>(n)];
      set_bits(rtl.enc_a_i, n, 1, axis.encoder.a);
      set_bits(rtl.enc_b_i, n, 1, axis.encoder.b);
      set_bits(rtl.enc_z_i, n, 1, axis.encoder.z);
      set_bits(rtl.set_zero_i, n, 1, axis.set_zero);
      set_bits(rtl.scene_i, 4 * n, 4, axis.scene);
      set_bits(rtl.law_torque_i, kTorque * n, kTorque, static_cast<std::uint64_t>(axis.law_torque));
    }
    rtl.arm_i = in.arm;
    rtl.stop_i = in.stop;
    rtl.law_late_i = in.law_late;
    rtl.law_restart_i = in.law_restart;
    rtl.reg_addr_i = in.reg_addr;
    rtl.reg_wdata_i = in.reg_wdata;
    rtl.reg_write_i = in.reg_write;
    rtl.reg_read_i = in.reg_read;
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
    check("tick_count", rtl.tick_count_o, first.tick_count);
    check("snapshot_valid", rtl.snapshot_valid_o, first.snapshot_valid);
    check("word_valid", rtl.word_valid_o, first.word_valid);
    check("word_slot", rtl.word_slot_o, first.word_slot);
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
