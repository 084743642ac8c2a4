// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The gimbal: three motors, a handle in two rings, encoders and a hand. Documentation:
// docs/devices/three-axes.md
#include "sim/plant/gimbal/gimbal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace feltgate::plant {

using Kind = TurnPhase::Kind;

Gimbal::Gimbal(const GimbalParameters& parameters, const Effects& effects, const Drive& drive,
               const TurningHand& hand)
    : p_(parameters),
      on_(effects),
      clock_hz_(drive.clock_hz),
      hand_(hand),
      mechanics_(p_.bodies, p_.stops),
      axes_(p_, on_, drive, hand.start_rad) {
  if (hand_.phases.empty()) hand_.phases.emplace_back();
  state_.theta_rad = hand.start_rad;
  seen_.theta_rad = hand.start_rad;
  seen_.handle = seen_.target = gimbal_pose(hand.start_rad).handle;
  seen_.bus_v = axes_.bus_v();
}

void Gimbal::begin_phase() {
  const TurnPhase& phase = hand_.phases[phase_];
  constexpr double never = 0x1p62;
  last_ = phase_ + 1 == hand_.phases.size() || std::isinf(phase.duration_s);
  if (!last_) {
    phase_end_ = phase_begin_ + std::llround(std::min(phase.duration_s * clock_hz_, never));
  }
  way_ = ProfileRun(phase.way, 0.0);
  held_ = seen_.handle;
  steered_ = false;
  started_ = true;
}

// The hand's action in the middle of the step.
void Gimbal::lead() {
  if (!started_) begin_phase();
  while (!last_ && now_ >= phase_end_) {
    phase_begin_ = phase_end_;
    ++phase_;
    begin_phase();
  }
  const TurnPhase& phase = hand_.phases[phase_];
  load_ = {};
  if (phase.kind == Kind::kFree) return;
  const double at_s = static_cast<double>(now_ - phase_begin_) / clock_hz_ + 0.5 * dt_s_;
  const ProfileSample way = way_.at(at_s);
  if (phase.kind == Kind::kTorque) {
    load_.hand_nm = way.value * phase.axis;
    return;
  }
  load_.stiffness_nm_rad = phase.stiffness_nm_rad;
  load_.damping_nm_s_rad = phase.damping_nm_s_rad;
  load_.target = Quaternion::about(phase.axis, way.value) * held_;
  load_.target_rad_s = way.rate * phase.axis;
  if (steered_) {
    const double since_s = static_cast<double>(now_ - steered_since_) / clock_hz_ + 0.5 * dt_s_;
    const double rad_s = length(steered_rad_s_);
    const Vec3 axis = rad_s > 0.0 ? 1.0 / rad_s * steered_rad_s_ : Vec3{0.0, 0.0, 1.0};
    load_.target = Quaternion::about(axis, rad_s * since_s) * held_;
    load_.target_rad_s = steered_rad_s_;
  }
  seen_.target = load_.target;
}

void Gimbal::steer(const Quaternion& target, Vec3 rate_rad_s) {
  held_ = target;
  steered_ = true;
  steered_rad_s_ = rate_rad_s;
  steered_since_ = now_;
}

Clock Gimbal::next_corner() const {
  constexpr Clock never = Clock{1} << 62;
  if (!started_) return now_ + 1;
  Clock corner = last_ ? never : std::max(now_ + 1, phase_end_);
  const double begin_s = static_cast<double>(now_ - phase_begin_) / clock_hz_;
  const double clocks = std::ceil(way_.next_corner_s(begin_s) * clock_hz_);
  if (clocks < static_cast<double>(never)) {
    corner = std::min(corner, std::max(now_ + 1, phase_begin_ + static_cast<Clock>(clocks)));
  }
  return corner;
}

void Gimbal::begin(Clock clocks) {
  if (clocks < 1) throw std::invalid_argument("gimbal: a step is at least one clock");
  dt_s_ = static_cast<double>(clocks) / clock_hz_;
  axes_.begin(dt_s_);
  lead();
  for (std::size_t i = 0; i < axes; ++i) {
    middle_rad_s_[i] = state_.omega_rad_s[i] + 0.5 * dt_s_ * acceleration_rad_s2_[i];
  }
}

void Gimbal::advance(const std::array<Bridge, 3>& bridges, Clock clocks) {
  begin(clocks);
  finish(axes_.drive(bridges, middle_rad_s_), clocks);
}

void Gimbal::advance(const GimbalJoints& torque_nm, Clock clocks) {
  begin(clocks);
  finish(axes_.drive(torque_nm, middle_rad_s_), clocks);
}

void Gimbal::finish(const AxisSet<axes>::Torques& torques, Clock clocks) {
  const GimbalState before = state_;
  load_.viscous_nm_s_rad = p_.smooth_nm_s_rad(on_);
  for (std::size_t i = 0; i < axes; ++i) {
    load_.torque_nm[i] = torques.motor[i] - torques.dry[i];
  }
  mechanics_.step(state_, load_, dt_s_);
  // Also true if a value is NaN.
  if (!axes_.turn(before.theta_rad, state_.theta_rad, now_, clocks) ||
      !std::isfinite(state_.hand_work_j)) {
    throw MotionError(fmt::format(
        "after {:.6g} s a joint turns by more than one state of its encoder in a clock (outer, "
        "middle, inner: {:.4g}, {:.4g}, {:.4g} rad/s); use gentler constants of the "
        "device, or slower motions",
        seconds(), before.omega_rad_s[0], before.omega_rad_s[1], before.omega_rad_s[2]));
  }
  for (std::size_t i = 0; i < axes; ++i) {
    const double way = state_.theta_rad[i] - before.theta_rad[i];
    acceleration_rad_s2_[i] = (state_.omega_rad_s[i] - before.omega_rad_s[i]) / dt_s_;
    seen_.motor_work_j += torques.motor[i] * way;
    seen_.dry_j += torques.dry[i] * way;
  }
  now_ += clocks;
  const GimbalPose pose = gimbal_pose(state_.theta_rad);
  seen_.theta_rad = state_.theta_rad;
  seen_.omega_rad_s = state_.omega_rad_s;
  seen_.handle = pose.handle;
  seen_.turning_rad_s = pose.turning(state_.omega_rad_s);
  seen_.hand_nm = load_.on_handle(pose, seen_.turning_rad_s);
  seen_.motor_nm = torques.motor;
  seen_.current_a = axes_.current_a();
  seen_.bus_v = axes_.bus_v();
  seen_.hand_work_j = state_.hand_work_j;
  seen_.viscous_j = state_.viscous_j;
  seen_.stop_j = mechanics_.stop_loss_j();
}

}  // namespace feltgate::plant
