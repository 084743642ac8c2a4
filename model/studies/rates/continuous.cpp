// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/rates/continuous.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "feltgate/generated/causes.hpp"
#include "feltgate/largest.hpp"
#include "studies/stability/linear_loop.hpp"

namespace feltgate::rates {

namespace {

constexpr double rounding_nm_rad = 1e-6;    ///< no more than that is no stiffness
constexpr int look_every = 20;              ///< runs between two looks at the slope
constexpr double look_at_place_s = 0.5e-3;  ///< the same for places: a look costs more
constexpr double speed_step_rad_s = 1e-3, observed_step_nm = 1e-4;
/// Causes for which the torque is not that of the law.
constexpr int left_out =
    static_cast<int>(limit::ramp | limit::gates_closed | limit::hold | limit::chatter);

}  // namespace

std::vector<Change> changes_of(const Scenario& scene, const law::Law& law) {
  std::vector<Change> all;
  const auto add = [&](double at_s, const std::map<std::string, double>& set) {
    for (std::size_t i = 0; i < law.parameters.size(); ++i) {
      const law::Parameter& p = law.parameters[i];
      const auto it = p.derived < 0 ? set.find(p.name) : set.end();
      if (it != set.end()) all.push_back({at_s, i, it->second * p.to_si});
    }
  };
  add(0, scene.parameters);
  for (const Event& e : scene.events) add(e.at_s, e.set);
  return all;
}

Continuous::Continuous(const law::Law& law, std::vector<Change> changes, const Setting& setting)
    : law_(law),
      changes_(std::move(changes)),
      setting_(setting),
      true_(law),
      sampled_(law),
      lines_(law.lines.size()),
      seen_(setting.axes),
      counted_(setting.axes),
      axes_(setting.axes) {
  for (const law::Output& o : law.outputs) axes_.at(static_cast<std::size_t>(o.axis)).driven = true;
  for (const law::Input& in : law.inputs) {
    observes_ = observes_ || in.source == law::Source::tau_hat;
  }
  for (const Estimator& by : setting.beside) {
    const auto m1 = static_cast<std::size_t>(by.m1);
    beside_.push_back({by,
                       law::Evaluation<double>(law),
                       std::vector<double>(m1),
                       0,
                       std::vector<Sample>(1),
                       0,
                       {}});
  }
}

double Continuous::mean_error_nm(std::size_t axis) const {
  const Axis& a = axes_[axis];
  return a.error.count() == 0 ? 0 : a.sum_nm / static_cast<double>(a.error.count());
}

void Continuous::set(std::size_t parameter, double si) {
  true_.set_parameter(parameter, si);
  sampled_.set_parameter(parameter, si);
  for (Beside& b : beside_) b.law.set_parameter(parameter, si);
}

double Continuous::limited(double nm) const {
  return std::clamp(nm, -setting_.limit_nm, setting_.limit_nm);
}

void Continuous::run(law::Evaluation<double>& law, const std::vector<Sample>& samples,
                     double Axis::*to_nm) {
  inputs_.clear();
  for (const law::Input& in : law_.inputs) {
    const Sample& s = samples[static_cast<std::size_t>(in.axis)];
    inputs_.push_back(in.source == law::Source::position   ? s.position_rad
                      : in.source == law::Source::velocity ? s.velocity_rad_s
                                                           : s.tau_hat_nm);
  }
  law.run(inputs_);
  for (std::size_t i = 0; i < law_.outputs.size(); ++i) {
    axes_[static_cast<std::size_t>(law_.outputs[i].axis)].*to_nm = limited(law.outputs()[i]);
  }
}

Eigen::VectorXd Continuous::probe(const std::vector<Sample>& samples) {
  law::Evaluation<double> copy = true_;
  run(copy, samples, &Axis::ideal_nm);
  Eigen::VectorXd nm(static_cast<Eigen::Index>(axes_.size()));
  for (std::size_t n = 0; n < axes_.size(); ++n) {
    nm[static_cast<Eigen::Index>(n)] = axes_[n].driven ? axes_[n].ideal_nm : 0;
  }
  return nm;
}

Eigen::MatrixXd Continuous::fall(double Sample::*input, double step) {
  const auto axes = static_cast<Eigen::Index>(axes_.size());
  Eigen::MatrixXd out(axes, axes);
  std::vector<Sample> at = seen_;
  for (std::size_t n = 0; n < axes_.size(); ++n) {
    const double middle = at[n].*input;
    at[n].*input = middle - step;
    const Eigen::VectorXd before = probe(at);
    at[n].*input = middle + step;
    out.col(static_cast<Eigen::Index>(n)) = before - probe(at);
    at[n].*input = middle;
  }
  return out;
}

// A slope is equal over a count and over a sixteenth of it; a difference that does not shrink with
// the distance is a jump.
bool Continuous::smooth(const Eigen::MatrixXd& wide, const Eigen::MatrixXd& narrow) {
  bool all_smooth = true;
  for (Eigen::Index n = 0; n < wide.cols(); ++n) {
    const double all = wide.col(n).cwiseAbs().maxCoeff();
    const double part = narrow.col(n).cwiseAbs().maxCoeff();
    const double off = (wide.col(n) - 16 * narrow.col(n)).cwiseAbs().maxCoeff();
    if (off <= 0.05 * all + 1e-9 * setting_.limit_nm) continue;
    all_smooth = false;
    if (part > 0.5 * all) slope_.jump_nm = std::max(slope_.jump_nm, part);
  }
  return all_smooth;
}

void Continuous::look() {
  const double h = setting_.count_rad / 2;
  const Eigen::MatrixXd wide = fall(&Sample::position_rad, h);
  if (!smooth(wide, fall(&Sample::position_rad, h / 16))) return;
  const Eigen::MatrixXd stiffness = wide / (2 * h);
  const Eigen::MatrixXd damping =
      fall(&Sample::velocity_rad_s, speed_step_rad_s) / (2 * speed_step_rad_s);
  const Eigen::VectorXd at = at_rad();
  const Eigen::MatrixXd per_torque = this->per_torque(at);
  const auto largest = [](const Eigen::MatrixXd& m) {
    return stability::eigenvalues(m).real().maxCoeff();
  };
  const double steep = largest(per_torque.lazyProduct(stiffness));
  const bool stiff = largest(stiffness) > rounding_nm_rad || slope_.stiffness_nm_rad > 0;
  if (largest(stiffness) <= rounding_nm_rad && wide.cols() > 1) {
    slope_.coupled = slope_.coupled || (stiffness - stiffness.transpose()).norm() > rounding_nm_rad;
  }
  const double compared = stiff ? steep : largest(per_torque.lazyProduct(damping));
  // A stiff place ends the search for places that only damp.
  if (stiff && slope_.stiffness_nm_rad <= 0) steepest_ = steepest_nm_ = 0;
  // Of places that are as steep, the one with the most torque: there the law is not about to end.
  const double here_nm = probe(seen_).cwiseAbs().maxCoeff();
  const bool steeper = compared > (stiff ? 1.001 : 1.0) * steepest_;
  const bool as_steep = stiff && compared > 0.999 * steepest_ && here_nm > steepest_nm_;
  if (compared <= 0 || (!steeper && !as_steep)) return;
  slope_.stiffness_nm_rad = stiff ? largest(stiffness) : 0;
  slope_.damping_nm_s_rad = largest(damping);
  slope_.stiffness = stiffness;
  slope_.damping = damping;
  slope_.observed = Eigen::MatrixXd::Zero(wide.rows(), wide.cols());
  if (observes_) {
    slope_.observed = -fall(&Sample::tau_hat_nm, observed_step_nm) / (2 * observed_step_nm);
  }
  slope_.at_rad = at;
  steepest_ = std::max(compared, steepest_);
  steepest_nm_ = here_nm;
}

Eigen::VectorXd Continuous::at_rad() const {
  Eigen::VectorXd at(static_cast<Eigen::Index>(axes_.size()));
  for (std::size_t n = 0; n < axes_.size(); ++n) {
    at[static_cast<Eigen::Index>(n)] = seen_[n].position_rad + axes_[n].zero_rad;
  }
  return at;
}

Eigen::MatrixXd Continuous::per_torque(const Eigen::VectorXd& at_rad) const {
  if (setting_.inertia) return stability::inverse(setting_.inertia(at_rad));
  return Eigen::MatrixXd::Identity(at_rad.size(), at_rad.size());
}

void Continuous::look_at_place() {
  const auto axes = static_cast<Eigen::Index>(axes_.size());
  Place here{Eigen::VectorXd(3 * axes), {}, {}, lines_, at_rad()};
  for (Eigen::Index n = 0; n < axes; ++n) {
    const Sample& s = seen_[static_cast<std::size_t>(n)];
    here.inputs[n] = s.position_rad;
    here.inputs[axes + n] = s.velocity_rad_s;
    here.inputs[2 * axes + n] = s.tau_hat_nm;
  }
  for (std::size_t i = 0; i < law_.states.size(); ++i) here.states.push_back(true_.state(i));
  for (std::size_t i = 0; i < law_.parameters.size(); ++i) {
    here.parameters.push_back(true_.parameter(i));
  }
  const auto linear = linearised(law_, here, setting_.count_rad, setting_.words);
  if (!linear || probe(seen_).cwiseAbs().maxCoeff() >= setting_.limit_nm) return;
  places_.note(here, *linear, setting_.run_s, per_torque(here.at_rad));
}

void Continuous::place(const Row* rows) {
  if (placed_) return;
  placed_ = true;
  const double q = setting_.count_rad;
  for (std::size_t n = 0; n < axes_.size(); ++n) {
    // The core counts from where it was reset. An encoder's zero is anywhere: a count is taken for
    // the middle of its angles.
    const Row& r = rows[n];
    axes_[n].zero_rad = std::floor(r.theta_rad / q) * q - r.position_rad + q / 2;
  }
}

void Continuous::estimate(Beside& b, const Row& row) const {
  const std::int64_t tick = b.ticks++;
  if (tick % b.by.every != 0) return;
  double& oldest_rad = b.travelled_rad[static_cast<std::size_t>(tick / b.by.every % b.by.m1)];
  const double raw = b.by.raw_rad_s_rad * (row.position_rad - oldest_rad);
  oldest_rad = row.position_rad;
  Sample& s = b.held.front();
  s = {row.position_rad, s.velocity_rad_s + b.by.a1 * (raw - s.velocity_rad_s), row.tau_hat_nm};
}

void Continuous::tick(const Row* rows) {
  place(rows);
  for (Beside& b : beside_) estimate(b, *rows);
  for (; next_ < changes_.size() && changes_[next_].at_s <= rows[0].time_s; ++next_) {
    set(changes_[next_].parameter, changes_[next_].si);
  }
  // The engine runs its law by the first axis.
  if ((rows[0].limits & static_cast<int>(limit::gates_closed)) != 0) {
    true_.reset();
    sampled_.reset();
    for (Beside& b : beside_) b.law.reset();
    lines_.assign(lines_.size(), {});
    ticks_ = 0;
    return;
  }
  if (ticks_++ % setting_.every == 0) {
    for (std::size_t n = 0; n < axes_.size(); ++n) {
      const Row& r = rows[n];
      seen_[n] = {r.theta_rad - axes_[n].zero_rad, r.omega_rad_s, r.tau_hat_nm};
      counted_[n] = {r.position_rad, r.velocity_rad_s, r.tau_hat_nm};
    }
    if (setting_.slope && runs_ % look_every == 0) look();
    const auto every = std::max<std::int64_t>(1, std::llround(look_at_place_s / setting_.run_s));
    if (setting_.places && runs_ % every == 0) look_at_place();
    ++runs_;
    if (setting_.floor) run(sampled_, counted_, &Axis::of_counts_nm);
    for (Beside& b : beside_) {
      run(b.law, b.held, &Axis::ideal_nm);
      b.of_counts_nm = axes_[0].ideal_nm;
    }
    run(true_, seen_, &Axis::ideal_nm);
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      lines_[i].insert(lines_[i].begin(), true_.value(law_.lines[i].written));
      const auto length = static_cast<std::size_t>(law_.lines[i].length);
      if (lines_[i].size() > length) lines_[i].pop_back();
    }
  }
  for (std::size_t n = 0; n < axes_.size(); ++n) {
    Axis& a = axes_[n];
    if (!a.driven || rows[0].law_stale || (rows[n].limits & left_out) != 0) continue;
    const double off_nm = rows[n].tau_ref_nm - a.ideal_nm;
    a.error.add(off_nm);
    a.sum_nm += off_nm;
    error_.add(off_nm);
    largest_nm_ = larger(largest_nm_, std::fabs(a.ideal_nm));
    if (setting_.floor) floor_.add(a.of_counts_nm - a.ideal_nm);
    for (Beside& b : beside_) b.error.add(b.of_counts_nm - a.ideal_nm);
  }
}

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
