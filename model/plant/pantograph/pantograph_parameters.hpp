// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Constants of a pantograph: linkage, joints, stops and two motors alike, in SI units.
// Documentation: docs/pantograph.md
#pragma once

#include <string>

#include "../parameters.hpp"
#include "linkage_mechanics.hpp"

namespace feltgate::plant {

/// What stands between a motor and its crank; both joints are alike.
struct JointParameters {
  double rotor_inertia_kg_m2 = 0.0;
  double drum_inertia_kg_m2 = 0.0;  ///< turns with the crank
  double pulley_radius_m = 0.0;     ///< of the capstan, on the motor
  double drum_radius_m = 0.0;
  double viscous_nm_s_rad = 0.0;  ///< at the crank
  bool encoder_on_motor = false;  ///< its counts are then of the motor's angle

  /// Turns of the motor per turn of the crank.
  double ratio() const { return drum_radius_m / pulley_radius_m; }
  double inertia_kg_m2() const {
    return drum_inertia_kg_m2 + ratio() * ratio() * rotor_inertia_kg_m2;
  }
};

struct PantographParameters {
  std::string name;
  LinkageGeometry linkage;
  LinkageBodies bodies;  ///< joint_inertia_kg_m2 included
  JointParameters joint;
  LinkageStops stops;
  Vec2 start_m;  ///< of the pen at clock 0, unless a hand says otherwise
  MotorParameters motor;
  LugreParameters lugre;      ///< at the motor's shaft
  SupplyParameters supply;    ///< one for both motors
  EncoderParameters encoder;  ///< of joint 1; that of joint 5 has the next seed
  Effects effects;

  /// Viscous torque per speed of a crank, of the effects that are on, Nm s/rad.
  double smooth_nm_s_rad(const Effects& on) const {
    return (on.viscous ? joint.viscous_nm_s_rad : 0.0) +
           (on.lugre ? joint.ratio() * joint.ratio() * lugre.viscous_nm_s_rad : 0.0);
  }
};

}  // namespace feltgate::plant
