// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A hand on a lever, expressed in angles of the lever. Documentation: docs/page.md
#pragma once

#include "sim/plant/hand.hpp"

namespace feltgate::page {

/// A hand of plant::Impedance that grips a lever firmly at a radius: its mass moves with the lever.
struct LeverHand {
  static constexpr double radius_m = 0.1;

  double inertia_kg_m2() const { return impedance.mass_kg * (radius_m * radius_m); }
  /// Torque of the hand's spring and damper on a lever at theta_rad; the hand aims at hand_rad.
  double torque_nm(double hand_rad, double hand_rad_s, double theta_rad, double speed_rad_s) const {
    return radius_m * radius_m *
           (impedance.stiffness_n_m * (hand_rad - theta_rad) +
            impedance.damping_ns_m * (hand_rad_s - speed_rad_s));
  }

  plant::Impedance impedance;
};

}  // namespace feltgate::page
