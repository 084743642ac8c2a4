// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What a pen feels of a shape's law, in real numbers: moved from place to place, the law run at
// each. Documentation: docs/devices/shapes.md
#pragma once

#include <array>
#include <string>
#include <vector>

#include "law/evaluate.hpp"
#include "shape/rhombus.hpp"
#include "shape/rounded.hpp"

namespace feltgate::shape {

/// A law of two axes under a pen that is led.
class Pen {
 public:
  explicit Pen(const law::Law& law) : law_(law), run_(law) {}
  /// The force after `runs` runs at p, at rest.
  Point at(Point pen_m, int runs = 1);
  /// A parameter of the law, by its place in Law::parameters.
  void set_parameter(std::size_t index, double si) { run_.set_parameter(index, si); }
  const law::Evaluation<double>& evaluation() const { return run_; }

 private:
  const law::Law& law_;
  law::Evaluation<double> run_;
};

struct Felt {
  double rms_error = 0;  ///< of the force against the smooth curve's, over that one's size
  double most_step = 0;  ///< largest change of force per step of the pen, over its size
  int jumps = 0;         ///< steps by which its direction turns by more than 30 degrees
  std::vector<Point> pen_m, force_n;  ///< every step
};

/// A pen led once around inside the curve at this depth, in steps of `step_m`.
Felt around(const law::Law& law, const Curve& curve, double stiffness_n_per_m, double depth_m,
            double step_m);

/// Changes of direction beyond 30 degrees between forces that follow each other and are felt.
int jumps(const std::vector<Point>& forces);

}  // namespace feltgate::shape
