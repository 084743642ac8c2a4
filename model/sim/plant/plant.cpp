// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The plant: motor, lever, friction, encoder, supply and hand. Documentation: docs/plant.md
#include "sim/plant/plant.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace feltgate::plant {

Plant::Plant(const Parameters& parameters, const Effects& effects, const Drive& drive,
             const Hand& hand)
    : p_(parameters),
      on_(effects),
      clock_hz_(drive.clock_hz),
      per_radius_(1.0 / hand.radius_m.value_or(parameters.lever.radius_m)),
      smooth_nm_s_rad_(smooth_damping_nm_s_rad(parameters, effects)),
      bridge_(drive, parameters.supply, parameters.motor, effects),
      winding_(parameters.motor.resistance_ohm, parameters.motor.inductance_h),
      lugre_(parameters.lugre),
      supply_(parameters.supply),
      mechanics_(parameters.lever.inertia_kg_m2),
      hand_(hand, hand.radius_m.value_or(parameters.lever.radius_m), drive.clock_hz,
            effects.hand_dynamics),
      shaft_{hand.initial_rad(), 0.0},
      encoder_(parameters.encoder, effects.encoder_imperfect, hand.initial_rad()) {
  events_.reserve(16);
  seen_.theta_rad = shaft_.theta_rad;
  seen_.bus_v = supply_.bus_v();
  hand_.begin_step(0, 0.0, shaft_);
}

void Plant::set_step(Clock clocks) {
  if (clocks < 1) throw std::invalid_argument("plant: a step is at least one clock");
  step_clocks_ = clocks;
  dt_s_ = static_cast<double>(clocks) / clock_hz_;
  per_s_ = 1.0 / dt_s_;
  most_way_rad_ = encoder_.count_rad() * static_cast<double>(clocks);
  if (on_.inductance) winding_.set_step(dt_s_);
  if (on_.lugre) lugre_.set_step(dt_s_);
}

void Plant::short_motor(double wiring_ohm, double wiring_h) {
  winding_ = Winding(wiring_ohm, wiring_h);
  on_.back_emf = on_.dead_voltage = false;
  step_clocks_ = -1;
}

// Advances the current by one step; returns its mean over the step.
double Plant::advance_current(const Bridge& bridge, double omega_rad_s) {
  if (on_.dead_time && bridge.mode == Bridge::Mode::kAveraged) ++evaluations_.dead_time;
  if (bridge.shoots_through()) seen_.shoot_through = true;
  const double bus_v = supply_.bus_v();
  const BridgeVoltage voltage = bridge_.voltage(bridge, bus_v, current_a_);
  double positive_v = voltage.at_positive_v(bus_v);
  double negative_v = voltage.at_negative_v(bus_v);
  if (on_.back_emf) {
    ++evaluations_.back_emf;
    const double emf_v = p_.motor.back_emf_constant_v_s_rad * omega_rad_s;
    positive_v -= emf_v;
    negative_v -= emf_v;
  }
  if (on_.dead_voltage) {
    ++evaluations_.dead_voltage;
    positive_v -= p_.motor.dead_voltage_v;
    negative_v += p_.motor.dead_voltage_v;
  }
  double mean_a = 0.0;
  if (on_.inductance) {
    ++evaluations_.inductance;
    const CurrentStep step = winding_.advance(current_a_, positive_v, negative_v);
    current_a_ = step.end_a;
    mean_a = step.mean_a;
  } else {
    current_a_ = winding_.settled_a(positive_v, negative_v);
    mean_a = current_a_;
  }
  const double share = mean_a >= 0.0 ? voltage.share_positive : voltage.share_negative;
  seen_.supply_current_a = share * mean_a;
  if (on_.supply_limit) {
    ++evaluations_.supply_limit;
    seen_.supply_current_a = supply_.advance(share * mean_a, dt_s_);
    seen_.bus_v = supply_.bus_v();
  }
  return mean_a;
}

double Plant::cogging_nm(double theta_rad) const {
  double torque_nm = 0.0;
  for (const CoggingHarmonic& h : p_.cogging) {
    torque_nm += h.amplitude_nm * std::sin(h.per_turn * theta_rad + h.phase_rad);
  }
  return torque_nm;
}

// Adds the torque of an end stop; its spring is softer on the way back.
void Plant::push_back(const EndStops& stops, ShaftTorque& torque) const {
  const bool low = shaft_.theta_rad < stops.low_rad;
  if (!low && shaft_.theta_rad <= stops.high_rad) return;
  const bool back = low ? shaft_.omega_rad_s > 0.0 : shaft_.omega_rad_s < 0.0;
  const double kept = back ? stops.restitution * stops.restitution : 1.0;
  const double stiffness = kept * stops.stiffness_nm_rad;
  torque.theta_nm_rad -= stiffness;
  torque.constant_nm += stiffness * (low ? stops.low_rad : stops.high_rad);
}

void Plant::advance_shaft(double motor_nm, double friction_nm, double omega_mid_rad_s) {
  const double before_rad_s = shaft_.omega_rad_s;
  // At the middle of the step, where the other torques that depend on the motion are taken.
  if (!p_.cogging.empty()) motor_nm += cogging_nm(shaft_.theta_rad + 0.5 * dt_s_ * omega_mid_rad_s);
  if (hand_.imposes()) {
    shaft_ = hand_.target();
    const double gain_nm = (shaft_.omega_rad_s - before_rad_s) * per_s_ * p_.lever.inertia_kg_m2;
    seen_.hand_torque_nm = gain_nm + friction_nm + smooth_nm_s_rad_ * omega_mid_rad_s - motor_nm;
    return;
  }
  ShaftTorque torque = hand_.torque();
  if (p_.end_stops) push_back(*p_.end_stops, torque);
  torque.constant_nm += motor_nm - friction_nm;
  torque.omega_nm_s_rad -= smooth_nm_s_rad_;
  if (hand_.has_mass()) {
    ++evaluations_.hand_dynamics;
    mechanics_.step(shaft_, hand_.mass(), torque, hand_.dynamics(), dt_s_);
  } else {
    mechanics_.step(shaft_, torque, dt_s_);
  }
  seen_.hand_torque_nm = hand_.kind() == HandPhase::Kind::kFree ? 0.0 : hand_.torque_nm(shaft_);
}

// Separate, so that it is not in the path of every step.
void Plant::refuse_motion(double way_rad) const {
  const double time_s = static_cast<double>(now_) / clock_hz_;
  if (!std::isfinite(way_rad + shaft_.omega_rad_s + seen_.motor_torque_mean_nm)) {
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

void Plant::advance(const Bridge& bridge, Clock clocks) {
  if (clocks != step_clocks_) set_step(clocks);
  events_.clear();
  hand_.begin_step(now_, dt_s_, shaft_);
  if (hand_.kind() != HandPhase::Kind::kFree) ++evaluations_.hand;
  if (on_.viscous) ++evaluations_.viscous;

  const double before_rad = shaft_.theta_rad;
  const double before_rad_s = shaft_.omega_rad_s;
  const double omega_mid_rad_s = hand_.imposes()
                                     ? (hand_.target().theta_rad - before_rad) * per_s_
                                     : before_rad_s + 0.5 * dt_s_ * acceleration_rad_s2_;
  const double mean_a = advance_current(bridge, omega_mid_rad_s);
  const double motor_nm = p_.motor.torque_constant_nm_a * mean_a;
  double friction_nm = 0.0;
  if (on_.lugre) {
    ++evaluations_.lugre;
    friction_nm = lugre_.advance(omega_mid_rad_s);
  }
  advance_shaft(motor_nm, friction_nm, omega_mid_rad_s);
  acceleration_rad_s2_ = hand_.imposes() ? 0.0 : (shaft_.omega_rad_s - before_rad_s) * per_s_;

  // Also true if a value is NaN.
  const double way_rad = shaft_.theta_rad - before_rad;
  if (!(std::abs(way_rad) <= most_way_rad_) || !std::isfinite(motor_nm + shaft_.omega_rad_s)) {
    refuse_motion(way_rad);
  }
  encoder_.advance(shaft_.theta_rad, now_, clocks, events_);
  now_ += clocks;
  seen_.theta_rad = shaft_.theta_rad;
  seen_.omega_rad_s = shaft_.omega_rad_s;
  seen_.motor_current_a = current_a_;
  seen_.motor_current_mean_a = mean_a;
  seen_.motor_torque_nm = p_.motor.torque_constant_nm_a * current_a_;
  seen_.motor_torque_mean_nm = motor_nm;
  seen_.friction_nm = friction_nm + smooth_nm_s_rad_ * omega_mid_rad_s;
  seen_.hand_force_n = seen_.hand_torque_nm * per_radius_;
}

std::vector<StateValue> Plant::state() const {
  std::vector<StateValue> values;
  if (!hand_.imposes()) {
    values.push_back({"theta_rad", shaft_.theta_rad});
    values.push_back({"omega_rad_s", shaft_.omega_rad_s});
  }
  if (on_.inductance) values.push_back({"motor_current_a", current_a_});
  if (on_.lugre) values.push_back({"bristle_rad", lugre_.z_rad()});
  if (on_.supply_limit) values.push_back({"bus_v", supply_.bus_v()});
  if (hand_.has_mass()) {
    values.push_back({"hand_rad", hand_.mass().theta_rad});
    values.push_back({"hand_rad_s", hand_.mass().omega_rad_s});
  }
  return values;
}

std::size_t Plant::state_size() const { return state().size(); }

Evaluations Plant::evaluations() const {
  Evaluations counted = evaluations_;
  counted.encoder_imperfect = encoder_.offset_edges();
  return counted;
}

}  // namespace feltgate::plant
