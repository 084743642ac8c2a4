// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// From SVG to vertices: reading, placing and rounding against closed forms. What is refused:
// command_test.py. Documentation: docs/devices/shapes.md
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "catch.hpp"
#include "shape_case.hpp"

using namespace feltgate::shape;

namespace {

Outline drawing(const std::string& inside) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("feltgate-outline_test-" + std::to_string(::getpid()) + ".svg");
  std::ofstream(path) << "<svg xmlns='http://www.w3.org/2000/svg'>" << inside << "</svg>";
  const Outline outline = read_svg(path.string());
  std::filesystem::remove(path);
  return outline;
}

}  // namespace

TEST_CASE("an outline is scaled, placed and counter-clockwise, whichever way it is drawn") {
  for (const char* d : {"M0 0 H60 V60 H0 Z", "M0 0 V60 H60 V0 Z", "M0 0 h60 v60 h-60 v-60 z",
                        "M0 0 L0 0 L60 0 L60 0 L60 60 L30 60 L0 60 L0 0 Z"}) {
    const Outline o = placed(drawing(std::string("<path d='") + d + "'/>"), {});
    REQUIRE(o.size() == 4);
    CHECK(area(o) == Approx(0.06 * 0.06));
    for (const Point& p : o) {
      CHECK(std::fabs(p.x) == Approx(0.03));
      CHECK(std::fabs(p.y - 0.12) == Approx(0.03));
    }
  }
}

TEST_CASE("SVG's y points down, transforms of groups and paths multiply, a circle has its area") {
  const Outline o = drawing(
      "<g transform='translate(10 20)'><path transform='scale(2)' d='M1 2 L3 2 L3 5 Z'/></g>");
  REQUIRE(o.size() == 3);
  CHECK(o[1].x == Approx(16));
  CHECK(o[1].y == Approx(-24));
  CHECK(o[2].y == Approx(-30));
  for (const char* circle :
       {"<circle cx='5' cy='5' r='4'/>", "<path d='M1 5 A4 4 0 0 1 9 5 A4 4 0 0 1 1 5 Z'/>"}) {
    CHECK(std::fabs(area(drawing(circle))) == Approx(pi * 16).epsilon(2e-3));
  }
}

TEST_CASE("round corners: the square's way around and area; half of the vertices where it bends") {
  const double r = 5e-3, a = 0.06;
  const Curve c = curve_of("square", r);
  CHECK(c.length_m == Approx(4 * (a - 2 * r) + 2 * pi * r));
  for (std::size_t i = 0; i < c.pieces.size(); ++i) {
    const Piece &p = c.pieces[i], &next = c.pieces[(i + 1) % c.pieces.size()];
    CHECK(length(place(p, p.length_m) - next.from) < 1e-12);
    CHECK(length(direction(p, p.length_m) - direction(next, 0)) < 1e-12);
  }
  const Polygon p = sampled(c, 100);
  CHECK(area(p.at) == Approx(a * a - (4 - pi) * r * r).epsilon(1e-4));
  const auto bends = [](Point t) { return std::min(std::fabs(t.x), std::fabs(t.y)) > 1e-6; };
  // The arcs have half of the weight by their turning, and their share of the length.
  CHECK(std::count_if(p.along.begin(), p.along.end(), bends) ==
        Approx(100 * (0.5 + 0.5 * 2 * pi * r / c.length_m)).margin(4));
}
