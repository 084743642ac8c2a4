// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A drum stick in a hand that the mouse leads. Simulates the law's words and the counts of one
// joint, without core, motor and friction. Documentation: docs/page.md
#pragma once

#include <string>
#include <vector>

#include "apps/page/image_law.hpp"
#include "apps/page/lever_hand.hpp"
#include "apps/page/pace.hpp"

namespace feltgate::page {

/// An event of the law.
struct StickEvent {
  std::string name;
  double value = 0;  ///< in SI
  double time_s = 0;
};

class StickLoop {
 public:
  static constexpr double highest_rad = 0.6, lowest_rad = -0.6;

  /// The stick rests at 0.3 rad. Throws std::invalid_argument for a broken image.
  explicit StickLoop(const std::string& image_text);

  /// Sets a parameter or a word of the mailbox. Throws std::invalid_argument.
  void set(const std::string& parameter, double value) { law_.set(parameter, value); }
  /// The angle to which the hand moves the stick, at constant speed, during the next advance().
  void lead(double theta_rad);
  /// Runs the law as often as it fits in the time; the remainder is added to the next call.
  void advance(double seconds);

  double theta_rad() const { return theta_rad_; }
  double speed_rad_s() const { return speed_rad_s_; }
  double hand_rad() const { return hand_rad_; }
  /// Torque of the law on the stick in the last run, Nm.
  double torque_nm() const { return torque_nm_; }
  double time_s() const { return time_s_; }
  const ImageLaw& law() const { return law_; }
  /// Events of the last advance(), in order.
  const std::vector<StickEvent>& events() const { return events_; }

 private:
  void step(double dt_s, double hand_rad_s);

  ImageLaw law_;
  LeverHand hand_;
  double theta_rad_ = 0.3, speed_rad_s_ = 0, hand_rad_ = 0.3, wanted_rad_ = 0.3;
  double torque_nm_ = 0, time_s_ = 0;
  Pace pace_;
  std::vector<StickEvent> events_;
};

}  // namespace feltgate::page
