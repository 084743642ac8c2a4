// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Laws of heights against the force by its definition: in random places of a random image, and the
// shipped row. In the device: stylus_test.cpp. Documentation: docs/devices/shapes.md
#include "catch.hpp"
#include "feltgate/random.hpp"
#include "shape_case.hpp"
#include "studies/texture/texture_law.hpp"

using namespace feltgate;
using namespace feltgate::texture;

namespace {

using Vec = std::array<double, 3>;

/// The force of a law in real numbers, under its three capstans.
Vec felt(const law::Law& law, const Vec& pen_m) {
  law::Evaluation<double> run(law);
  const auto angle = [&](std::size_t axis) { return pen_m[axis] / capstan_m; };
  Vec force = shape::torques_nm(law, run, {angle(0), angle(1), angle(2)});
  for (double& n : force) n /= capstan_m;
  return force;
}

/// The force by definition. Beyond the field its edges go on.
Vec defined(const Image& f, const LawRequest& r, const Vec& pen_m) {
  const double u = pen_m[0] / r.texel_m + 0.5 * (f.width - 1);
  const double v = pen_m[1] / r.texel_m + 0.5 * (f.height - 1);
  const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
  const double a = u - i, b = v - j;
  const auto height = [&](int x, int y) {
    return r.depth_m * f.at(std::clamp(x, 0, f.width - 1), std::clamp(y, 0, f.height - 1));
  };
  // Of four pixels, by a line along x and one along y; or of the triangle that the place is in.
  const auto between = [&](const auto& of) {
    return (1 - b) * ((1 - a) * of(i, j) + a * of(i + 1, j)) +
           b * ((1 - a) * of(i, j + 1) + a * of(i + 1, j + 1));
  };
  double top = between(height);
  double x = between([&](int p, int q) { return 0.5 * (height(p + 1, q) - height(p - 1, q)); });
  double y = between([&](int p, int q) { return 0.5 * (height(p, q + 1) - height(p, q - 1)); });
  if (r.normals == Normals::facets) {
    const int p = a + b < 1 ? i : i + 1, q = a + b < 1 ? j : j + 1;  // the corner between its sides
    x = height(i + 1, q) - height(i, q);
    y = height(p, j + 1) - height(p, j);
    top = height(p, q) + (u - p) * x + (v - q) * y;
  }
  x /= r.texel_m;
  y /= r.texel_m;
  const double deep = std::max(0.0, top - pen_m[2]), within = std::min(deep, top);
  const double along = r.stiffness_n_per_m * within / std::sqrt(1 + x * x + y * y);
  return {-along * x, -along * y, along + r.stiffness_n_per_m * (deep - within)};
}

}  // namespace

TEST_CASE("a field of heights: along the normal in the texture, upright below it, level beyond") {
  SplitMix64 random(1);
  Image image{5, 4, {}};
  for (int k = 0; k < 20; ++k) image.share.push_back(random.between(0, 1));
  LawRequest r;
  for (const Normals normals : {Normals::interpolated, Normals::facets}) {
    r.normals = normals;
    const law::Law law = law::read_law_text(field_law(image, r), "field.law", 50e3);
    int pressed = 0;
    for (int k = 0; k < 1000; ++k) {
      const Vec pen_m{random.between(-4e-3, 4e-3), random.between(-4e-3, 4e-3),
                      random.between(-2e-3, 2e-3)};
      const Vec is = felt(law, pen_m), wanted = defined(image, r, pen_m);
      INFO("at " << pen_m[0] << ", " << pen_m[1] << ", " << pen_m[2]);
      for (std::size_t n = 0; n < 3; ++n) REQUIRE(is[n] == Approx(wanted[n]).margin(1e-9));
      pressed += is[2] > 0 ? 1 : 0;
    }
    CHECK(pressed > 500);
  }
}

TEST_CASE("the shipped row of an image: a sine of 4 mm and 16 mm under the pantograph's pen") {
  Image row{113, 1, {}};
  for (int k = 0; k < 113; ++k) row.share.push_back(0.5 + 0.5 * std::sin(shape::pi * k / 8));
  LawRequest r;
  r.depth_m = 4e-3;
  const std::string file = std::string(FELTGATE_ROOT) + "/rtl/laws/texture.law";
  shape::Pen pen(law::read_law(file, 100e3));
  for (double x = -0.05; x < 0.05; x += 0.37e-3) {
    const double below_m = 0.5e-3 + 0.04 * x;  // from above black to below it
    const shape::Point f = pen.at({x, 0.08 - below_m});
    const Vec wanted = defined(row, r, {x, 0, -below_m});
    // The image has 256 levels, 8 um.
    CHECK(f.x == Approx(wanted[0]).margin(0.02));
    CHECK(f.y == Approx(wanted[2]).margin(0.01));
  }
}
