// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Poles of a loop that is known by what it does to a state. Derivation: docs/stability.md
#pragma once

#include <Eigen/Dense>
#include <complex>
#include <functional>
#include <vector>

namespace feltgate::stability {

/// An eigenvalue as a pole, rad/s.
using Pole = std::complex<double>;

/// Poles nearest to growth, the fastest growing first; those of a conjugate pair with imag >= 0.
/// `after` is linear and takes a state `seconds` on; at most `most` of its eigenvalues are sought,
/// from a start that no wanted mode may lack.
std::vector<Pole> dominant_poles(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& after,
    const Eigen::VectorXd& start, Eigen::Index most, double seconds);

}  // namespace feltgate::stability
