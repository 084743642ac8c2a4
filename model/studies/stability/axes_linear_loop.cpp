// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/stability.md
#include "studies/stability/axes_linear_loop.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "studies/stability/axis_chain.hpp"

namespace feltgate::stability {

namespace {

using Vector = Eigen::VectorXd;
using Index = Eigen::Index;

/// What all ticks of a run share, so that none allocates.
class AxesTicks {
 public:
  AxesTicks(const AxesLoopModel& model, const AxesWall& wall)
      : m_(model.axis),
        plant_(model.plant),
        wall_(wall),
        axes_(plant_.rows() / 3),
        chains_(static_cast<std::size_t>(axes_)),
        state_(4 * axes_),
        next_(3 * axes_),
        velocity_(axes_),
        observed_(axes_),
        asked_(axes_) {}

  Index size() const { return axes_ * (3 + chain_size()); }
  Index axes() const { return axes_; }

  Vector after(const Vector& v, int ticks) {
    state_.head(3 * axes_) = v.head(3 * axes_);
    const double* from = v.data() + 3 * axes_;
    for (AxisChain& c : chains_) {
      c.unpack(m_, from);
      from += chain_size();
    }
    for (int k = 0; k < ticks; ++k) tick(k);
    Vector out(v.size());
    out.head(3 * axes_) = state_.head(3 * axes_);
    double* to = out.data() + 3 * axes_;
    for (const AxisChain& c : chains_) {
      c.pack(to);
      to += chain_size();
    }
    return out;
  }

 private:
  Index chain_size() const { return AxisChain::scalars + m_.m1; }

  void tick(long k) {
    const Renewal renewal{wall_.scene_ticks, wall_.delay_ticks};
    for (Index n = 0; n < axes_; ++n) {
      AxisChain& c = chain(n);
      c.begin(m_, renewal, k);
      c.see(m_, state_[2 * axes_ + n]);
      velocity_[n] = c.velocity;
      observed_[n] = c.observed(m_);
    }
    if (k % wall_.scene_ticks == 0) {
      asked_.noalias() = wall_.observed * observed_;
      asked_.noalias() -= wall_.stiffness_nm_rad * state_.segment(2 * axes_, axes_);
      asked_.noalias() -= wall_.damping_nm_s_rad * velocity_;
    }
    for (Index n = 0; n < axes_; ++n) {
      AxisChain& c = chain(n);
      c.ask(renewal, k, asked_[n]);
      c.drive(m_);
      state_[3 * axes_ + n] = c.volts;
    }
    next_.noalias() = plant_ * state_;
    state_.head(3 * axes_) = next_;
  }
  AxisChain& chain(Index n) { return chains_[static_cast<std::size_t>(n)]; }

  const LoopModel& m_;
  const Eigen::MatrixXd& plant_;
  const AxesWall& wall_;
  Index axes_;
  std::vector<AxisChain> chains_;
  Vector state_, next_, velocity_, observed_, asked_;
};

}  // namespace

AxesLoopModel make_axes_model(const design::Elaborated& e, const plant::Parameters& joint,
                              const Eigen::MatrixXd& inertia) {
  const Index n = inertia.rows();
  const Eigen::MatrixXd per_torque = inertia.inverse();
  if (!per_torque.allFinite()) throw std::invalid_argument("an inertia that has no inverse");
  plant::Parameters mean = joint;
  mean.lever.inertia_kg_m2 = inertia.trace() / static_cast<double>(n);
  AxesLoopModel out;
  out.axis = make_model(e, mean);
  const Eigen::MatrixXd change =
      plant_change(joint, out.axis.damping_nm_s_rad, per_torque, out.axis.tick_s);
  out.plant = (Eigen::MatrixXd::Identity(4 * n, 4 * n) + change).topRows(3 * n);
  return out;
}

std::vector<Pole> poles(const AxesLoopModel& model, const AxesWall& wall) {
  AxesTicks run(model, wall);
  const int ticks = apart_ticks(model.axis, std::lcm(model.axis.pwm_ticks, wall.scene_ticks));
  // No mode whose shares are ratios is at rest in it.
  const Index n = run.axes(), chain = (run.size() - 3 * n) / n;
  Vector start = Vector::Zero(run.size());
  for (Index i = 0; i < n; ++i) {
    const double share = (i % 2 == 0 ? 1.0 : -1.0) / std::sqrt(static_cast<double>(i + 1));
    const double angle = 0.01 * share;
    start[n + i] = share;
    start[2 * n + i] = angle;
    start[3 * n + i * chain] = share;
    start.segment(3 * n + i * chain + AxisChain::scalars, model.axis.m1).setConstant(angle);
  }
  return dominant_poles([&](const Vector& v) { return run.after(v, ticks); }, start, 24 * n,
                        ticks * model.axis.tick_s);
}

}  // namespace feltgate::stability
