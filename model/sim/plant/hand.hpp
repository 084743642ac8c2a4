// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What holds the lever: a list of timed phases, which hand_file.cpp reads from the [hand] table of
// a scene, and their execution step by step on the integer clock. Documentation: docs/plant.md
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "feltgate/encoder_source.hpp"
#include "mechanics.hpp"
#include "profile.hpp"

namespace feltgate::plant {

/// A cord from the lever to ground. Defaults: assumed, stiff enough to settle within milliseconds.
struct Cord {
  double stiffness_nm_rad = 30.0;
  double damping_nm_s_rad = 0.1;
};

/// One phase of a hand.
struct HandPhase {
  enum class Kind {
    kFree,        ///< nothing touches the lever
    kLocked,      ///< the lever stops where it is
    kPrescribed,  ///< the angle follows `profile` (rad)
    kTrace,       ///< the angle follows `trace`, shifted to begin where the lever is
    kImpedance,   ///< `impedance`; its equilibrium angle follows `profile` (rad)
    kCord,        ///< `cord`, unstretched at the angle where the phase begins
    kTorque,      ///< the hand applies `profile` (Nm), starting from 0
  };
  Kind kind = Kind::kFree;
  int line = 0;  ///< line in the scene file; 0: not from a file
  double duration_s = std::numeric_limits<double>::infinity();  ///< infinite: forever
  Profile profile;
  Trace trace;
  Impedance impedance;
  Cord cord;
};

/// A hand at the lever.
struct Hand {
  std::optional<double> start_rad;  ///< angle at clock 0; default: start of a leading trace, or 0
  std::optional<double> radius_m;   ///< where the hand holds; default: that of the plant
  std::vector<HandPhase> phases;    ///< empty: free forever; the last phase lasts forever

  /// Angle of the lever at clock 0, rad.
  double initial_rad() const;
};

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

/// A hand that raises its torque to `torque_nm` within `ramp_s` and keeps it.
inline Hand pushing_hand(double torque_nm, double ramp_s = 0.01) {
  Segment ramp;
  ramp.kind = Segment::Kind::kRamp;
  ramp.duration_s = ramp_s;
  ramp.to = torque_nm;
  HandPhase push;
  push.kind = HandPhase::Kind::kTorque;
  push.profile = {ramp};
  Hand hand;
  hand.phases = {push};
  return hand;
}

}  // namespace feltgate::plant
