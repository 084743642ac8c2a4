// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Fewer faces of a mesh by meshoptimizer, and how far they are from those that they replace.
// Documentation: docs/touch.md
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "sim/touch/touch.hpp"

namespace feltgate::touch {

namespace {

using plant::cross;
using plant::dot;
using plant::length;

/// The farthest that a corner or the middle of a face of `from` is away from `to`, m.
double farthest_m(const Mesh& from, const TriangleTree& to) {
  double farthest = 0;
  for (const Vec3 at : from.at) farthest = std::max(farthest, to.nearest(at).distance_m);
  for (const Triangle& t : from.triangles) {
    const Vec3 middle = (1.0 / 3) * (from.at[t[0]] + from.at[t[1]] + from.at[t[2]]);
    farthest = std::max(farthest, to.nearest(middle).distance_m);
  }
  return farthest;
}

}  // namespace

Soup decimate(const Mesh& mesh, std::size_t most_faces) {
  std::vector<float> positions;
  for (const Vec3& v : mesh.at) {
    for (const double part : {v.x, v.y, v.z}) positions.push_back(static_cast<float>(part));
  }
  std::vector<std::vector<unsigned>> of_part(std::max<std::size_t>(1, mesh.materials.size()));
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    auto& part = of_part[mesh.parts[n]];
    part.insert(part.end(), mesh.triangles[n].begin(), mesh.triangles[n].end());
  }
  const bool several = std::count_if(of_part.begin(), of_part.end(),
                                     [](const auto& part) { return !part.empty(); }) > 1;
  Soup fewer;
  fewer.at = mesh.at;
  fewer.materials = mesh.materials;
  const double kept = static_cast<double>(most_faces) / static_cast<double>(mesh.triangles.size());
  for (std::size_t part = 0; part < of_part.size(); ++part) {
    const std::vector<unsigned>& faces = of_part[part];
    if (faces.empty()) continue;
    std::vector<unsigned> left(faces.size());
    const auto wanted =
        3 * static_cast<std::size_t>(std::floor(kept * static_cast<double>(faces.size()) / 3));
    // No limit of the error: the number of faces is asked for, the error is told. Where materials
    // meet, the border stays, so that no gap opens.
    const std::size_t count = meshopt_simplify(
        left.data(), faces.data(), faces.size(), positions.data(), mesh.at.size(),
        3 * sizeof(float), wanted, 1, several ? unsigned{meshopt_SimplifyLockBorder} : 0U, nullptr);
    for (std::size_t n = 0; n + 2 < count; n += 3) {
      fewer.triangles.push_back({left[n], left[n + 1], left[n + 2]});
      fewer.parts.push_back(static_cast<std::uint32_t>(part));
    }
  }
  if (fewer.triangles.empty())
    throw std::invalid_argument("no face is left of it; allow more by --faces");
  return fewer;
}

double hausdorff_m(const Mesh& a, const Mesh& b) {
  return std::max(farthest_m(a, TriangleTree(b)), farthest_m(b, TriangleTree(a)));
}

Jumps jumps_of(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3> seen;
  std::vector<std::pair<double, double>> edges;  // angle and length
  double all_m = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 normal = mesh.normal(t);
    for (std::size_t side = 0; side < 3; ++side) {
      const std::uint32_t a = t[side], b = t[(side + 1) % 3];
      const auto [other, fresh] = seen.try_emplace(std::minmax(a, b), normal);
      if (fresh) continue;
      const Vec3 before = other->second;
      edges.emplace_back(std::atan2(length(cross(before, normal)), dot(before, normal)),
                         length(mesh.at[b] - mesh.at[a]));
      all_m += edges.back().second;
    }
  }
  std::sort(edges.begin(), edges.end());
  Jumps jumps;
  double length_m = 0;
  for (const auto& [angle_rad, edge_m] : edges) {
    if (length_m < 0.95 * all_m) jumps.most_rad = angle_rad;
    length_m += edge_m;
    jumps.largest_rad = angle_rad;
  }
  return jumps;
}

}  // namespace feltgate::touch
