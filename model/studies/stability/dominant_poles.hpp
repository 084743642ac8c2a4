// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Finds the dominant poles of a loop that is given as a function on its state. Derivation:
// docs/speed-for-accuracy.md
#pragma once

#include <Eigen/Core>
#include <complex>
#include <functional>
#include <vector>

namespace feltgate::stability {

/// An eigenvalue as a pole, rad/s.
using Pole = std::complex<double>;

/// The poles with the largest real parts, the fastest growing first; of a conjugate pair, the one
/// with imag >= 0. `after` is linear and advances a state by `seconds`. At most `most` eigenvalues
/// are computed; the start vector must contain every wanted mode.
std::vector<Pole> dominant_poles(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& after,
    const Eigen::VectorXd& start, Eigen::Index most, double seconds);

}  // namespace feltgate::stability
