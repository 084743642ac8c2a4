// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Dynamics of a five-bar linkage: mass matrix, centrifugal and Coriolis torques, kinetic energy,
// from the centres and rotations of its bodies. Derivation: docs/devices/pantograph.md
#pragma once

#include "linkage.hpp"

namespace feltgate::plant {

struct LinkBody {
  double mass_kg = 0.0;
  double centre_m = 0.0;       ///< centre of mass, from the motor (crank) or elbow (rod)
  double inertia_kg_m2 = 0.0;  ///< about the centre of mass
};

struct LinkageBodies {
  LinkBody crank_1, rod_1, rod_5, crank_5;
  double pen_kg = 0.0;  ///< a point mass at the pen
  Joints joint_inertia_kg_m2 =
      {};  ///< of what turns with the joint: motor behind the capstan, drum
};

/// Mass matrix and torques of the linkage.
class LinkageDynamics {
 public:
  LinkageDynamics(const LinkageGeometry& geometry, const LinkageBodies& bodies)
      : linkage_(geometry), b_(bodies) {
    crank_1_ = b_.crank_1.centre_m / geometry.crank_1_m;
    rod_1_ = b_.rod_1.centre_m / geometry.rod_1_m;
    rod_5_ = b_.rod_5.centre_m / geometry.rod_5_m;
    crank_5_ = b_.crank_5.centre_m / geometry.crank_5_m;
  }
  const Linkage& linkage() const { return linkage_; }

  /// The mass matrix M in T = 1/2 omega' M omega, kg m^2.
  JointMatrix mass(const LinkagePose& p) const {
    JointMatrix m{b_.joint_inertia_kg_m2[0], 0.0, b_.joint_inertia_kg_m2[1]};
    add(m, b_.crank_1, crank_1_ * p.elbow_1_by_1, {}, {1.0, 0.0});
    add(m, b_.crank_5, {}, crank_5_ * p.elbow_5_by_5, {0.0, 1.0});
    add(m, b_.rod_1, (1.0 - rod_1_) * p.elbow_1_by_1 + rod_1_ * p.pen_by_1, rod_1_ * p.pen_by_5,
        p.rod_1_by);
    add(m, b_.rod_5, rod_5_ * p.pen_by_1, (1.0 - rod_5_) * p.elbow_5_by_5 + rod_5_ * p.pen_by_5,
        p.rod_5_by);
    add(m, {b_.pen_kg, 0.0, 0.0}, p.pen_by_1, p.pen_by_5, {});
    return m;
  }

  /// Torques that keep the speeds constant (C in M alpha + C = torque), Nm: mass times acceleration
  /// of each body at constant speeds, transformed to the joints.
  Joints coriolis(const LinkagePose& p, const Joints& omega) const {
    const LinkageSwing s = linkage_.swing(p, omega);
    Joints c = {};
    // Cranks turn about fixed points: their acceleration is radial and needs no torque.
    push(c, b_.rod_1, (1.0 - rod_1_) * s.elbow_1 + rod_1_ * s.pen, s.rod_1,
         (1.0 - rod_1_) * p.elbow_1_by_1 + rod_1_ * p.pen_by_1, rod_1_ * p.pen_by_5, p.rod_1_by);
    push(c, b_.rod_5, (1.0 - rod_5_) * s.elbow_5 + rod_5_ * s.pen, s.rod_5, rod_5_ * p.pen_by_1,
         (1.0 - rod_5_) * p.elbow_5_by_5 + rod_5_ * p.pen_by_5, p.rod_5_by);
    push(c, {b_.pen_kg, 0.0, 0.0}, s.pen, 0.0, p.pen_by_1, p.pen_by_5, {});
    return c;
  }

  /// Kinetic energy, J.
  double kinetic_j(const LinkagePose& p, const Joints& omega) const {
    return 0.5 * dot(omega, mass(p).times(omega));
  }

 private:
  static void add(JointMatrix& m, const LinkBody& body, Vec2 by_1, Vec2 by_5, const Joints& turn) {
    m.m11 += body.mass_kg * dot(by_1, by_1) + body.inertia_kg_m2 * turn[0] * turn[0];
    m.m15 += body.mass_kg * dot(by_1, by_5) + body.inertia_kg_m2 * turn[0] * turn[1];
    m.m55 += body.mass_kg * dot(by_5, by_5) + body.inertia_kg_m2 * turn[1] * turn[1];
  }
  static void push(Joints& c, const LinkBody& body, Vec2 acceleration, double spin, Vec2 by_1,
                   Vec2 by_5, const Joints& turn) {
    c[0] += body.mass_kg * dot(by_1, acceleration) + body.inertia_kg_m2 * turn[0] * spin;
    c[1] += body.mass_kg * dot(by_5, acceleration) + body.inertia_kg_m2 * turn[1] * spin;
  }

  Linkage linkage_;
  LinkageBodies b_;
  double crank_1_, rod_1_, rod_5_, crank_5_;  ///< centres as shares of the lengths
};

}  // namespace feltgate::plant
