// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Computes the force of a shape's law on a pen in real numbers: the pen moves from place to place,
// and the law runs at each. Documentation: docs/devices/shapes.md
#pragma once

#include <array>
#include <string>
#include <vector>

#include "law/evaluate.hpp"
#include "studies/shape/rhombus.hpp"
#include "studies/shape/rounded.hpp"

namespace feltgate::shape {

/// A pen that the caller moves, with a law of two axes.
class Pen {
 public:
  explicit Pen(const law::Law& law) : law_(law), run_(law) {}
  /// The force, N, after `runs` runs with the pen at rest at `pen_m`.
  Point at(Point pen_m, int runs = 1);
  /// Sets a parameter of the law by its index in Law::parameters, SI.
  void set_parameter(std::size_t index, double si) { run_.set_parameter(index, si); }
  const law::Evaluation<double>& evaluation() const { return run_; }

 private:
  const law::Law& law_;
  law::Evaluation<double> run_;
};

struct Felt {
  double rms_error = 0;               ///< error of the force relative to the smooth curve's force
  double most_step = 0;               ///< largest relative change of force per step of the pen
  int jumps = 0;                      ///< steps in which the force turns by more than 30 degrees
  std::vector<Point> pen_m, force_n;  ///< of every step
};

/// Leads a pen once around inside the curve at depth `depth_m`, in steps of `step_m`.
Felt around(const law::Law& law, const Curve& curve, double stiffness_n_per_m, double depth_m,
            double step_m);

/// Number of changes of direction beyond 30 degrees between consecutive forces that can be felt.
int jumps(const std::vector<Point>& forces);

}  // namespace feltgate::shape
