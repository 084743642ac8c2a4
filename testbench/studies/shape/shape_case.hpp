// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Shapes as laws, a pen that feels a law in real numbers, and the nearest place of a curve, for
// tests. Documentation: docs/devices/shapes.md
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "law/evaluate.hpp"
#include "law/read_law.hpp"
#include "studies/shape/rhombus.hpp"
#include "studies/shape/shape_law.hpp"

namespace feltgate::shape {

constexpr double pi = 3.14159265358979323846;

inline Curve curve_of(const std::string& name, double radius_m = 5e-3) {
  const std::string file = std::string(FELTGATE_ROOT) + "/vectors/shapes/" + name + ".svg";
  return rounded(placed(read_svg(file), {}), radius_m);
}

inline law::Law law_of(const Curve& curve, int vertices) {
  return law::read_law_text(law_text(sampled(curve, vertices), {"a shape"}), "shape.law", 50e3);
}

/// Torques of the axes, Nm, after so many runs of a law at rest at these angles.
inline std::array<double, 3> torques_nm(const law::Law& law, law::Evaluation<double>& run,
                                        const std::array<double, 3>& angles, int runs = 1) {
  std::vector<double> inputs;
  for (const law::Input& i : law.inputs) {
    const bool is_position = i.source == law::Source::position;
    inputs.push_back(is_position ? angles[static_cast<std::size_t>(i.axis)] : 0.0);
  }
  for (int i = 0; i < runs; ++i) run.run(inputs);
  std::array<double, 3> torques{};
  for (std::size_t o = 0; o < law.outputs.size(); ++o) {
    torques[static_cast<std::size_t>(law.outputs[o].axis)] = run.outputs()[o];
  }
  return torques;
}

/// A pen that the caller moves, with a law of two axes.
class Pen {
 public:
  explicit Pen(law::Law law) : law_(std::move(law)), run_(law_) {}
  /// The force, N, after `runs` runs with the pen at rest at `pen_m`.
  Point at(Point pen_m, int runs = 1) {
    const auto [first, second] = cranks(pen_m);
    const auto torques = torques_nm(law_, run_, {first, second, 0}, runs);
    return force_at(pen_m, {torques[0], torques[1]});
  }
  /// Sets a parameter of the law by its index in Law::parameters, SI.
  void set_parameter(std::size_t index, double si) { run_.set_parameter(index, si); }

 private:
  const law::Law law_;
  law::Evaluation<double> run_;
};

/// The place of the curve nearest to p, and the direction there.
struct Nearest {
  Point at, along;
};
inline Nearest nearest(const Curve& curve, Point q) {
  Nearest best{{1e9, 1e9}, {}};
  for (const Piece& p : curve.pieces) {
    double s = dot(q - p.from, direction(p, 0));
    if (p.curvature_per_m != 0) {
      // The direction from the arc's middle to q, as far as the arc goes.
      const double r = 1 / p.curvature_per_m;
      const Point start = direction(p, 0), to_start = Point{start.y, -start.x} * r;
      const Point to_q = q - p.from + to_start;
      s = std::atan2(cross(to_start, to_q), dot(to_start, to_q)) * r;
    }
    s = std::clamp(s, 0.0, p.length_m);
    if (length(q - place(p, s)) < length(q - best.at)) best = {place(p, s), direction(p, s)};
  }
  return best;
}

}  // namespace feltgate::shape
