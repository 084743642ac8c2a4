// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The linear loop and its eigenvalues. Documentation: docs/speed-for-accuracy.md
#include "studies/stability/linear_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace feltgate::stability {

namespace {

/// Everything that one tick hands to the next.
struct State {
  double current = 0, speed = 0, angle = 0;
  double read = 0, reading = 0;  ///< angles of an absolute encoder: the newest, and under way
  AxisChain chain;
};

/// The states before those of the chain.
Eigen::Index before_chain(const LoopModel& m) { return m.reading_ticks > 1 ? 5 : 3; }

/// The angle that the tick `k` has.
double seen(const LoopModel& m, long k, State& s) {
  if (m.reading_ticks == 1) return s.angle;
  if ((k - m.reading_delay_ticks) % m.reading_ticks == 0) s.read = s.reading;
  if (k % m.reading_ticks == 0) s.reading = s.angle;
  return s.read;
}

Renewal renewal_of(const Wall& wall) {
  if (wall.delay_ticks >= 0) return {wall.scene_ticks, wall.delay_ticks};
  return {wall.scene_ticks, wall.scene_ticks > 1 ? host_ticks : 0};
}

/// The tick `k` of the loop.
void tick(const LoopModel& m, const Wall& wall, long k, State& s) {
  const Renewal renewal = renewal_of(wall);
  s.chain.begin(m, renewal, k);
  const double angle = seen(m, k, s);
  s.chain.see(m, angle);
  s.chain.ask(renewal, k,
              -wall.stiffness_nm_rad * angle - wall.damping_nm_s_rad * s.chain.velocity);
  s.chain.drive(m);
  const Eigen::Vector3d next =
      m.plant * Eigen::Vector4d(s.current, s.speed, s.angle, s.chain.volts);
  s.current = next[0];
  s.speed = next[1];
  s.angle = next[2];
}

Eigen::VectorXd after(const LoopModel& m, const Wall& wall, const Eigen::VectorXd& v, int ticks) {
  State s;
  s.current = v[0];
  s.speed = v[1];
  s.angle = v[2];
  const Eigen::Index first = before_chain(m);
  if (first > 3) s.read = v[3], s.reading = v[4];
  s.chain.unpack(m, v.data() + first);
  for (int k = 0; k < ticks; ++k) tick(m, wall, k, s);
  Eigen::VectorXd out(v.size());
  out.head(3) << s.current, s.speed, s.angle;
  if (first > 3) out.segment(3, 2) << s.read, s.reading;
  s.chain.pack(out.data() + first);
  return out;
}

int period_ticks(const LoopModel& m, const Wall& wall) {
  return std::lcm(std::lcm(m.pwm_ticks, wall.scene_ticks), m.reading_ticks);
}

Eigen::Index size_of(const LoopModel& m) { return before_chain(m) + AxisChain::scalars + m.m1; }

double back_emf_of(const plant::Parameters& p) {
  return p.effects.back_emf ? p.motor.back_emf_constant_v_s_rad : 0.0;
}

}  // namespace

Eigen::MatrixXd plant_change(const plant::Parameters& p, double damping_nm_s_rad,
                             const Eigen::MatrixXd& per_torque, double tick_s,
                             const plant::HandDynamics* hand) {
  const double r = p.motor.resistance_ohm, l = p.motor.inductance_h;
  const double kt = p.motor.torque_constant_nm_a, ke = back_emf_of(p);
  const Eigen::Index n = per_torque.rows(), size = 4 * n + (hand != nullptr ? 2 : 0);
  Eigen::MatrixXd rate = Eigen::MatrixXd::Zero(size, size);
  const auto block = [&](Eigen::Index to, Eigen::Index from) {
    return rate.block(to * n, from * n, n, n);
  };
  using Of = LinearLoop;
  double damping = damping_nm_s_rad;
  if (p.effects.inductance) {
    block(Of::kCurrent, Of::kCurrent).diagonal().setConstant(-r / l);
    block(Of::kCurrent, Of::kSpeed).diagonal().setConstant(-ke / l);
    block(Of::kCurrent, Of::kVoltage).diagonal().setConstant(1 / l);
    block(Of::kSpeed, Of::kCurrent) = kt * per_torque;
  } else {
    damping += kt * ke / r;
    block(Of::kSpeed, Of::kVoltage) = kt / r * per_torque;
  }
  block(Of::kSpeed, Of::kSpeed) = -damping * per_torque;
  block(Of::kAngle, Of::kSpeed).setIdentity();
  if (hand != nullptr) {
    const Eigen::Index speed = 4, angle = 5;  // of the hand's mass
    const double k = hand->grip_stiffness_nm_rad, d = hand->grip_damping_nm_s_rad;
    const Eigen::Vector4d grip(-d, -k, d, k),
        own(d, k, -d - hand->damping_nm_s_rad, -k - hand->stiffness_nm_rad);
    const Eigen::Index of[] = {Of::kSpeed, Of::kAngle, speed, angle};
    for (Eigen::Index i = 0; i < 4; ++i) {
      rate(Of::kSpeed, of[i]) += per_torque(0, 0) * grip[i];
      rate(speed, of[i]) += hand->inverse_inertia * own[i];
    }
    rate(angle, speed) = 1;
  }
  Eigen::MatrixXd change = matrix_exp_minus_one(rate, tick_s);
  // A current that follows at once is no state: nothing of it remains after a tick.
  if (!p.effects.inductance) change.topLeftCorner(n, n) = -Eigen::MatrixXd::Identity(n, n);
  return change;
}

LinearLoop make_linear_loop(const design::Elaborated& e, const plant::Parameters& p) {
  e.design.needs_n_method("the linear model of the loop");
  const auto word = [&](const char* name) { return e.word(name).quantised(); };
  LinearLoop m;
  m.tick_s = e.design.tick_s();
  m.m1 = e.design.m1;
  m.damping_nm_s_rad = plant::smooth_damping_nm_s_rad(p, p.effects);
  m.change = plant_change(p, m.damping_nm_s_rad,
                          Eigen::MatrixXd::Constant(1, 1, 1 / p.lever.inertia_kg_m2), m.tick_s);
  const double two_pi = 6.283185307179586;
  m.raw_rad_s_rad = 4.0 * p.encoder.lines / two_pi * e.rad_s_per_count();
  if (e.design.absolute) {
    m.raw_rad_s_rad = e.rad_s_per_count() / e.design.count_rad();
    m.reading_ticks = e.design.absolute_period_ticks();
    m.reading_delay_ticks = e.design.absolute_delay_ticks();
  }
  m.velocity_a1 = word("velocity_a1");
  m.observer_a1 = word("observer_a1");
  m.torque_constant = word("torque_constant");
  m.inertia_gain = word("inertia_gain");
  m.torque_gain = word("torque_gain");
  m.observer_gain = word("observer_gain");
  m.emf_constant = e.design.emf_in_law() ? word("emf_constant") : 0.0;
  m.applied = p.supply.voltage_v / e.design.supply_v;
  return m;
}

int pwm_ticks(const design::Design& d) {
  return std::max(1, d.pwm_period_clocks() / d.clocks_per_tick());
}

int scene_ticks(const design::Design& d, double rate_hz) {
  const double ticks = static_cast<double>(d.tick_hz) / rate_hz;
  const int pwm = pwm_ticks(d);
  const int whole = std::max(1, static_cast<int>(std::lround(ticks / pwm))) * pwm;
  if (std::abs(whole - ticks) < 0.01 * ticks) return whole;
  return std::max(1, static_cast<int>(std::lround(ticks)));
}

LoopModel make_model(const design::Elaborated& e, const plant::Parameters& p) {
  if (e.design.current_loop) {
    throw std::invalid_argument("design " + e.design.name +
                                " controls a measured current, which this linear loop does not; "
                                "the borders of its walls are "
                                "in docs/blocks/current.md");
  }
  LoopModel m;
  static_cast<LinearLoop&>(m) = make_linear_loop(e, p);
  m.pwm_ticks = pwm_ticks(e.design);
  m.voltage_gain = e.word("voltage_gain").quantised();
  m.plant = (Eigen::Matrix4d::Identity() + m.change).topRows<3>();
  const double r = p.motor.resistance_ohm, kt = p.motor.torque_constant_nm_a;
  const double ke = back_emf_of(p);
  m.inertia_kg_m2 = p.lever.inertia_kg_m2;
  m.torque_per_volt = kt / r;
  m.motor_damping_nm_s_rad = kt * ke / r;
  m.electrical_s = p.effects.inductance ? p.motor.inductance_h / r : 0.0;
  m.compensated = ke == 0 ? 0.0 : m.emf_constant * m.applied / ke;
  // The estimator: a window of m1 ticks, then one pole.
  const double window_s = m.m1 * m.tick_s, pole_s = m.tick_s / m.velocity_a1;
  m.velocity_delay_s = window_s / 2 + pole_s;
  m.velocity_moment_s2 = window_s * window_s / 6 + window_s / 2 * pole_s + pole_s * pole_s;
  return m;
}

Eigen::MatrixXd monodromy(const LoopModel& m, const Wall& wall, int* ticks) {
  *ticks = period_ticks(m, wall);
  const Eigen::Index n = size_of(m);
  Eigen::MatrixXd out(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    out.col(i) = after(m, wall, Eigen::VectorXd::Unit(n, i), *ticks);
  }
  return out;
}

int apart_ticks(const LoopModel& m, int period_ticks) {
  return period_ticks *
         std::max(1, static_cast<int>(std::lround(1e-3 / (period_ticks * m.tick_s))));
}

std::vector<Pole> poles(const LoopModel& m, const Wall& wall) {
  const int ticks = apart_ticks(m, period_ticks(m, wall));
  Eigen::VectorXd start = Eigen::VectorXd::Zero(size_of(m));
  start[1] = start[before_chain(m)] = 1;
  start[2] = 0.01;
  start.tail(m.m1).setConstant(0.01);
  return dominant_poles([&](const Eigen::VectorXd& v) { return after(m, wall, v, ticks); }, start,
                        24, ticks * m.tick_s);
}

Border border(const LoopModel& m, double damping_nm_s_rad, int scene_ticks) {
  const auto top = [&](double k) {
    return poles(m, Wall{k, damping_nm_s_rad, scene_ticks}).front();
  };
  // The wall of a device is stable from 0 up to its border; below 1e-3 Nm/rad it is no wall.
  double low = 1e-3;
  if (top(low).real() > 0) return {};
  double high = std::max(2 * low, closed_form(m, damping_nm_s_rad, scene_ticks) / 4);
  for (; top(high).real() < 0; high *= 1.3) low = high;
  for (int i = 0; i < 24 && high - low > 1e-6 * high; ++i) {
    const double middle = (low + high) / 2;
    (top(middle).real() < 0 ? low : high) = middle;
  }
  return {low, std::abs(top(low).imag())};
}

double actuator_delay_s(const LoopModel& m, int scene_ticks) {
  const double host = scene_ticks > 1 ? host_ticks * m.tick_s : 0.0;
  // The newest duty waits for a PWM period: half of one on average, and the tick that computed it.
  return m.electrical_s + (m.pwm_ticks + 1) / 2.0 * m.tick_s + host;
}

namespace {

double left_of_motor(const LoopModel& m) {
  return m.motor_damping_nm_s_rad * (1 - m.compensated) + m.damping_nm_s_rad;
}

double time_s(const LoopModel& m, int scene_ticks) {
  const double reading_s = ((m.reading_ticks - 1) / 2.0 + m.reading_delay_ticks) * m.tick_s;
  return scene_ticks * m.tick_s / 2 + reading_s + actuator_delay_s(m, scene_ticks);
}

}  // namespace

double closed_form(const LoopModel& m, double damping_nm_s_rad, int scene_ticks) {
  return (left_of_motor(m) + damping_nm_s_rad) / time_s(m, scene_ticks);
}

double closed_form_with_estimator(const LoopModel& m, double damping_nm_s_rad, int scene_ticks) {
  const double fed_back = damping_nm_s_rad - m.motor_damping_nm_s_rad * m.compensated;
  const double inertia = m.inertia_kg_m2 - fed_back * m.velocity_delay_s;
  if (!(inertia > 0)) return std::numeric_limits<double>::quiet_NaN();
  return (left_of_motor(m) + damping_nm_s_rad) /
         (time_s(m, scene_ticks) + fed_back * m.velocity_moment_s2 / inertia);
}

double free_impedance_nm_rad(const LoopModel& m, double rad_s) {
  const Pole s{0, rad_s};
  const double window_s = m.m1 * m.tick_s;
  const Pole estimator =
      (1.0 - std::exp(-s * window_s)) / (s * window_s) / (1.0 + s * (m.tick_s / m.velocity_a1));
  const Pole observer = 1.0 / (1.0 + s * (m.tick_s / m.observer_a1));
  const Pole reference = m.observer_gain * m.inertia_gain * (observer - 1.0) /
                         (1.0 - m.observer_gain * m.torque_constant * observer);
  // The motor's torque per unit of speed, taken as a resistance.
  const Pole motor = m.motor_damping_nm_s_rad - m.torque_per_volt * m.applied * estimator *
                                                    (m.emf_constant + m.voltage_gain * reference);
  return std::abs(s * (s * m.inertia_kg_m2 + m.damping_nm_s_rad + motor));
}

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

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues();
}

Eigen::VectorXd dominant_eigenvector(const Eigen::MatrixXd& matrix) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix);
  Eigen::Index best = 0;
  solver.eigenvalues().real().maxCoeff(&best);
  return solver.eigenvectors().col(best).real();
}

Eigen::MatrixXcd solved(const Eigen::MatrixXcd& matrix, const Eigen::MatrixXcd& right) {
  return matrix.partialPivLu().solve(right);
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix) {
  return matrix.inverse();
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
