// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Eigenvalues and exponential of a real matrix, in one source: Eigen's solver takes the compiler
// long. Documentation: docs/speed-for-accuracy.md
#pragma once

#include <Eigen/Core>

namespace feltgate::stability {

/// All eigenvalues of a square matrix, in no order.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);

/// exp(a*t) - 1 of a square matrix `a` and a time t >= 0 in the inverse of its unit, by a Taylor
/// series and doubling, so that small results keep their digits.
Eigen::MatrixXd matrix_exp_minus_one(const Eigen::MatrixXd& a, double t);

}  // namespace feltgate::stability
