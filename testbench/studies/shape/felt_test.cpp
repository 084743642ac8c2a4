// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The forces from the law of a shape: closed forms, a texture, a thin tail, several shapes; and
// the exit code of commands that make a law. Documentation: docs/devices/shapes.md
#include <algorithm>
#include <cmath>

#include "apps/commands/made_law.hpp"
#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "shape_case.hpp"

using namespace feltgate;
using namespace feltgate::shape;

namespace {

constexpr int settle = 300;

/// Forces along a straight way from a to b.
std::vector<Point> pushed(const law::Law& law, Point a, Point b, double step_m) {
  Pen pen(law);
  pen.at(a, settle);
  std::vector<Point> forces;
  const int steps = static_cast<int>(std::ceil(length(b - a) / step_m));
  for (int i = 0; i <= steps; ++i) {
    forces.push_back(pen.at(a + (b - a) * (static_cast<double>(i) / steps), settle));
  }
  return forces;
}

/// A tail 4 mm thick and 30 mm long between two bodies, lying along x at y = 0.12 m.
Curve tail() {
  const Outline o{{-0.03, 0.105}, {-0.015, 0.105}, {-0.015, 0.118}, {0.015, 0.118},
                  {0.015, 0.105}, {0.03, 0.105},   {0.03, 0.135},   {0.015, 0.135},
                  {0.015, 0.122}, {-0.015, 0.122}, {-0.015, 0.135}, {-0.03, 0.135}};
  return rounded(o, 1e-3);
}

}  // namespace

TEST_CASE("the square: 2 mm behind its side at 50 N/m are 0.1 N, square to it") {
  for (const double radius_m : {0.0, 5e-3}) {
    const Curve square = curve_of("square", radius_m);
    for (const int vertices : {20, 40, 100}) {
      const law::Law law = law_of(square, vertices);
      Pen pen(law);
      // From 40 to 28 mm beside the middle in one step; the proxy is at (0.03, 0).
      CHECK(length(pen.at({0.04, 0.12}, settle)) < 1e-12);
      const Point f = pen.at({0.028, 0.12}, 2);
      INFO(vertices << " vertices, corners of " << radius_m << " m");
      CHECK(f.x == Approx(50 * 0.002).epsilon(1e-6));
      CHECK(std::fabs(f.y) < 1e-6);
    }
  }
}

TEST_CASE(
    "a rounded shape: at 2 mm depth the force changes by 6 % per 0.153 mm of travel at most") {
  // On an arc of 5 mm the pen goes around with 3 mm: its normal turns by 0.153 / 3 = 5.1 %.
  for (const int vertices : {20, 40, 100}) {
    const Curve c = curve_of("square");
    const Felt f = around(law_of(c, vertices), c, 50, 2e-3, 0.153e-3);
    INFO(vertices << " vertices: step " << f.most_step << ", error " << f.rms_error);
    CHECK(f.most_step > 0.03);
    if (vertices == 100) CHECK(f.most_step < 0.06);
    CHECK(f.jumps == 0);
    CHECK(f.rms_error < (vertices == 100 ? 0.02 : vertices == 40 ? 0.06 : 0.2));
  }
}

TEST_CASE("a texture: a sine of the way along the outline, square to it") {
  const Curve c = curve_of("square");
  const Polygon p = sampled(c, 80);
  LawRequest request;
  request.texture = true;
  const law::Law law = law::read_law_text(law_text(p, request), "shape.law", 50e3);
  Pen pen(law);
  pen.at({0.04, 0.12}, settle);
  double around_m = 0, least = 1, most = 0;
  for (std::size_t i = 0; i < p.size(); ++i) around_m += p.edge_m(i);
  for (double y = 0.105; y < 0.135; y += 0.05e-3) {
    const Point f = pen.at({0.028, y}, settle);
    // The way along the polygon to (0.03, y), on one of its edges up the right side.
    double way_m = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Point a = p.at[i], b = p.at[(i + 1) % p.size()];
      if (std::fabs(a.x - 0.03) < 1e-9 && std::fabs(b.x - 0.03) < 1e-9 && a.y <= y && y < b.y) {
        way_m += y - a.y;
        break;
      }
      way_m += p.edge_m(i);
    }
    // K (d + A sin(2 pi n s / length)), 80 ripples of 0.2 mm.
    const double wanted_n =
        50 * (2e-3 + 0.2e-3 * std::sin(2 * std::acos(-1.0) * 80 * way_m / around_m));
    INFO("at " << y);
    REQUIRE(f.x == Approx(wanted_n).margin(1e-6));
    CHECK(std::fabs(f.y) < 1e-6);
    least = std::min(least, f.x);
    most = feltgate::larger(most, f.x);
  }
  CHECK(least == Approx(50 * 1.8e-3).epsilon(1e-2));
  CHECK(most == Approx(50 * 2.2e-3).epsilon(1e-2));
}

TEST_CASE("a thin tail pushed through: the proxy holds on to the side it came from") {
  const Curve c = tail();
  const Point above{0.0, 0.124}, below{0.0, 0.1185};
  // 5.5 mm down through 4 mm: past the middle the nearest edge is the other side.
  const law::Law law = law_of(c, 100);
  const auto held = pushed(law, above, below, 0.1e-3);
  CHECK(jumps(held) == 0);
  CHECK(held.back().y == Approx(50 * (0.122 - below.y)).epsilon(1e-3));
  CHECK(std::fabs(held.back().x) < 1e-3);
  // The pen passes through and out: the law still pushes back.
  const auto through = pushed(law, above, {0.0, 0.116}, 0.1e-3);
  CHECK(through.back().y > 0.25);
}

TEST_CASE(
    "seven shapes in a law: each is felt as it was drawn, nothing while one is looked along") {
  const std::vector<const char*> names{"square",    "bell",     "banana", "fish",
                                       "horseshoe", "mushroom", "duck"};
  constexpr int vertices = 27;
  std::vector<Polygon> polygons;
  for (const char* name : names) polygons.push_back(sampled(curve_of(name, 2e-3), vertices));
  const law::Law law = law::read_law_text(law_text(polygons, LawRequest{}), "shapes.law", 50e3);
  REQUIRE(law.parameters[2].name == "shape");
  Pen pen(law);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const Curve c = curve_of(names[k], 2e-3);
    // Outside, then 2 mm inside, beside the middle of each long enough piece of the outline.
    int felt = 0;
    double worst = 0;
    for (const Piece& p : c.pieces) {
      if (p.length_m < 5e-3) continue;
      Piece half = p;
      half.length_m /= 2;
      const Point along = end_heading(half), outward{along.y, -along.x};
      // A part of less than 8 mm has another side as near.
      if (length(nearest(c, end(half) - outward * 4e-3).at - end(half)) > 1e-4) continue;
      const Point out = end(half) + outward * 1.5e-3, in = end(half) - outward * 2e-3;
      pen.set_parameter(2, 0);
      pen.at(out, settle);
      pen.set_parameter(2, static_cast<double>(k));
      pen.at(out, settle);
      const Point force = pen.at(in, settle), wanted = (nearest(c, in).at - in) * 50;
      INFO(names[k] << " at " << end(half).x << ", " << end(half).y << ": " << force.x << ", "
                    << force.y << " N instead of " << wanted.x << ", " << wanted.y);
      worst = feltgate::larger(worst, length(force - wanted));
      ++felt;
      // Another shape is set under the pen: first no force, then the force of the new shape.
      pen.set_parameter(2, k == 0 ? 5 : 0);
      CHECK(length(pen.at(in, 1)) == 0);
      CHECK(length(pen.at(in, 2 * vertices - 3)) == 0);
    }
    INFO(names[k] << ": off by up to " << worst << " N in " << felt << " places");
    CHECK(felt >= 2);
    CHECK(worst < 0.015);  // of 0.1, with 27 vertices
  }
}

TEST_CASE("outside there is no force, wherever the pen comes from") {
  for (const char* name : {"square", "fish", "bell"}) {
    const Curve c = curve_of(name, 2e-3);
    const Outline outline = sampled(c, 100).at;
    const auto inside = [&](Point p) {
      bool in = false;
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const Point a = outline[i], b = outline[(i + 1) % outline.size()];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) {
          in = !in;
        }
      }
      return in;
    };
    {
      const law::Law law = law_of(c, 100);
      Pen pen(law);
      constexpr int ways = 12, runs = 50;
      const auto at = [](double angle, double away) {
        return Point{away * std::cos(angle), 0.12 + away * std::sin(angle)};
      };
      pen.at(at(0, 0.05), settle);
      for (int way = 0; way < ways; ++way) {
        const double angle = 2 * std::acos(-1.0) * way / ways;
        INFO(name << ", from " << angle << " rad");
        for (int i = 20; i >= 0; --i) {
          pen.at(at(angle - 2 * std::acos(-1.0) * i / (20 * ways), 0.05), runs);
        }
        double away = 0.05, most_n = 0;
        for (; !inside(at(angle, away)) && away > 0; away -= 0.2e-3) {
          most_n = feltgate::larger(most_n, length(pen.at(at(angle, away), runs)));
        }
        REQUIRE(away > 0);
        CHECK(most_n < 50 * 0.1e-3);  // a polygon's edge is that near to its curve
        for (int i = 0; i < 10; ++i, away -= 0.2e-3) pen.at(at(angle, away), runs);
        const double depth_m = length(nearest(c, at(angle, away)).at - at(angle, away));
        CHECK(length(pen.at(at(angle, away), settle)) == Approx(50 * depth_m).epsilon(0.15));
        pen.at(at(angle, 0.05), settle);
      }
    }
  }
}

TEST_CASE("the seven shapes as the page has them: felt all around, without a jump") {
  for (const char* name : {"duck", "bell", "banana", "fish", "horseshoe", "mushroom", "square"}) {
    const Curve curve = curve_of(name, 2e-3);
    CHECK_FALSE(crosses_itself(sampled(curve, 40).at));
    const law::Law law = law_of(curve, 40);
    const Felt felt = around(law, curve, 50, 1e-3, 0.153e-3);
    INFO(name << ": rms error " << felt.rms_error << ", step " << felt.most_step);
    CHECK(felt.jumps == 0);
    CHECK(felt.rms_error < 0.153);  // of 1 mm: less than a count moves the pen
  }
}

TEST_CASE("a law whose proof failed ends its command with 1, a warning does not") {
  CHECK(end_of({}) == exit_ok);
  CHECK(end_of({{}, {"the bound is 2 % of its range"}}) == exit_ok);
  CHECK(end_of({{"1 Nm was measured, the bound is 0.1 Nm"}, {}}) == exit_failed);
}
