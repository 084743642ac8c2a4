// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The pen of the pantograph in a hand that a mouse leads, with a law of two axes that pushes it.
// Simulates program words and counts, without cores, motors and friction. Documentation:
// docs/page.md
#pragma once

#include <memory>
#include <string>

#include "apps/page/image_law.hpp"
#include "apps/page/pace.hpp"
#include "sim/plant/hand.hpp"
#include "studies/shape/rhombus.hpp"

namespace feltgate::page {

class PenLoop {
 public:
  /// Reach of the pen: smallest and largest distance from the motors, smallest distance in front of
  /// them, m.
  static constexpr double nearest_m = 0.04, farthest_m = 0.19, front_m = 0.02;

  /// The pen rests at (0, 0.06) m. Throws std::invalid_argument for a broken image.
  explicit PenLoop(const std::string& image_text);

  /// Replaces the law; pen and hand stay. Throws std::invalid_argument.
  void load(const std::string& image_text);
  void set(const std::string& parameter, double value) { law_->set(parameter, value); }
  /// Places pen and hand at rest at `at_m`.
  void place(shape::Point at_m);
  /// The place to which the hand moves at constant speed during the next advance(). It is moved
  /// into reach; a place that is not finite is ignored.
  void lead(shape::Point to_m);
  /// Runs the law at its own rate, as often as it fits in the time; the remainder is added to the
  /// next call.
  void advance(double seconds);

  shape::Point pen_m() const { return pen_m_; }
  shape::Point velocity_m_s() const { return velocity_m_s_; }
  shape::Point hand_m() const { return hand_m_; }
  /// Force of the law on the pen in the last run, N.
  shape::Point force_n() const { return force_n_; }
  const ImageLaw& law() const { return *law_; }
  double time_s() const { return time_s_; }

  static shape::Point within_reach(shape::Point p);

 private:
  void step(double dt_s, shape::Point hand_m_s);

  std::unique_ptr<ImageLaw> law_;
  plant::Impedance hand_;
  shape::Point pen_m_, velocity_m_s_, hand_m_, wanted_m_, force_n_;
  double time_s_ = 0;
  Pace pace_;
};

}  // namespace feltgate::page
