// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/rates/linearise.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace feltgate::rates {

namespace {

using Index = Eigen::Index;

/// The law as a function of the numbers that are moved: inputs; states; what each line wrote last;
/// and what other runs read of earlier words of the lines.
class Law {
 public:
  struct Read {
    std::size_t line;
    int runs_ago;
  };

  Law(const law::Law& law, const Place& place, const HostWords& words)
      : law_(law), at_(law), place_(place), words_(words), axes_(place.inputs.size() / 3) {
    for (std::size_t i = 0; i < law.parameters.size(); ++i) {
      if (law.parameters[i].derived < 0) at_.set_parameter(i, place.parameters[i]);
    }
    for (std::size_t i = 0; i < law.states.size(); ++i) {
      if (!law.states[i].whole && !law.states[i].phase) moved_.push_back(i);
    }
    for (std::size_t i = 0; i < law.lines.size(); ++i) reads_.push_back({i, 1});
    find_reads();
  }
  Index axes() const { return axes_; }
  Index inputs() const { return (words_ ? 5 : 3) * axes_; }
  /// States of the linear law: the law's own, and a line's last word.
  Index states() const { return static_cast<Index>(moved_.size() + law_.lines.size()); }
  Index reads() const { return static_cast<Index>(reads_.size() - law_.lines.size()); }
  const Read& read(Index i) const {
    return reads_[law_.lines.size() + static_cast<std::size_t>(i)];
  }
  Index state_of_line(std::size_t line) const { return static_cast<Index>(moved_.size() + line); }

  /// Next states, then torques; `by` is added to number `which`.
  Eigen::VectorXd after(Index which, double by) const {
    const law::Evaluation<double> law = ran(which, by);
    Eigen::VectorXd out = Eigen::VectorXd::Zero(states() + axes_);
    Index i = 0;
    for (const std::size_t s : moved_) out[i++] = law.state(s);
    for (const law::Line& l : law_.lines) out[i++] = law.value(l.written);
    for (std::size_t k = 0; k < law_.outputs.size(); ++k) {
      out[states() + law_.outputs[k].axis] = law.outputs()[k];
    }
    return out;
  }
  /// Size of a small step of this number.
  double step(Index which, double count_rad) const {
    if (which >= inputs() + static_cast<Index>(moved_.size())) {
      return of_range(law_.lines[moved_read(which).line].range);
    }
    if (which >= inputs()) return of_range(law_.states[moved_state(which)].range);
    const Index kind = which / axes_;  // in the order of LinearLaw
    return kind == 1 ? 1e-3 : kind == 2 ? 1e-4 : count_rad / 2;
  }

 private:
  static double of_range(const law::Range& r) {
    const double width = r.upper - r.lower;
    return width > 0 ? 1e-5 * width : 1e-5;
  }
  std::size_t moved_state(Index which) const {
    return moved_[static_cast<std::size_t>(which - inputs())];
  }
  const Read& moved_read(Index which) const {
    return reads_[static_cast<std::size_t>(which - inputs()) - moved_.size()];
  }

  /// A copy of the law that has made its run.
  law::Evaluation<double> ran(Index which, double by) const {
    law::Evaluation<double> law = at_;
    Eigen::VectorXd u = Eigen::VectorXd::Zero(inputs());
    u.head(3 * axes_) = place_.inputs;
    for (Index i = 3; i < inputs() / axes_; ++i) u.segment(i * axes_, axes_) = u.head(axes_);
    if (which < inputs()) u[which] += by;
    if (words_) words_(u.segment(3 * axes_, axes_), u.tail(axes_), law);
    for (std::size_t i = 0; i < law_.states.size(); ++i) law.set_state(i, place_.states[i]);
    for (std::size_t i = 0; i < place_.lines.size(); ++i) {
      for (std::size_t k = 0; k < place_.lines[i].size(); ++k) {
        law.set_line(i, k + 1, place_.lines[i][k]);
      }
    }
    if (which >= inputs() + static_cast<Index>(moved_.size())) {
      const Read& r = moved_read(which);
      const auto k = static_cast<std::size_t>(r.runs_ago);
      const bool known = r.line < place_.lines.size() && k <= place_.lines[r.line].size();
      law.set_line(r.line, k, (known ? place_.lines[r.line][k - 1] : 0) + by);
    } else if (which >= inputs()) {
      const std::size_t i = moved_state(which);
      law.set_state(i, place_.states[i] + by);
    }
    std::vector<double> inputs;
    for (const law::Input& in : law_.inputs) {
      inputs.push_back(u[static_cast<Index>(in.source) * axes_ + in.axis]);
    }
    law.run(inputs);
    return law;
  }

  /// Which words of its lines the law reads there, besides the last ones.
  void find_reads() {
    if (law_.lines.empty()) return;
    const law::Evaluation<double> law = ran(0, 0);
    for (const law::Node& n : law_.nodes) {
      if (n.op != law::Op::line_read) continue;
      const Read r{static_cast<std::size_t>(n.index),
                   static_cast<int>(std::clamp(
                       std::floor(law.value(n.arguments[0])), 1.0,
                       static_cast<double>(law_.lines[static_cast<std::size_t>(n.index)].length)))};
      const bool known = std::any_of(reads_.begin(), reads_.end(), [&](const Read& o) {
        return o.line == r.line && o.runs_ago == r.runs_ago;
      });
      if (!known) reads_.push_back(r);
    }
  }

  const law::Law& law_;
  law::Evaluation<double> at_;
  const Place& place_;
  const HostWords& words_;
  Index axes_;
  std::vector<std::size_t> moved_;
  std::vector<Read> reads_;  ///< the last word of each line, then others
};

}  // namespace

void Places::note(const Place& place, const stability::LinearLaw& law, double period_s,
                  const Eigen::MatrixXd& per_torque) {
  const stability::Steepness s = stability::steepness(law, period_s, per_torque);
  if (law.a.rows() > 0) any_states_ = true;
  if (law.d.cols() > 3 * law.axes() &&
      !(law.d.rightCols(2 * law.axes()).isZero(0) && law.b.rightCols(2 * law.axes()).isZero(0))) {
    any_host_ = true;
  }
  const double values[] = {s.fastest, s.most_nm_rad};
  for (std::size_t i = 0; i < 2; ++i) {
    Best& best = best_[i];
    if (!(values[i] > 1.001 * best.value)) continue;
    best = {values[i], place};
    best.place.most_nm_rad = s.most_nm_rad;
  }
}

std::optional<stability::LinearLaw> linearised(const law::Law& law, const Place& place,
                                               double count_rad, const HostWords& words) {
  const Law function(law, place, words);
  const Index inputs = function.inputs(), n = function.states(), axes = function.axes();
  Eigen::MatrixXd all(n + axes, inputs + n + function.reads());
  for (Index k = 0; k < all.cols(); ++k) {
    const auto slope = [&](double h) -> Eigen::VectorXd {
      return (function.after(k, h) - function.after(k, -h)) / (2 * h);
    };
    // A slope is the same over a sixteenth of the step; at a jump it is not, however short the
    // step.
    bool smooth = false;
    for (double h = function.step(k, count_rad); !smooth; h /= 16) {
      const Eigen::VectorXd wide = slope(h), narrow = slope(h / 16);
      smooth = (wide - narrow).cwiseAbs().maxCoeff() <= 0.05 * wide.cwiseAbs().maxCoeff() + 1e-9;
      all.col(k) = narrow;
      if (!smooth && h < 1e-4 * function.step(k, count_rad)) return {};
    }
  }
  stability::LinearLaw out;
  out.a = all.block(0, inputs, n, n);
  out.b = all.topLeftCorner(n, inputs);
  out.c = all.block(n, inputs, axes, n);
  out.d = all.bottomLeftCorner(axes, inputs);
  for (Index i = 0; i < function.reads(); ++i) {
    const auto& read = function.read(i);
    out.taps.push_back(
        {function.state_of_line(read.line), read.runs_ago - 1, all.col(inputs + n + i)});
  }
  return stability::in_loop(out);
}

}  // namespace feltgate::rates
