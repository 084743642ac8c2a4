// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Computes the stability margin of a scene's law at a rate. Documentation:
// docs/speed-for-accuracy.md
#pragma once

#include "studies/rates/continuous.hpp"
#include "studies/stability/axes_linear_loop.hpp"
#include "studies/stability/law_loop.hpp"
#include "studies/stability/linear_loop.hpp"

namespace feltgate::rates {

struct Margin {
  enum class Of { stiffness, damping, torque, none } of = Of::none;
  double border = 0;  ///< largest stable stiffness at the law's damping, Nm/rad; or damping; of a
                      ///< law with states the largest stable torque per angle at its place
  double ratio = 0;   ///< border divided by the law's value; at 1 the loop oscillates for ever
  /// Growth without a swing at the law's own torque: a pen slides off a round body whose planes a
  /// host sends. It is no part of the margin then.
  double slides_1_s = 0;
};

/// Computes the margin by the eigenvalues of the linear loop: it scales the stiffness at the law's
/// damping, or the damping if the law is stiff nowhere. There is no margin if the law has neither,
/// or only a jump. `delay_ticks`: ticks from the samples of a run to the first tick with its
/// torque, at most `scene_ticks`.
Margin margin(const stability::LoopModel& model, const Slope& slope, int scene_ticks,
              int delay_ticks);

/// The margin of a law with states, or on what a host sends, at a place: it scales the whole
/// torque.
Margin margin(const stability::AxesLoopModel& model, const stability::LinearLaw& law,
              double steepness_nm_rad, int scene_ticks, int delay_ticks);

/// The same for several axes: it scales the whole matrix of the stiffness, or of the damping.
Margin margin(const stability::AxesLoopModel& model, const Slope& slope, int scene_ticks,
              int delay_ticks);

}  // namespace feltgate::rates
