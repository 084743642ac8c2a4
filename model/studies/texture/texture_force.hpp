// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Computes the force of a texture in the engine's words, and its vertical firmness with and without
// the split of the depth. Documentation: docs/devices/shapes.md
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "law/compile.hpp"
#include "law/engine/machine.hpp"
#include "studies/shape/rhombus.hpp"
#include "studies/texture/texture_law.hpp"

namespace feltgate::texture {

/// Runs a compiled law in the interpreter, with the values of its file.
class Words {
 public:
  explicit Words(const law::Compiled& compiled);
  /// Torques of the axes, Nm, of a run at positions in counts and velocities in words.
  std::array<double, 3> torque_nm(const std::array<std::int32_t, 3>& counts,
                                  const std::array<std::int32_t, 3>& velocities = {});
  double count_rad() const { return count_rad_; }

 private:
  law::Machine machine_;
  int thread_;
  double count_rad_;
  std::array<double, 3> lsb_nm_{};  ///< LSB of each torque; 0 if the law has none for the axis
};

/// A row under the pantograph: the place of the pen after rounding to counts, and the force there.
struct PenForce {
  shape::Point at_m, force_n;
};
PenForce pen_force(Words& words, shape::Point pen_m);

/// Throws std::invalid_argument when the area of +-`half_m` along the row, from black down to
/// `below_m` below it, leaves the reach of the pantograph's pen.
void check_reach(const LawRequest& r, double half_m, double below_m);

/// Force of the plane through two pixels only, as wide as its texel: it acts along the normal, with
/// the depth along the normal, and ends where the normal leaves the texel. `x_m` from the first
/// pixel, `below_m` below black.
shape::Point plane_force(const std::vector<double>& row, const LawRequest& r, double x_m,
                         double below_m);

/// Vertical force gained from black to `firmness_depth_m` below it, divided by stiffness and
/// distance, averaged along the row: 1 is the requested firmness.
struct Firmness {
  double split = 0, plane = 0;
};
constexpr double firmness_depth_m = 3e-3;
Firmness firmness(const law::Compiled& compiled, const std::vector<double>& row,
                  const LawRequest& r);

}  // namespace feltgate::texture
