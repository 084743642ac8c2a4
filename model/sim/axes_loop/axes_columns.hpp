// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Columns of a run with several axes, in the order of axes_columns(). Documentation:
// docs/devices.md
#pragma once

#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

#include "sim/axes_loop/axes_scene.hpp"
#include "sim/plant/gimbal/gimbal.hpp"
#include "sim/plant/lever_set.hpp"
#include "sim/plant/pantograph/pantograph.hpp"

namespace feltgate {

/// A device with a pen has `pen`, the plant's position, and `counted`, the one from its joints'
/// counts.
template <class Plant>
struct DeviceSignals;

template <>
struct DeviceSignals<plant::Pantograph> {
  static constexpr bool has_pen = true;
  static std::vector<std::string> names() { return {"pen_x_m", "pen_y_m", "hand_x_n", "hand_y_n"}; }
  static void add(const plant::Pantograph& p, std::vector<double>& to) {
    const plant::PantographSeen& s = p.seen();
    to.insert(to.end(), {s.pen_m.x, s.pen_m.y, s.hand_n.x, s.hand_n.y});
  }
  static plant::Vec3 pen(const plant::Pantograph& p) { return in_plane(p.seen().pen_m); }
  static plant::Vec3 counted(const plant::Pantograph& p, const plant::Joints& theta_rad) {
    return in_plane(p.linkage().pose(theta_rad).pen);
  }

 private:
  static plant::Vec3 in_plane(plant::Vec2 at) { return {at.x, at.y, 0.0}; }
};

template <>
struct DeviceSignals<plant::TwoLevers> {
  static constexpr bool has_pen = false;
  static std::vector<std::string> names() { return {"hand_nm", "met_nm", "met_work_j"}; }
  static void add(const plant::TwoLevers& p, std::vector<double>& to) {
    const auto& s = p.seen();
    to.insert(to.end(), {s.hand_nm[0], s.hand_nm[1], s.work_j[1]});
  }
};

template <>
struct DeviceSignals<plant::Stylus> {
  static constexpr bool has_pen = true;
  static std::vector<std::string> names() {
    return {"pen_x_m", "pen_y_m", "pen_z_m", "hand_x_n", "hand_y_n", "hand_z_n"};
  }
  static void add(const plant::Stylus& p, std::vector<double>& to) {
    const plant::Vec3 at = p.pen_m(), force = p.hand_n();
    to.insert(to.end(), {at.x, at.y, at.z, force.x, force.y, force.z});
  }
  static plant::Vec3 pen(const plant::Stylus& p) { return p.pen_m(); }
  static plant::Vec3 counted(const plant::Stylus& p, const std::array<double, 3>& theta_rad) {
    return p.place_m(theta_rad);
  }
};

template <>
struct DeviceSignals<plant::Gimbal> {
  static constexpr bool has_pen = false;
  static std::vector<std::string> names() {
    return {"handle_w", "handle_x", "handle_y", "handle_z", "hand_x_nm", "hand_y_nm", "hand_z_nm"};
  }
  static void add(const plant::Gimbal& p, std::vector<double>& to) {
    const plant::Quaternion& o = p.seen().handle;
    const plant::Vec3& hand = p.seen().hand_nm;
    to.insert(to.end(), {o.w, o.x, o.y, o.z, hand.x, hand.y, hand.z});
  }
};

/// Name of a column of one axis, "NAME.n".
inline std::string of_axis(const char* name, std::size_t axis) {
  return fmt::format("{}.{}", name, axis);
}

/// The columns of a scene on this kind of plant, in order.
template <class Plant>
std::vector<std::string> columns_of(const AxesScene& scene) {
  std::vector<std::string> all{"time_s"};
  for (std::size_t n = 0; n < Plant::axes; ++n) {
    for (const char* name : {"theta_rad", "position_rad", "velocity_rad_s", "tau_ref_nm",
                             "tau_hat_nm", "motor_torque_nm", "law_nm", "limits", "faults"}) {
      all.push_back(of_axis(name, n));
    }
  }
  const auto own = DeviceSignals<Plant>::names();
  all.insert(all.end(), own.begin(), own.end());
  if (scene.plane) {
    for (const std::string& name : PlaneHost::names(scene.plane->axes)) all.push_back(name);
  }
  return all;
}

}  // namespace feltgate
