// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// How stiff a plant may be for its step: beyond it the integrator's own error grows from step to
// step. Derivation: docs/plant.md
#pragma once

#include "hand.hpp"
#include "parameters.hpp"

namespace feltgate::plant {

/// The Runge-Kutta step of the mechanics damps every pole whose product with the step is below.
constexpr double most_pole_steps = 2.5;

/// The largest magnitude of a pole of lever, cord, hand and viscous friction in this phase, 1/s.
/// `radius_m` is where the hand holds. 0 where the hand imposes the angle.
double mechanical_pole_1_s(const Parameters& p, const Effects& on, const HandPhase& phase,
                           double radius_m);

/// Bristles and back-EMF act on the lever from the outside of the Runge-Kutta step, by the speed
/// predicted for its middle: the larger of their damping rate over 1 and their natural frequency
/// over 0.3, 1/s, which times the step must stay below 1.
double outer_pole_1_s(const Parameters& p, const Effects& on, double step_s);

}  // namespace feltgate::plant
