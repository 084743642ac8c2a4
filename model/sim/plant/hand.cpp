// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Execution of the phases of a Hand. Documentation: docs/plant.md
#include "sim/plant/hand.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace feltgate::plant {

using Kind = HandPhase::Kind;

double Hand::initial_rad() const {
  if (start_rad) return *start_rad;
  if (phases.empty() || phases.front().kind != Kind::kTrace) return 0.0;
  return phases.front().trace.theta_rad.empty() ? 0.0 : phases.front().trace.theta_rad.front();
}

HandRun::HandRun(Hand hand, double radius_m, double clock_hz, bool dynamics)
    : hand_(std::move(hand)),
      radius_m_(radius_m),
      clock_hz_(clock_hz),
      clock_s_(1.0 / clock_hz),
      has_dynamics_(dynamics) {
  if (hand_.phases.empty()) hand_.phases.emplace_back();
  for (HandPhase& phase : hand_.phases) phase.kind = kind_of(phase);
}

Kind HandRun::kind_of(const HandPhase& phase) const {
  return phase.kind == Kind::kImpedance && !has_dynamics_ ? Kind::kPrescribed : phase.kind;
}

void HandRun::take(HandPhase phase) {
  phase.kind = kind_of(phase);
  phase.duration_s = std::numeric_limits<double>::infinity();
  const bool begun = started_;
  hand_.phases = {hand_.phases[index_], std::move(phase)};
  index_ = begun ? 0 : 1;
  last_ = false;
  taken_ = true;
}

Clock HandRun::end_of(std::size_t index) const {
  constexpr double never = 0x1p62;  // more than 2000 years of any clock; no sum overflows
  return phase_begin_ + std::llround(std::min(hand_.phases[index].duration_s * clock_hz_, never));
}

void HandRun::begin_phase(const Shaft& lever) {
  corner_ = 0;
  steered_ = false;
  const HandPhase& phase = hand_.phases[index_];
  const bool goes_on = started_ && kind_ == Kind::kImpedance && phase.kind == Kind::kImpedance;
  kind_ = phase.kind;
  started_ = true;
  // The last phase lasts forever, whatever its duration.
  last_ = index_ + 1 == hand_.phases.size() || std::isinf(phase.duration_s);
  if (!last_) phase_end_ = end_of(index_);
  anchor_rad_ = lever.theta_rad;
  target_ = {lever.theta_rad, 0.0};
  applied_nm_ = 0.0;
  switch (kind_) {
    case Kind::kPrescribed:
      profile_ = ProfileRun(phase.profile, lever.theta_rad);
      break;
    case Kind::kTorque:
      profile_ = ProfileRun(phase.profile, 0.0);
      break;
    case Kind::kTrace:
      trace_ = TraceRun(phase.trace);
      shift_rad_ =
          phase.trace.theta_rad.empty() ? 0.0 : lever.theta_rad - phase.trace.theta_rad.front();
      break;
    case Kind::kImpedance:
      profile_ = ProfileRun(phase.profile, goes_on ? dynamics_.equilibrium_rad : lever.theta_rad);
      if (!goes_on) mass_ = lever;
      dynamics_ = dynamics_of(phase.impedance, radius_m_);
      break;
    case Kind::kFree:
    case Kind::kLocked:
    case Kind::kCord:
      break;
  }
}

void HandRun::find_corner(Clock now) {
  constexpr Clock never = Clock{1} << 62;
  corner_ = last_ ? never : std::max(now + 1, phase_end_);
  if (kind_ != Kind::kPrescribed && kind_ != Kind::kTorque && kind_ != Kind::kImpedance) return;
  const double begin_s = static_cast<double>(now - phase_begin_) * clock_s_;
  const double clocks = std::ceil(profile_.next_corner_s(begin_s) * clock_hz_);
  if (clocks < static_cast<double>(never)) {
    corner_ = std::min(corner_, std::max(now + 1, phase_begin_ + static_cast<Clock>(clocks)));
  }
}

void HandRun::begin_step(Clock now, double dt_s, const Shaft& lever) {
  if (taken_ && started_) phase_end_ = now;
  taken_ = false;
  if (!started_) begin_phase(lever);
  while (!last_ && now >= phase_end_) {
    phase_begin_ = phase_end_;
    ++index_;
    begin_phase(lever);
  }
  if (kind_ == Kind::kFree || kind_ == Kind::kLocked || kind_ == Kind::kCord) return;
  const double begin_s = static_cast<double>(now - phase_begin_) * clock_s_;
  if (kind_ == Kind::kPrescribed) {
    const ProfileSample end = profile_.at(begin_s + dt_s);
    target_ = {end.value, end.rate};
  } else if (kind_ == Kind::kTrace) {
    const ProfileSample end = trace_.at(begin_s + dt_s);
    target_ = {end.value + shift_rad_, end.rate};
  } else if (steered_) {
    const double passed_s = static_cast<double>(now - steered_since_) * clock_s_ + 0.5 * dt_s;
    dynamics_.equilibrium_rad = steered_from_.theta_rad + steered_from_.omega_rad_s * passed_s;
    dynamics_.equilibrium_rad_s = steered_from_.omega_rad_s;
  } else {
    const ProfileSample middle = profile_.at(begin_s + 0.5 * dt_s);
    applied_nm_ = middle.value;
    dynamics_.equilibrium_rad = middle.value;
    dynamics_.equilibrium_rad_s = middle.rate;
  }
}

}  // namespace feltgate::plant
