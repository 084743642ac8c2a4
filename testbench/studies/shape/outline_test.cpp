// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// From SVG to vertices: reading, placing, rounding, and what is refused.
// Documentation: docs/devices/shapes.md
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "catch.hpp"
#include "shape_case.hpp"

using namespace feltgate::shape;
using Catch::Contains;

namespace {

constexpr double kPi = 3.14159265358979323846;

Outline read_text(const std::string& text) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                     fmt::format("feltgate-{}-outline_test.svg", ::getpid());
  std::ofstream(path) << text;
  struct Gone {
    const std::filesystem::path& path;
    ~Gone() { std::filesystem::remove(path); }
  } gone{path};
  return read_svg(path.string());
}

std::string drawing(const std::string& inside) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\">\n" + inside + "\n</svg>\n";
}

std::string message(const std::string& text) {
  try {
    (void)rounded(placed(read_text(text), {}), 5e-3);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "read";
}

}  // namespace

TEST_CASE("an outline is scaled, placed and counter-clockwise, whichever way it is drawn") {
  for (const char* d : {"M0 0 H60 V60 H0 Z", "M0 0 V60 H60 V0 Z", "M0 0 h60 v60 h-60 v-60 z"}) {
    const Outline o = placed(read_text(drawing(std::string("<path d='") + d + "'/>")), {});
    REQUIRE(o.size() == 4);
    CHECK(doubled_area(o) == Approx(2 * 0.06 * 0.06));
    for (const Point& p : o) {
      CHECK(std::fabs(p.x) == Approx(0.03));
      CHECK(std::fabs(p.y - 0.12) == Approx(0.03));
    }
  }
}

TEST_CASE("SVG's y points down, transforms of groups and paths multiply") {
  const Outline o = read_text(drawing(
      "<g transform='translate(10 20)'><path transform='scale(2)' d='M1 2 L3 2 L3 5 Z'/></g>"));
  REQUIRE(o.size() == 3);
  CHECK(o[1].x == Approx(16));
  CHECK(o[1].y == Approx(-24));
  CHECK(o[2].y == Approx(-30));
}

TEST_CASE("curves and basic shapes: a circle has its area") {
  const Outline o = read_text(drawing("<circle cx='5' cy='5' r='4'/>"));
  CHECK(std::fabs(doubled_area(o) / 2) == Approx(kPi * 16).epsilon(2e-3));
  const Outline arc = read_text(drawing("<path d='M1 5 A4 4 0 0 1 9 5 A4 4 0 0 1 1 5 Z'/>"));
  CHECK(std::fabs(doubled_area(arc) / 2) == Approx(kPi * 16).epsilon(2e-3));
}

TEST_CASE("edges without length are dropped") {
  const Outline o =
      placed(read_text(drawing("<path d='M0 0 L0 0 L60 0 L60 0 L60 60 L0 60 L0 0 Z'/>")), {});
  CHECK(o.size() == 4);
}

TEST_CASE("round corners: the square's way around and area in closed form") {
  const double r = 5e-3, a = 0.06;
  const Curve c = curve_of("square", r);
  CHECK(c.length_m == Approx(4 * (a - 2 * r) + 2 * kPi * r));
  double turned = 0;
  for (const Piece& p : c.pieces) turned += p.length_m * p.curvature_per_m;
  CHECK(turned == Approx(2 * kPi));
  for (std::size_t i = 0; i < c.pieces.size(); ++i) {
    const Piece& next = c.pieces[(i + 1) % c.pieces.size()];
    CHECK(length(end(c.pieces[i]) - next.from) < 1e-12);
    CHECK(length(end_heading(c.pieces[i]) -
                 Point{std::cos(next.heading_rad), std::sin(next.heading_rad)}) < 1e-12);
  }
  const Polygon p = sampled(c, 100);
  CHECK(doubled_area(p.at) / 2 == Approx(a * a - (4 - kPi) * r * r).epsilon(1e-4));
}

TEST_CASE("half of the vertices lie where the outline bends") {
  const Curve c = curve_of("square");
  const Polygon p = sampled(c, 100);
  int bent = 0;
  for (const Point& t : p.along) bent += std::min(std::fabs(t.x), std::fabs(t.y)) > 1e-6 ? 1 : 0;
  // The arcs have half of the weight by their turning, and their share of the length.
  const double share = 0.5 + 0.5 * 2 * kPi * 5e-3 / c.length_m;
  CHECK(bent == Approx(100 * share).margin(4));
}

TEST_CASE("the nearest place of the curve is square to the pen") {
  const Curve c = curve_of("fish", 2e-3);
  for (int i = 0; i < 200; ++i) {
    const Point q{0.04 * std::cos(0.1 * i) * (0.2 + 0.004 * i), 0.12 + 0.03 * std::sin(0.17 * i)};
    const Nearest n = nearest(c, q);
    CHECK(std::fabs(dot(q - n.at, n.along)) < 1e-9);
  }
}

TEST_CASE("what is refused, with the mend") {
  CHECK_THAT(message(drawing("<text>no outline</text>")), Contains("outline_test.svg:1: no path;"));
  CHECK_THAT(message(drawing("<path d='M0 0 L60 60 L60 0 L0 60 Z'/>")),
             Contains("crosses or touches itself; unite"));
  CHECK_THAT(message(drawing("<path d='M0 0 L60 0 L60 60'/>")), Contains("open; close it"));
  CHECK_THAT(message(drawing("<path d='M0 0 L60 0 L60 60 Z M1 1 L2 1 L2 2 Z'/>")),
             Contains("2 outlines; unite"));
  CHECK_THAT(message("<svg xmlns=\"http://www.w3.org/2000/svg\">\n<path d='M0 0 L60 0"),
             Contains("outline_test.svg:2: no whole XML"));
  // A prefix without a namespace; a byte that cannot be printed.
  CHECK_THAT(message("<svg xmlns=\"http://www.w3.org/2000/svg\" a:b=\"1\"/>"),
             Contains("outline_test.svg:1: no whole XML"));
  CHECK_THAT(message(drawing("<path d='M0 0 L60 \x01 Z'/>")), Contains("\"M0 0 L60 ? Z\""));
  CHECK_THAT(message(""), Contains("no element"));
  CHECK_THAT(message(drawing("<path d='M0 0 L60 nothing Z'/>")), Contains("save the drawing"));
  CHECK_THAT(message(drawing("<path d='M0 0 L1 0 L2 0 Z'/>")), Contains("no area"));
  CHECK_THAT(message(drawing("<path d='M0 0 L60 0 L60 60 L59 60 L58 59 L0 60 Z'/>")),
             Contains("too short for a radius of 5.00 mm"));
  std::string many = "<path d='M0 0";
  for (int i = 1; i < 10000; ++i) many += " L" + std::to_string(i) + " " + std::to_string(i % 7);
  CHECK_THAT(message(drawing(many + " Z'/>")), Contains("more than 2000 corners"));

  // The line is that of the element that is to blame.
  const std::string head = "<svg xmlns=\"http://www.w3.org/2000/svg\">\n<g><text>x</text>\n";
  const std::string whole = "<path d='M0 0 L60 0 L60 60 Z'/>\n";
  CHECK_THAT(message(head + "<path d='M0 0 L60 0 L60 60'/>\n</g></svg>"),
             Contains("outline_test.svg:3: the path is open"));
  CHECK_THAT(message(head + whole + "<rect width='3' height='3'/>\n</g>\n" + whole + "</svg>"),
             Contains("outline_test.svg:4: 3 outlines"));
  CHECK_THAT(message(head + whole + "</g>\n<path d='M0 0 L60 nothing Z'/></svg>"),
             Contains("outline_test.svg:5: "));
  CHECK_THAT(message(head + "</g>\n" + many + " Z'/></svg>"),
             Contains("outline_test.svg:4: a path of more than 2000 corners"));
  const std::string foreign =
      "<x:path xmlns:x='y' d='M0 0'/><!--\n<g> --><defs><path d='M0'/></defs>\r\n";
  CHECK_THAT(message(head + foreign + "<path d='M0 0 L60 0 L60 60'/>\n</g></svg>"),
             Contains("outline_test.svg:5: the path is open"));
  CHECK_THAT(message("<svg><path d='M0 0 L60 0 L60 60 Z'/></svg>"), Contains("xmlns"));
  std::string deep, half = "<path d='M0 0";
  for (int i = 0; i < 30000; ++i) deep += "<g>";
  CHECK_THAT(message(drawing(deep)), Contains("ungroup"));
  for (int i = 1; i < 1200; ++i) half += " L" + std::to_string(i) + " " + std::to_string(i % 7);
  CHECK_THAT(message(drawing(half + " Z'/>" + half + " Z'/>")), Contains("2 outlines"));
  Placing far;
  far.centre_m = {0.0, 0.18};
  CHECK_THROWS_WITH(curve_of("square", 5e-3, far), Contains("out of the pen's reach"));
}
