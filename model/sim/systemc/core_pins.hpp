// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The ports of the core in SystemC, written once: names and types are those of `verilator --sc`, so
// that the twin and the Verilated core take each other's place. Documentation: docs/library.md
#pragma once

#include <cstdint>
#include <string>
#include <systemc>
#include <type_traits>

#include "feltgate/core_ports.hpp"

/// X(type, name) for every port but clk_i and rst_ni. Signed numbers are two's complement words in
/// the low bits; of current_data_i bit n is the line of modulator n.
#define FELTGATE_CORE_INPUTS(X)    \
  X(bool, enc_a_i)                 \
  X(bool, enc_b_i)                 \
  X(bool, enc_z_i)                 \
  X(bool, encoder_data_i)          \
  X(std::uint32_t, hall_i)         \
  X(std::uint32_t, current_data_i) \
  X(bool, driver_fault_i)          \
  X(bool, arm_i)                   \
  X(bool, stop_i)                  \
  X(bool, set_zero_i)              \
  X(std::uint32_t, scene_i)        \
  X(std::uint32_t, law_torque_i)   \
  X(bool, law_late_i)              \
  X(bool, law_restart_i)           \
  X(bool, axis_fault_i)            \
  X(bool, axis_silent_i)           \
  X(bool, axis_blocked_i)          \
  X(bool, axis_testing_i)          \
  X(bool, axis_waits_i)            \
  X(std::uint32_t, reg_addr_i)     \
  X(std::uint32_t, reg_wdata_i)    \
  X(bool, reg_write_i)
#define FELTGATE_CORE_OUTPUTS(X)  \
  X(bool, gate_a_hi_o)            \
  X(bool, gate_a_lo_o)            \
  X(bool, gate_b_hi_o)            \
  X(bool, gate_b_lo_o)            \
  X(bool, gate_c_hi_o)            \
  X(bool, gate_c_lo_o)            \
  X(bool, encoder_select_no)      \
  X(bool, encoder_clock_o)        \
  X(bool, encoder_command_o)      \
  X(bool, current_clock_o)        \
  X(std::uint32_t, current_o)     \
  X(bool, heartbeat_o)            \
  X(bool, arm_request_o)          \
  X(bool, ready_o)                \
  X(bool, testing_o)              \
  X(bool, measured_o)             \
  X(bool, zeroed_o)               \
  X(bool, reg_busy_o)             \
  X(std::uint32_t, reg_rdata_o)   \
  X(bool, snapshot_valid_o)       \
  X(std::uint32_t, tick_count_o)  \
  X(std::uint32_t, position_o)    \
  X(CoreWord<D>, velocity_o)      \
  X(std::uint32_t, tau_hat_o)     \
  X(std::uint32_t, tau_ref_o)     \
  X(std::uint32_t, current_ref_o) \
  X(std::uint32_t, voltage_o)     \
  X(std::uint32_t, duty_o)        \
  X(std::uint32_t, scene_o)       \
  X(std::uint32_t, limits_o)      \
  X(std::uint32_t, faults_o)      \
  X(std::uint32_t, first_fault_o) \
  X(bool, armed_o)                \
  X(std::uint32_t, duty_active_o) \
  X(bool, gates_enable_o)         \
  X(bool, word_valid_o)           \
  X(std::uint32_t, word_slot_o)   \
  X(std::uint32_t, word_data_o)

namespace feltgate::systemc {

/// The word of the velocity: the one signal that may have more than 32 bits.
template <class D>
using CoreWord = std::conditional_t<(D::f.velocity.width() > 32), std::uint64_t, std::uint32_t>;

/// Signals at the inputs of a core, which several may share.
struct CoreInputs : sc_core::sc_module {
  explicit CoreInputs(const sc_core::sc_module_name& name) : sc_module(name) {}

  sc_core::sc_signal<bool> rst_ni{"rst_ni", true};  ///< the twin needs no reset, the RTL does
#define FELTGATE_SIGNAL(type, name) sc_core::sc_signal<type> name{#name};
  FELTGATE_CORE_INPUTS(FELTGATE_SIGNAL)
};

/// Signals at the outputs of one core of design D.
template <class D>
struct CoreOutputs : sc_core::sc_module {
  explicit CoreOutputs(const sc_core::sc_module_name& name) : sc_module(name) {}

  FELTGATE_CORE_OUTPUTS(FELTGATE_SIGNAL)
#undef FELTGATE_SIGNAL

  /// Name of the first output in which the other differs now, nullptr if none does.
  const char* difference(const CoreOutputs& other) const {
#define FELTGATE_DIFFERS(type, name) \
  if (name.read() != other.name.read()) return #name;
    FELTGATE_CORE_OUTPUTS(FELTGATE_DIFFERS)
#undef FELTGATE_DIFFERS
    return nullptr;
  }

  /// Writes every output into a waveform, as PREFIX.NAME.
  void trace(sc_core::sc_trace_file* file, const std::string& prefix) const {
#define FELTGATE_TRACE(type, name) sc_core::sc_trace(file, name, prefix + "." + #name);
    FELTGATE_CORE_OUTPUTS(FELTGATE_TRACE)
#undef FELTGATE_TRACE
  }
};

/// Connects a TwinModule<D> or the Verilated core of D.
template <class D, class Module>
void bind(Module& core, sc_core::sc_in<bool>::in_if_type& clk, CoreInputs& in,
          CoreOutputs<D>& out) {
  core.clk_i(clk);
  core.rst_ni(in.rst_ni);
#define FELTGATE_BIND(type, name) core.name(in.name);
  FELTGATE_CORE_INPUTS(FELTGATE_BIND)
#undef FELTGATE_BIND
#define FELTGATE_BIND(type, name) core.name(out.name);
  FELTGATE_CORE_OUTPUTS(FELTGATE_BIND)
#undef FELTGATE_BIND
}

/// Clock and signals of one core on its own.
template <class D>
struct Board : sc_core::sc_module {
  explicit Board(const sc_core::sc_module_name& name)
      : sc_module(name), clk("clk", 1e9 / static_cast<double>(D::clock_hz), sc_core::SC_NS) {}
  /// A TwinModule<D>, the Verilated core of D or a MotorModule.
  template <class Module>
  void connect(Module& module) {
    bind(module, clk, in, out);
  }

  sc_core::sc_clock clk;
  CoreInputs in{"in"};
  CoreOutputs<D> out{"out"};
};

}  // namespace feltgate::systemc
