// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The plant behind the H-bridge: motor, lever, friction, encoder, supply and hand. It closes the
// loop in simulation. Equations, step and convergence: docs/plant.md
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "bridge.hpp"
#include "encoder.hpp"
#include "feltgate/encoder_source.hpp"
#include "hand_run.hpp"
#include "lugre.hpp"
#include "mechanics.hpp"
#include "parameters.hpp"
#include "supply.hpp"
#include "winding.hpp"

namespace feltgate::plant {

/// Outputs of the plant, at the end of the last step unless stated as mean.
struct Observables {
  double theta_rad = 0.0;
  double omega_rad_s = 0.0;
  double motor_current_a = 0.0;
  double motor_current_mean_a = 0.0;  ///< over the last step
  double motor_torque_nm = 0.0;       ///< Kt*i, on the lever, before friction
  double motor_torque_mean_nm = 0.0;  ///< over the last step; feed PeriodMean with it
  double friction_nm = 0.0;           ///< mean of the last step, opposes positive omega
  double hand_torque_nm = 0.0;        ///< of the hand on the lever; mean where it imposes
  double hand_force_n = 0.0;          ///< hand torque over the radius of the hand
  double supply_current_a = 0.0;      ///< mean of the last step
  double bus_v = 0.0;
  bool shoot_through = false;  ///< whether both gates of a leg were ever on at once
};

/// One continuous state of the plant.
struct StateValue {
  std::string name;  ///< with unit
  double value;
};

/// A motion that cannot be simulated: faster than one encoder state per clock, or not finite.
/// what() gives time, speed and what to change.
class MotionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The plant of a lever, step by step.
class Plant {
 public:
  /// `hand` decides the angle at clock 0; the lever starts at rest, without current.
  /// Errors: std::invalid_argument for an impossible drive (see BridgeModel).
  Plant(const Parameters& parameters, const Effects& effects, const Drive& drive, const Hand& hand);

  /// Advances by `clocks` >= 1 FPGA clocks with this bridge. Equal steps are fastest; 25 clocks
  /// (0.5 us) are recommended, at most 250 (5 us). Errors: MotionError.
  void advance(const Bridge& bridge, Clock clocks);

  /// The first clock after now() at which the hand's motion changes; up to there one long step is
  /// as good as many short ones.
  Clock next_corner() { return hand_.next_corner(now_); }

  /// Replaces the hand's phases by `phase`, forever; it starts at the lever's present angle.
  void take(const HandPhase& phase) { hand_.take(phase); }
  /// Sets the equilibrium of an impedance hand to `theta_rad`, moving at `rad_s`, until the next
  /// call. Call it after the first step of the phase; other hands ignore it.
  void steer(double theta_rad, double rad_s) { hand_.steer({theta_rad, rad_s}, now_); }

  /// Shorts the motor's terminals: from now on the bridge drives the wiring to the short alone. The
  /// motor's current is that of the wiring, and its torque means nothing any more.
  void short_motor(double wiring_ohm, double wiring_h);

  /// Time since the start, in clocks; all times in seconds are computed from it.
  Clock now() const { return now_; }
  /// Pin changes during the last step; valid until the next advance().
  const std::vector<EncoderEvent>& events() const { return events_; }
  const Encoder& encoder() const { return encoder_; }
  const Observables& observables() const { return seen_; }

  /// Number of continuous states that the present hand and the effects that are on need.
  std::size_t state_size() const;
  /// These states with their names, in a fixed order.
  std::vector<StateValue> state() const;
  Evaluations evaluations() const;

 private:
  void set_step(Clock clocks);
  [[noreturn]] void refuse_motion(double way_rad) const;
  double advance_current(const Bridge& bridge, double omega_rad_s);
  double cogging_nm(double theta_rad) const;
  void push_back(const EndStops& stops, ShaftTorque& torque) const;
  void advance_shaft(double motor_nm, double friction_nm, double omega_mid_rad_s);

  Parameters p_;
  Effects on_;
  double clock_hz_;
  double per_radius_;       ///< 1/m
  double smooth_nm_s_rad_;  ///< viscous torque per omega, from the effects that are on
  BridgeModel bridge_;
  Winding winding_;
  Lugre lugre_;
  Supply supply_;
  Mechanics mechanics_;
  HandRun hand_;
  Shaft shaft_;
  Encoder encoder_;

  Clock now_ = 0;
  Clock step_clocks_ = -1;  ///< -1: none yet
  double dt_s_ = 0.0;
  double per_s_ = 0.0;                ///< 1/dt_s_
  double most_way_rad_ = 0.0;         ///< largest way in a step: one encoder state per clock
  double acceleration_rad_s2_ = 0.0;  ///< mean of the last step; predicts the next middle
  double current_a_ = 0.0;
  std::vector<EncoderEvent> events_;
  Observables seen_;
  Evaluations evaluations_;
};

}  // namespace feltgate::plant
