// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The smooth mechanics of lever and hand, linear during a step, so that a fourth-order Runge-Kutta
// step is one matrix product; and the friction of a shaft. Reason for this step: docs/plant.md
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "parameters.hpp"

namespace feltgate::plant {

/// State of a shaft: angle and speed.
struct Shaft {
  double theta_rad = 0.0;
  double omega_rad_s = 0.0;
};

/// Torque on the lever over one step: constant_nm + omega_nm_s_rad*omega + theta_nm_rad*theta.
struct ShaftTorque {
  double constant_nm = 0.0;
  double omega_nm_s_rad = 0.0;
  double theta_nm_rad = 0.0;
};

/// Linear impedance of a hand at the lever, in linear units at the radius of the hand.
/// Defaults: van Beek et al., Scientific Reports 5:18004 (2015), Fig. 3, one trial; grip assumed.
struct Impedance {
  double mass_kg = 0.554;
  double damping_ns_m = 6.45;
  double stiffness_n_m = 135.0;
  double grip_stiffness_n_m = 3000.0;
  double grip_damping_ns_m = 10.0;
};

/// A hand behind a grip, in angles of the lever. The grip's stiffness and damping act between lever
/// and hand, the hand's own between hand and equilibrium.
struct HandDynamics {
  double inverse_inertia = 0.0;  ///< 1/(kg m^2)
  double damping_nm_s_rad = 0.0;
  double stiffness_nm_rad = 0.0;
  double grip_damping_nm_s_rad = 0.0;
  double grip_stiffness_nm_rad = 0.0;
  double equilibrium_rad = 0.0;  ///< at the middle of the step
  double equilibrium_rad_s = 0.0;

  /// Torque of the hand on the lever, Nm.
  double grip_nm(const Shaft& lever, const Shaft& hand) const {
    return grip_stiffness_nm_rad * (hand.theta_rad - lever.theta_rad) +
           grip_damping_nm_s_rad * (hand.omega_rad_s - lever.omega_rad_s);
  }
};

/// One step of dx/dt = A*x + b with A and b held. The classic Runge-Kutta step of such a system is
/// x + P*(A*x + b) with P = dt*(1 + z/2*(1 + z/3*(1 + z/4))), z = A*dt.
template <std::size_t N>
class LinearStep {
 public:
  using Vector = std::array<double, N>;
  using Matrix = std::array<Vector, N>;

  void set(const Matrix& a, double dt_s) {
    Matrix p = identity();
    for (const double order : {4.0, 3.0, 2.0}) {
      Matrix next = identity();
      for (std::size_t i = 0; i < N; ++i) {
        for (std::size_t j = 0; j < N; ++j) {
          for (std::size_t k = 0; k < N; ++k) next[i][j] += dt_s / order * a[i][k] * p[k][j];
        }
      }
      p = next;
    }
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N; ++j) by_rate_[j][i] = dt_s * p[i][j];
    }
  }
  /// Change of x in a step that starts with the rate A*x + b.
  Vector gain(const Vector& rate) const {
    Vector g{};
    for (std::size_t j = 0; j < N; ++j) {
      for (std::size_t i = 0; i < N; ++i) g[i] += by_rate_[j][i] * rate[j];
    }
    return g;
  }

 private:
  static Matrix identity() {
    Matrix m{};
    for (std::size_t i = 0; i < N; ++i) m[i][i] = 1.0;
    return m;
  }
  Matrix by_rate_{};  ///< P, stored by columns
};

/// The matrix A of the lever alone; states: angle, speed.
inline LinearStep<2>::Matrix lever_matrix(const ShaftTorque& torque, double inverse_inertia) {
  return {{{0.0, 1.0},
           {torque.theta_nm_rad * inverse_inertia, torque.omega_nm_s_rad * inverse_inertia}}};
}

/// The matrix A of lever and hand; states: angle and speed of the lever, then of the hand.
inline LinearStep<4>::Matrix grip_matrix(const ShaftTorque& torque, const HandDynamics& h,
                                         double inverse_inertia) {
  const double k = h.grip_stiffness_nm_rad, b = h.grip_damping_nm_s_rad;
  const double lever = inverse_inertia, hand = h.inverse_inertia;
  return {
      {{0.0, 1.0, 0.0, 0.0},
       {(torque.theta_nm_rad - k) * lever, (torque.omega_nm_s_rad - b) * lever, k * lever,
        b * lever},
       {0.0, 0.0, 0.0, 1.0},
       {k * hand, b * hand, -(h.stiffness_nm_rad + k) * hand, -(h.damping_nm_s_rad + b) * hand}}};
}

/// The hand's dynamics in angles of the lever; the equilibrium is 0.
inline HandDynamics dynamics_of(const Impedance& i, double radius_m) {
  const double r2 = radius_m * radius_m;
  return {1.0 / (i.mass_kg * r2),
          i.damping_ns_m * r2,
          i.stiffness_n_m * r2,
          i.grip_damping_ns_m * r2,
          i.grip_stiffness_n_m * r2,
          0.0,
          0.0};
}

/// Steps of the lever, alone or with a hand that has a mass.
class Mechanics {
 public:
  explicit Mechanics(double inertia_kg_m2) : inverse_inertia_(1.0 / inertia_kg_m2) {}

  /// One step of the lever alone.
  void step(Shaft& lever, const ShaftTorque& torque, double dt_s) {
    if (!lever_set_.same({dt_s, torque.theta_nm_rad, torque.omega_nm_s_rad})) {
      lever_step_.set(lever_matrix(torque, inverse_inertia_), dt_s);
    }
    const auto gain =
        lever_step_.gain({lever.omega_rad_s, lever_nm(lever, torque) * inverse_inertia_});
    lever.theta_rad += gain[0];
    lever.omega_rad_s += gain[1];
  }

  /// One step of lever and hand.
  void step(Shaft& lever, Shaft& hand, const ShaftTorque& torque, const HandDynamics& h,
            double dt_s) {
    if (!grip_set_.same({dt_s, torque.theta_nm_rad, torque.omega_nm_s_rad, h.inverse_inertia,
                         h.damping_nm_s_rad, h.stiffness_nm_rad, h.grip_damping_nm_s_rad,
                         h.grip_stiffness_nm_rad})) {
      grip_step_.set(grip_matrix(torque, h, inverse_inertia_), dt_s);
    }
    const double grip_nm = h.grip_nm(lever, hand);
    const double hand_nm = h.stiffness_nm_rad * (h.equilibrium_rad - hand.theta_rad) +
                           h.damping_nm_s_rad * (h.equilibrium_rad_s - hand.omega_rad_s);
    const auto gain =
        grip_step_.gain({lever.omega_rad_s, (lever_nm(lever, torque) + grip_nm) * inverse_inertia_,
                         hand.omega_rad_s, (hand_nm - grip_nm) * h.inverse_inertia});
    lever.theta_rad += gain[0];
    lever.omega_rad_s += gain[1];
    hand.theta_rad += gain[2];
    hand.omega_rad_s += gain[3];
  }

 private:
  /// The coefficients from which a matrix was computed.
  template <std::size_t N>
  class MadeFrom {
   public:
    /// Whether `now` are these coefficients; if not, stores `now`.
    bool same(const std::array<double, N>& now) {
      if (now == values_) return true;
      values_ = now;
      return false;
    }

   private:
    std::array<double, N> values_{};  // a step of length 0 never occurs
  };

  static double lever_nm(const Shaft& lever, const ShaftTorque& torque) {
    return torque.constant_nm + torque.omega_nm_s_rad * lever.omega_rad_s +
           torque.theta_nm_rad * lever.theta_rad;
  }

  double inverse_inertia_;
  LinearStep<2> lever_step_;
  LinearStep<4> grip_step_;
  MadeFrom<3> lever_set_;
  MadeFrom<8> grip_set_;
};

/// The LuGre friction of one shaft, step by step; the deflection of the bristles is advanced by the
/// exact exponential over the step. Source: Canudas de Wit et al., "A new model for control of
/// systems with friction", IEEE TAC 1995.
class Lugre {
 public:
  explicit Lugre(const LugreParameters& p)
      : p_(p),
        inverse_stribeck_s_rad_(1.0 / p.stribeck_rad_s),
        inverse_stiffness_rad_nm_(1.0 / p.stiffness_nm_rad) {}

  /// Sets the length of the following steps, s.
  void set_step(double dt_s) {
    stiffness_dt_ = p_.stiffness_nm_rad * dt_s;
    damping_per_dt_ = p_.damping_nm_s_rad / dt_s;
  }

  /// Mean of sigma0*z + sigma1*dz/dt over one step, Nm, opposing positive omega; omega (rad/s) is
  /// held. The viscous part sigma2*omega is not included: it is smooth and belongs to the
  /// mechanics.
  double advance(double omega_rad_s) {
    if (omega_rad_s == 0.0) return p_.stiffness_nm_rad * z_rad_;
    const double x = omega_rad_s * inverse_stribeck_s_rad_;
    const double rise_nm = p_.static_nm - p_.coulomb_nm;
    const double g_nm = p_.coulomb_nm + (x * x < kNegligible ? rise_nm * stribeck(x * x) : 0.0);
    const double exponent = stiffness_dt_ * std::abs(omega_rad_s) / g_nm;
    const double target_rad = std::copysign(g_nm, omega_rad_s) * inverse_stiffness_rad_nm_;
    const double mean = mean_share(exponent);
    const double step_rad = (target_rad - z_rad_) * exponent * mean;
    const double mean_rad = target_rad + (z_rad_ - target_rad) * mean;
    z_rad_ += step_rad;
    return p_.stiffness_nm_rad * mean_rad + damping_per_dt_ * step_rad;
  }

 private:
  static constexpr double kNegligible = 40.0;  // exp(-40) is below one rounding of the sum

  static constexpr double kShort = 0.0625;  // where the series is as exact as a double

  // (1 - exp(-x))/x; a series for short steps, since exp() takes most of the run time.
  static double mean_share(double x) {
    if (std::abs(x) < kShort) return series(x);
    return x < kNegligible ? -std::expm1(-x) / x : 1.0 / x;
  }

  // Sum of (-x)^n/(n+1)! to n = 8, in pairs, so that the terms can be computed in parallel.
  static double series(double x) {
    const double x2 = x * x, x4 = x2 * x2;
    const double low = (1.0 - x * (1.0 / 2)) + (1.0 / 6 - x * (1.0 / 24)) * x2;
    const double high = (1.0 / 120 - x * (1.0 / 720)) + (1.0 / 5040 - x * (1.0 / 40320)) * x2;
    return low + (high + x4 * (1.0 / 362880)) * x4;
  }

  // exp(-square), computed from the exact value at a near square, which serves many steps.
  double stribeck(double square) {
    const double away = square - near_square_;
    if (!(std::abs(away) < kShort)) {
      near_square_ = square;
      near_exp_ = std::exp(-square);
      return near_exp_;
    }
    return near_exp_ - near_exp_ * away * series(away);
  }

  LugreParameters p_;
  double inverse_stribeck_s_rad_;
  double inverse_stiffness_rad_nm_;
  double stiffness_dt_ = 0.0;
  double damping_per_dt_ = 0.0;
  double z_rad_ = 0.0;
  double near_square_ = 0.0, near_exp_ = 1.0;
};

}  // namespace feltgate::plant
