// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Bridge, motor, lever, hand and encoder as an sc_module: gates in, encoder pins out.
// Documentation: docs/library.md
#pragma once

#include <deque>
#include <systemc>

#include "../plant/drive.hpp"
#include "../plant/plant.hpp"
#include "core_pins.hpp"

namespace feltgate::systemc {

class MotorModule : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> clk_i{"clk_i"}, rst_ni{"rst_ni"};  ///< in reset the lever waits
  sc_core::sc_in<bool> gate_a_hi_i{"gate_a_hi_i"}, gate_a_lo_i{"gate_a_lo_i"};
  sc_core::sc_in<bool> gate_b_hi_i{"gate_b_hi_i"}, gate_b_lo_i{"gate_b_lo_i"};
  sc_core::sc_out<bool> enc_a_o{"enc_a_o"}, enc_b_o{"enc_b_o"}, enc_z_o{"enc_z_o"};
  sc_core::sc_signal<double> angle_rad{"angle_rad"}, torque_nm{"torque_nm"};  ///< to look at

  /// A motor behind the bridge of `design`. The plant takes steps of `step_clocks` and sees what
  /// share of the step before each gate was on.
  SC_HAS_PROCESS(MotorModule);
  MotorModule(const sc_core::sc_module_name& name, const plant::Parameters& motor,
              const DesignInfo& design, const plant::Hand& hand, int step_clocks = 25)
      : sc_module(name),
        plant_(motor, motor.effects, plant::drive_of(design), hand),
        pins_(plant_.encoder().pins()),
        step_clocks_(step_clocks) {
    SC_METHOD(edge);
    sensitive << clk_i.pos();
  }
  const plant::Plant& plant() const { return plant_; }

 private:
  void edge() {
    if (rst_ni.read() && clk_i.posedge()) {
      count(gate_a_hi_i, &on_.a_hi);
      count(gate_a_lo_i, &on_.a_lo);
      count(gate_b_hi_i, &on_.b_hi);
      count(gate_b_lo_i, &on_.b_lo);
      if (now_ % step_clocks_ == 0) step();
      // A pin that changes at a clock is there when that clock's edge comes.
      for (; !events_.empty() && events_.front().clock <= now_ + 1; events_.pop_front()) {
        pins_ = events_.front().pins;
      }
      ++now_;
    }
    enc_a_o.write(pins_.a);
    enc_b_o.write(pins_.b);
    enc_z_o.write(pins_.z);
    angle_rad.write(plant_.observables().theta_rad);
    torque_nm.write(plant_.observables().motor_torque_nm);
  }

  void step() {
    plant_.advance(plant::Bridge::gates(on_.a_hi, on_.a_lo, on_.b_hi, on_.b_lo), step_clocks_);
    on_ = {};
    events_.insert(events_.end(), plant_.events().begin(), plant_.events().end());
  }
  void count(const sc_core::sc_in<bool>& gate, double* share) const {
    // The gates of the clock before; there is none before the first.
    if (now_ > 0 && gate.read()) *share += 1.0 / step_clocks_;
  }

  struct Shares {
    double a_hi = 0, a_lo = 0, b_hi = 0, b_lo = 0;
  };
  plant::Plant plant_;
  EncoderPins pins_;
  int step_clocks_;
  Shares on_;
  Clock now_ = 0;
  std::deque<EncoderEvent> events_;
};

/// Connects the motor to the gates and the encoder's pins of a core.
template <class D>
void bind(MotorModule& motor, sc_core::sc_in<bool>::in_if_type& clk, CoreInputs& in,
          CoreOutputs<D>& out) {
  motor.clk_i(clk);
  motor.rst_ni(in.rst_ni);
  motor.gate_a_hi_i(out.gate_a_hi_o);
  motor.gate_a_lo_i(out.gate_a_lo_o);
  motor.gate_b_hi_i(out.gate_b_hi_o);
  motor.gate_b_lo_i(out.gate_b_lo_o);
  motor.enc_a_o(in.enc_a_i);
  motor.enc_b_o(in.enc_b_i);
  motor.enc_z_o(in.enc_z_i);
}

}  // namespace feltgate::systemc
