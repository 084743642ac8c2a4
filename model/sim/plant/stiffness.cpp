// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// How stiff a plant may be for its step. Derivation: docs/plant.md
#include "sim/plant/stiffness.hpp"

#include <algorithm>
#include <cmath>

#include "sim/plant/mechanics.hpp"

namespace feltgate::plant {

namespace {

using Kind = HandPhase::Kind;

template <std::size_t N>
using Matrix = typename LinearStep<N>::Matrix;

/// Largest magnitude of an eigenvalue: |A^k|^(1/k), with k = 2^30 by repeated squaring.
template <std::size_t N>
double spectral_radius(Matrix<N> a) {
  double log_radius = 0.0, share = 1.0;
  for (int squaring = 0; squaring < 30; ++squaring) {
    double size = 0.0;
    for (const auto& row : a) {
      for (const double v : row) size = std::isnan(v) ? v : std::max(size, std::abs(v));
    }
    if (size == 0.0 || !std::isfinite(size)) return size;
    log_radius += share * std::log(size);
    share *= 0.5;
    Matrix<N> square{};
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N; ++j) {
        for (std::size_t k = 0; k < N; ++k) square[i][j] += a[i][k] / size * (a[k][j] / size);
      }
    }
    a = square;
  }
  return std::exp(log_radius);
}

}  // namespace

double mechanical_pole_1_s(const Parameters& p, const Effects& on, const HandPhase& phase,
                           double radius_m) {
  const double inverse_inertia = 1.0 / p.lever.inertia_kg_m2;
  ShaftTorque torque{0.0, -smooth_damping_nm_s_rad(p, on),
                     p.end_stops ? -p.end_stops->stiffness_nm_rad : 0.0};
  switch (phase.kind) {
    case Kind::kLocked:
    case Kind::kPrescribed:
    case Kind::kTrace:
      return 0.0;
    case Kind::kImpedance: {
      if (!on.hand_dynamics) return 0.0;
      const HandDynamics hand = dynamics_of(phase.impedance, radius_m);
      return spectral_radius<4>(grip_matrix(torque, hand, inverse_inertia));
    }
    case Kind::kCord:
      torque.omega_nm_s_rad -= phase.cord.damping_nm_s_rad;
      torque.theta_nm_rad -= phase.cord.stiffness_nm_rad;
      break;
    case Kind::kFree:
    case Kind::kTorque:
      break;
  }
  return spectral_radius<2>(lever_matrix(torque, inverse_inertia));
}

double outer_pole_1_s(const Parameters& p, const Effects& on, double step_s) {
  double damping = 0.0, stiffness = 0.0;  // Nm s/rad, Nm/rad
  if (on.lugre) {
    damping += p.lugre.damping_nm_s_rad;
    stiffness += p.lugre.stiffness_nm_rad;
  }
  if (on.back_emf) {
    const MotorParameters& m = p.motor;
    const double emf = m.torque_constant_nm_a * m.back_emf_constant_v_s_rad;
    // The winding's mean current in a step follows a change of speed by this share.
    const double x = step_s * m.resistance_ohm / m.inductance_h;
    const double share = on.inductance ? 1.0 + std::expm1(-x) / x : 1.0;
    damping += emf / m.resistance_ohm * share;
    if (on.inductance) stiffness += emf / m.inductance_h * std::min(1.0, 1.0 / x);
  }
  constexpr double most_frequency_steps = 0.3;
  const double inverse_inertia = 1.0 / p.lever.inertia_kg_m2;
  return std::max(damping * inverse_inertia,
                  std::sqrt(stiffness * inverse_inertia) / most_frequency_steps);
}

}  // namespace feltgate::plant
