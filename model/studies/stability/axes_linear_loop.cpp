// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/stability/axes_linear_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace feltgate::stability {

namespace {

using Vector = Eigen::VectorXd;
using Index = Eigen::Index;

struct Setting {
  double gain = 1, held_nm_rad = 0;
  int scene_ticks = 1, delay_ticks = 0;
  double host_phase_ticks = 0;  ///< its first sample
};

/// What all ticks of a run share, so that none allocates.
class AxesTicks {
 public:
  AxesTicks(const AxesLoopModel& model, const LinearLaw& law, const Setting& setting)
      : m_(model.axis),
        plant_(model.plant),
        law_(law),
        set_(setting),
        axes_(law.axes()),
        hand_(plant_.rows() - 3 * axes_),
        chains_(static_cast<std::size_t>(axes_)),
        state_(4 * axes_ + hand_),
        next_(3 * axes_ + hand_),
        u_(law.d.cols()),
        asked_(axes_),
        of_run_(law.a.rows() + axes_),
        sampled_(law.host.period_ticks > 0 ? 2 * axes_ : 0) {
    for (const LinearLaw::Tap& t : law.taps) longest_ = std::max(longest_, t.runs);
    if (sampled_.size() > 0) {
      // Samples of before the first tick that are still to come.
      const double late = std::max(0.0, law.host.age_ticks + set_.host_phase_ticks);
      under_way_ = static_cast<Index>(std::ceil(late / law.host.period_ticks));
    }
  }

  /// Plant, law as it was in the last runs, host, chains.
  Index size() const {
    return 3 * axes_ + hand_ + law_.a.rows() * (longest_ + 1) + sampled_.size() * (under_way_ + 1) +
           (sampled_.size() > 0 ? axes_ : 0) + axes_ * (AxisChain::scalars + m_.m1);
  }

  /// A vector in which no mode is at rest whose shares are ratios.
  Vector start() {
    Vector v = Vector::Constant(size(), 0.01);
    v.head(3 * axes_ + hand_).setZero();
    const Index chain = AxisChain::scalars + m_.m1, chains = size() - axes_ * chain;
    for (Index i = 0; i < axes_; ++i) {
      const double share = (i % 2 == 0 ? 1.0 : -1.0) / std::sqrt(static_cast<double>(i + 1));
      v[axes_ + i] = share;
      v[2 * axes_ + i] = 0.01 * share;
      v.segment(chains + i * chain, AxisChain::scalars).setZero();
      v[chains + i * chain] = share;
      v.segment(chains + i * chain + AxisChain::scalars, m_.m1).setConstant(0.01 * share);
    }
    return v;
  }

  Vector after(const Vector& v, int ticks) {
    const double* from = v.data();
    const auto take = [&](Index n) {
      const Vector out = Eigen::Map<const Vector>(from, n);
      from += n;
      return out;
    };
    state_.head(3 * axes_) = take(3 * axes_);
    state_.tail(hand_) = take(hand_);
    x_.clear();
    for (int i = 0; i <= longest_; ++i) x_.push_back(take(law_.a.rows()));
    arriving_.clear();
    if (sampled_.size() > 0) {
      sampled_ = take(2 * axes_);
      smooth_ = take(axes_);
      for (Index i = under_way_; i > 0; --i) {
        arriving_.push_back({arrival(-static_cast<long>(i)), take(2 * axes_)});
      }
    }
    for (AxisChain& c : chains_) {
      c.unpack(m_, from);
      from += AxisChain::scalars + m_.m1;
    }
    samples_ = 0;
    newest_ = 0;
    for (int k = 0; k < ticks; ++k) tick(k);
    return packed(v.size());
  }

 private:
  struct Arriving {
    double at = 0;
    Vector what;
  };
  double sampled_at(long sample) const {
    return static_cast<double>(sample) * law_.host.period_ticks + set_.host_phase_ticks;
  }
  double arrival(long sample) const { return sampled_at(sample) + law_.host.age_ticks; }

  Vector packed(Index size) const {
    Vector out(size);
    double* to = out.data();
    const auto put = [&](const Vector& v) {
      std::copy(v.data(), v.data() + v.size(), to);
      to += v.size();
    };
    put(state_.head(3 * axes_));
    put(state_.tail(hand_));
    for (int i = 0; i <= longest_; ++i) put(before(i));
    if (sampled_.size() > 0) {
      put(sampled_);
      put(smooth_);
      // As many as there is room for, the newest last; the ones before them have arrived.
      const auto room = static_cast<std::size_t>(under_way_);
      for (std::size_t i = 0; i < room; ++i) {
        const std::size_t has = arriving_.size();
        put(has + i < room ? sampled_ : arriving_[has + i - room].what);
      }
    }
    for (const AxisChain& c : chains_) {
      c.pack(to);
      to += AxisChain::scalars + m_.m1;
    }
    return out;
  }

  /// The law's states as they were `runs` before.
  const Vector& before(int runs) const {
    const auto n = x_.size();
    return x_[(newest_ + static_cast<std::size_t>(runs)) % n];
  }

  void sample(long k) {
    const HostLink& h = law_.host;
    if (static_cast<double>(k) >= sampled_at(samples_)) {
      const auto angles = state_.segment(2 * axes_, axes_);
      smooth_ = h.alpha * angles + (1 - h.alpha) * smooth_;
      Vector both(2 * axes_);
      both << smooth_, angles;
      arriving_.push_back({arrival(samples_++), both});
    }
    std::size_t come = 0;
    while (come < arriving_.size() && arriving_[come].at <= static_cast<double>(k)) ++come;
    if (come == 0) return;
    sampled_ = arriving_[come - 1].what;
    arriving_.erase(arriving_.begin(), arriving_.begin() + static_cast<std::ptrdiff_t>(come));
  }

  void run() {
    const Index n = law_.a.rows();
    u_.head(axes_) = state_.segment(2 * axes_, axes_);
    if (sampled_.size() > 0) u_.tail(2 * axes_) = sampled_;
    asked_.noalias() = law_.d * u_;
    if (n > 0) {
      const Vector& x = before(0);
      of_run_.head(n).noalias() = law_.a * x;
      of_run_.head(n).noalias() += law_.b * u_;
      asked_.noalias() += law_.c * x;
      for (const LinearLaw::Tap& t : law_.taps) {
        const double was = before(t.runs)[t.from];
        of_run_.head(n) += was * t.to.head(n);
        asked_ += was * t.to.tail(axes_);
      }
      newest_ = (newest_ + x_.size() - 1) % x_.size();
      x_[newest_] = of_run_.head(n);
    }
    asked_ *= set_.gain;
    asked_ -= set_.held_nm_rad * u_.head(axes_);
  }

  void tick(long k) {
    const Renewal renewal{set_.scene_ticks, set_.delay_ticks};
    for (Index n = 0; n < axes_; ++n) {
      AxisChain& c = chain(n);
      c.begin(m_, renewal, k);
      c.see(m_, state_[2 * axes_ + n]);
      u_[axes_ + n] = c.velocity;
      u_[2 * axes_ + n] = c.observed(m_);
    }
    if (sampled_.size() > 0) sample(k);
    if (k % set_.scene_ticks == 0) run();
    for (Index n = 0; n < axes_; ++n) {
      AxisChain& c = chain(n);
      c.ask(renewal, k, asked_[n]);
      c.drive(m_);
      state_[3 * axes_ + n] = c.volts;
    }
    next_.noalias() = plant_ * state_;
    state_.head(3 * axes_) = next_.head(3 * axes_);
    state_.tail(hand_) = next_.tail(hand_);
  }
  AxisChain& chain(Index n) { return chains_[static_cast<std::size_t>(n)]; }

  const LoopModel& m_;
  const Eigen::MatrixXd& plant_;
  const LinearLaw& law_;
  Setting set_;
  Index axes_, hand_;
  std::vector<AxisChain> chains_;
  Vector state_, next_, u_, asked_, of_run_;
  int longest_ = 0;
  std::vector<Vector> x_;  ///< the law's states before the next run and before earlier ones, a ring
  std::size_t newest_ = 0;
  Vector sampled_, smooth_;  ///< of the host: in force, and its filter
  Index under_way_ = 0;
  std::vector<Arriving> arriving_;
  long samples_ = 0;
};

/// Ticks after which the loop repeats. With a host it is a multiple of the law's period after which
/// the host's samples fall within half a percent of their period; the bridge's phase, 20 us at
/// most, may jump there too.
int repeats_ticks(const LoopModel& m, const LinearLaw& law, int scene_ticks) {
  if (law.host.period_ticks <= 0) return std::lcm(m.pwm_ticks, scene_ticks);
  int best = scene_ticks;
  double least_off = 1;
  for (int ticks = scene_ticks; ticks * m.tick_s <= 1; ticks += scene_ticks) {
    const double samples = ticks / law.host.period_ticks;
    const double off = std::abs(samples - std::round(samples));
    if (samples < 0.5 || off >= least_off) continue;
    least_off = off;
    best = ticks;
    if (off < 5e-3) break;
  }
  return best;
}

/// The phase of the host in which its words wait for half a run on average, as they do where the
/// phase is any or drifts.
double mean_phase_ticks(const LinearLaw& law, int scene_ticks, int ticks) {
  const HostLink& h = law.host;
  if (h.period_ticks <= 0) return 0;
  double best = 0, least_off = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 64; ++i) {
    const double phase = scene_ticks * i / 64.0;
    double waits = 0;
    const int samples = std::max(1, static_cast<int>(std::lround(ticks / h.period_ticks)));
    for (int j = 0; j < samples; ++j) {
      const double at = j * h.period_ticks + phase + h.age_ticks;
      waits += std::ceil(at / scene_ticks) * scene_ticks - at;
    }
    const double off = std::abs(waits / samples - scene_ticks / 2.0);
    if (off >= least_off) continue;
    least_off = off;
    best = phase;
  }
  return best;
}

AxesLoopModel around(const design::Elaborated& e, const plant::Parameters& joint,
                     const plant::Parameters& mean, const Eigen::MatrixXd& per_torque,
                     const plant::HandDynamics* hand) {
  const Index n = per_torque.rows();
  AxesLoopModel out;
  out.axis = make_model(e, mean);
  out.per_torque = per_torque;
  Eigen::MatrixXd plant =
      plant_change(joint, out.axis.damping_nm_s_rad, per_torque, out.axis.tick_s, hand);
  plant += Eigen::MatrixXd::Identity(plant.rows(), plant.cols());
  out.plant.resize(plant.rows() - n, plant.cols());
  out.plant << plant.topRows(3 * n), plant.bottomRows(plant.rows() - 4 * n);
  return out;
}

}  // namespace

AxesLoopModel make_axes_model(const design::Elaborated& e, const plant::Parameters& joint,
                              const Eigen::MatrixXd& inertia, const plant::HandDynamics* hand) {
  const Eigen::MatrixXd per_torque = inverse(inertia);
  if (!per_torque.allFinite()) throw std::invalid_argument("an inertia that has no inverse");
  plant::Parameters mean = joint;
  mean.lever.inertia_kg_m2 = inertia.trace() / static_cast<double>(inertia.rows());
  return around(e, joint, mean, per_torque, hand);
}

AxesLoopModel make_axes_model(const design::Elaborated& e, const plant::Parameters& lever,
                              const plant::HandDynamics* hand) {
  return around(e, lever, lever, Eigen::MatrixXd::Constant(1, 1, 1 / lever.lever.inertia_kg_m2),
                hand);
}

std::vector<Pole> poles(const AxesLoopModel& model, const AxesWall& wall) {
  const Index axes = wall.stiffness_nm_rad.rows();
  LinearLaw law{Eigen::MatrixXd(0, 0),
                Eigen::MatrixXd(0, 3 * axes),
                Eigen::MatrixXd(axes, 0),
                Eigen::MatrixXd(axes, 3 * axes),
                {},
                {}};
  law.d << -wall.stiffness_nm_rad, -wall.damping_nm_s_rad, wall.observed;
  return poles(model, law, 1, 0, wall.scene_ticks, wall.delay_ticks);
}

std::vector<Pole> poles(const AxesLoopModel& model, const LinearLaw& law, double gain,
                        double held_nm_rad, int scene_ticks, int delay_ticks) {
  const int ticks = apart_ticks(model.axis, repeats_ticks(model.axis, law, scene_ticks));
  const double phase = mean_phase_ticks(law, scene_ticks, ticks);
  AxesTicks run(model, law, {gain, held_nm_rad, scene_ticks, delay_ticks, phase});
  return dominant_poles([&](const Vector& v) { return run.after(v, ticks); }, run.start(),
                        24 * law.axes(), ticks * model.axis.tick_s);
}

}  // namespace feltgate::stability
