// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The smooth mechanics of lever and hand, one fixed step of Boost.Odeint's fourth-order
// Runge-Kutta. Why this stepper and this step: docs/plant.md
#pragma once

#include <array>

#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4_classic.hpp>

namespace feltgate::plant {

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

/// Hand behind a grip, in angles of the lever: stiffness and damping of the grip act between lever
/// and hand, those of the hand between hand and its equilibrium.
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

class Mechanics {
 public:
  explicit Mechanics(double inertia_kg_m2) : inverse_inertia_(1.0 / inertia_kg_m2) {}

  /// Lever alone.
  void step(Shaft& lever, const ShaftTorque& torque, double dt_s) {
    const double c0 = torque.constant_nm * inverse_inertia_;
    const double c1 = torque.omega_nm_s_rad * inverse_inertia_;
    const double c2 = torque.theta_nm_rad * inverse_inertia_;
    LeverState x{lever.theta_rad, lever.omega_rad_s};
    lever_stepper_.do_step(
        [=](const LeverState& s, LeverState& rate, double) {
          rate[0] = s[1];
          rate[1] = c0 + c1 * s[1] + c2 * s[0];
        },
        x, 0.0, dt_s);
    lever = {x[0], x[1]};
  }

  /// Lever and hand.
  void step(Shaft& lever, Shaft& hand, const ShaftTorque& torque, const HandDynamics& h,
            double dt_s) {
    GripState x{lever.theta_rad, lever.omega_rad_s, hand.theta_rad, hand.omega_rad_s};
    grip_stepper_.do_step(
        [&](const GripState& s, GripState& rate, double) {
          const double grip_nm = h.grip_nm({s[0], s[1]}, {s[2], s[3]});
          const double hand_nm = h.stiffness_nm_rad * (h.equilibrium_rad - s[2]) +
                                 h.damping_nm_s_rad * (h.equilibrium_rad_s - s[3]);
          const double lever_nm =
              torque.constant_nm + torque.omega_nm_s_rad * s[1] + torque.theta_nm_rad * s[0];
          rate[0] = s[1];
          rate[1] = (lever_nm + grip_nm) * inverse_inertia_;
          rate[2] = s[3];
          rate[3] = (hand_nm - grip_nm) * h.inverse_inertia;
        },
        x, 0.0, dt_s);
    lever = {x[0], x[1]};
    hand = {x[2], x[3]};
  }

 private:
  using LeverState = std::array<double, 2>;
  using GripState = std::array<double, 4>;
  template <class State>
  using Stepper =
      boost::numeric::odeint::runge_kutta4_classic<State, double, State, double,
                                                   boost::numeric::odeint::array_algebra>;
  Stepper<LeverState> lever_stepper_;
  Stepper<GripState> grip_stepper_;
  double inverse_inertia_;
};

}  // namespace feltgate::plant
