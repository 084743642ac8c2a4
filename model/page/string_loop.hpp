// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A lever in a hand that draws a bow across a string: the law's words and the counts of one joint,
// without core, motor and friction of the lever; what the bridge hears. Documentation: docs/page.md
#pragma once

#include <string>
#include <vector>

#include "page/image_law.hpp"
#include "page/lever_hand.hpp"
#include "page/pace.hpp"

namespace feltgate::page {

/// A slip of the string below the bow, as the law told it.
struct StringSlip {
  double time_s = 0;   ///< of the run that told it
  double since_s = 0;  ///< from the slip before; 0.1 s stand for more too
};

class StringLoop {
 public:
  /// How far the hand can go, and where a bow that draws itself turns around.
  static constexpr double farthest_rad = 1.0, turn_rad = 0.9;

  /// Lever, hand and string rest at 0. `heard`: the state that comes to the bridge. Errors:
  /// std::invalid_argument for a broken image and for one that tells no slips.
  StringLoop(const std::string& image_text, const StateWord& heard);

  /// A parameter or a word of the mailbox: force (N), place. Errors: std::invalid_argument.
  void set(const std::string& parameter, double value) { law_.set(parameter, value); }
  /// The angle where the hand wants the lever when the next advance() ends; it moves there evenly.
  void lead(double theta_rad);
  /// The bow by itself: the hand goes evenly to and fro so that the bow has this speed, m/s. 0, and
  /// what is no number: lead() leads again, from where the hand is.
  void draw(double bow_m_s);
  /// Runs the law as often as fits; the rest of the time waits for the next call.
  void advance(double seconds);

  double theta_rad() const { return theta_rad_; }
  double speed_rad_s() const { return speed_rad_s_; }
  double hand_rad() const { return hand_rad_; }
  /// Of the law on the lever, in the last run.
  double torque_nm() const { return torque_nm_; }
  /// In the mean of the last advance() that ran the law: what a hand feels of it.
  double mean_nm() const { return mean_nm_; }
  double time_s() const { return time_s_; }
  const ImageLaw& law() const { return law_; }
  /// Of the last advance(), in order.
  const std::vector<StringSlip>& slips() const { return slips_; }
  /// What came to the bridge in each run of the last advance(), m/s.
  const std::vector<float>& heard_m_s() const { return heard_m_s_; }

 private:
  double hand_rad_s(double led_rad_s, double dt_s);
  void step(double dt_s, double hand_rad_s);

  ImageLaw law_;
  StateWord heard_;
  double slip_s_ = 0;  ///< of 1 in the word of a slip
  LeverHand hand_;
  double theta_rad_ = 0, speed_rad_s_ = 0, hand_rad_ = 0, wanted_rad_ = 0, drawn_rad_s_ = 0;
  double torque_nm_ = 0, mean_nm_ = 0, time_s_ = 0;
  Pace pace_;
  std::vector<StringSlip> slips_;
  std::vector<float> heard_m_s_;
};

}  // namespace feltgate::page
