// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The pen of the pantograph under a hand that a mouse leads, and a law of two axes that pushes it:
// program words and counts, without cores, motors and friction. Documentation: docs/page.md
#pragma once

#include <memory>
#include <string>

#include "page/image_law.hpp"
#include "page/pace.hpp"
#include "plant/hand.hpp"
#include "shape/rhombus.hpp"

namespace feltgate::page {

class PenLoop {
 public:
  /// Where the pen can be: m from the motors, and in front of them.
  static constexpr double nearest_m = 0.04, farthest_m = 0.19, front_m = 0.02;

  /// The pen rests at (0, 0.06) m. Errors: std::invalid_argument for a broken image.
  explicit PenLoop(const std::string& image_text);

  /// Another law under the same pen and hand. Errors: std::invalid_argument.
  void load(const std::string& image_text);
  void set(const std::string& parameter, double value) { law_->set(parameter, value); }
  /// Pen and hand at rest there.
  void place(shape::Point at_m);
  /// Where the hand wants to be when the next advance() ends; it moves there evenly. Drawn into
  /// reach; what is no place is not followed.
  void lead(shape::Point to_m);
  /// Runs the law as often as fits, at its own rate; the rest of the time waits for the next call.
  void advance(double seconds);

  shape::Point pen_m() const { return pen_m_; }
  shape::Point velocity_m_s() const { return velocity_m_s_; }
  shape::Point hand_m() const { return hand_m_; }
  /// Of the law on the pen, in the last run.
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
