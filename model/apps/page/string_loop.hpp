// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A lever as a bow on a string, in a hand that the mouse leads. Simulates the law's words and the
// counts of one joint, without core, motor and friction of the lever, and returns the signal at the
// bridge. Documentation: docs/page.md
#pragma once

#include <string>
#include <vector>

#include "apps/page/image_law.hpp"
#include "apps/page/lever_hand.hpp"
#include "apps/page/pace.hpp"

namespace feltgate::page {

/// A slip of the string under the bow, as the law reports it.
struct StringSlip {
  double time_s = 0;   ///< time of the run that reported it
  double since_s = 0;  ///< time since the previous slip; 0.1 s means 0.1 s or more
};

class StringLoop {
 public:
  /// Largest |angle| of the hand, and the |angle| at which an automatic bow reverses.
  static constexpr double farthest_rad = 1.0, turn_rad = 0.9;

  /// Lever, hand and string rest at 0. `heard`: the state that arrives at the bridge. Throws
  /// std::invalid_argument for a broken image and for one without slip events.
  StringLoop(const std::string& image_text, const StateWord& heard);

  /// Sets a parameter or a word of the mailbox: force (N), place. Throws std::invalid_argument.
  void set(const std::string& parameter, double value) { law_.set(parameter, value); }
  /// The angle to which the hand moves the lever, at constant speed, during the next advance().
  void lead(double theta_rad);
  /// Draws the bow automatically: the hand moves to and fro so that the bow has this speed, m/s.
  /// With 0 or NaN, lead() moves the hand again, from its present angle.
  void draw(double bow_m_s);
  /// Runs the law as often as it fits in the time; the remainder is added to the next call.
  void advance(double seconds);

  double theta_rad() const { return theta_rad_; }
  double speed_rad_s() const { return speed_rad_s_; }
  double hand_rad() const { return hand_rad_; }
  /// Torque of the law on the lever in the last run, Nm.
  double torque_nm() const { return torque_nm_; }
  /// Mean torque in the last advance() that ran the law, Nm: a hand feels this torque.
  double mean_nm() const { return mean_nm_; }
  double time_s() const { return time_s_; }
  const ImageLaw& law() const { return law_; }
  /// Slips of the last advance(), in order.
  const std::vector<StringSlip>& slips() const { return slips_; }
  /// Velocity at the bridge in each run of the last advance(), m/s.
  const std::vector<float>& heard_m_s() const { return heard_m_s_; }

 private:
  double hand_rad_s(double led_rad_s, double dt_s);
  void step(double dt_s, double hand_rad_s);

  ImageLaw law_;
  StateWord heard_;
  double slip_s_ = 0;  ///< seconds per LSB of the word of a slip
  LeverHand hand_;
  double theta_rad_ = 0, speed_rad_s_ = 0, hand_rad_ = 0, wanted_rad_ = 0, drawn_rad_s_ = 0;
  double torque_nm_ = 0, mean_nm_ = 0, time_s_ = 0;
  Pace pace_;
  std::vector<StringSlip> slips_;
  std::vector<float> heard_m_s_;
};

}  // namespace feltgate::page
