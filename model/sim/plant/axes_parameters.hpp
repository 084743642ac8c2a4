// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Constants of joints with equal drives: motor, capstan, friction, encoder.
// docs/devices/pantograph.md
#pragma once

#include "parameters.hpp"

namespace feltgate::plant {

/// The transmission between a motor and its joint.
struct JointParameters {
  double rotor_inertia_kg_m2 = 0.0;
  double drum_inertia_kg_m2 = 0.0;  ///< turns with the joint
  double pulley_radius_m = 0.0;     ///< capstan pulley, on the motor
  double drum_radius_m = 0.0;
  double viscous_nm_s_rad = 0.0;  ///< at the joint
  bool encoder_on_motor = false;  ///< the counts are those of the motor's angle

  /// Turns of the motor per turn of the joint.
  double ratio() const { return drum_radius_m / pulley_radius_m; }
  double encoder_ratio() const { return encoder_on_motor ? ratio() : 1.0; }
  double inertia_kg_m2() const {
    return drum_inertia_kg_m2 + ratio() * ratio() * rotor_inertia_kg_m2;
  }
};

/// Parameters of a device with equal joints.
struct AxesParameters {
  JointParameters joint;
  MotorParameters motor;
  LugreParameters lugre;      ///< at the motor's shaft
  SupplyParameters supply;    ///< one for all motors
  EncoderParameters encoder;  ///< of axis 0; the other axes have the next seeds
  Effects effects;            ///< defaults of the file; a scene may override each

  /// Viscous torque per speed of a joint, from the effects that are on, Nm s/rad.
  double smooth_nm_s_rad(const Effects& on) const {
    return (on.viscous ? joint.viscous_nm_s_rad : 0.0) +
           (on.lugre ? joint.ratio() * joint.ratio() * lugre.viscous_nm_s_rad : 0.0);
  }
};

}  // namespace feltgate::plant
