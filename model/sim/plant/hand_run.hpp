// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Executes the phases of a Hand, step by step on the integer clock. Documentation: docs/plant.md
#pragma once

#include <cstddef>

#include "feltgate/encoder_source.hpp"
#include "hand.hpp"
#include "mechanics.hpp"

namespace feltgate::plant {

/// The phases in progress.
class HandRun {
 public:
  /// Without `dynamics`, an impedance hand imposes its motion on the lever.
  HandRun(Hand hand, double radius_m, double clock_hz, bool dynamics = true);

  /// Prepares the step of dt_s that starts at clock `now` with this lever. A phase starts with the
  /// first step at or after its time; its profile counts from the time itself, so nothing drifts.
  void begin_step(Clock now, double dt_s, const Shaft& lever);

  /// The first clock after `now` at which a phase or a segment of its motion ends; later than any
  /// run if there is none.
  Clock next_corner(Clock now) {
    if (corner_ <= now) find_corner(now);
    return corner_;
  }

  /// Replaces the hand's phases: `phase` begins with the next step and lasts forever.
  void take(HandPhase phase);
  /// Sets the equilibrium of an impedance hand at `now`; it moves on at this rate, instead of by
  /// its profile, until the next call or phase.
  void steer(const Shaft& equilibrium, Clock now) {
    steered_ = true;
    steered_from_ = equilibrium;
    steered_since_ = now;
  }

  HandPhase::Kind kind() const { return kind_; }
  /// Whether the hand determines the lever's motion: target() at the end of the step.
  bool imposes() const {
    return kind_ == HandPhase::Kind::kLocked || kind_ == HandPhase::Kind::kPrescribed ||
           kind_ == HandPhase::Kind::kTrace;
  }
  bool has_mass() const { return kind_ == HandPhase::Kind::kImpedance; }
  const Shaft& target() const { return target_; }

  /// Torque of cord or torque profile over the step, for the mechanics.
  ShaftTorque torque() const {
    if (kind_ == HandPhase::Kind::kTorque) return {applied_nm_, 0.0, 0.0};
    if (kind_ != HandPhase::Kind::kCord) return {};
    const Cord& cord = hand_.phases[index_].cord;
    return {cord.stiffness_nm_rad * anchor_rad_, -cord.damping_nm_s_rad, -cord.stiffness_nm_rad};
  }
  /// The hand's torque at one state of the lever, Nm; an impedance acts through the grip.
  double torque_nm(const Shaft& lever) const {
    if (has_mass()) return dynamics_.grip_nm(lever, mass_);
    const ShaftTorque t = torque();
    return t.constant_nm + t.omega_nm_s_rad * lever.omega_rad_s + t.theta_nm_rad * lever.theta_rad;
  }
  const HandDynamics& dynamics() const { return dynamics_; }
  /// State of the hand's own mass, in angles of the lever.
  Shaft& mass() { return mass_; }
  const Shaft& mass() const { return mass_; }

 private:
  HandPhase::Kind kind_of(const HandPhase& phase) const;
  void begin_phase(const Shaft& lever);
  void find_corner(Clock now);
  Clock end_of(std::size_t index) const;

  Hand hand_;
  double radius_m_;
  double clock_hz_;
  double clock_s_;
  bool has_dynamics_;
  bool taken_ = false;  ///< the next step starts the phase of take()
  std::size_t index_ = 0;
  bool started_ = false;
  Clock phase_begin_ = 0;
  Clock phase_end_ = 0;
  Clock corner_ = 0;  ///< next_corner(), while it is in the future
  bool last_ = true;
  HandPhase::Kind kind_ = HandPhase::Kind::kFree;
  ProfileRun profile_;
  TraceRun trace_;
  double shift_rad_ = 0.0;
  double anchor_rad_ = 0.0;
  double applied_nm_ = 0.0;
  Shaft target_;
  bool steered_ = false;
  Shaft steered_from_;
  Clock steered_since_ = 0;
  Shaft mass_;
  HandDynamics dynamics_;
};

}  // namespace feltgate::plant
