// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A mesh under the page's stylus. Documentation: docs/page.md
#include "apps/page/felt_mesh.hpp"

#include <utility>

namespace feltgate::page {

using plant::Vec3;
using touch::Soup;

Soup knob_mesh() {
  constexpr std::uint32_t cells = 16;
  constexpr double largest_m = 0.03, hollow = 0.4;
  Soup s;
  s.materials = {"none"};
  // Six sides of a cube, u x v outwards, drawn to a ball with the fourth powers on it.
  for (int side = 0; side < 6; ++side) {
    const double out = side < 3 ? 1 : -1;
    const auto first = static_cast<std::uint32_t>(s.at.size());
    for (std::uint32_t i = 0; i <= cells; ++i) {
      for (std::uint32_t j = 0; j <= cells; ++j) {
        const double u = 2.0 * i / cells - 1, v = out * (2.0 * j / cells - 1);
        const Vec3 on = side % 3 == 0   ? Vec3{out, u, v}
                        : side % 3 == 1 ? Vec3{v, out, u}
                                        : Vec3{u, v, out};
        const Vec3 n = 1 / plant::length(on) * on;
        const double x2 = n.x * n.x, y2 = n.y * n.y, z2 = n.z * n.z;
        const double bump = x2 * x2 + y2 * y2 + z2 * z2;
        s.at.push_back(largest_m * (1 - hollow + hollow * bump) * n);
      }
    }
    for (std::uint32_t i = 0; i < cells; ++i) {
      for (std::uint32_t j = 0; j < cells; ++j) {
        const std::uint32_t a = first + i * (cells + 1) + j, b = a + cells + 1;
        s.triangles.push_back({a, b, b + 1});
        s.triangles.push_back({a, b + 1, a + 1});
      }
    }
  }
  s.parts.assign(s.triangles.size(), 0);
  return s;
}

FeltMesh::FeltMesh(touch::Mesh mesh) : mesh_(std::move(mesh)), proxy_(mesh_, {}) {}

void FeltMesh::begin(Vec3 pen_m) {
  proxy_.begin(pen_m);
  touched_ = {};
}

Plane FeltMesh::move(Vec3 pen_m) {
  touched_ = proxy_.move(pen_m);
  const touch::Touched& t = touched_;
  return {t.point_m, t.normal, t.second_point_m, t.second, t.convex};
}

}  // namespace feltgate::page
