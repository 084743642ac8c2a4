// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A law of any number of axes, linear near one place: with states of its own (filters, masses,
// springs), delay lines, and a host that samples the device. Derivation: docs/speed-for-accuracy.md
#pragma once

#include <vector>

#include <Eigen/Core>

namespace feltgate::stability {

/// A host that samples all angles at its own rate; what it makes of them is in force a while later.
struct HostLink {
  double period_ticks = 0;  ///< 0: no host
  double age_ticks = 0;     ///< from a sample to the first tick whose run can see it
  double alpha = 1;         ///< of its filter s_n = alpha*x_n + (1 - alpha)*s_(n-1)
};

/// A law near one place. A run gives the torques c x + d u and leaves the states a x + b u. u has
/// the angles (rad) of all axes, then the velocity estimates (rad/s), the tau_hats (Nm) and, of a
/// law with a host, the angles that the host has sampled: filtered, and as they were.
struct LinearLaw {
  Eigen::MatrixXd a, b, c, d;
  /// A delay line: state `from`, as it was `runs` before, adds to the states and then the torques.
  struct Tap {
    Eigen::Index from = 0;
    int runs = 1;
    Eigen::VectorXd to;
  };
  std::vector<Tap> taps;
  HostLink host;
  Eigen::Index axes() const { return d.rows(); }
};

/// The law without the states that no input moves, or that no torque shows: a phase that turns by
/// itself has an eigenvalue of 1, which says nothing of the loop.
LinearLaw in_loop(const LinearLaw& law);

/// Torques per angle of a swing with this frequency, as complex numbers; a host's delay is left
/// out. For runs every `period_s`.
Eigen::MatrixXcd torque_per_angle(const LinearLaw& law, double period_s, double hz);

/// Torque per angle at 5, 50 and 500 Hz; of several axes along the direction with the most. The
/// delay of a host is left out.
struct Steepness {
  double spring_nm_rad = 0;  ///< at 50 Hz, against the angle and in phase with it: a spring's
  double most_nm_rad = 0;    ///< the largest magnitude of the three, a damper's included
  double fastest = 0;        ///< the spring divided by the inertia, of the fastest swing
};
/// For runs every `period_s`; `per_torque`: inverse of the axes' inertia.
Steepness steepness(const LinearLaw& law, double period_s, const Eigen::MatrixXd& per_torque);

}  // namespace feltgate::stability
