// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The textbook loop: a mass with friction, a force held between samples, velocity by backward
// difference. It is small enough to check the method of the large loop by hand.
// Documentation: docs/speed-for-accuracy.md
#pragma once

namespace feltgate::stability {

/// SI units, linear or rotary alike: kg or kg m^2, N s/m or Nm s/rad.
struct MassLoop {
  double mass = 0;
  double friction = 0;     ///< b of the device
  double period_s = 0;     ///< of the scene; the force is held
  double damping = 0;      ///< B of the wall, on the backward difference
  double actuator_s = 0;   ///< time constant of the actuator, 0: ideal
  double dead_time_s = 0;  ///< between force and actuator
};

/// Largest modulus of the eigenvalues of one period.
double spectral_radius(const MassLoop& loop, double stiffness);

/// Largest stable stiffness by exact eigenvalues; 0 where none is.
double stiffest(const MassLoop& loop);

/// (b + B) / (T/2 + t_d).
double closed_form(const MassLoop& loop);

/// Stiffest wall over free space: K / (b * 2*pi*f), as impedances at f.
double z_width(double stiffness, double friction, double frequency_hz);

}  // namespace feltgate::stability
