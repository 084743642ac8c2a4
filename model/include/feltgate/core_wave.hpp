// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The arithmetic of a wave inside the core's twin: each law is evaluated once, in a clock in which
// all that it needs is there, and shown in the clock in which the RTL shows it.
// Documentation: docs/blocks/feltgate_core.md
#pragma once

#include <cstdint>

#include "feltgate/core_ports.hpp"
#include "feltgate/dob.hpp"
#include "feltgate/scenes.hpp"
#include "feltgate/torque_control.hpp"
#include "feltgate/velocity_n.hpp"
#include "feltgate/words.hpp"

namespace feltgate {

template <class D>
class CoreWave {
 public:
  /// The parameter words stay, as in the RTL.
  void reset() {
    velocity_.reset();
    dob_.reset();
    scenes_.reset();
    control_ = {};
    scene_position_ = 0;
    sampled_travel_ = 0;
    flags_ = {};
  }

  void set_word(int address, std::uint32_t word) { words_.set_raw(address, word); }

  /// The laws at the clocks in which the RTL shows their results.
  void clock(int t, std::int32_t position, std::int16_t travel, Mode mode, CoreOut& out) {
    switch (t) {
      case 0:
        out.position = position;
        sampled_travel_ = travel;
        scene_position_ =
            narrow<fixed_of<D::f.scene_position.key()>, Round::truncate, Overflow::saturate>(
                fixed_of<D::f.position.key()>::from_raw(position))
                .raw();
        break;
      case 2:
        velocity_.tick(sampled_travel_,
                       words_.template get<D::P::velocity_a1.key()>(D::A::velocity_a1));
        flags_.velocity = velocity_.out().saturated;
        break;
      case 8:
        out.velocity = velocity_.out().velocity;
        break;
      case 22:
        dob_.tick(out.armed, fixed_of<D::f.current.key()>::from_raw(out.current_ref),
                  velocity_.velocity(),
                  words_.template get<D::P::torque_constant.key()>(D::A::torque_constant),
                  words_.template get<D::P::inertia_gain.key()>(D::A::inertia_gain),
                  words_.template get<D::P::observer_a1.key()>(D::A::observer_a1));
        out.tau_hat = static_cast<std::int32_t>(dob_.out().tau_hat);
        flags_.tau_hat = dob_.out().saturated;
        break;
      case 24:
        if (mode == Mode::voltage) {
          out.voltage = static_cast<std::int32_t>(
              words_.template get<D::f.voltage.key()>(D::A::voltage_setpoint).raw());
        }
        break;
      case 25:
        scenes_.tick(words_, out.armed, out.scene, static_cast<std::int32_t>(scene_position_),
                     velocity_.velocity());
        flags_.torque = scenes_.limit_torque();
        break;
      case 27:
        out.tau_ref = static_cast<std::int32_t>(scenes_.tau_ref().raw());
        flags_.ramp = scenes_.limit_ramp();
        break;
      case 33:
        control_.tick(words_, out.armed, mode, scenes_.tau_ref(), dob_.tau_hat(),
                      velocity_.velocity());
        out.current_ref = static_cast<std::int32_t>(control_.current.raw());
        flags_.control.current = control_.limit.current;
        break;
      case 39:
        out.voltage = static_cast<std::int32_t>(control_.voltage.raw());
        flags_.control.voltage = control_.limit.voltage;
        break;
      case 45:
        out.duty = static_cast<std::int16_t>(control_.duty.raw());
        flags_.control.duty = control_.limit.duty;
        break;
      default:
        break;
    }
  }

  /// The region of the voltage gain that the last torque reference fell into.
  bool region_high() const { return control_.region_high; }
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

  VelocityN<D> velocity_;
  Dob<D> dob_;
  Scenes<D> scenes_;
  TorqueControlStep<D, Fixed> control_;
  Words<D, Fixed> words_;
  std::int64_t scene_position_ = 0;
  std::int16_t sampled_travel_ = 0;
  Flags flags_;
};

}  // namespace feltgate
