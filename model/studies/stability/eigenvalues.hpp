// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The eigenvalues of a real matrix, compiled once: Eigen's solver is ten seconds of the compiler
// wherever it is used. Documentation: docs/stability.md
#pragma once

#include <Eigen/Core>

namespace feltgate::stability {

/// All eigenvalues of a square matrix, in no order.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);

/// exp(a*t) - 1, by a Taylor series and doubling.
Eigen::MatrixXd matrix_exp_minus_one(const Eigen::MatrixXd& a, double t);

}  // namespace feltgate::stability
