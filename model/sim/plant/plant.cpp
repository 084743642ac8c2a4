// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The plant: motor, lever, friction, encoder, supply and hand. Documentation: docs/plant.md
#include "sim/plant/plant.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace feltgate::plant {

ShaftPlant::ShaftPlant(const Parameters& parameters, const Effects& effects, double clock_hz,
                       const Hand& hand)
    : p_(parameters),
      on_(effects),
      clock_hz_(clock_hz),
      per_radius_(1.0 / hand.radius_m.value_or(parameters.lever.radius_m)),
      smooth_nm_s_rad_(smooth_damping_nm_s_rad(parameters, effects)),
      lugre_(parameters.lugre),
      supply_(parameters.supply),
      mechanics_(parameters.lever.inertia_kg_m2),
      hand_(hand, hand.radius_m.value_or(parameters.lever.radius_m), clock_hz,
            effects.hand_dynamics),
      shaft_{hand.initial_rad(), 0.0},
      encoder_(parameters.encoder, effects.encoder_imperfect, hand.initial_rad()) {
  events_.reserve(16);
  seen_.theta_rad = shaft_.theta_rad;
  seen_.bus_v = supply_.bus_v();
  hand_.begin_step(0, 0.0, shaft_);
}

void ShaftPlant::set_step(Clock clocks) {
  if (clocks < 1) throw std::invalid_argument("plant: a step is at least one clock");
  step_clocks_ = clocks;
  dt_s_ = static_cast<double>(clocks) / clock_hz_;
  per_s_ = 1.0 / dt_s_;
  most_way_rad_ = encoder_.count_rad() * static_cast<double>(clocks);
  if (on_.lugre) lugre_.set_step(dt_s_);
}

double ShaftPlant::cogging_nm(double theta_rad) const {
  double torque_nm = 0.0;
  for (const CoggingHarmonic& h : p_.cogging) {
    torque_nm += h.amplitude_nm * std::sin(h.per_turn * theta_rad + h.phase_rad);
  }
  return torque_nm;
}

// Adds the torque of an end stop; its spring is softer on the way back.
void ShaftPlant::push_back(const EndStops& stops, ShaftTorque& torque) const {
  const bool low = shaft_.theta_rad < stops.low_rad;
  if (!low && shaft_.theta_rad <= stops.high_rad) return;
  const bool back = low ? shaft_.omega_rad_s > 0.0 : shaft_.omega_rad_s < 0.0;
  const double kept = back ? stops.restitution * stops.restitution : 1.0;
  const double stiffness = kept * stops.stiffness_nm_rad;
  torque.theta_nm_rad -= stiffness;
  torque.constant_nm += stiffness * (low ? stops.low_rad : stops.high_rad);
}

void ShaftPlant::advance_shaft(double motor_nm, double friction_nm, const Shaft& middle) {
  const double before_rad_s = shaft_.omega_rad_s;
  // At the middle of the step, where the other torques that depend on the motion are taken.
  if (!p_.cogging.empty()) motor_nm += cogging_nm(middle.theta_rad);
  if (hand_.imposes()) {
    shaft_ = hand_.target();
    const double gain_nm = (shaft_.omega_rad_s - before_rad_s) * per_s_ * p_.lever.inertia_kg_m2;
    seen_.hand_torque_nm = gain_nm + friction_nm + smooth_nm_s_rad_ * middle.omega_rad_s - motor_nm;
    return;
  }
  ShaftTorque torque = hand_.torque();
  if (p_.end_stops) push_back(*p_.end_stops, torque);
  torque.constant_nm += motor_nm - friction_nm;
  torque.omega_nm_s_rad -= smooth_nm_s_rad_;
  if (hand_.has_mass()) {
    mechanics_.step(shaft_, hand_.mass(), torque, hand_.dynamics(), dt_s_);
  } else {
    mechanics_.step(shaft_, torque, dt_s_);
  }
  seen_.hand_torque_nm = hand_.kind() == HandPhase::Kind::kFree ? 0.0 : hand_.torque_nm(shaft_);
}

// Separate, so that it is not in the path of every step.
void ShaftPlant::refuse_motion(double way_rad, double motor_nm) const {
  const double time_s = static_cast<double>(now_) / clock_hz_;
  if (!std::isfinite(way_rad + shaft_.omega_rad_s + motor_nm)) {
    throw MotionError(fmt::format(
        "after {:.6g} s the plant's state is no longer finite (the lever turned at {:.4g} rad/s); "
        "use gentler constants or a shorter step of the plant",
        time_s, seen_.omega_rad_s));
  }
  throw MotionError(fmt::format(
      "after {:.6g} s the lever turns at {:.4g} rad/s, {:.3g} states of the encoder in a "
      "clock, and pins can show one; slow the motion, or give the encoder fewer lines",
      time_s, way_rad * per_s_, std::abs(way_rad) / most_way_rad_));
}

std::size_t ShaftPlant::shaft_states() const {
  const std::size_t lever = hand_.imposes() ? 0 : 2, hand = hand_.has_mass() ? 2 : 0;
  return lever + hand + (on_.lugre ? 1 : 0) + (on_.supply_limit ? 1 : 0);
}

void Plant::advance(const Bridge& bridge, Clock clocks) {
  step(motor_, clocks, [this, &bridge](double bus_v, const Shaft& middle) {
    return motor_.advance(bridge, bus_v, middle.omega_rad_s);
  });
}

void Plant::short_motor(double wiring_ohm, double wiring_h) {
  motor_.short_terminals(wiring_ohm, wiring_h);
  renew_step();
}

}  // namespace feltgate::plant
