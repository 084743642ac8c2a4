// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/devices/shapes.md
#include "studies/shape/pen_force.hpp"

#include <algorithm>
#include <cmath>

#include "feltgate/largest.hpp"

namespace feltgate::shape {

namespace {

/// Runs in which a law that looks along the whole outline has found its place.
constexpr int settling = 300;

/// Places inside the curve at this depth, `step_m` apart.
std::vector<Point> path_inside(const Curve& curve, double depth_m, double step_m) {
  std::vector<Point> path;
  for (const Piece& p : curve.pieces) {
    // An arc around a convex corner is shorter at depth.
    const double inner_m = p.length_m * (1 - depth_m * p.curvature_per_m);
    const int steps = std::max(1, static_cast<int>(std::ceil(inner_m / step_m)));
    for (int i = 0; i < steps; ++i) {
      Piece part = p;
      part.length_m = p.length_m * i / steps;
      const Point along = end_heading(part);
      path.push_back(end(part) + Point{-along.y, along.x} * depth_m);
    }
  }
  return path;
}

}  // namespace

Point Pen::at(Point p, int runs) {
  const auto angle = cranks(p);
  std::vector<double> inputs;
  for (const law::Input& i : law_.inputs) {
    inputs.push_back(i.source == law::Source::position ? angle[static_cast<std::size_t>(i.axis)]
                                                       : 0.0);
  }
  for (int i = 0; i < runs; ++i) run_.run(inputs);
  std::array<double, 2> torque{};
  for (std::size_t o = 0; o < law_.outputs.size(); ++o) {
    torque[static_cast<std::size_t>(law_.outputs[o].axis)] = run_.outputs()[o];
  }
  return force_at(p, torque);
}

int jumps(const std::vector<Point>& forces) {
  int count = 0;
  for (std::size_t i = 1; i < forces.size(); ++i) {
    const Point a = forces[i - 1], b = forces[i];
    if (length(a) < 1e-3 || length(b) < 1e-3) continue;
    count += std::fabs(std::atan2(cross(a, b), dot(a, b))) > std::acos(-1.0) / 6 ? 1 : 0;
  }
  return count;
}

Felt around(const law::Law& law, const Curve& curve, double stiffness, double depth_m,
            double step_m) {
  Pen pen(law);
  const std::vector<Point> path = path_inside(curve, depth_m, step_m);
  const Point first = nearest(curve, path.front()).at;
  const Point outward = (first - path.front()) * (1 / depth_m);
  // From outside to inside, as a hand comes.
  for (double out = 2e-3; out > -depth_m; out -= 0.1e-3) pen.at(first + outward * out, settling);
  std::vector<Point> forces;
  double squares = 0;
  for (const Point& p : path) {
    forces.push_back(pen.at(p, settling));
    const Point wanted = (nearest(curve, p).at - p) * stiffness;
    squares += dot(forces.back() - wanted, forces.back() - wanted);
  }
  const double size = stiffness * depth_m;
  Felt f;
  f.rms_error = std::sqrt(squares / static_cast<double>(path.size())) / size;
  for (std::size_t i = 1; i < forces.size(); ++i) {
    f.most_step = larger(f.most_step, length(forces[i] - forces[i - 1]) / size);
  }
  f.jumps = jumps(forces);
  f.pen_m = path;
  f.force_n = forces;
  return f;
}

}  // namespace feltgate::shape
