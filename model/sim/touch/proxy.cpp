// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Queries of a mesh by a tree of boxes, in doubles (a ball of 10 um needs more than floats); and
// the proxy: it goes towards the pen, along up to three walls at once. Documentation: docs/touch.md
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "sim/touch/touch.hpp"

namespace feltgate::touch {

namespace {
using plant::cross;
using plant::dot;
using plant::length;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t most_in_leaf = 4;
/// A gap of this share of a ball's radius is a contact.
constexpr double contact_share = 1e-6;

double part(Vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
Vec3 lower(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3 upper(Vec3 a, Vec3 b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

/// The nearest point of a triangle: C. Ericson, Real-Time Collision Detection, 2005, 5.1.5.
Vec3 nearest_point(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  }
  const double sum = va + vb + vc;
  return a + vb / sum * ab + vc / sum * ac;
}

/// The share of the way until the ball touches the triangle; above 1: it does not. The distance to
/// a triangle is a convex function of the way, so that a step of Newton's from before the contact
/// never goes beyond it.
double contact_on_way(const Mesh& mesh, std::size_t triangle, Vec3 from, Vec3 way, double radius_m,
                      double most) {
  const double rounding_m = contact_share * radius_m;
  double share = 0;
  for (int step = 0; step < 100; ++step) {
    const Vec3 at = from + share * way;
    const Near near = nearest_of_triangle(mesh, triangle, at);
    if (!(near.distance_m > 0)) return share;
    const double gap_m = near.distance_m - radius_m;
    const double rate = dot(at - near.point_m, way) / near.distance_m;
    // On the rest of the way the gap is at least that of the tangent.
    if (gap_m + std::min(0.0, rate) * (most - share) >= -rounding_m) return infinity;
    if (gap_m <= rounding_m) {
      // Over the edge of a flat or convex wall it only grazes: look at the least gap of the rest.
      double low = share, high = most, least_m = gap_m;
      for (int half = 0; half < 50 && least_m >= -rounding_m; ++half) {
        const double middle = 0.5 * (low + high);
        const Near there = nearest_of_triangle(mesh, triangle, from + middle * way);
        least_m = there.distance_m - radius_m;
        (dot(from + middle * way - there.point_m, way) < 0 ? low : high) = middle;
      }
      return least_m >= -rounding_m ? infinity : share;
    }
    share -= gap_m / rate;
  }
  return share;
}

constexpr int most_steps = 40;
constexpr std::size_t most_walls = 48;
/// Walls nearer than this beyond the radius, of the radius, hold the proxy.
constexpr double near_share = 0.05;

/// Solves n_i s = b_i for up to three directions by the shortest s, s = sum of by_i n_i; false
/// where the directions depend on each other.
bool shortest(const Vec3* n, const double* b, int count, double* by) {
  if (count == 1) {
    by[0] = b[0] / dot(n[0], n[0]);
    return true;
  }
  const double g01 = dot(n[0], n[1]);
  if (count == 2) {
    const double det = 1 - g01 * g01;
    if (det < 1e-9) return false;
    by[0] = (b[0] - g01 * b[1]) / det;
    by[1] = (b[1] - g01 * b[0]) / det;
    return true;
  }
  const double volume = dot(n[0], cross(n[1], n[2]));
  if (std::abs(volume) < 1e-6) return false;
  const Vec3 s =
      1 / volume * (b[0] * cross(n[1], n[2]) + b[1] * cross(n[2], n[0]) + b[2] * cross(n[0], n[1]));
  by[0] = dot(s, cross(n[1], n[2])) / volume;
  by[1] = dot(s, cross(n[2], n[0])) / volume;
  by[2] = dot(s, cross(n[0], n[1])) / volume;
  return true;
}

Vec3 along(const Vec3* n, const double* by, int count) {
  Vec3 sum{};
  for (int k = 0; k < count; ++k) sum = sum + by[k] * n[k];
  return sum;
}

}  // namespace

Near nearest_of_triangle(const Mesh& mesh, std::size_t triangle, Vec3 to) {
  const Triangle& t = mesh.triangles[triangle];
  const Vec3 point = nearest_point(to, mesh.at[t[0]], mesh.at[t[1]], mesh.at[t[2]]);
  return {length(to - point), point, triangle};
}

TriangleTree::TriangleTree(const Mesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  std::vector<Box> boxes;
  std::vector<Vec3> middles;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.at[t[0]], b = mesh.at[t[1]], c = mesh.at[t[2]];
    boxes.push_back({lower(lower(a, b), c), upper(upper(a, b), c)});
    middles.push_back(1.0 / 3 * (a + b + c));
  }
  nodes_.push_back({{}, 0, static_cast<std::uint32_t>(order_.size())});
  split(0, boxes, middles, 0);
}

void TriangleTree::split(std::size_t node, const std::vector<Box>& boxes,
                         const std::vector<Vec3>& middles, int depth) {
  const std::uint32_t first = nodes_[node].first, count = nodes_[node].count;
  Box box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  Box spread = box;
  for (std::uint32_t n = first; n < first + count; ++n) {
    const std::uint32_t t = order_[n];
    box = {lower(box.low, boxes[t].low), upper(box.high, boxes[t].high)};
    spread = {lower(spread.low, middles[t]), upper(spread.high, middles[t])};
  }
  nodes_[node].box = box;
  const Vec3 size = spread.high - spread.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto begin = order_.begin() + first;
  if (count <= most_in_leaf || depth >= 60) {
    // Which halves a leaf is made of is certain, their order is the library's.
    std::sort(begin, begin + count);
    return;
  }
  std::nth_element(begin, begin + count / 2, begin + count, [&](std::uint32_t a, std::uint32_t b) {
    const double at_a = part(middles[a], axis), at_b = part(middles[b], axis);
    return at_a != at_b ? at_a < at_b : a < b;
  });
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = child;
  nodes_[node].count = 0;
  nodes_.push_back({{}, first, count / 2});
  nodes_.push_back({{}, first + count / 2, count - count / 2});
  split(child, boxes, middles, depth + 1);
  split(child + 1, boxes, middles, depth + 1);
}

double TriangleTree::away_m(const Box& box, Vec3 from) {
  const Vec3 by = upper(upper(box.low - from, from - box.high), {});
  return length(by);
}

template <class Reject, class Each>
void TriangleTree::walk(Reject&& reject, Each&& each) const {
  std::uint32_t waiting[64 * 2];
  std::size_t count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const Node& node = nodes_[waiting[--count]];
    if (reject(node.box)) continue;
    if (node.count == 0) {
      waiting[count++] = node.first + 1;
      waiting[count++] = node.first;
      continue;
    }
    for (std::uint32_t n = node.first; n < node.first + node.count; ++n) each(order_[n]);
  }
}

Near TriangleTree::nearest(Vec3 to) const {
  Near best{infinity, {}, 0};
  std::uint32_t waiting[64 * 2];
  std::size_t count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const Node& node = nodes_[waiting[--count]];
    if (away_m(node.box, to) >= best.distance_m) continue;
    if (node.count == 0) {
      // The nearer child first.
      const bool swap = away_m(nodes_[node.first + 1].box, to) < away_m(nodes_[node.first].box, to);
      waiting[count++] = node.first + (swap ? 0 : 1);
      waiting[count++] = node.first + (swap ? 1 : 0);
      continue;
    }
    for (std::uint32_t n = node.first; n < node.first + node.count; ++n) {
      const Near near = nearest_of_triangle(mesh_, order_[n], to);
      if (near.distance_m < best.distance_m) best = near;
    }
  }
  return best;
}

void TriangleTree::within(Vec3 to, double distance_m, std::vector<Near>& found) const {
  found.clear();
  walk([&](const Box& box) { return away_m(box, to) > distance_m; },
       [&](std::uint32_t t) {
         const Near near = nearest_of_triangle(mesh_, t, to);
         if (near.distance_m <= distance_m) found.push_back(near);
       });
}

double TriangleTree::free_way(Vec3 from, Vec3 way, double radius_m) const {
  double most = 1;
  const double wide_m = 1.001 * radius_m;
  walk(
      [&](const Box& box) {
        double enters = 0, leaves = most;
        for (int axis = 0; axis < 3; ++axis) {
          const double at = part(from, axis), by = part(way, axis);
          const double low = part(box.low, axis) - wide_m, high = part(box.high, axis) + wide_m;
          if (by == 0) {
            if (at < low || at > high) return true;
            continue;
          }
          const double one = (low - at) / by, other = (high - at) / by;
          enters = std::max(enters, std::min(one, other));
          leaves = std::min(leaves, std::max(one, other));
        }
        // By rounding, a box may be missed that is only just touched.
        return enters > leaves + 1e-12;
      },
      [&](std::uint32_t t) {
        most = std::min(most, contact_on_way(mesh_, t, from, way, radius_m, most));
      });
  return most;
}

Proxy::Proxy(const Mesh& mesh, const ProxySettings& settings)
    : mesh_(mesh), tree_(mesh), settings_(settings) {
  tell_edges(settings.edges);
}

void Proxy::begin(Vec3 pen_m) {
  if (tree_.nearest(pen_m).distance_m < (1 + near_share) * settings_.radius_m) {
    throw std::invalid_argument("the pen begins on the mesh; begin outside of it");
  }
  if (std::abs(winding(mesh_, pen_m)) > 0.5) {
    throw std::invalid_argument("the pen begins inside of the mesh; begin outside of it");
  }
  at_ = pen_m;
}

void Proxy::find_walls() {
  tree_.within(at_, (1 + near_share) * settings_.radius_m, near_);
  std::sort(near_.begin(), near_.end(), [](const Near& a, const Near& b) {
    return std::tie(a.distance_m, a.triangle) < std::tie(b.distance_m, b.triangle);
  });
  walls_.clear();
  for (const Near& near : near_) {
    // A radius above a face's plane it may go along, also beyond its edges: no seams. Beside a
    // face, its edge or corner counts from the contact on.
    const Triangle& t = mesh_.triangles[near.triangle];
    const Vec3 across = mesh_.across(t);
    const double above_m = dot(across, at_ - mesh_.at[t[0]]) / length(across);
    const bool face = std::abs(above_m) >= (1 - 2 * contact_share) * settings_.radius_m;
    if (!face && near.distance_m > (1 + 2 * contact_share) * settings_.radius_m) continue;
    const Vec3 normal = face ? (above_m < 0 ? -1 : 1) / length(across) * across
                             : 1 / near.distance_m * (at_ - near.point_m);
    // Faces of a flat wall in floats differ by 1e-7: one of them may stand in the other's way.
    const double same = face ? 1e-11 : 3e-3;
    const bool known = std::any_of(walls_.begin(), walls_.end(),
                                   [&](const Wall& w) { return length(w.normal - normal) < same; });
    if (!known)
      walls_.push_back({normal, settings_.radius_m - (face ? std::abs(above_m) : near.distance_m)});
    if (walls_.size() == most_walls) break;
  }
}

/// The point nearest to the pen that no wall forbids. The least distance to a convex set is reached
/// where the pull of up to three walls, all of them outwards, is in balance with that to the pen;
/// so the first such point that no other wall forbids is the one.
Proxy::Goal Proxy::goal_of(Vec3 pen_m) {
  find_walls();
  const Vec3 pull = pen_m - at_;
  const double rounding_m = 1e-7 * settings_.radius_m;
  const auto allowed = [&](Vec3 step) {
    return std::all_of(walls_.begin(), walls_.end(), [&](const Wall& w) {
      return dot(w.normal, step) >= w.least_m - rounding_m;
    });
  };
  if (allowed(pull)) return {pen_m, {}, 0};
  const std::size_t count = walls_.size();
  for (int held = 1; held <= 3; ++held) {
    std::size_t of[3] = {0, 1, 2};
    const auto size = static_cast<std::size_t>(held);
    if (count < size) break;
    while (true) {
      Goal goal;
      double missing[3], by[3];
      for (std::size_t k = 0; k < size; ++k) {
        const Wall& w = walls_[of[k]];
        goal.held[k] = w.normal;
        missing[k] = w.least_m - dot(w.normal, pull);
      }
      if (shortest(goal.held, missing, held, by) &&
          std::all_of(by, by + held, [](double b) { return b >= 0; })) {
        const Vec3 step = pull + along(goal.held, by, held);
        if (allowed(step)) {
          goal.at = at_ + step;
          goal.walls = held;
          return goal;
        }
      }
      // The next choice of so many walls.
      std::size_t k = size;
      while (k > 0 && of[k - 1] == count - size + k - 1) --k;
      if (k == 0) break;
      ++of[k - 1];
      for (; k < size; ++k) of[k] = of[k - 1] + 1;
    }
  }
  // Walls that all but depend on each other: it stays.
  Goal goal{at_, {}, 1};
  goal.held[0] = walls_.front().normal;
  return goal;
}

Touched Proxy::move(Vec3 pen_m) {
  Goal goal;
  for (int step = 0; step < most_steps; ++step) {
    goal = goal_of(pen_m);
    Vec3 way = goal.at - at_;
    const double far_m = length(way);
    const double held_m = goal.walls > 0 ? settings_.friction * length(pen_m - goal.at) : 0;
    if (held_m > 0) way = std::max(0.0, 1 - held_m / std::max(far_m, 1e-300)) * way;
    if (length(way) < 1e-10) break;
    const double share = tree_.free_way(at_, way, settings_.radius_m);
    at_ = at_ + share * way;
    if (share >= 1 && held_m > 0) break;
  }
  return told(pen_m, goal);
}

Touched Proxy::told(Vec3 pen_m, const Goal& goal) const {
  Touched t;
  t.proxy_m = at_;
  const Vec3 off = at_ - pen_m;
  if (goal.walls > 0 && length(off) > 1e-10) {
    // From the middle of the ball to the surfaces that hold it.
    const double radii[] = {settings_.radius_m, settings_.radius_m, settings_.radius_m};
    double by[3];
    t.proxy_m =
        at_ - (shortest(goal.held, radii, goal.walls, by) ? along(goal.held, by, goal.walls)
                                                          : settings_.radius_m * goal.held[0]);
    const bool slides = goal.walls == 1 && settings_.friction == 0;
    t.normal = slides ? goal.held[0] : 1 / length(off) * off;
    t.depth_m = dot(t.normal, t.proxy_m - pen_m);
    t.touching = t.depth_m > 0;
  }
  const Near near = tree_.nearest(at_);
  t.triangle = near.triangle;
  if (t.touching) {
    t.constraints = goal.walls;
    t.point_m = t.proxy_m;
  } else {
    t.normal = 1 / near.distance_m * (at_ - near.point_m);
    t.point_m = near.point_m;
    t.depth_m = 0;
    t.proxy_m = pen_m;
  }
  if (settings_.shading && t.constraints <= 1) t = shaded(t, pen_m, near);
  if (edges_) edges_->add(t, at_, near.distance_m);
  return t;
}

}  // namespace feltgate::touch
