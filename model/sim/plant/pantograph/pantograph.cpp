// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The pantograph: two motors, a five-bar linkage, stops, encoders and a hand. Documentation:
// docs/devices/pantograph.md
#include "sim/plant/pantograph/pantograph.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace feltgate::plant {
namespace {

PenHand placed(PenHand hand, const PantographParameters& p) {
  if (!hand.start_m) hand.start_m = p.start_m;
  return hand;
}

Joints start_of(const PantographParameters& p, const PenHand& hand) {
  const Vec2 pen = hand.start_m.value_or(p.start_m);
  const auto theta = Linkage(p.linkage).inverse(pen);
  if (!theta) {
    throw std::invalid_argument(
        fmt::format("pantograph: the pen cannot start at ({:g}, {:g}) m", pen.x, pen.y));
  }
  return *theta;
}

}  // namespace

Pantograph::Pantograph(const PantographParameters& parameters, const Effects& effects,
                       const Drive& drive, const PenHand& hand)
    : p_(parameters),
      on_(effects),
      clock_hz_(drive.clock_hz),
      mechanics_(p_.linkage, p_.bodies, p_.stops),
      hand_(placed(hand, p_), drive.clock_hz, on_.hand_dynamics),
      state_{start_of(p_, hand), {}, {}, {}, 0.0, 0.0},
      axes_(p_, on_, drive, state_.theta_rad) {
  seen_.theta_rad = state_.theta_rad;
  seen_.pen_m = hand.start_m.value_or(p_.start_m);
  seen_.bus_v = axes_.bus_v();
}

void Pantograph::begin(Clock clocks) {
  if (clocks < 1) throw std::invalid_argument("pantograph: a step is at least one clock");
  dt_s_ = static_cast<double>(clocks) / clock_hz_;
  axes_.begin(dt_s_);
  hand_.begin_step(now_, dt_s_, seen_.pen_m, seen_.pen_m_s, state_);
  for (std::size_t i = 0; i < 2; ++i) {
    middle_rad_s_[i] = state_.omega_rad_s[i] + 0.5 * dt_s_ * acceleration_rad_s2_[i];
  }
}

void Pantograph::advance(const std::array<Bridge, 2>& bridges, Clock clocks) {
  begin(clocks);
  finish(axes_.drive(bridges, middle_rad_s_), clocks);
}

void Pantograph::advance(const Joints& torque_nm, Clock clocks) {
  begin(clocks);
  finish(axes_.drive(torque_nm, middle_rad_s_), clocks);
}

void Pantograph::finish(const AxisSet<axes>::Torques& torques, Clock clocks) {
  const auto& [motor_nm, dry_nm] = torques;
  const Joints before = state_.theta_rad, before_rad_s = state_.omega_rad_s;
  LinkageLoad load;
  load.viscous_nm_s_rad = p_.smooth_nm_s_rad(on_);
  for (std::size_t i = 0; i < 2; ++i) load.torque_nm[i] = motor_nm[i] - dry_nm[i];
  hand_.load(load);
  if (hand_.imposes()) {
    const auto theta = linkage().inverse(hand_.target_m(), before[0]);
    if (!theta) refuse("the hand puts the pen where it cannot be", before);
    const Joints omega = linkage().pose(*theta).omega(hand_.target_m_s());
    seen_.hand_n = mechanics_.impose(state_, *theta, omega, load, dt_s_);
  } else {
    mechanics_.step(state_, load, dt_s_);
  }
  const LinkagePose pose = linkage().pose(state_.theta_rad);
  seen_.pen_m = pose.pen;
  seen_.pen_m_s = pose.pen_speed(state_.omega_rad_s);
  if (!hand_.imposes()) seen_.hand_n = load.on_pen(state_, seen_.pen_m, seen_.pen_m_s);
  // Also true if a value is NaN.
  if (!std::isfinite(dot(seen_.pen_m_s, seen_.pen_m_s) + dot(seen_.hand_n, seen_.hand_n))) {
    refuse("the linkage does not close any more, or its state is not finite", before);
  }
  if (!axes_.turn(before, state_.theta_rad, now_, clocks)) {
    refuse("a crank turns by more than one state of its encoder in a clock", before);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const double way = state_.theta_rad[i] - before[i];
    acceleration_rad_s2_[i] =
        hand_.imposes() ? 0.0 : (state_.omega_rad_s[i] - before_rad_s[i]) / dt_s_;
    seen_.motor_work_j += motor_nm[i] * way;
    seen_.dry_j += dry_nm[i] * way;
    seen_.friction_nm[i] = dry_nm[i] + load.viscous_nm_s_rad * middle_rad_s_[i];
  }
  now_ += clocks;
  seen_.theta_rad = state_.theta_rad;
  seen_.omega_rad_s = state_.omega_rad_s;
  seen_.motor_nm = motor_nm;
  seen_.hand_m = state_.hand_m;
  seen_.current_a = axes_.current_a();
  seen_.bus_v = axes_.bus_v();
  seen_.supply_a = axes_.supply_a();
  seen_.hand_work_j = state_.hand_work_j;
  seen_.viscous_j = state_.viscous_j;
  seen_.stop_j = mechanics_.stop_loss_j();
}

void Pantograph::refuse(const char* what, const Joints& before) const {
  constexpr double kDegrees = 180.0 / 3.14159265358979323846;
  throw MotionError(fmt::format(
      "after {:.6g} s {} (the cranks stood at {:.4g} and {:.4g} degrees, with {:.4g} and {:.4g} "
      "rad/s); use gentler constants of the device, or slower motions",
      seconds(), what, kDegrees * before[0], kDegrees * before[1], seen_.omega_rad_s[0],
      seen_.omega_rad_s[1]));
}

}  // namespace feltgate::plant
