// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// How stiff a plant may be for its step; beyond that, the integrator's error grows from step to
// step. Derivation: docs/plant.md
#pragma once

#include "hand.hpp"
#include "parameters.hpp"

namespace feltgate::plant {

/// The Runge-Kutta step of the mechanics is stable if (pole * step) is below this, for every pole.
constexpr double most_pole_steps = 2.5;

/// The largest magnitude of a pole of lever, cord, hand and viscous friction in this phase, 1/s; 0
/// if the hand imposes the angle. `radius_m` is where the hand holds.
double mechanical_pole_1_s(const Parameters& p, const Effects& on, const HandPhase& phase,
                           double radius_m);

/// Bristles and back-EMF act on the lever outside the Runge-Kutta step, through the speed predicted
/// for the step's middle. Returns the larger of (damping rate / 1) and (natural frequency / 0.3),
/// 1/s; the step times this value must stay below 1.
double outer_pole_1_s(const Parameters& p, const Effects& on, double step_s);

}  // namespace feltgate::plant
