// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/stability/dominant_poles.hpp"

#include <algorithm>

#include "studies/stability/eigenvalues.hpp"

namespace feltgate::stability {

// Arnoldi: the matrix is known by what it does to a vector, its largest eigenvalues are wanted and
// most of the others are 0 (the windows forget).
std::vector<Pole> dominant_poles(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& after,
    const Eigen::VectorXd& start, Eigen::Index most, double seconds) {
  const Eigen::Index n = start.size();
  most = std::min(most, n);
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(n, most + 1);
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(most + 1, most);
  basis.col(0) = start.normalized();
  Eigen::Index size = 0;
  while (size < most) {
    Eigen::VectorXd w = after(basis.col(size));
    const double scale = w.norm();
    for (int pass = 0; pass < 2; ++pass) {
      for (Eigen::Index i = 0; i <= size; ++i) {
        const double part = basis.col(i).dot(w);
        h(i, size) += part;
        w -= part * basis.col(i);
      }
    }
    h(size + 1, size) = w.norm();
    ++size;
    if (w.norm() <= 1e-13 * scale) break;
    basis.col(size) = w / w.norm();
  }
  std::vector<Pole> out;
  for (const Pole& z : eigenvalues(h.topLeftCorner(size, size))) {
    if (std::abs(z) > 1e-6 && z.imag() >= 0) out.push_back(std::log(z) / seconds);
  }
  std::sort(out.begin(), out.end(),
            [](const Pole& a, const Pole& b) { return a.real() > b.real(); });
  return out;
}

}  // namespace feltgate::stability
