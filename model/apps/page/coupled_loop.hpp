// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Two levers that only a law couples. The mouse leads a hand on one of them; the second lever can
// meet an object. Simulates program words and counts, without cores, motors and friction.
// Documentation: docs/page.md
#pragma once

#include <array>
#include <string>

#include "apps/page/image_law.hpp"
#include "apps/page/lever_hand.hpp"
#include "apps/page/pace.hpp"

namespace feltgate::page {

/// The object that the second lever meets.
enum class Met {
  nothing,
  spring,  ///< with a stiffness in Nm/rad, at rest at 0 rad
  wall,    ///< the same from CoupledLoop::wall_rad on
  weight,  ///< a torque towards lower angles, Nm
};

class CoupledLoop {
 public:
  static constexpr double most_rad = 1.0;  ///< that the hand is led to, either way
  static constexpr double wall_rad = 0.3;
  /// What the law reads as tau_hat lags by a first-order filter of this time, as an observer does.
  static constexpr double observer_s = 2e-3;

  /// Both levers have this inertia and rest at 0 rad; the hand holds the first. Throws
  /// std::invalid_argument for a broken image.
  CoupledLoop(const std::string& image_text, double inertia_kg_m2)
      : law_(image_text), inertia_kg_m2_(inertia_kg_m2) {}

  /// A parameter of the law. Errors: std::invalid_argument.
  void set(const std::string& parameter, double value) { law_.set(parameter, value); }
  /// The hand holds lever 0 or 1 from now on, at the lever's position and speed; its mass moves
  /// with the lever. Throws std::invalid_argument.
  void hold(int lever);
  /// Chooses the object. Strength: Nm/rad for spring and wall, Nm for the weight. Throws
  /// std::invalid_argument for a negative strength.
  void meet(Met what, double strength);
  /// The angle to which the hand moves its lever, at constant speed, during the next advance().
  void lead(double theta_rad);
  /// Runs the law as often as it fits in the time; the remainder is added to the next call.
  void advance(double seconds);

  int held() const { return held_; }
  double theta_rad(int lever) const { return levers_[index(lever)].theta_rad; }
  double hand_rad() const { return hand_rad_; }
  /// Torque of the law on a lever in the last run, Nm.
  double torque_nm(int lever) const { return levers_[index(lever)].torque_nm; }
  /// Torque of the object on the second lever, Nm.
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
