// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A stick in a hand that the mouse leads, over drums: the law's words and the counts of one joint,
// without core, motor and friction. Documentation: docs/page.md
#pragma once

#include <string>
#include <vector>

#include "page/image_law.hpp"
#include "page/lever_hand.hpp"
#include "page/pace.hpp"

namespace feltgate::page {

/// What a law told.
struct StickEvent {
  std::string name;
  double value = 0;  ///< in SI
  double time_s = 0;
};

class StickLoop {
 public:
  static constexpr double highest_rad = 0.6, lowest_rad = -0.6;

  /// The stick rests at 0.3 rad. Errors: std::invalid_argument for a broken image.
  explicit StickLoop(const std::string& image_text);

  /// A parameter or a word of the mailbox. Errors: std::invalid_argument.
  void set(const std::string& parameter, double value) { law_.set(parameter, value); }
  /// The angle where the hand wants the stick when the next advance() ends; it moves there evenly.
  void lead(double theta_rad);
  /// Runs the law as often as fits; the rest of the time waits for the next call.
  void advance(double seconds);

  double theta_rad() const { return theta_rad_; }
  double speed_rad_s() const { return speed_rad_s_; }
  double hand_rad() const { return hand_rad_; }
  /// Of the law on the stick, in the last run.
  double torque_nm() const { return torque_nm_; }
  double time_s() const { return time_s_; }
  const ImageLaw& law() const { return law_; }
  /// Of the last advance(), in order.
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
