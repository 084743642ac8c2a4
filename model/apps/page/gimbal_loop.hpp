// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A handle that turns about three axes, in a hand that a mouse turns, and the body of the law
// rigid_body behind it. Simulates the law's words, without cores, motors and friction.
// Documentation: docs/page.md
#pragma once

#include <array>
#include <string>

#include "apps/page/image_law.hpp"
#include "apps/page/lever_hand.hpp"
#include "apps/page/pace.hpp"
#include "sim/plant/rotation.hpp"

namespace feltgate::page {

/// The design for which the law's image is compiled; it need not be built in.
DesignInfo gimbal_design();

class GimbalLoop {
 public:
  static constexpr double host_hz = 1000;  ///< at which a host sends the handle's orientation
  /// The states of the body's quaternion: w, x, y, z.
  using BodyWords = std::array<StateWord, 4>;

  /// Hand, handle and body rest with the axes of the base. Throws std::invalid_argument for a
  /// broken image.
  GimbalLoop(const std::string& image_text, const BodyWords& body);

  /// A parameter of the law. Throws std::invalid_argument.
  void set(const std::string& parameter, double value) { law_.set(parameter, value); }
  /// The hand turns by this vector, rad, about the axes of the base, at constant speed during the
  /// next advance(). A vector that is not finite is ignored.
  void turn(plant::Vec3 rad);
  /// Runs the law as often as it fits in the time; the remainder is added to the next call.
  void advance(double seconds);

  const plant::Quaternion& hand() const { return hand_; }
  const plant::Quaternion& handle() const { return handle_; }
  plant::Quaternion body() const;
  /// Torque of the law on the handle in the last run, Nm.
  plant::Vec3 torque_nm() const { return torque_nm_; }
  /// Angle between handle and body, the shorter way, rad.
  double twist_rad() const;
  double time_s() const { return time_s_; }
  const ImageLaw& law() const { return law_; }

 private:
  void step(double dt_s, plant::Vec3 hand_rad_s);

  ImageLaw law_;
  BodyWords body_;
  LeverHand held_;  ///< spring, damper and mass of the hand, at a radius of 0.1 m
  plant::Quaternion hand_, handle_;
  plant::Vec3 wanted_rad_, speed_rad_s_, torque_nm_;
  int runs_per_host_;
  int runs_ = 0;  ///< until the host sends
  double time_s_ = 0;
  Pace pace_;
};

}  // namespace feltgate::page
