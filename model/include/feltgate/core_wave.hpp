// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The arithmetic of a wave inside the core's twin: each law is evaluated once, in a clock in which
// all that it needs is there, and shown in the clock in which the RTL shows it.
// Documentation: docs/blocks/feltgate_core.md
#pragma once

#include <cstdint>

#include "feltgate/chain_tick.hpp"
#include "feltgate/core_ports.hpp"

namespace feltgate {

template <class D>
class CoreWave {
 public:
  /// The parameter words stay, as in the RTL.
  void reset() {
    chain_.reset();
    sampled_travel_ = 0;
    flags_ = {};
  }

  void set_word(int address, std::uint32_t word) { chain_.words().set_raw(address, word); }

  /// The laws at the clocks in which the RTL shows their results.
  void clock(int t, std::int32_t position, std::int16_t travel, Mode mode, CoreOut& out) {
    switch (t) {
      case 0:
        out.position = position;
        sampled_travel_ = travel;
        break;
      case 2:
        chain_.estimate(sampled_travel_);
        flags_.velocity = chain_.limit_velocity();
        break;
      case 8:
        out.velocity = chain_.velocity().raw();
        break;
      case 22:
        chain_.observe(out.armed);
        out.tau_hat = static_cast<std::int32_t>(chain_.tau_hat().raw());
        flags_.tau_hat = chain_.limit_tau_hat();
        break;
      case 24:
        if (mode == Mode::voltage) {
          out.voltage = static_cast<std::int32_t>(
              chain_.words().template get<D::f.voltage.key()>(D::A::voltage_setpoint).raw());
        }
        break;
      case 25:
        chain_.render(out.armed, out.scene, out.position);
        flags_.torque = chain_.limit_torque();
        break;
      case 27:
        out.tau_ref = static_cast<std::int32_t>(chain_.tau_ref().raw());
        flags_.ramp = chain_.limit_ramp();
        break;
      case 33:
        chain_.drive(out.armed, mode);
        out.current_ref = static_cast<std::int32_t>(chain_.control().current.raw());
        flags_.control.current = chain_.control().limit.current;
        break;
      case 39:
        out.voltage = static_cast<std::int32_t>(chain_.control().voltage.raw());
        flags_.control.voltage = chain_.control().limit.voltage;
        break;
      case 45:
        out.duty = static_cast<std::int16_t>(chain_.control().duty.raw());
        flags_.control.duty = chain_.control().limit.duty;
        break;
      default:
        break;
    }
  }

  /// All of them at once.
  void tick(std::int32_t position, std::int16_t travel, Mode mode, CoreOut& out) {
    out.position = position;
    sampled_travel_ = travel;
    chain_.tick(position, travel, out.armed, out.scene, mode);
    out.velocity = chain_.velocity().raw();
    out.tau_hat = static_cast<std::int32_t>(chain_.tau_hat().raw());
    out.tau_ref = static_cast<std::int32_t>(chain_.tau_ref().raw());
    out.current_ref = static_cast<std::int32_t>(chain_.control().current.raw());
    out.voltage = static_cast<std::int32_t>(chain_.control().voltage.raw());
    out.duty = static_cast<std::int16_t>(chain_.control().duty.raw());
    flags_ = {chain_.limit_torque(), chain_.limit_ramp(), chain_.limit_velocity(),
              chain_.limit_tau_hat(), chain_.control().limit};
  }

  /// The region of the voltage gain that the last torque reference fell into.
  bool region_high() const { return chain_.control().region_high; }
  /// Free-running count that the running wave started from.
  std::int16_t sampled_travel() const { return sampled_travel_; }

  /// The limits word.
  std::uint8_t limits(bool gates_enable) const {
    return static_cast<std::uint8_t>(flags_.torque | flags_.ramp << 1 |
                                     flags_.control.current << 2 | flags_.control.voltage << 3 |
                                     flags_.control.duty << 4 | flags_.velocity << 5 |
                                     flags_.tau_hat << 6 | !gates_enable << 7);
  }

 private:
  struct Flags {
    bool torque = false, ramp = false, velocity = false, tau_hat = false;
    ControlLimits control;
  };

  ChainTick<D, Fixed> chain_;
  std::int16_t sampled_travel_ = 0;
  Flags flags_;
};

}  // namespace feltgate
