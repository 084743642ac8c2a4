// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// How far a law of a scene is from the border of stability at a rate. Documentation: docs/rates.md
#pragma once

#include "rates/continuous.hpp"
#include "stability/axes_linear_loop.hpp"
#include "stability/linear_loop.hpp"

namespace feltgate::rates {

struct Margin {
  enum class Of { stiffness, damping, none } of = Of::none;
  double border = 0;  ///< largest stable stiffness with the law's damping, Nm/rad; or damping
  double ratio = 0;   ///< border over what the law has; at 1 the loop swings for ever
};

/// By the eigenvalues of the linear loop, stiffness scaled at the law's damping; of a law that is
/// nowhere stiff the damping. None where the law has neither, or ends in a jump alone.
/// `delay_ticks`: from the samples of a run to the first tick in which its torque is in force, at
/// most `scene_ticks`.
Margin margin(const stability::LoopModel& model, const Slope& slope, int scene_ticks,
              int delay_ticks);

/// The same of several axes: the whole matrix of the stiffness is scaled, or that of the damping.
Margin margin(const stability::AxesLoopModel& model, const Slope& slope, int scene_ticks,
              int delay_ticks);

}  // namespace feltgate::rates
