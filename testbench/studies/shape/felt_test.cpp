// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The forces of the law of a shape against the drawn curve: in it, outside, through a thin tail,
// and of several shapes in a law. Documentation: docs/devices/shapes.md
#include "catch.hpp"
#include "shape_case.hpp"

using namespace feltgate;
using namespace feltgate::shape;

namespace {

constexpr int settle = 300;

/// How far the force is from a spring of 50 N/m to the nearest place of the curve, once around.
struct Felt {
  double rms = 0;   ///< of the error, in forces at that depth
  double step = 0;  ///< largest change for 0.153 mm of travel; 30 degrees are 0.5
};

Felt around(Pen& pen, const Curve& curve, double depth_m) {
  Felt felt;
  Point before{};
  int count = 0;
  for (const Piece& p : curve.pieces) {
    // An arc around a convex corner is shorter at depth.
    const double inner_m = p.length_m * (1 - depth_m * p.curvature_per_m);
    const int steps = std::max(1, static_cast<int>(std::ceil(inner_m / 0.153e-3)));
    for (int i = 0; i < steps; ++i) {
      const double s = p.length_m * i / steps;
      const Point along = direction(p, s), inward{-along.y, along.x};
      // From outside to inside at first, as a hand comes.
      for (double out = 2e-3; count == 0 && out > -depth_m; out -= 0.1e-3) {
        pen.at(place(p, s) - inward * out, settle);
      }
      const Point at = place(p, s) + inward * depth_m, force = pen.at(at, settle);
      const double off = length(force - (nearest(curve, at).at - at) * 50) / (50 * depth_m);
      felt.rms += off * off;
      if (count++ > 0) felt.step = std::max(felt.step, length(force - before) / (50 * depth_m));
      before = force;
    }
  }
  felt.rms = std::sqrt(felt.rms / count);
  return felt;
}

}  // namespace

TEST_CASE("the square: 2 mm behind its side at 50 N/m are 0.1 N, square to it") {
  for (const double radius_m : {0.0, 5e-3}) {
    for (const int vertices : {20, 40, 100}) {
      Pen pen(law_of(curve_of("square", radius_m), vertices));
      // From 40 to 28 mm beside the middle in one step; the proxy is at (0.03, 0).
      CHECK(length(pen.at({0.04, 0.12}, settle)) < 1e-12);
      const Point f = pen.at({0.028, 0.12}, 2);
      CHECK(f.x == Approx(50 * 0.002).epsilon(1e-6));
      CHECK(std::fabs(f.y) < 1e-6);
    }
  }
}

TEST_CASE("a shape is felt all around, without a jump; with 100 vertices a step changes by 6 %") {
  // On an arc of 5 mm the pen goes around with 3 mm: its normal turns by 0.153 / 3 = 5.1 %.
  const Curve square = curve_of("square");
  for (const auto& [vertices, most] : {std::pair{20, 0.2}, {40, 0.06}, {100, 0.02}}) {
    Pen pen(law_of(square, vertices));
    const Felt felt = around(pen, square, 2e-3);
    INFO(vertices << " vertices: step " << felt.step << ", error " << felt.rms);
    CHECK(felt.step > 0.03);
    CHECK(felt.step < (vertices == 100 ? 0.06 : 0.5));
    CHECK(felt.rms < most);
  }
  for (const char* name : {"duck", "bell", "banana", "fish", "horseshoe", "mushroom", "square"}) {
    const Curve curve = curve_of(name, 2e-3);
    Pen pen(law_of(curve, 40));
    const Felt felt = around(pen, curve, 1e-3);
    INFO(name << ": rms error " << felt.rms << ", step " << felt.step);
    CHECK(felt.step < 0.5);
    CHECK(felt.rms < 0.153);  // of 1 mm: less than a count moves the pen
  }
}

TEST_CASE("a thin tail pushed through: the proxy holds on to the side it came from") {
  const Curve tail =
      rounded({{-0.015, 0.118}, {0.015, 0.118}, {0.015, 0.122}, {-0.015, 0.122}}, 1e-3);
  Pen pen(law_of(tail, 100));
  // 4 mm thick: past the middle the nearest edge is the other side, below 0.118 the pen is out
  // there, and still it is pushed back.
  for (double y = 0.124; y > 0.116; y -= 0.1e-3) {
    const Point force = pen.at({0, y}, settle);
    CHECK(force.y == Approx(50 * std::max(0.0, 0.122 - y)).margin(1e-4));
    CHECK(std::fabs(force.x) < 1e-3);
  }
}

TEST_CASE("outside there is no force, wherever the pen comes from") {
  for (const char* name : {"square", "fish", "bell"}) {
    const Curve c = curve_of(name, 2e-3);
    Pen pen(law_of(c, 100));
    for (int way = 0; way < 12; ++way) {
      const double angle = pi / 6 * way;
      const auto at = [&](double away) {
        return Point{away * std::cos(angle), 0.12 + away * std::sin(angle)};
      };
      pen.at(at(0.05), settle);
      double inside_m = -1;
      for (double away = 0.05; inside_m < 2e-3; away -= 0.2e-3) {
        const Nearest n = nearest(c, at(away));
        inside_m = cross(n.along, at(away) - n.at);
        INFO(name << ", from " << angle << " rad, inside by " << inside_m << " m");
        // A polygon's edge is within 0.1 mm of its curve.
        CHECK(length(pen.at(at(away), 50)) ==
              Approx(50 * std::max(0.0, inside_m)).margin(50 * 0.1e-3).epsilon(0.1));
      }
    }
  }
}

TEST_CASE("seven shapes in a law: each is felt as drawn, nothing while one is looked along") {
  const char* const names[] = {"square", "bell", "banana", "fish", "horseshoe", "mushroom", "duck"};
  Pen pen(law::read_law(std::string(FELTGATE_ROOT) + "/rtl/laws/hidden_shapes.law", 50e3));
  for (int k = 0; k < 7; ++k) {
    const Curve c = curve_of(names[k], 2e-3);
    // 2 mm inside, beside the middle of each long enough piece of the outline.
    int felt = 0;
    for (const Piece& p : c.pieces) {
      const double s = p.length_m / 2;
      const Point inward{-direction(p, s).y, direction(p, s).x}, on = place(p, s);
      // A part of less than 8 mm has another side as near.
      if (p.length_m < 5e-3 || length(nearest(c, on + inward * 4e-3).at - on) > 1e-4) continue;
      const Point in = on + inward * 2e-3;
      pen.set_parameter(2, k);
      pen.at(on - inward * 1.5e-3, settle);
      INFO(names[k] << " at " << on.x << ", " << on.y);
      CHECK(length(pen.at(in, settle) - (nearest(c, in).at - in) * 50) < 0.015);  // of 0.1
      ++felt;
      // Another shape is set under the pen: first no force, then the force of the new shape.
      pen.set_parameter(2, k == 0 ? 5 : 0);
      CHECK(length(pen.at(in, 1)) == 0);
      CHECK(length(pen.at(in, 2 * 27 - 3)) == 0);
      pen.at(on - inward * 1.5e-3, settle);
    }
    CHECK(felt >= 2);
  }
}
