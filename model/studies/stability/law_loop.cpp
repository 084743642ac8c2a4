// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/stability.md
#include "studies/stability/law_loop.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <complex>
#include <numeric>

#include "studies/stability/axis_chain.hpp"

namespace feltgate::stability {

namespace {

constexpr Eigen::Index plant_states = 3;  // current, speed, angle

/// The states that can be reached from `first` by `next(from, to)`.
template <class Next>
std::vector<bool> reached(std::vector<bool> first, const Next& next) {
  const auto n = static_cast<Eigen::Index>(first.size());
  for (bool more = true; more;) {
    more = false;
    for (Eigen::Index from = 0; from < n; ++from) {
      for (Eigen::Index to = 0; to < n; ++to) {
        const auto f = static_cast<std::size_t>(from), t = static_cast<std::size_t>(to);
        if (!first[f] || first[t] || !next(from, to)) continue;
        first[t] = more = true;
      }
    }
  }
  return first;
}

}  // namespace

LinearLaw in_loop(const LinearLaw& law) {
  const Eigen::Index n = law.a.rows();
  std::vector<bool> moved, shown;
  for (Eigen::Index i = 0; i < n; ++i) {
    moved.push_back(!law.b.row(i).isZero(0));
    shown.push_back(law.c[i] != 0);
  }
  moved = reached(moved, [&](auto from, auto to) { return law.a(to, from) != 0; });
  shown = reached(shown, [&](auto from, auto to) { return law.a(from, to) != 0; });
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (moved[static_cast<std::size_t>(i)] && shown[static_cast<std::size_t>(i)]) kept.push_back(i);
  }
  const auto size = static_cast<Eigen::Index>(kept.size());
  LinearLaw out{Eigen::MatrixXd(size, size), Eigen::MatrixXd(size, 3), Eigen::RowVectorXd(size),
                law.d};
  for (Eigen::Index i = 0; i < size; ++i) {
    const Eigen::Index from = kept[static_cast<std::size_t>(i)];
    out.b.row(i) = law.b.row(from);
    out.c[i] = law.c[from];
    for (Eigen::Index k = 0; k < size; ++k) {
      out.a(i, k) = law.a(from, kept[static_cast<std::size_t>(k)]);
    }
  }
  return out;
}

Steepness steepness(const LinearLaw& law, double period_s) {
  using Complex = std::complex<double>;
  const Eigen::Index n = law.a.rows();
  Steepness out;
  for (const double hz : {5.0, 50.0, 500.0}) {
    const Complex rate(0, 2 * 3.141592653589793 * hz), z = std::exp(rate * period_s);
    // Of an angle that swings with this frequency, and its velocity.
    const Eigen::Vector3cd u(1, rate, 0);
    Complex nm_rad = (law.d.cast<Complex>() * u)(0, 0);
    if (n > 0) {
      const Eigen::MatrixXcd of_z = z * Eigen::MatrixXcd::Identity(n, n) - law.a.cast<Complex>();
      const Eigen::VectorXcd x = of_z.partialPivLu().solve(law.b.cast<Complex>() * u);
      nm_rad += (law.c.cast<Complex>() * x)(0, 0);
    }
    if (hz == 50.0) out.spring_nm_rad = -nm_rad.real();
    out.most_nm_rad = std::max(out.most_nm_rad, std::abs(nm_rad));
  }
  return out;
}

std::vector<Pole> poles(const LoopModel& m, const LinearLaw& law, double gain, double held_nm_rad,
                        int scene_ticks, int delay_ticks) {
  const Renewal renewal{scene_ticks, delay_ticks};
  const Eigen::Index own = law.a.rows();
  const int ticks = apart_ticks(m, std::lcm(m.pwm_ticks, scene_ticks));
  // States: of the plant, of the law, of the chain.
  const auto after = [&](const Eigen::VectorXd& v) {
    Eigen::Vector3d plant = v.head(plant_states);
    Eigen::VectorXd x = v.segment(plant_states, own);
    AxisChain chain;
    chain.unpack(m, v.data() + plant_states + own);
    for (int k = 0; k < ticks; ++k) {
      chain.begin(m, renewal, k);
      chain.see(m, plant[2]);
      if (k % scene_ticks == 0) {
        const Eigen::Vector3d u(plant[2], chain.velocity, chain.observed(m));
        const double torque = law.c.dot(x) + law.d.dot(u);
        chain.ask(renewal, k, gain * torque - held_nm_rad * plant[2]);
        x = law.a * x + law.b * u;
      }
      chain.drive(m);
      plant = m.plant * Eigen::Vector4d(plant[0], plant[1], plant[2], chain.volts);
    }
    Eigen::VectorXd out(v.size());
    out.head(plant_states) = plant;
    out.segment(plant_states, own) = x;
    chain.pack(out.data() + plant_states + own);
    return out;
  };
  Eigen::VectorXd start = Eigen::VectorXd::Zero(plant_states + own + AxisChain::scalars + m.m1);
  start[1] = start[plant_states + own] = 1;
  start[2] = 0.01;
  start.segment(plant_states, own).setConstant(0.01);
  start.tail(m.m1).setConstant(0.01);
  return dominant_poles(after, start, 24, ticks * m.tick_s);
}

}  // namespace feltgate::stability
