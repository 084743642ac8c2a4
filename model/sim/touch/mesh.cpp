// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cleaning of a mesh, and what it is: edges, components, genus, normals. Documentation:
// docs/touch.md
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "sim/touch/touch.hpp"

namespace feltgate::touch {

namespace {

using plant::cross;
using plant::dot;
using plant::length;

/// Sets that grow together.
class Union {
 public:
  explicit Union(std::size_t n) : above_(n) { std::iota(above_.begin(), above_.end(), 0U); }
  std::size_t of(std::size_t n) {
    while (above_[n] != n) n = above_[n] = above_[above_[n]];
    return n;
  }
  void join(std::size_t a, std::size_t b) { above_[of(a)] = of(b); }

 private:
  std::vector<std::size_t> above_;
};

Vec3 area_vector(const std::vector<Vec3>& at, const Triangle& t) {
  return 0.5 * cross(at[t[1]] - at[t[0]], at[t[2]] - at[t[0]]);
}
double longest_side(const std::vector<Vec3>& at, const Triangle& t) {
  return std::max(
      {length(at[t[1]] - at[t[0]]), length(at[t[2]] - at[t[1]]), length(at[t[0]] - at[t[2]])});
}

/// Vertices nearer to each other than `within` become one. A cell of the grid is ten times as
/// large, so that few vertices look into a neighbour's. It counts from `origin`, which is among
/// them: far from it a cell's number would not fit.
class Welder {
 public:
  Welder(double within, Vec3 origin) : within_(within), cell_(10 * within), origin_(origin) {}

  /// The first of them, in whatever order the cell has them.
  std::uint32_t add(Vec3 v) {
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t first = none;
    std::int64_t low[3], high[3];
    const Vec3 from_origin = v - origin_;
    const double part[] = {from_origin.x, from_origin.y, from_origin.z};
    for (int n = 0; n < 3; ++n) {
      low[n] = static_cast<std::int64_t>(std::floor((part[n] - within_) / cell_));
      high[n] = static_cast<std::int64_t>(std::floor((part[n] + within_) / cell_));
    }
    for (std::int64_t i = low[0]; i <= high[0]; ++i) {
      for (std::int64_t j = low[1]; j <= high[1]; ++j) {
        for (std::int64_t k = low[2]; k <= high[2]; ++k) {
          const auto [from, to] = cells_.equal_range(key(i, j, k));
          for (auto it = from; it != to; ++it) {
            if (length(at[it->second] - v) <= within_) first = std::min(first, it->second);
          }
        }
      }
    }
    if (first != none) return first;
    const auto index = static_cast<std::uint32_t>(at.size());
    at.push_back(v);
    cells_.emplace(key(static_cast<std::int64_t>(std::floor(part[0] / cell_)),
                       static_cast<std::int64_t>(std::floor(part[1] / cell_)),
                       static_cast<std::int64_t>(std::floor(part[2] / cell_))),
                   index);
    return index;
  }

  std::vector<Vec3> at;

 private:
  /// Cells may share a key: the distance decides.
  static std::uint64_t key(std::int64_t i, std::int64_t j, std::int64_t k) {
    return static_cast<std::uint64_t>(i) * 0x9e3779b97f4a7c15U +
           static_cast<std::uint64_t>(j) * 0xc2b2ae3d27d4eb4fU +
           static_cast<std::uint64_t>(k) * 0x165667b19e3779f9U;
  }
  double within_, cell_;
  Vec3 origin_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> cells_;
};

/// One side of a triangle: from corner `side` to the next.
struct Side {
  std::uint32_t low, high;  ///< its vertices
  std::uint32_t triangle;
  std::uint8_t side;
  bool upwards;  ///< runs from low to high
};

/// Edges of a mesh: its sides, those of one edge beside each other.
struct Edges {
  explicit Edges(const std::vector<Triangle>& triangles) {
    for (std::size_t n = 0; n < triangles.size(); ++n) {
      for (std::uint8_t side = 0; side < 3; ++side) {
        const std::uint32_t a = triangles[n][side], b = triangles[n][(side + 1U) % 3];
        sides.push_back(
            {std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(n), side, a < b});
      }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return std::tie(a.low, a.high, a.triangle, a.side) <
             std::tie(b.low, b.high, b.triangle, b.side);
    });
    for (std::size_t n = 0; n < sides.size(); ++n) {
      if (n == 0 || sides[n].low != sides[n - 1].low || sides[n].high != sides[n - 1].high)
        first.push_back(n);
    }
    first.push_back(sides.size());
  }
  std::size_t size() const { return first.size() - 1; }
  const Side& of(std::size_t edge, std::size_t n) const { return sides[first[edge] + n]; }
  std::size_t faces(std::size_t edge) const { return first[edge + 1] - first[edge]; }

  std::vector<Side> sides;
  std::vector<std::size_t> first;
};

void drop_degenerate(Mesh& mesh, const Soup& soup, double within) {
  Welder welder(within, soup.at[soup.triangles[0][0]]);
  // Vertices that no triangle has are not there.
  std::vector<std::uint32_t> now(soup.at.size(), std::numeric_limits<std::uint32_t>::max());
  std::set<Triangle> known;
  std::int64_t used = 0;
  for (std::size_t k = 0; k < soup.triangles.size(); ++k) {
    const Triangle& read = soup.triangles[k];
    Triangle t{};
    for (std::size_t n = 0; n < 3; ++n) {
      std::uint32_t& to = now[read[n]];
      if (to == std::numeric_limits<std::uint32_t>::max()) {
        to = welder.add(soup.at[read[n]]);
        ++used;
      }
      t[n] = to;
    }
    Triangle sorted = t;
    std::sort(sorted.begin(), sorted.end());
    const double side = longest_side(welder.at, t);
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0] ||
        2 * length(area_vector(welder.at, t)) < within * side) {
      ++mesh.report.degenerate;
    } else if (!known.insert(sorted).second) {
      ++mesh.report.duplicates;
    } else {
      mesh.triangles.push_back(t);
      mesh.parts.push_back(k < soup.parts.size() ? soup.parts[k] : 0);
    }
  }
  mesh.at = std::move(welder.at);
  mesh.report.triangles_read = static_cast<std::int64_t>(soup.triangles.size());
  mesh.report.vertices_read = used;
  mesh.report.welded = used - static_cast<std::int64_t>(mesh.at.size());
}

/// Turns the faces of each component to the side of most of them; those of a component that has two
/// sides of one face stay as they are.
class OneSide {
 public:
  OneSide(Mesh& mesh, const Edges& edges)
      : mesh_(mesh), beside_(mesh.triangles.size()), turned_(mesh.triangles.size(), -1) {
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (edges.faces(e) != 2) continue;
      const Side &a = edges.of(e, 0), &b = edges.of(e, 1);
      const bool against = a.upwards == b.upwards;
      beside_[a.triangle].emplace_back(b.triangle, against);
      beside_[b.triangle].emplace_back(a.triangle, against);
    }
  }
  /// Marks triangles of components that cannot be turned to one side.
  std::vector<bool> turn() {
    std::vector<bool> two_sided(turned_.size(), false);
    for (std::size_t n = 0; n < turned_.size(); ++n) {
      if (turned_[n] >= 0) continue;
      std::vector<std::size_t> part{n};
      const bool possible = spread(part);
      std::size_t turned = 0;
      for (const std::size_t t : part) turned += turned_[t] == 1 ? 1 : 0;
      const int most = 2 * turned > part.size() ? 1 : 0;
      for (const std::size_t t : part) {
        two_sided[t] = !possible;
        if (!possible || turned_[t] == most) continue;
        std::swap(mesh_.triangles[t][1], mesh_.triangles[t][2]);
        ++mesh_.report.turned;
      }
    }
    return two_sided;
  }

 private:
  bool spread(std::vector<std::size_t>& part) {
    bool possible = true;
    turned_[part[0]] = 0;
    for (std::size_t next = 0; next < part.size(); ++next) {
      for (const auto& [other, against] : beside_[part[next]]) {
        const int wanted = against ? 1 - turned_[part[next]] : turned_[part[next]];
        if (turned_[other] < 0) {
          turned_[other] = wanted;
          part.push_back(other);
        } else if (turned_[other] != wanted) {
          possible = false;
        }
      }
    }
    return possible;
  }

  Mesh& mesh_;
  std::vector<std::vector<std::pair<std::size_t, bool>>> beside_;
  std::vector<int> turned_;
};

void count_components(Mesh& mesh, const Edges& edges, const std::vector<bool>& two_sided) {
  const std::size_t faces = mesh.triangles.size();
  Union parts(faces), corners(3 * faces);
  const auto corner = [&](const Side& s, bool low) {
    return 3 * s.triangle + (low == s.upwards ? s.side : (s.side + 1U) % 3);
  };
  // Corners that edges join are one vertex: two fans that only touch in a point have two there.
  for (std::size_t e = 0; e < edges.size(); ++e) {
    for (std::size_t n = 1; n < edges.faces(e); ++n) {
      parts.join(edges.of(e, 0).triangle, edges.of(e, n).triangle);
      for (const bool low : {true, false})
        corners.join(corner(edges.of(e, 0), low), corner(edges.of(e, n), low));
    }
  }
  std::map<std::size_t, Component> found;
  for (std::size_t t = 0; t < faces; ++t) {
    Component& c = found[parts.of(t)];
    ++c.faces;
    if (two_sided[t]) c.orientable = false;
    const Triangle& at = mesh.triangles[t];
    c.volume_m3 += dot(mesh.at[at[0]], cross(mesh.at[at[1]], mesh.at[at[2]])) / 6;
  }
  for (std::size_t n = 0; n < 3 * faces; ++n) {
    if (corners.of(n) == n) ++found[parts.of(n / 3)].vertices;
  }
  Union loops(3 * faces);
  std::map<std::size_t, std::size_t> borders;  // a vertex of the border, and its component
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Side& side = edges.of(e, 0);
    Component& c = found[parts.of(side.triangle)];
    ++c.edges;
    if (edges.faces(e) > 2) c.manifold = false;
    if (edges.faces(e) != 1) continue;
    const std::size_t a = corners.of(corner(side, true)), b = corners.of(corner(side, false));
    loops.join(a, b);
    borders[a] = borders[b] = parts.of(side.triangle);
  }
  for (const auto& [vertex, part] : borders) {
    if (loops.of(vertex) == vertex) ++found[part].border_loops;
  }
  for (std::size_t t = 0; t < faces; ++t) {
    mesh.closed.push_back(found[parts.of(t)].border_loops == 0);
  }
  for (auto& [part, c] : found) {
    if (c.border_loops > 0) c.volume_m3 = 0;
    mesh.report.components.push_back(c);
  }
  std::stable_sort(mesh.report.components.begin(), mesh.report.components.end(),
                   [](const Component& a, const Component& b) { return a.faces > b.faces; });
}

/// As arctangent(); its angle is at most pi.
double cosine(double angle_rad) {
  double sum = 1, term = 1;
  for (int n = 1; n < 16; ++n) {
    term *= -angle_rad * angle_rad / ((2 * n - 1) * (2 * n));
    sum += term;
  }
  return sum;
}

double angle_at(const Mesh& mesh, const Triangle& t, std::size_t corner) {
  const Vec3 at = mesh.at[t[corner]];
  const Vec3 a = mesh.at[t[(corner + 1) % 3]] - at, b = mesh.at[t[(corner + 2) % 3]] - at;
  return arctangent(length(cross(a, b)), dot(a, b));
}

void add_normals(Mesh& mesh, double crease_rad) {
  constexpr std::size_t most_faces = 256;  // of a vertex; the time grows with their square
  std::vector<Vec3> faces;
  std::vector<std::vector<std::pair<std::uint32_t, double>>> around(mesh.at.size());
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    const Triangle& t = mesh.triangles[n];
    const Vec3 area = area_vector(mesh.at, t);
    faces.push_back(1 / length(area) * area);
    for (std::size_t c = 0; c < 3; ++c) around[t[c]].emplace_back(n, angle_at(mesh, t, c));
  }
  const double crease = cosine(crease_rad);
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    std::array<Vec3, 3> smooth{faces[n], faces[n], faces[n]};
    for (std::size_t c = 0; c < 3; ++c) {
      const auto& all = around[mesh.triangles[n][c]];
      if (all.size() > most_faces) continue;
      Vec3 sum{};
      for (const auto& [other, angle] : all) {
        if (dot(faces[other], faces[n]) > crease) sum = sum + angle * faces[other];
      }
      if (length(sum) > 0) smooth[c] = 1 / length(sum) * sum;
    }
    mesh.normals.push_back(smooth);
  }
}

}  // namespace

double arctangent(double y, double x) {
  const double size = std::sqrt(x * x + y * y);
  if (size == 0) return 0;
  double c = x / size, s = y / size;
  // Half the angle, four times: at most pi / 16 is left.
  for (int n = 0; n < 4; ++n) {
    if (c >= 0) {
      c = std::sqrt((1 + c) / 2);
      s /= 2 * c;
    } else {
      const double half = std::copysign(std::sqrt((1 - c) / 2), s);
      c = s / (2 * half);
      s = half;
    }
  }
  const double t = s / c;
  double sum = 0;
  for (int n = 21; n > 0; n -= 2) sum = 1.0 / n - t * t * sum;
  return 16 * t * sum;
}

std::optional<std::int64_t> Component::genus() const {
  if (!manifold || !orientable) return std::nullopt;
  return (2 - euler() - border_loops) / 2;
}

Mesh clean(const Soup& soup, double crease_rad) {
  double largest = 0;
  for (const Triangle& t : soup.triangles) {
    for (const std::uint32_t n : t)
      largest = std::max(largest, length(soup.at[n] - soup.at[soup.triangles[0][0]]));
  }
  if (!(largest > 0) || !std::isfinite(largest))
    throw std::invalid_argument(
        "the mesh has no extent; export a mesh that has triangles with an area");
  Mesh mesh;
  mesh.materials = soup.materials;
  drop_degenerate(mesh, soup, 1e-6 * largest);
  if (mesh.triangles.empty())
    throw std::invalid_argument("the mesh has no triangle with an area; export a mesh that has");
  const Edges edges(mesh.triangles);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    mesh.report.border_edges += edges.faces(e) == 1 ? 1 : 0;
    mesh.report.nonmanifold_edges += edges.faces(e) > 2 ? 1 : 0;
    if (edges.faces(e) == 2 && edges.of(e, 0).upwards == edges.of(e, 1).upwards)
      ++mesh.report.inverted_edges;
  }
  const std::vector<bool> two_sided = OneSide(mesh, edges).turn();
  // Turned triangles have other sides.
  count_components(mesh, Edges(mesh.triangles), two_sided);
  add_normals(mesh, crease_rad);
  return mesh;
}

double winding(const Mesh& mesh, Vec3 at) {
  double sum = 0;
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    if (!mesh.closed[n]) continue;
    const Triangle& t = mesh.triangles[n];
    const Vec3 a = mesh.at[t[0]] - at, b = mesh.at[t[1]] - at, c = mesh.at[t[2]] - at;
    const double la = length(a), lb = length(b), lc = length(c);
    // Half the solid angle: van Oosterom and Strackee, 1983.
    sum += arctangent(dot(a, cross(b, c)),
                      la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (2 * 3.14159265358979323846);
}

}  // namespace feltgate::touch
