// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The twin of a design as an sc_module with the pins of model/sim/backends/feltgate_core.sv.
// Documentation: docs/library.md
#pragma once

#include <cstdint>

#include "core_pins.hpp"
#include "feltgate/feltgate_core.hpp"

namespace feltgate::systemc {

template <class D>
class TwinModule : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> clk_i{"clk_i"}, rst_ni{"rst_ni"};
#define FELTGATE_PORT(type, name) sc_core::sc_in<type> name{#name};
  FELTGATE_CORE_INPUTS(FELTGATE_PORT)
#undef FELTGATE_PORT
#define FELTGATE_PORT(type, name) sc_core::sc_out<type> name{#name};
  FELTGATE_CORE_OUTPUTS(FELTGATE_PORT)
#undef FELTGATE_PORT

  SC_HAS_PROCESS(TwinModule);
  explicit TwinModule(const sc_core::sc_module_name& name) : sc_module(name) {
    SC_METHOD(react);
    sensitive << clk_i.pos() << rst_ni.neg() << stop_i.pos();
    dont_initialize();
  }

 private:
  void react() {
    if (!rst_ni.read()) {
      core_.reset();
    } else if (clk_i.posedge()) {
      core_.clock(inputs());
    } else {
      // A stop between two clocks counts, and closes the gates without one, as at the RTL's pin.
      stop_seen_ = true;
      CoreOut stopped = core_.out();
      stopped.gates = 0;
      show(stopped);
      return;
    }
    stop_seen_ = stop_i.read();
    show(core_.out());
  }

  CoreIn inputs() const {
    CoreIn in;
    in.encoder = {enc_a_i.read(), enc_b_i.read(), enc_z_i.read()};
    in.encoder_data = encoder_data_i.read();
    in.hall = static_cast<std::uint8_t>(hall_i.read());
    in.current_data = static_cast<std::uint8_t>(current_data_i.read());
    in.driver_fault = driver_fault_i.read();
    in.arm = arm_i.read();
    in.stop = stop_seen_ || stop_i.read();
    in.set_zero = set_zero_i.read();
    in.scene = static_cast<std::uint8_t>(scene_i.read());
    in.reg_addr = static_cast<std::uint16_t>(reg_addr_i.read());
    in.reg_wdata = reg_wdata_i.read();
    in.reg_write = reg_write_i.read();
    in.law_torque = torque(law_torque_i.read());
    in.law_late = law_late_i.read();
    in.law_restart = law_restart_i.read();
    in.axis_fault = axis_fault_i.read();
    in.axis_silent = axis_silent_i.read();
    in.axis_blocked = axis_blocked_i.read();
    in.axis_testing = axis_testing_i.read();
    in.axis_waits = axis_waits_i.read();
    return in;
  }

  /// The low bits of a number, as the RTL's port shows them.
  static std::uint32_t word(std::int64_t raw, Format f) {
    return static_cast<std::uint32_t>(static_cast<std::uint64_t>(raw) &
                                      ((std::uint64_t{1} << f.width()) - 1));
  }

  static std::int32_t torque(std::uint32_t word) {
    const std::uint32_t sign = 1u << (D::f.torque.width() - 1);
    return static_cast<std::int32_t>(((word & (2 * sign - 1)) ^ sign) - sign);
  }

  void show(const CoreOut& o) {
    arm_request_o.write(core_.arm_request(inputs()));
    ready_o.write(core_.ready());
    testing_o.write(core_.testing());
    measured_o.write(core_.measured());
    zeroed_o.write(core_.zeroed());
    gate_a_hi_o.write((o.gates & 1u) != 0);
    gate_a_lo_o.write((o.gates & 2u) != 0);
    gate_b_hi_o.write((o.gates & 4u) != 0);
    gate_b_lo_o.write((o.gates & 8u) != 0);
    gate_c_hi_o.write((o.gates & 16u) != 0);
    gate_c_lo_o.write((o.gates & 32u) != 0);
    encoder_select_no.write((o.serial & 1u) != 0);
    encoder_clock_o.write((o.serial & 2u) != 0);
    encoder_command_o.write((o.serial & 4u) != 0);
    current_clock_o.write(o.current_clock);
    current_o.write(word(o.current, D::f.current));
    heartbeat_o.write(o.heartbeat);
    reg_busy_o.write(o.reg_busy);
    reg_rdata_o.write(o.reg_rdata);
    snapshot_valid_o.write(o.snapshot_valid);
    tick_count_o.write(o.tick_count);
    position_o.write(static_cast<std::uint32_t>(o.position));
    const int unused = 64 - D::f.velocity.width();
    velocity_o.write(
        static_cast<CoreWord<D>>(static_cast<std::uint64_t>(o.velocity) << unused >> unused));
    tau_hat_o.write(word(o.tau_hat, D::f.torque));
    tau_ref_o.write(word(o.tau_ref, D::f.torque));
    current_ref_o.write(word(o.current_ref, D::f.current));
    voltage_o.write(word(o.voltage, D::f.voltage));
    duty_o.write(word(o.duty, D::f.duty));
    scene_o.write(o.scene);
    limits_o.write(o.limits);
    faults_o.write(o.faults);
    first_fault_o.write(o.first_fault);
    armed_o.write(o.armed);
    duty_active_o.write(word(o.duty_active, D::f.duty));
    gates_enable_o.write(o.gates_enable);
    word_valid_o.write(o.word_valid);
    word_slot_o.write(o.word_slot);
    word_data_o.write(o.word_data);
  }

  FeltgateCore core_{design_of<D>()};
  bool stop_seen_ = false;  ///< since the last clock
};

}  // namespace feltgate::systemc
