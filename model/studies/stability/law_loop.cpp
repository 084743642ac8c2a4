// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/stability/law_loop.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include <Eigen/SVD>

#include "studies/stability/linear_loop.hpp"

namespace feltgate::stability {

namespace {

using Index = Eigen::Index;

/// The states that can be reached from `first` by steps(from, to).
template <class Steps>
std::vector<bool> reached(std::vector<bool> first, const Steps& steps) {
  const auto at = [](Index i) { return static_cast<std::size_t>(i); };
  const auto n = static_cast<Index>(first.size());
  std::vector<Index> open;
  for (Index i = 0; i < n; ++i) {
    if (first[at(i)]) open.push_back(i);
  }
  while (!open.empty()) {
    const Index from = open.back();
    open.pop_back();
    for (Index to = 0; to < n; ++to) {
      if (first[at(to)] || !steps(from, to)) continue;
      first[at(to)] = true;
      open.push_back(to);
    }
  }
  return first;
}

}  // namespace

LinearLaw in_loop(const LinearLaw& law) {
  const Index n = law.a.rows(), axes = law.axes();
  Eigen::MatrixXd acts = law.a.cwiseAbs(), tells = law.c.cwiseAbs();
  for (const LinearLaw::Tap& t : law.taps) {
    acts.col(t.from) += t.to.head(n).cwiseAbs();
    tells.col(t.from) += t.to.tail(axes).cwiseAbs();
  }
  std::vector<bool> moved, shown;
  for (Index i = 0; i < n; ++i) {
    moved.push_back(!law.b.row(i).isZero(0));
    shown.push_back(!tells.col(i).isZero(0));
  }
  moved = reached(moved, [&](Index from, Index to) { return acts(to, from) != 0; });
  shown = reached(shown, [&](Index from, Index to) { return acts(from, to) != 0; });
  std::vector<Index> kept;
  for (Index i = 0; i < n; ++i) {
    if (moved[static_cast<std::size_t>(i)] && shown[static_cast<std::size_t>(i)]) kept.push_back(i);
  }
  const auto size = static_cast<Index>(kept.size());
  LinearLaw out = law;
  out.a = law.a(kept, kept);
  out.b = law.b(kept, Eigen::all);
  out.c = law.c(Eigen::all, kept);
  out.taps.clear();
  for (const LinearLaw::Tap& t : law.taps) {
    const auto at = std::find(kept.begin(), kept.end(), t.from);
    if (at == kept.end()) continue;
    Eigen::VectorXd to(size + axes);
    to << t.to(kept), t.to.tail(axes);
    if (!to.isZero(0)) out.taps.push_back({at - kept.begin(), t.runs, to});
  }
  return out;
}

Eigen::MatrixXcd torque_per_angle(const LinearLaw& law, double period_s, double hz) {
  using Complex = std::complex<double>;
  using Matrix = Eigen::MatrixXcd;
  const Index n = law.a.rows(), axes = law.axes();
  const Complex rate(0, 2 * 3.141592653589793 * hz), z = std::exp(rate * period_s);
  // Of angles that swing with this frequency, of their velocities, and of what the host samples.
  const auto swung = [&](const Eigen::MatrixXd& of) {
    Matrix sum = of.leftCols(axes) + rate * of.middleCols(axes, axes);
    for (Index from = 3 * axes; from < of.cols(); from += axes) sum += of.middleCols(from, axes);
    return sum;
  };
  const Matrix nm_rad = swung(law.d);
  if (n == 0) return nm_rad;
  Matrix of_z = z * Matrix::Identity(n, n) - law.a.cast<Complex>();
  Matrix shows = law.c.cast<Complex>();
  for (const LinearLaw::Tap& t : law.taps) {
    const Complex late = std::pow(z, -t.runs);
    of_z.col(t.from) -= late * t.to.head(n);
    shows.col(t.from) += late * t.to.tail(axes);
  }
  return nm_rad + shows.lazyProduct(solved(of_z, swung(law.b)));
}

Steepness steepness(const LinearLaw& law, double period_s, const Eigen::MatrixXd& per_torque) {
  Steepness out;
  for (const double hz : {5.0, 50.0, 500.0}) {
    const Eigen::MatrixXcd nm_rad = torque_per_angle(law, period_s, hz);
    if (hz == 50.0) {
      const Eigen::MatrixXd spring = -nm_rad.real();
      out.spring_nm_rad = eigenvalues(spring).real().maxCoeff();
      out.fastest = eigenvalues(per_torque.lazyProduct(spring)).real().maxCoeff();
    }
    // It is square: nothing comes before the SVD.
    const Eigen::JacobiSVD<Eigen::MatrixXcd, Eigen::NoQRPreconditioner> svd(nm_rad);
    out.most_nm_rad = std::max(out.most_nm_rad, svd.singularValues()[0]);
  }
  return out;
}

}  // namespace feltgate::stability
