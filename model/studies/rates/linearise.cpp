// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/rates.md
#include "studies/rates/linearise.hpp"

#include <Eigen/Core>
#include <cmath>

namespace feltgate::rates {

namespace {

/// The law as a function of the numbers that are moved: (inputs, states) to (torque, states).
class Law {
 public:
  Law(const law::Law& law, const Place& place) : law_(law), at_(law), place_(place) {
    for (std::size_t i = 0; i < law.parameters.size(); ++i) {
      if (law.parameters[i].derived < 0) at_.set_parameter(i, place.parameters[i]);
    }
    for (std::size_t i = 0; i < law.states.size(); ++i) {
      if (!law.states[i].whole && !law.states[i].phase) moved_.push_back(i);
    }
  }
  std::size_t states() const { return moved_.size(); }
  /// Torque and next states; `by` is added to number `which`: 0 to 2 an input, then a state.
  Eigen::VectorXd after(std::size_t which, double by) const {
    law::Evaluation<double> law = at_;
    for (std::size_t i = 0; i < law_.states.size(); ++i) law.set_state(i, place_.states[i]);
    if (which >= 3) {
      const std::size_t i = moved_[which - 3];
      law.set_state(i, place_.states[i] + by);
    }
    std::vector<double> inputs;
    for (const law::Input& in : law_.inputs) {
      const auto source = static_cast<std::size_t>(in.source);  // position, velocity, tau_hat
      const double own[] = {place_.position_rad, place_.velocity_rad_s, place_.tau_hat_nm};
      inputs.push_back(own[source] + (source == which ? by : 0));
    }
    law.run(inputs);
    Eigen::VectorXd out(static_cast<Eigen::Index>(1 + moved_.size()));
    out[0] = law.outputs()[0];
    for (std::size_t i = 0; i < moved_.size(); ++i) {
      out[static_cast<Eigen::Index>(1 + i)] = law.state(moved_[i]);
    }
    return out;
  }
  /// Size of a small step of this number.
  double step(std::size_t which, double count_rad) const {
    if (which == 0) return count_rad / 2;
    if (which == 1) return 1e-3;
    if (which == 2) return 1e-4;
    const law::Range& r = law_.states[moved_[which - 3]].range;
    const double width = r.upper - r.lower;
    return width > 0 ? 1e-5 * width : 1e-5;
  }

 private:
  const law::Law& law_;
  law::Evaluation<double> at_;
  const Place& place_;
  std::vector<std::size_t> moved_;
};

}  // namespace

void Places::note(const Place& place, const stability::LinearLaw& law, double period_s) {
  const stability::Steepness s = stability::steepness(law, period_s);
  if (law.a.rows() > 0) any_states_ = true;
  const double values[] = {s.spring_nm_rad, s.most_nm_rad};
  for (std::size_t i = 0; i < 2; ++i) {
    Best& best = best_[i];
    if (!(values[i] > 1.001 * best.value)) continue;
    best = {values[i], place};
    best.place.most_nm_rad = s.most_nm_rad;
  }
}

std::optional<stability::LinearLaw> linearised(const law::Law& law, const Place& place,
                                               double count_rad) {
  if (!law.lines.empty() || law.outputs.size() != 1) return {};
  const Law function(law, place);
  const auto n = static_cast<Eigen::Index>(function.states());
  Eigen::MatrixXd all(1 + n, 3 + n);
  for (Eigen::Index k = 0; k < 3 + n; ++k) {
    const auto which = static_cast<std::size_t>(k);
    const auto slope = [&](double h) -> Eigen::VectorXd {
      return (function.after(which, h) - function.after(which, -h)) / (2 * h);
    };
    // A slope is the same over a sixteenth of the step; at a jump it is not, however short the
    // step.
    bool smooth = false;
    for (double h = function.step(which, count_rad); !smooth; h /= 16) {
      const Eigen::VectorXd wide = slope(h), narrow = slope(h / 16);
      smooth = (wide - narrow).cwiseAbs().maxCoeff() <= 0.05 * wide.cwiseAbs().maxCoeff() + 1e-9;
      all.col(k) = narrow;
      if (!smooth && h < 1e-4 * function.step(which, count_rad)) return {};
    }
  }
  stability::LinearLaw out;
  out.d = all.row(0).head(3);
  out.c = all.row(0).tail(n);
  out.b = all.bottomLeftCorner(n, 3);
  out.a = all.bottomRightCorner(n, n);
  return stability::in_loop(out);
}

}  // namespace feltgate::rates
