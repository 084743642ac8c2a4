// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The loop of core, motor and a wall without quantisation: every state of every tick, the window of
// the velocity estimator included, and the eigenvalues of its monodromy matrix. Derivation:
// docs/speed-for-accuracy.md
#pragma once

#include <complex>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "design/design.hpp"
#include "sim/plant/mechanics.hpp"
#include "sim/plant/parameters.hpp"

namespace feltgate::stability {

// Finds the dominant poles of a loop that is given as a function on its state. Derivation:

/// An eigenvalue as a pole, rad/s.
using Pole = std::complex<double>;

/// The poles with the largest real parts, the fastest growing first; of a conjugate pair, the one
/// with imag >= 0. `after` is linear and advances a state by `seconds`. At most `most` eigenvalues
/// are computed; the start vector must contain every wanted mode.
std::vector<Pole> dominant_poles(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& after,
    const Eigen::VectorXd& start, Eigen::Index most, double seconds);

/// A wall and how often its torque is computed anew; the torque is held in between.
struct Wall {
  double stiffness_nm_rad = 0;
  double damping_nm_s_rad = 0;
  int scene_ticks = 1;  ///< 1: the core's own wall; else a host reads, computes and writes
  /// From the samples to the first tick in which their torque acts, at most scene_ticks; -1: none
  /// in the core, host_ticks with a host.
  int delay_ticks = -1;
};

/// Ticks from the one whose snapshot a host reads to the first in which its torque acts: one for
/// the register write, which is carried out with the end of the next tick.
constexpr int host_ticks = 2;

/// Constants of the loop, from a design with its quantised words and a linear plant.
struct LinearLoop {
  /// States of the motor with its lever, and its input.
  enum : Eigen::Index { kCurrent, kSpeed, kAngle, kVoltage };
  double tick_s = 0;
  int m1 = 0;
  int reading_ticks = 1;        ///< from reading to reading of an absolute encoder; 1: edges
  int reading_delay_ticks = 0;  ///< from the angle to the tick that has it
  /// Change of the states over a tick: the transition matrix minus identity, which keeps the digits
  /// of slow poles.
  Eigen::Matrix4d change;
  double raw_rad_s_rad = 0;  ///< raw velocity per radian of travel in m1 ticks
  double velocity_a1 = 0, observer_a1 = 0;
  double torque_constant = 0, inertia_gain = 0, torque_gain = 0, observer_gain = 0;
  double emf_constant = 0;
  double applied = 0;           ///< plant volts per commanded volt
  double damping_nm_s_rad = 0;  ///< of the lever
};

/// Makes the loop. Of the plant's effects it uses inductance, back-EMF and viscous friction.
LinearLoop make_linear_loop(const design::Elaborated& e, const plant::Parameters& plant);

/// The same with a voltage gain, PWM periods, and the values for the closed-form expressions.
struct LoopModel : LinearLoop {
  int pwm_ticks = 0;
  double voltage_gain = 0;
  Eigen::Matrix<double, 3, 4>
      plant;  ///< (current, speed, angle) after a tick, from those and volts
  double inertia_kg_m2 = 0;
  double torque_per_volt = 0;         ///< Kt/R of the plant, Nm/V
  double motor_damping_nm_s_rad = 0;  ///< Kt*Ke/R of the plant
  double compensated = 0;             ///< share of it that the voltage law takes away at rest
  double electrical_s = 0;            ///< L/R
  double velocity_delay_s = 0;        ///< window/2 + 1/cut-off
  double velocity_moment_s2 = 0;  ///< half the second moment of the estimator's impulse response
};

/// The change of all currents, speeds, angles and voltages over one tick in which these are held,
/// by the exact exponential; `per_torque`: inverse of the inertia of all axes. `hand`: on a single
/// axis, speed and angle of its mass come last; nullptr: none.
Eigen::MatrixXd plant_change(const plant::Parameters& plant, double damping_nm_s_rad,
                             const Eigen::MatrixXd& per_torque, double tick_s,
                             const plant::HandDynamics* hand = nullptr);

/// Ticks of a torque's period that are repeated so that poles stand apart, about 1 ms: up to 500 Hz
/// no turn is lost by that.
int apart_ticks(const LoopModel& model, int period_ticks);

/// Ticks of a PWM period. Where a tick is longer, a duty waits here for its end, longer than in the
/// core: the borders are on the safe side.
int pwm_ticks(const design::Design& d);

/// Ticks of a scene period: the nearest; a multiple of the PWM period where that changes the rate
/// by less than 1 %, so that the loop repeats after one of them.
int scene_ticks(const design::Design& design, double rate_hz);

/// Of two voltage gains, the low one.
LoopModel make_model(const design::Elaborated& e, const plant::Parameters& plant);

/// Poles nearest to growth, the fastest growing first; those of a conjugate pair with imag >= 0.
std::vector<Pole> poles(const LoopModel& model, const Wall& wall);

/// The monodromy matrix itself, over the least number of ticks after which the loop repeats; its
/// size is the number of states, m1 + 10, with an absolute encoder m1 + 12.
Eigen::MatrixXd monodromy(const LoopModel& model, const Wall& wall, int* ticks);

/// Largest stable stiffness with this damping, and the frequency at which the loop then swings.
struct Border {
  double stiffness_nm_rad = 0;  ///< 0: no stiffness is stable
  double rad_s = 0;
};
Border border(const LoopModel& model, double damping_nm_s_rad, int scene_ticks);

/// (b + B) / (T/2 + t_d): what is left of damping over half a scene period and the actuator.
double closed_form(const LoopModel& model, double damping_nm_s_rad, int scene_ticks);
/// The same with the next order of the velocity estimator: it acts as a delay longer by
/// (B - b_emf) * m2 / J. NaN where the lever is too light for this: J <= (B - b_emf) * the lag.
double closed_form_with_estimator(const LoopModel& model, double damping_nm_s_rad, int scene_ticks);
/// t_d: winding, half a PWM period, and what a host costs.
double actuator_delay_s(const LoopModel& model, int scene_ticks);

/// Impedance of the armed lever without a scene at a frequency, as a stiffness: |torque / angle|,
/// Nm/rad. Back-EMF compensation and observer are in it, the winding's lag is not.
double free_impedance_nm_rad(const LoopModel& model, double rad_s);

// Matrices of a few numbers, in one source: what Eigen has for large ones takes the compiler
// seconds, its products too, but lazyProduct().

/// All eigenvalues of a square matrix, in no order.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);
/// The real part of the eigenvector whose eigenvalue has the largest real part.
Eigen::VectorXd dominant_eigenvector(const Eigen::MatrixXd& matrix);

/// The x of matrix * x = right; not finite where the matrix is singular.
Eigen::MatrixXcd solved(const Eigen::MatrixXcd& matrix, const Eigen::MatrixXcd& right);
Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix);

/// exp(a*t) - 1 of a square matrix `a` and a time t >= 0 in the inverse of its unit, by a Taylor
/// series and doubling, so that small results keep their digits.
Eigen::MatrixXd matrix_exp_minus_one(const Eigen::MatrixXd& a, double t);

// The state of an axis of the core from tick to tick, without quantisation: estimator, observer,
// torque of a scene or a host, voltage.

/// Period and delay of a torque, which is held in between.
struct Renewal {
  int scene_ticks = 1;
  int delay_ticks = 0;  ///< from the samples to the first tick in which their torque acts
};

/// A tick calls, in this order: begin(), see() with the angle, ask() for a torque, drive().
struct AxisChain {
  double velocity = 0, observer = 0, reference = 0;
  double volts_new = 0, volts = 0;     ///< newest, and in force in this PWM period
  double torque = 0, torque_next = 0;  ///< of the host: in force, and under way
  std::vector<double> window;          ///< angles of the last m1 ticks, a ring
  std::size_t oldest = 0;

  static constexpr Eigen::Index scalars = 7;

  void begin(const LoopModel& m, const Renewal& r, long k) {
    if (k % m.pwm_ticks == 0) volts = volts_new;
    if (r.delay_ticks > 0 && (k - r.delay_ticks) % r.scene_ticks == 0) torque = torque_next;
  }
  void see(const LoopModel& m, double angle) {
    const double travel = angle - window[oldest];
    window[oldest] = angle;
    if (++oldest == window.size()) oldest = 0;
    velocity += m.velocity_a1 * (m.raw_rad_s_rad * travel - velocity);
    observer += m.observer_a1 * (m.torque_constant * reference + inertia(m) - observer);
  }
  /// The observer's torque, the law's tau_hat.
  double observed(const LoopModel& m) const { return observer - inertia(m); }
  void ask(const Renewal& r, long k, double asked) {
    if (k % r.scene_ticks != 0) return;
    torque_next = asked;
    if (r.delay_ticks == 0) torque = asked;
  }
  void drive(const LoopModel& m) {
    reference = m.torque_gain * torque + m.observer_gain * observed(m);
    volts_new = m.applied * (m.voltage_gain * reference + m.emf_constant * velocity);
  }

  /// From a vector of scalars + m1 numbers, and to one: the window with its oldest angle first.
  void unpack(const LoopModel& m, const double* v) {
    velocity = v[0];
    observer = v[1];
    reference = v[2];
    volts_new = v[3];
    volts = v[4];
    torque = v[5];
    torque_next = v[6];
    window.assign(v + scalars, v + scalars + m.m1);
    oldest = 0;
  }
  void pack(double* v) const {
    const double all[] = {velocity, observer, reference, volts_new, volts, torque, torque_next};
    for (const double x : all) *v++ = x;
    for (std::size_t i = 0; i < window.size(); ++i) *v++ = window[(oldest + i) % window.size()];
  }

 private:
  double inertia(const LoopModel& m) const { return m.inertia_gain * velocity; }
};

}  // namespace feltgate::stability
