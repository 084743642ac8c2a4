// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Execution of the phases of a hand at a pen. Documentation: docs/devices/pantograph.md
#include "sim/plant/pantograph/pen_hand.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace feltgate::plant {

using Kind = PenPhase::Kind;

PenHandRun::PenHandRun(PenHand hand, double clock_hz, bool dynamics)
    : hand_(std::move(hand)), clock_hz_(clock_hz), has_dynamics_(dynamics) {
  if (hand_.phases.empty()) hand_.phases.emplace_back();
}

Kind PenHandRun::kind_of(const PenPhase& phase) const {
  return phase.kind == Kind::kImpedance && !has_dynamics_ ? Kind::kPrescribed : phase.kind;
}

void PenHandRun::take(PenPhase phase) {
  phase.duration_s = std::numeric_limits<double>::infinity();
  hand_.phases.resize(index_ + 1);
  if (started_)
    hand_.phases.push_back(std::move(phase));
  else
    hand_.phases[index_] = std::move(phase);
  // The present phase ends before the next step, wherever that begins.
  last_ = !started_;
  phase_end_ = std::numeric_limits<Clock>::min();
}

void PenHandRun::steer(Vec2 target_m, Vec2 rate_m_s, Clock now) {
  steered_ = true;
  steered_from_m_ = target_m;
  steered_m_s_ = rate_m_s;
  steered_since_ = now;
}

void PenHandRun::begin_phase(Vec2 pen_m, Vec2 pen_m_s, LinkageState& state) {
  const PenPhase& phase = hand_.phases[index_];
  // A second impedance phase in a row keeps mass and equilibrium of the first.
  const bool goes_on = started_ && kind_ == Kind::kImpedance && phase.kind == Kind::kImpedance;
  started_ = true;
  steered_ = false;
  kind_ = kind_of(phase);
  last_ = index_ + 1 == hand_.phases.size() || std::isinf(phase.duration_s);
  constexpr double never = 0x1p62;
  if (!last_) {
    phase_end_ = phase_begin_ + std::llround(std::min(phase.duration_s * clock_hz_, never));
  }
  const Vec2 from = kind_ == Kind::kForce ? Vec2{} : goes_on ? target_m_ : pen_m;
  x_ = ProfileRun(phase.x, from.x);
  y_ = ProfileRun(phase.y, from.y);
  target_m_ = from;
  target_m_s_ = {};
  if (kind_ == Kind::kImpedance && !goes_on) {
    state.hand_m = pen_m;
    state.hand_m_s = pen_m_s;
  }
}

void PenHandRun::begin_step(Clock now, double dt_s, Vec2 pen_m, Vec2 pen_m_s, LinkageState& state) {
  if (!started_) begin_phase(pen_m, pen_m_s, state);
  while (!last_ && now >= phase_end_) {
    phase_begin_ = phase_end_ == std::numeric_limits<Clock>::min() ? now : phase_end_;
    ++index_;
    begin_phase(pen_m, pen_m_s, state);
  }
  if (kind_ == Kind::kFree) return;
  // An imposed motion holds for the end of the step, a force for its middle.
  const double share = kind_ == Kind::kPrescribed ? 1.0 : 0.5;
  if (steered_ && kind_ == Kind::kImpedance) {
    const double since_s = static_cast<double>(now - steered_since_) / clock_hz_ + share * dt_s;
    target_m_ = steered_from_m_ + since_s * steered_m_s_;
    target_m_s_ = steered_m_s_;
    return;
  }
  const double at_s = static_cast<double>(now - phase_begin_) / clock_hz_ + share * dt_s;
  const ProfileSample x = x_.at(at_s), y = y_.at(at_s);
  target_m_ = {x.value, y.value};
  target_m_s_ = {x.rate, y.rate};
}

void PenHandRun::load(LinkageLoad& load) const {
  load.hand = has_mass();
  load.force_n = kind_ == Kind::kForce ? target_m_ : Vec2{};
  if (!load.hand) return;
  const Impedance& i = hand_.phases[index_].impedance;
  load.hand_per_kg = 1.0 / i.mass_kg;
  load.damping_ns_m = i.damping_ns_m;
  load.stiffness_n_m = i.stiffness_n_m;
  load.grip_damping_ns_m = i.grip_damping_ns_m;
  load.grip_stiffness_n_m = i.grip_stiffness_n_m;
  load.target_m = target_m_;
  load.target_m_s = target_m_s_;
}

Clock PenHandRun::next_corner(Clock now) const {
  constexpr Clock never = Clock{1} << 62;
  if (!started_) return now + 1;
  Clock corner = last_ ? never : std::max(now + 1, phase_end_);
  if (kind_ == Kind::kFree) return corner;
  const double begin_s = static_cast<double>(now - phase_begin_) / clock_hz_;
  for (const ProfileRun* run : {&x_, &y_}) {
    const double clocks = std::ceil(run->next_corner_s(begin_s) * clock_hz_);
    if (clocks < static_cast<double>(never)) {
      corner = std::min(corner, std::max(now + 1, phase_begin_ + static_cast<Clock>(clocks)));
    }
  }
  return corner;
}

}  // namespace feltgate::plant
