// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The plant behind the bridge: motor, lever, friction, encoder, supply and hand. It closes the loop
// in simulation. The motor here has brushes; three_phase.hpp has one without on the same shaft.
// Equations, step and convergence: docs/plant.md
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "brushed_motor.hpp"
#include "encoder.hpp"
#include "feltgate/encoder_source.hpp"
#include "hand.hpp"
#include "mechanics.hpp"
#include "parameters.hpp"

namespace feltgate::plant {

/// Gets step means, e.g. Observables::motor_torque_mean_nm; periods start at clock `phase`.
class PeriodMean {
 public:
  /// Errors: std::invalid_argument if the period is below one clock.
  explicit PeriodMean(Clock period_clocks, Clock phase = 0)
      : period_(period_clocks), left_(period_clocks) {
    if (period_clocks < 1) throw std::invalid_argument("PWM period below one clock");
    const Clock offset = phase % period_;
    if (offset > 0) left_ = offset;
    partial_ = offset > 0;
  }

  /// Adds `value`, held over `clocks`; returns how many periods ended in that time.
  int add(Clock clocks, double value) {
    int ended = 0;
    while (clocks > 0) {
      const Clock part = clocks < left_ ? clocks : left_;
      sum_ += value * static_cast<double>(part);
      clocks -= part;
      left_ -= part;
      if (left_ > 0) continue;
      if (!partial_) {
        mean_ = sum_ / static_cast<double>(period_);
        ++periods_;
        ++ended;
      }
      partial_ = false;
      sum_ = 0.0;
      left_ = period_;
    }
    return ended;
  }

  /// Mean of the last full period, in the unit of the signal; 0 before the first.
  double mean() const { return mean_; }
  std::int64_t periods() const { return periods_; }

 private:
  Clock period_;
  Clock left_;
  bool partial_ = false;
  double sum_ = 0.0;
  double mean_ = 0.0;
  std::int64_t periods_ = 0;
};

/// Outputs of the plant, at the end of the last step unless stated as mean.
struct Observables {
  double theta_rad = 0.0;
  double omega_rad_s = 0.0;
  double motor_current_a = 0.0;       ///< of three phases: that makes the torque
  double motor_current_mean_a = 0.0;  ///< over the last step
  double motor_torque_nm = 0.0;       ///< Kt*i, on the lever, before friction
  double motor_torque_mean_nm = 0.0;  ///< over the last step; feed PeriodMean with it
  double friction_nm = 0.0;           ///< mean of the last step, opposes positive omega
  double hand_torque_nm = 0.0;        ///< of the hand on the lever; mean where it imposes
  double hand_force_n = 0.0;          ///< hand torque over the radius of the hand
  double supply_current_a = 0.0;      ///< mean of the last step
  double bus_v = 0.0;
};

/// A motion that cannot be simulated: faster than one encoder state per clock, or not finite.
/// what() gives time, speed and what to change.
class MotionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Everything of a plant but its motor: lever, friction, encoder, supply and hand, step by step.
class ShaftPlant {
 public:
  /// The first clock after now() at which the hand's motion changes; up to there one long step is
  /// as good as many short ones.
  Clock next_corner() { return hand_.next_corner(now_); }

  /// Replaces the hand's phases by `phase`, forever; it starts at the lever's present angle.
  void take(const HandPhase& phase) { hand_.take(phase); }
  /// Sets the equilibrium of an impedance hand to `theta_rad`, moving at `rad_s`, until the next
  /// call. Call it after the first step of the phase; other hands ignore it.
  void steer(double theta_rad, double rad_s) { hand_.steer({theta_rad, rad_s}, now_); }

  /// Time since the start, in clocks; all times in seconds are computed from it.
  Clock now() const { return now_; }
  /// Pin changes during the last step; valid until the next advance().
  const std::vector<EncoderEvent>& events() const { return events_; }
  const Encoder& encoder() const { return encoder_; }
  const Observables& observables() const { return seen_; }

 protected:
  /// `hand` decides the angle at clock 0; the lever starts at rest.
  ShaftPlant(const Parameters& parameters, const Effects& effects, double clock_hz,
             const Hand& hand);

  /// Advances by `clocks` with the motor's mean torque. `drive(bus_v, middle)` moves the motor by
  /// the step, whose middle has this angle and speed, and returns its MotorStep.
  template <class Motor, class Advance>
  void step(Motor& motor, Clock clocks, const Advance& drive);
  /// The motor gets its step's length again: for one whose constants have changed.
  void renew_step() { step_clocks_ = -1; }
  /// Number of continuous states beside those of the motor.
  std::size_t shaft_states() const;

 private:
  void set_step(Clock clocks);
  [[noreturn]] void refuse_motion(double way_rad, double motor_nm) const;
  double cogging_nm(double theta_rad) const;
  void push_back(const EndStops& stops, ShaftTorque& torque) const;
  void advance_shaft(double motor_nm, double friction_nm, const Shaft& middle);

  Parameters p_;
  Effects on_;
  double clock_hz_;
  double per_radius_;       ///< 1/m
  double smooth_nm_s_rad_;  ///< viscous torque per omega, from the effects that are on
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
  std::vector<EncoderEvent> events_;
  Observables seen_;
};

/// The plant of a lever whose motor has brushes.
class Plant : public ShaftPlant {
 public:
  /// `hand` decides the angle at clock 0; the lever starts at rest, without current.
  /// Errors: std::invalid_argument for an impossible drive (see BridgeModel), and for a motor with
  /// three phases.
  Plant(const Parameters& parameters, const Effects& effects, const Drive& drive, const Hand& hand)
      : ShaftPlant(parameters, effects, drive.clock_hz, hand),
        motor_(parameters.motor, parameters.supply, drive, effects),
        inductance_(effects.inductance) {
    if (!parameters.phases) return;
    throw std::invalid_argument("plant " + parameters.name +
                                " has a motor with three phases, and here an H-bridge drives one "
                                "with brushes; choose another plant");
  }

  /// Advances by `clocks` >= 1 FPGA clocks with this bridge. Equal steps are fastest; 25 clocks
  /// (0.5 us) are recommended, at most 250 (5 us). Errors: MotionError.
  void advance(const Bridge& bridge, Clock clocks);

  /// Shorts the motor's terminals: from now on the bridge drives the wiring to the short alone. The
  /// motor's current is that of the wiring, and its torque means nothing any more.
  void short_motor(double wiring_ohm, double wiring_h);

  /// Number of continuous states that the present hand and the effects that are on need.
  std::size_t state_size() const { return shaft_states() + (inductance_ ? 1 : 0); }

 private:
  BrushedMotor motor_;
  bool inductance_;
};

template <class Motor, class Advance>
void ShaftPlant::step(Motor& motor, Clock clocks, const Advance& drive) {
  if (clocks != step_clocks_) {
    set_step(clocks);
    motor.set_step(dt_s_);
  }
  events_.clear();
  hand_.begin_step(now_, dt_s_, shaft_);

  const double before_rad = shaft_.theta_rad;
  const double before_rad_s = shaft_.omega_rad_s;
  const double omega_mid_rad_s = hand_.imposes()
                                     ? (hand_.target().theta_rad - before_rad) * per_s_
                                     : before_rad_s + 0.5 * dt_s_ * acceleration_rad_s2_;
  const Shaft middle{before_rad + 0.5 * dt_s_ * omega_mid_rad_s, omega_mid_rad_s};
  const MotorStep moved = drive(supply_.bus_v(), middle);
  seen_.supply_current_a = moved.bridge_a;
  if (on_.supply_limit) {
    seen_.supply_current_a = supply_.advance(moved.bridge_a, dt_s_);
    seen_.bus_v = supply_.bus_v();
  }
  double friction_nm = 0.0;
  if (on_.lugre) friction_nm = lugre_.advance(omega_mid_rad_s);
  advance_shaft(moved.torque_nm, friction_nm, middle);
  acceleration_rad_s2_ = hand_.imposes() ? 0.0 : (shaft_.omega_rad_s - before_rad_s) * per_s_;

  // Also true if a value is NaN.
  const double way_rad = shaft_.theta_rad - before_rad;
  if (!(std::abs(way_rad) <= most_way_rad_) ||
      !std::isfinite(moved.torque_nm + shaft_.omega_rad_s)) {
    refuse_motion(way_rad, moved.torque_nm);
  }
  encoder_.advance(shaft_.theta_rad, now_, clocks, events_);
  now_ += clocks;
  seen_.theta_rad = shaft_.theta_rad;
  seen_.omega_rad_s = shaft_.omega_rad_s;
  seen_.motor_current_a = motor.current_a(shaft_.theta_rad);
  seen_.motor_current_mean_a = moved.current_a;
  seen_.motor_torque_nm = motor.torque_nm(shaft_.theta_rad);
  seen_.motor_torque_mean_nm = moved.torque_nm;
  seen_.friction_nm = friction_nm + smooth_nm_s_rad_ * omega_mid_rad_s;
  seen_.hand_force_n = seen_.hand_torque_nm * per_radius_;
}

}  // namespace feltgate::plant
