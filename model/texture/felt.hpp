// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What is felt of a texture, in the engine's words, and how firm it is upright with and without the
// split of the depth. Documentation: docs/devices/texture.md
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/machine.hpp"
#include "law/compile.hpp"
#include "shape/rhombus.hpp"
#include "texture/texture_law.hpp"

namespace feltgate::texture {

/// A compiled law in the interpreter of its words, with the values of its file.
class Words {
 public:
  explicit Words(const law::Compiled& compiled);
  /// Torques of the axes, Nm, of a run at these positions, in counts, and velocities, in words.
  std::array<double, 3> torque_nm(const std::array<std::int32_t, 3>& counts,
                                  const std::array<std::int32_t, 3>& velocities = {});
  double count_rad() const { return count_rad_; }

 private:
  law::Machine machine_;
  int thread_;
  double count_rad_;
  std::array<double, 3> lsb_nm_{};  ///< 0 where the law has no torque for the axis
};

/// A row under the pantograph: where counts have the pen that is asked to be at `pen`, and the
/// force there.
struct PenForce {
  shape::Point at_m, force_n;
};
PenForce pen_force(Words& words, shape::Point pen_m);

/// Throws std::invalid_argument where a way of +-`half_m` along the row, from black to `below_m`
/// under it, leaves what the pen of the pantograph reaches.
void check_reach(const LawRequest& r, double half_m, double below_m);

/// The plane through two pixels alone, as wide as its texel: force along its normal with the depth
/// along it, which ends where it leaves the texel. `x_m` from the first pixel, `below_m` black.
shape::Point plane_force(const std::vector<double>& row, const LawRequest& r, double x_m,
                         double below_m);

/// Upright force that is gained from black to `firmness_depth_m` below, over stiffness and way,
/// mean along the row: 1 is as firm as asked for.
struct Firmness {
  double split = 0, plane = 0;
};
constexpr double firmness_depth_m = 3e-3;
Firmness firmness(const law::Compiled& compiled, const std::vector<double>& row,
                  const LawRequest& r);

}  // namespace feltgate::texture
