// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/stability/eigenvalues.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace feltgate::stability {

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues();
}

Eigen::MatrixXd matrix_exp_minus_one(const Eigen::MatrixXd& a, double t) {
  const int doublings = std::max(0, std::ilogb(a.cwiseAbs().maxCoeff() * t) + 4);
  const Eigen::MatrixXd step = a * std::ldexp(t, -doublings);
  Eigen::MatrixXd term = step, sum = Eigen::MatrixXd::Zero(a.rows(), a.cols());
  for (int n = 2; n < 20; ++n) {
    sum += term;
    term = (term * step / n).eval();
  }
  for (int n = 0; n < doublings; ++n) sum = (2 * sum + sum * sum).eval();
  return sum;
}

}  // namespace feltgate::stability
