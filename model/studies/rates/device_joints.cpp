// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/rates/device_joints.hpp"

#include <cmath>
#include <stdexcept>

#include "sim/plant/pantograph/linkage_mechanics.hpp"

namespace feltgate::rates {

namespace {

plant::Parameters joint_of(const plant::AxesParameters& p) {
  const double ratio = p.joint.ratio();
  plant::Parameters out;
  out.motor = p.motor;
  out.motor.torque_constant_nm_a *= ratio;
  out.motor.back_emf_constant_v_s_rad *= ratio;
  out.lever.viscous_nm_s_rad = p.joint.viscous_nm_s_rad;
  out.lugre.viscous_nm_s_rad = ratio * ratio * p.lugre.viscous_nm_s_rad;
  out.supply = p.supply;
  out.encoder = p.encoder;
  out.encoder.lines = static_cast<int>(std::lround(p.encoder.lines * p.joint.encoder_ratio()));
  return out;
}
plant::Parameters joint_of(const plant::LeverSetParameters& p) {
  plant::Parameters out = p.lever;
  out.encoder = p.encoder;
  return out;
}

Eigen::MatrixXd inertia(const plant::PantographParameters& p, const Eigen::VectorXd& angle) {
  const plant::LinkageDynamics dynamics(p.linkage, p.bodies);
  const plant::JointMatrix m = dynamics.mass(dynamics.linkage().pose({angle[0], angle[1]}));
  return Eigen::Matrix2d{{m.m11, m.m15}, {m.m15, m.m55}};
}
Eigen::MatrixXd inertia(const plant::GimbalParameters& p, const Eigen::VectorXd& angle) {
  const plant::GimbalMechanics mechanics(p.bodies, p.stops);
  const auto m = mechanics.mass(plant::gimbal_pose({angle[0], angle[1], angle[2]}));
  Eigen::Matrix3d out;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const plant::Vec3& row = m.rows[static_cast<std::size_t>(i)];
    out.row(i) << row.x, row.y, row.z;
  }
  return out;
}
Eigen::MatrixXd inertia(const plant::LeverSetParameters& p, const Eigen::VectorXd& angle) {
  return p.lever.lever.inertia_kg_m2 * Eigen::MatrixXd::Identity(angle.size(), angle.size());
}

}  // namespace

plant::Parameters joint_of(const DeviceSetup& device, plant::Effects on) {
  plant::Parameters out = std::visit([](const auto& d) { return joint_of(d.parameters); }, device);
  out.effects = on;
  out.effects.viscous = true;
  return out;
}

Eigen::MatrixXd inertia_kg_m2(const DeviceSetup& device, const Eigen::VectorXd& angle_rad) {
  return std::visit([&](const auto& d) { return inertia(d.parameters, angle_rad); }, device);
}

namespace {

using plant::Segment;

plant::Profile way(double to) {
  return {{Segment::Kind::kHold, 0.02}, {Segment::Kind::kMinimumJerk, 0.1, to}};
}
plant::Profile step(double to) { return {{Segment::Kind::kStep, 1, to}}; }

}  // namespace

void hold_and_let_go(DeviceSetup& device, const Eigen::VectorXd& at, const Eigen::VectorXd& beside,
                     const Eigen::VectorXd& nm, double hold_s) {
  const auto levers = [&](auto& hands) {
    for (std::size_t n = 0; n < hands.size(); ++n) {
      const auto i = static_cast<Eigen::Index>(n);
      plant::HandPhase bring, free;
      bring.kind = plant::HandPhase::Kind::kPrescribed;
      bring.duration_s = hold_s;
      bring.profile = way(at[i] + beside[i]);
      free.kind = plant::HandPhase::Kind::kTorque;
      free.profile = step(nm[i]);
      hands[n].phases = {bring, free};
    }
  };
  if (auto* p = std::get_if<PantographSetup>(&device)) {
    const plant::Linkage linkage(p->parameters.linkage);
    const plant::Vec2 pen = linkage.pose({at[0] + beside[0], at[1] + beside[1]}).pen;
    const plant::Vec2 force = linkage.pose({at[0], at[1]}).force({nm[0], nm[1]});
    plant::PenPhase bring, free;
    bring.kind = plant::PenPhase::Kind::kPrescribed;
    bring.duration_s = hold_s;
    bring.x = way(pen.x);
    bring.y = way(pen.y);
    free.kind = plant::PenPhase::Kind::kForce;
    free.x = step(force.x);
    free.y = step(force.y);
    p->hand.phases = {bring, free};
  } else if (auto* s = std::get_if<StylusSetup>(&device)) {
    levers(s->hand);
  } else if (auto* t = std::get_if<TwoLeversSetup>(&device)) {
    levers(t->hand);
  } else {
    throw std::invalid_argument("no hand lets a handle in rings go at a place");
  }
}

plant::Vec3 pen_m(const DeviceSetup& device, const Eigen::VectorXd& at) {
  if (const auto* p = std::get_if<PantographSetup>(&device)) {
    const plant::Vec2 pen = plant::Linkage(p->parameters.linkage).pose({at[0], at[1]}).pen;
    return {pen.x, pen.y, 0};
  }
  if (const auto* s = std::get_if<StylusSetup>(&device)) {
    const double per = s->parameters.lever.lever.radius_m;
    return {per * at[0], per * at[1], per * at[2]};
  }
  throw std::invalid_argument("this device has no pen");
}

}  // namespace feltgate::rates
