// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A mesh under the page's stylus: the proxy of `feltgate touch` behind the host of the planes.
// Documentation: docs/page.md
#pragma once

#include <utility>

#include "sim/axes_loop/plane_host.hpp"
#include "sim/touch/make_glb.hpp"

namespace feltgate::page {

/// A knob with six bumps, 60 mm wide: a ball drawn out along the axes.
inline touch::Soup knob_mesh() {
  constexpr double largest_m = 0.03, hollow = 0.4;
  touch::Soup s = touch::made_ball(3000);
  for (plant::Vec3& n : s.at) {
    const double x2 = n.x * n.x, y2 = n.y * n.y, z2 = n.z * n.z;
    const double bump = x2 * x2 + y2 * y2 + z2 * z2;
    n = largest_m * (1 - hollow + hollow * bump) * n;
  }
  s.materials = {"none"};
  s.parts.assign(s.triangles.size(), 0);
  return s;
}

/// A mesh and the proxy on it. It stays where it is: the proxy points to the mesh.
struct FeltMesh {
  explicit FeltMesh(touch::Mesh m) : mesh(std::move(m)), proxy(mesh, {}) {}
  FeltMesh(const FeltMesh&) = delete;
  FeltMesh& operator=(const FeltMesh&) = delete;

  /// Puts the proxy where the pen is. Errors: std::invalid_argument where that is inside of a
  /// closed mesh or on its surface.
  void begin(plant::Vec3 pen_m) {
    proxy.begin(pen_m);
    touched = {};
  }
  /// For PlaneHostSettings::search: the pen is here now.
  Plane move(plant::Vec3 pen_m) {
    touched = proxy.move(pen_m);
    return {touched.point_m, touched.normal, touched.second_point_m, touched.second,
            touched.convex};
  }

  touch::Mesh mesh;
  touch::Proxy proxy;
  touch::Touched touched;  ///< what the last move() found
};

}  // namespace feltgate::page
