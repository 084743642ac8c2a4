// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// How far a point is outside of a closed mesh, or inside of it. Documentation: docs/touch.md
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/touch/touch.hpp"

namespace feltgate::touch {

using plant::cross;
using plant::dot;
using plant::length;

SignedDistance::SignedDistance(const Mesh& mesh) : mesh_(mesh), tree_(mesh) {
  double volume_m3 = 0;
  for (const Component& c : mesh.report.components) {
    if (c.border_loops > 0 || !c.manifold || !c.orientable) {
      throw std::invalid_argument(
          "not closed, so nothing is inside of it; leave --distance out, the proxy needs no "
          "inside");
    }
    volume_m3 += c.volume_m3;
  }
  if (!(volume_m3 > 0)) {
    throw std::invalid_argument("its faces look inwards; leave --distance out, or turn them");
  }
}

SignedDistance::Place SignedDistance::at(Vec3 point_m) {
  const Near near = tree_.nearest(point_m);
  // J. Baerentzen and H. Aanaes, 2005: the side is that of the normals of all faces at the nearest
  // point, each by its angle there.
  constexpr double same_m = 1e-9;
  tree_.within(point_m, near.distance_m + same_m, near_);
  Vec3 sum{};
  for (const Near& n : near_) {
    if (length(n.point_m - near.point_m) > same_m) continue;
    const Triangle& t = mesh_.triangles[n.triangle];
    double angle_rad = 3.14159265358979323846;  // of an edge; a face is alone
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 corner = mesh_.at[t[k]];
      if (length(corner - near.point_m) > same_m) continue;
      const Vec3 a = mesh_.at[t[(k + 1) % 3]] - corner, b = mesh_.at[t[(k + 2) % 3]] - corner;
      angle_rad = arctangent(length(cross(a, b)), dot(a, b));
    }
    const Vec3 across = mesh_.across(t);
    sum = sum + angle_rad / length(across) * across;
  }
  const Vec3 way = point_m - near.point_m;
  const double side = dot(sum, way) < 0 ? -1 : 1;
  const bool on_it = near.distance_m < same_m;
  return {side * near.distance_m, near.point_m,
          on_it ? 1 / length(sum) * sum : side / near.distance_m * way, near.triangle};
}

Touched SignedDistance::touched(Vec3 pen_m) {
  const Place place = at(pen_m);
  Touched t;
  t.touching = place.distance_m < 0;
  t.constraints = t.touching ? 1 : 0;
  t.proxy_m = t.touching ? place.point_m : pen_m;
  t.depth_m = std::max(0.0, -place.distance_m);
  t.point_m = place.point_m;
  t.normal = place.gradient;
  t.triangle = place.triangle;
  return t;
}

}  // namespace feltgate::touch
