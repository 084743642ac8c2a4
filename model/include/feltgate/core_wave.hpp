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
    limits_ = 0;
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
        set(5, chain_.limit_velocity());
        break;
      case 8:
        out.velocity = chain_.velocity().raw();
        break;
      case 22:
        chain_.observe(out.armed);
        out.tau_hat = static_cast<std::int32_t>(chain_.tau_hat().raw());
        set(6, chain_.limit_tau_hat());
        break;
      case 24:
        if (mode == Mode::voltage) {
          out.voltage = static_cast<std::int32_t>(chain_.words().voltage_setpoint().raw());
        }
        break;
      case 25:
        chain_.render(out.armed, out.scene, out.position);
        set(0, chain_.limit_torque());
        break;
      case 27:
        out.tau_ref = static_cast<std::int32_t>(chain_.tau_ref().raw());
        set(1, chain_.limit_ramp());
        break;
      case 33:
        chain_.drive(out.armed, mode);
        out.current_ref = static_cast<std::int32_t>(chain_.control().current.raw());
        set(2, chain_.control().limit.current);
        break;
      case 39:
        out.voltage = static_cast<std::int32_t>(chain_.control().voltage.raw());
        set(3, chain_.control().limit.voltage);
        break;
      case 45:
        out.duty = static_cast<std::int16_t>(chain_.control().duty.raw());
        set(4, chain_.control().limit.duty);
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
    limits_ = chain_.limits();
  }

  /// What the velocity's low-pass would take in now, raw: the next velocity lies between it and the
  /// last.
  std::int64_t velocity_input(std::int16_t travel) const { return chain_.velocity_input(travel); }
  /// The region of the voltage gain that the last torque reference fell into.
  bool region_high() const { return chain_.control().region_high; }
  /// Free-running count that the running wave started from.
  std::int16_t sampled_travel() const { return sampled_travel_; }

  /// The limits word.
  std::uint8_t limits(bool gates_enable) const {
    return static_cast<std::uint8_t>(limits_ | (gates_enable ? 0 : 128));
  }

 private:
  void set(int bit, bool holds) {
    limits_ = static_cast<std::uint8_t>((limits_ & ~(1 << bit)) | (holds << bit));
  }

  ChainTick<D, Fixed> chain_;
  std::int16_t sampled_travel_ = 0;
  std::uint8_t limits_ = 0;  ///< bits 0 to 6
};

}  // namespace feltgate
