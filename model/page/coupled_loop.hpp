// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Two levers that nothing but a law couples: a hand that the mouse leads on either, something that
// the second one meets. Program words and counts, without cores, motors and friction.
// Documentation: docs/page.md
#pragma once

#include <array>
#include <string>

#include "page/image_law.hpp"
#include "page/lever_hand.hpp"
#include "page/pace.hpp"

namespace feltgate::page {

/// What the second lever meets.
enum class Met {
  nothing,
  spring,  ///< of a stiffness in Nm/rad, at rest at 0 rad
  wall,    ///< the same from CoupledLoop::wall_rad on
  weight,  ///< a torque towards lower angles, Nm
};

class CoupledLoop {
 public:
  static constexpr double most_rad = 1.0;  ///< that the hand is led to, either way
  static constexpr double wall_rad = 0.3;
  /// What the law reads as tau_hat lags by a first-order filter of this time, as an observer does.
  static constexpr double observer_s = 2e-3;

  /// Levers of this inertia each rest at 0 rad, the hand holds the first. Errors:
  /// std::invalid_argument for a broken image.
  CoupledLoop(const std::string& image_text, double inertia_kg_m2)
      : law_(image_text), inertia_kg_m2_(inertia_kg_m2) {}

  /// A parameter of the law. Errors: std::invalid_argument.
  void set(const std::string& parameter, double value) { law_.set(parameter, value); }
  /// The hand holds this lever from now on, 0 or 1, where it is; it brings its mass along, at the
  /// lever's speed. Errors: std::invalid_argument.
  void hold(int lever);
  /// Strength: Nm/rad of spring and wall, Nm of the weight. Errors: std::invalid_argument, of a
  /// negative one.
  void meet(Met what, double strength);
  /// The angle where the hand wants its lever when the next advance() ends; it moves there evenly.
  void lead(double theta_rad);
  /// Runs the law as often as fits; the rest of the time waits for the next call.
  void advance(double seconds);

  int held() const { return held_; }
  double theta_rad(int lever) const { return levers_[index(lever)].theta_rad; }
  double hand_rad() const { return hand_rad_; }
  /// Of the law on a lever, in the last run.
  double torque_nm(int lever) const { return levers_[index(lever)].torque_nm; }
  /// What the second lever meets gives it, Nm.
  double met_nm() const { return met_nm_; }
  double time_s() const { return time_s_; }
  const ImageLaw& law() const { return law_; }

 private:
  struct Lever {
    double theta_rad = 0, speed_rad_s = 0, torque_nm = 0, observed_nm = 0;
  };
  static std::size_t index(int lever) { return static_cast<std::size_t>(lever); }
  void step(double dt_s, double hand_rad_s);
  double given_nm(double theta_rad) const;

  ImageLaw law_;
  double inertia_kg_m2_;
  LeverHand hand_;
  std::array<Lever, 2> levers_;
  int held_ = 0;
  Met met_ = Met::nothing;
  double strength_ = 0, met_nm_ = 0;
  double hand_rad_ = 0, wanted_rad_ = 0, time_s_ = 0;
  Pace pace_;
};

}  // namespace feltgate::page
