// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// LuGre friction; the deflection of the bristles is advanced by the exact exponential over the
// step. Source: Canudas de Wit et al., "A new model for control of systems with friction", IEEE TAC
// 1995; the step: docs/plant.md
#pragma once

#include <cmath>

#include "parameters.hpp"

namespace feltgate::plant {

/// The friction of one shaft, step by step.
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

  double z_rad() const { return z_rad_; }

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
