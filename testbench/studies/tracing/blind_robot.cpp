// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/devices/shapes.md
#include "blind_robot.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "axes_fixture.hpp"

namespace feltgate::test {

namespace {

constexpr double kStep_s = 1e-3;
constexpr double kSpeed_m_s = 0.05;    ///< along the outline
constexpr double kPress_n = 0.1;       ///< that it means to feel
constexpr double kFollow_m_s_n = 0.3;  ///< inward for what it feels too little
constexpr int kProbes = 400;           ///< milliseconds of pressing in
constexpr std::size_t kSlope = 6;      ///< milliseconds to both sides for a speed
constexpr double kPi = 3.14159265358979323846;
constexpr double kFelt_n = 0.02;     ///< less is nothing
constexpr double kCorner_m = 3e-3;   ///< of the arc on which it looks for what it lost
constexpr double kReturn_m = 4e-3;   ///< as near to the beginning as that is back
constexpr double kLeast_m = 0.06;    ///< of a walk around
constexpr double kLonger = 8;        ///< of the weight of the normal before
constexpr Point kMiddle{0.0, 0.12};  ///< where it expects a shape

Point unit(Point p) {
  const double size = shape::length(p);
  return size > 0 ? p * (1 / size) : Point{0, 1};
}
Point left_of(Point p) { return {-p.y, p.x}; }

}  // namespace

BlindRobot::BlindRobot(const std::vector<std::string>& columns, Point start_m, double patience_s)
    : patience_s_(patience_s), end_m_(start_m) {
  const auto at = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) -
                                    columns.begin());
  };
  for (std::size_t n = 0; n < 2; ++n) {
    position_[n] = at("position_rad." + std::to_string(n));
    torque_[n] = at("tau_ref_nm." + std::to_string(n));
  }
}

PenLead BlindRobot::lead(const std::vector<double>& row) {
  const double a = row[position_[0]], b = row[position_[1]];
  Touch now;
  now.time_s = trace_.seconds = row[0];
  now.pen_m = {shape::link_m * (std::cos(a) + std::cos(b)),
               shape::link_m * (std::sin(a) + std::sin(b))};
  now.force_n = shape::force_at(now.pen_m, {row[torque_[0]], row[torque_[1]]});
  remember(now);
  const Point rate = way(now);
  end_m_ = end_m_ + rate * kStep_s;
  return {{end_m_.x, end_m_.y}, {rate.x, rate.y}};
}

Point BlindRobot::way(const Touch& now) {
  const double felt_n = shape::length(now.force_n);
  if (felt_n > kFelt_n && probes_ < kProbes) {
    if (!met_) normal_ = unit(now.force_n);
    met_ = true;
    ++probes_;
    const double press_n = kPress_n * (1 - 0.5 * std::cos(6 * kPi * probes_ / kProbes));
    return normal_ * (kFollow_m_s_n * (felt_n - press_n));
  }
  if (felt_n > kFelt_n) {
    normal_ = unit(normal_ * kLonger + unit(now.force_n));
    heading_ = left_of(normal_);
    return heading_ * kSpeed_m_s + normal_ * (kFollow_m_s_n * (felt_n - kPress_n));
  }
  if (probes_ < kProbes) return (met_ ? normal_ * -1 : unit(kMiddle - end_m_)) * kSpeed_m_s;
  // Around a corner: the shape is to the left.
  const double turn = kSpeed_m_s / kCorner_m * kStep_s;
  heading_ = unit(heading_ + left_of(heading_) * turn);
  normal_ = left_of(heading_) * -1;
  return heading_ * kSpeed_m_s;
}

void BlindRobot::remember(const Touch& now) {
  if (shape::length(now.force_n) <= kFelt_n) return;
  if (probes_ < kProbes) {
    trace_.probed.push_back(now);
    return;
  }
  if (!trace_.touches.empty()) {
    walked_m_ += shape::length(now.pen_m - trace_.touches.back().pen_m);
  }
  trace_.touches.push_back(now);
  const double apart_m = shape::length(now.pen_m - trace_.touches.front().pen_m);
  trace_.closed = walked_m_ > kLeast_m && apart_m < kReturn_m;
}

Material felt_material(const Trace& trace) {
  const std::vector<Touch>& all = trace.probed;
  if (all.size() < 4 * kSlope) return {};
  const Point outward = unit(all.front().force_n);
  // Force = offset + K in - B out', least squares; speeds over some counts of the encoders.
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sums = Eigen::Vector3d::Zero();
  for (std::size_t i = kSlope; i + kSlope < all.size(); ++i) {
    const Touch &before = all[i - kSlope], &after = all[i + kSlope];
    const double out_m_s =
        dot(after.pen_m - before.pen_m, outward) / (after.time_s - before.time_s);
    const Eigen::Vector3d known(1, -dot(all[i].pen_m - all.front().pen_m, outward), -out_m_s);
    squares += known * known.transpose();
    sums += known * dot(all[i].force_n, outward);
  }
  const Eigen::Vector3d found = squares.ldlt().solve(sums);
  return {found[1], found[2]};
}

Trace traced(int shape, double stiffness_n_m, double damping_ns_m, Point start_m) {
  return traced("hidden_shapes",
                {{"shape", static_cast<double>(shape)},
                 {"stiffness", stiffness_n_m},
                 {"damping", damping_ns_m}},
                start_m);
}

Trace traced(const std::string& law, const std::map<std::string, double>& parameters, Point start_m,
             double patience_s, const std::optional<PlaneHostSettings>& world) {
  AxesScene scene = scene_named("hidden_shapes");
  auto& setup = std::get<PantographSetup>(scene.device);
  setup.hand = {};
  setup.hand.start_m = plant::Vec2{start_m.x, start_m.y};
  plant::PenPhase phase;
  phase.kind = plant::PenPhase::Kind::kImpedance;
  phase.impedance.mass_kg = 0.1;
  phase.impedance.damping_ns_m = 8;
  phase.impedance.stiffness_n_m = 300;
  setup.hand.phases = {phase};
  scene.scenario.duration_s = patience_s + 1;
  scene.scenario.law = law;
  scene.scenario.events.clear();
  scene.scenario.expectations.clear();
  scene.scenario.parameters = parameters;
  scene.plane = world;
  BlindRobot robot(axes_columns(scene), start_m, patience_s);
  struct Enough {};
  try {
    (void)run_scene(scene, "twin", nullptr, 1000, [&](const std::vector<double>& row) {
      if (robot.done()) throw Enough{};
      return robot.lead(row);
    });
  } catch (const Enough&) {
  }
  return robot.trace();
}

}  // namespace feltgate::test
