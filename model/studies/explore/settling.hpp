// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Computes the settling time of the motor's torque after a step of the reference, with locked
// shaft, linear winding, and the bridge averaged over its period. Documentation: docs/explore.md
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "feltgate/scenes.hpp"
#include "sim/plant/parameters.hpp"
#include "sim/plant/winding.hpp"
#include "sim/reference/control_chain.hpp"
#include "studies/explore/measurement.hpp"

namespace feltgate::explore {

constexpr double settling_step_nm = 0.2;

/// Seconds from a register write (at worst a whole tick before it takes effect) until the torque
/// stays within 2 % of the step around its final value; -1 if the design has no scene "setpoint".
/// Uses the fixed-point chain.
template <class D>
double torque_settling_s(const std::vector<Value>& values, const plant::MotorParameters& motor) {
  const int scene = D::scene_number("setpoint");
  if (!scene_built<D>(scene)) return -1;
  ControlChain<D, Fixed> chain;
  chain.reset();
  for (const Value& v : values) chain.words().set_raw(v.address, v.raw);
  chain.words().set_raw(D::A::ramp_step, fixed_of<D::f.ramp.key()>::max_raw());
  chain.words().set_raw(D::A::setpoint_torque, 0);
  ChainIn in;
  in.armed = true;
  in.scene = scene;
  for (int k = 0; k < 100; ++k) chain.tick(in);
  chain.words().set_raw(D::A::setpoint_torque,
                        std::llround(std::ldexp(settling_step_nm, D::f.torque.fraction)));

  // Time in clocks from the start of the tick in which the write is in force.
  constexpr std::int64_t duty_clock = 2 + 46;
  constexpr std::int64_t end = D::clock_hz / 20;  // 50 ms
  plant::Winding winding(motor.resistance_ohm, motor.inductance_h);
  winding.set_step(static_cast<double>(D::pwm_period) / static_cast<double>(D::clock_hz));
  std::vector<double> torque_nm;
  double current_a = 0, held_v = 0;
  std::int64_t next_tick = 0;
  for (std::int64_t period = 0; period * D::pwm_period < end; ++period) {
    // The bridge takes the duty that is there at the start of its period.
    const std::int64_t now = period * D::pwm_period;
    while (next_tick + duty_clock <= now) {
      chain.tick(in);
      held_v = static_cast<double>(chain.control().duty.raw()) / D::pwm_period * D::supply_v;
      next_tick += D::clocks_per_tick;
    }
    const auto step = winding.advance(current_a, held_v, held_v);
    current_a = step.end_a;
    torque_nm.push_back(motor.torque_constant_nm_a * current_a);
  }
  std::size_t last = torque_nm.size();
  while (last > 0 && std::abs(torque_nm[last - 1] - torque_nm.back()) <= 0.02 * settling_step_nm) {
    --last;
  }
  return static_cast<double>(D::clocks_per_tick +
                             (static_cast<std::int64_t>(last) + 1) * D::pwm_period) /
         static_cast<double>(D::clock_hz);
}

}  // namespace feltgate::explore
