// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// LuGre friction, its bristle deflection advanced by the exact exponential over the step.
// Source: Canudas de Wit et al., "A new model for control of systems with friction", IEEE TAC 1995;
// the step: docs/plant.md
#pragma once

#include <cmath>

#include "plant/parameters.hpp"

namespace feltgate::plant {

class Lugre {
 public:
  explicit Lugre(const LugreParameters& p)
      : p_(p),
        inverse_stribeck_s_rad_(1.0 / p.stribeck_rad_s),
        inverse_stiffness_rad_nm_(1.0 / p.stiffness_nm_rad) {}

  /// Sets the length of the steps to come, s.
  void set_step(double dt_s) {
    stiffness_dt_ = p_.stiffness_nm_rad * dt_s;
    damping_per_dt_ = p_.damping_nm_s_rad / dt_s;
  }

  /// Mean of sigma0*z + sigma1*dz/dt over one step, Nm, opposing positive omega; omega (rad/s) is
  /// held. The viscous part sigma2*omega is not in it: it is smooth and goes with the mechanics.
  double advance(double omega_rad_s) {
    if (omega_rad_s == 0.0) return p_.stiffness_nm_rad * z_rad_;
    const double x = omega_rad_s * inverse_stribeck_s_rad_;
    const double rise_nm = p_.static_nm - p_.coulomb_nm;
    const double g_nm = p_.coulomb_nm + (x * x < kNegligible ? rise_nm * std::exp(-x * x) : 0.0);
    const double exponent = stiffness_dt_ * std::abs(omega_rad_s) / g_nm;
    const double target_rad = std::copysign(g_nm, omega_rad_s) * inverse_stiffness_rad_nm_;
    const double gone = decay_share(exponent);
    const double step_rad = (target_rad - z_rad_) * gone;
    const double mean_rad = target_rad + (z_rad_ - target_rad) * mean_share(exponent, gone);
    z_rad_ += step_rad;
    return p_.stiffness_nm_rad * mean_rad + damping_per_dt_ * step_rad;
  }

  double z_rad() const { return z_rad_; }
  void set_z_rad(double z_rad) { z_rad_ = z_rad; }

 private:
  static constexpr double kNegligible = 40.0;  // exp(-40) is below one rounding of the sum

  // 1 - exp(-x); short series where the step is short, so that the fast path needs no expm1.
  static double decay_share(double x) {
    if (x < 1e-3) return x * (1.0 - x * (0.5 - x * (1.0 / 6.0 - x / 24.0)));
    return x < kNegligible ? 1.0 - std::exp(-x) : 1.0;
  }

  // (1 - exp(-x))/x
  static double mean_share(double x, double gone) {
    if (x < 1e-3) return 1.0 - x * (0.5 - x * (1.0 / 6.0 - x / 24.0));
    return gone / x;
  }

  LugreParameters p_;
  double inverse_stribeck_s_rad_;
  double inverse_stiffness_rad_nm_;
  double stiffness_dt_ = 0.0;
  double damping_per_dt_ = 0.0;
  double z_rad_ = 0.0;
};

}  // namespace feltgate::plant
