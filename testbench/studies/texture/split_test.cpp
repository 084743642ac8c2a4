// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The split of the depth, a sine's height and slope, firmness against the size of texels, and force
// shading against the smooth curve. Documentation: docs/devices/shapes.md
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "catch.hpp"
#include "law/read_law.hpp"
#include "studies/shape/pen_force.hpp"
#include "texture_case.hpp"

using namespace feltgate;
using namespace feltgate::texture;

namespace {

/// The force of a field's law in real numbers, under its three capstans.
std::array<double, 3> field_force(const law::Law& law, const std::array<double, 3>& pen_m) {
  law::Evaluation<double> run(law);
  std::vector<double> inputs;
  for (const law::Input& i : law.inputs) {
    inputs.push_back(i.source == law::Source::position
                         ? pen_m[static_cast<std::size_t>(i.axis)] / capstan_m
                         : 0.0);
  }
  run.run(inputs);
  std::array<double, 3> force{};
  for (std::size_t o = 0; o < law.outputs.size(); ++o) {
    force[static_cast<std::size_t>(law.outputs[o].axis)] = run.outputs()[o] / capstan_m;
  }
  return force;
}

/// A slope of -0.75, of texels of 1 mm: five steps of 0.75 mm down.
const std::vector<double> kRamp{1.0, 0.8, 0.6, 0.4, 0.2, 0.0};

LawRequest ramp_request() {
  LawRequest r;
  r.summary = "a ramp";
  r.depth_m = 3.75e-3;
  r.stiffness_n_per_m = 1000;
  return r;
}

/// The place where the ramp is 0.8 mm high, from its middle: the normal there is (0.6, 0.8).
constexpr double kAtRamp_m = ((3.75 - 0.8) / 0.75 - 2.5) * 1e-3;

}  // namespace

TEST_CASE("texture: 0.8 mm high, 0.5 mm below, normal (0.6, 0.8), 1000 N/m: (0.48, 1.14) N") {
  const LawRequest r = ramp_request();
  const law::Law law = law::read_law_text(row_law(kRamp, r), "ramp.law", 100e3);
  const shape::Point f = shape::Pen(law).at({kAtRamp_m, r.surface_m - 0.5e-3});
  CHECK(f.x == Approx(0.48).margin(1e-9));
  CHECK(f.y == Approx(1.14).margin(1e-9));
  // Within the texture alone: along the normal. Above it: nothing.
  const shape::Point within = shape::Pen(law).at({kAtRamp_m, r.surface_m + 0.3e-3});
  CHECK(within.x == Approx(0.30).margin(1e-9));
  CHECK(within.y == Approx(0.40).margin(1e-9));
  const shape::Point above = shape::Pen(law).at({kAtRamp_m, r.surface_m + 0.81e-3});
  CHECK(std::abs(above.x) + std::abs(above.y) < 1e-12);
  // In the engine's words, at the counts next to that place: within a tenth of the law's bound,
  // which is of all parameters anywhere in their ranges.
  const law::Compiled c = law::compile_text(row_law(kRamp, r), "ramp.law", law::Target{});
  Words words(c);
  const PenForce w = pen_force(words, {kAtRamp_m, r.surface_m - 0.5e-3});
  const shape::Point same = shape::Pen(law).at(w.at_m);
  CHECK(w.force_n.x == Approx(same.x).margin(0.02));
  CHECK(w.force_n.y == Approx(same.y).margin(0.02));
}

TEST_CASE("texture: the same under three axes, with facets and with interpolated normals") {
  Image ramp;
  ramp.width = 6;
  ramp.height = 4;
  for (int row = 0; row < 4; ++row) {
    ramp.share.insert(ramp.share.end(), kRamp.begin(), kRamp.end());
  }
  LawRequest r = ramp_request();
  r.surface_m = 0;
  for (const Normals normals : {Normals::interpolated, Normals::facets}) {
    r.normals = normals;
    const law::Law law = law::read_law_text(field_law(ramp, r), "ramp.law", 50e3);
    const auto f = field_force(law, {kAtRamp_m, 0.3e-3, -0.5e-3});
    CHECK(f[0] == Approx(0.48).margin(1e-9));
    CHECK(f[1] == Approx(0).margin(1e-9));
    CHECK(f[2] == Approx(1.14).margin(1e-9));
    // Beyond the field, the surface goes on level at the height of its edge.
    const auto beyond = field_force(law, {-6e-3, 0.3e-3, 3e-3});
    CHECK(beyond[0] == Approx(0).margin(1e-9));
    CHECK(beyond[2] == Approx(0.75).margin(1e-9));
  }
  // Turned by 90 degrees: the other axis.
  Image turned;
  turned.width = 4;
  turned.height = 6;
  for (const double s : kRamp) turned.share.insert(turned.share.end(), 4, s);
  const auto f = field_force(law::read_law_text(field_law(turned, r), "ramp.law", 50e3),
                             {0.3e-3, kAtRamp_m, -0.5e-3});
  CHECK(f[0] == Approx(0).margin(1e-9));
  CHECK(f[1] == Approx(0.48).margin(1e-9));
}

TEST_CASE("texture: a twisted texel, of two triangles or in between") {
  Image twisted;
  twisted.width = twisted.height = 2;
  twisted.share = {0, 1, 0.5, 0.25};
  LawRequest r = ramp_request();
  r.surface_m = 0;
  r.texel_m = 4e-3;
  r.depth_m = 1e-3;
  // At a share `height` of 1 mm, slopes of `x` and `y` mm in 4 mm, pen at black.
  const auto at = [&](Normals normals, double a, double b, double height, double x, double y) {
    r.normals = normals;
    const law::Law law = law::read_law_text(field_law(twisted, r), "twisted.law", 50e3);
    const auto f = field_force(law, {(a - 0.5) * 4e-3, (b - 0.5) * 4e-3, 0});
    const double n = height / std::sqrt(1 + (x * x + y * y) / 16);
    CHECK(f[0] == Approx(-n * x / 4).margin(1e-9));
    CHECK(f[1] == Approx(-n * y / 4).margin(1e-9));
    CHECK(f[2] == Approx(n).margin(1e-9));
  };
  at(Normals::facets, 0.25, 0.25, 0.375, 1, 0.5);
  at(Normals::facets, 0.75, 0.75, 0.5, -0.25, -0.75);
  // The four heights and half differences, a share of 9/16, 3/16, 3/16, 1/16 each.
  at(Normals::interpolated, 0.25, 0.25, (3 * 1 + 3 * 0.5 + 0.25) / 16, (3 * 1 - 0.25) / 8,
     (3 * 0.5 - 0.75) / 8);
}

TEST_CASE("texture: a sine of 0.5 mm and 2 mm, at 0.25 mm: 0.35355 mm high, slope 1.11072") {
  for (const int per_period : {16, 60}) {
    const std::vector<double> row = sine(per_period, 3 * per_period + 1);
    LawRequest r;
    r.summary = "a sine";
    r.depth_m = 1e-3;
    r.texel_m = 2e-3 / per_period;
    r.stiffness_n_per_m = 1000;
    const law::Law law = law::read_law_text(row_law(row, r), "sine.law", 100e3);
    shape::Pen pen(law);
    // A period behind the first pixel, and 0.25 mm.
    const double x = 2.25e-3 - 3e-3;
    // The height is where a force begins, over the mean height of 0.5 mm.
    double low = 0, high = 1.2e-3;
    while (high - low > 1e-9) {
      const double middle = (low + high) / 2;
      (shape::length(pen.at({x, r.surface_m + middle})) > 1e-9 ? low : high) = middle;
    }
    // Lines between pixels: exact at a pixel, else at most h'' texel^2 / 8 below the sine.
    CHECK(low - 0.5e-3 == Approx(0.35355e-3).margin(per_period == 16 ? 1e-7 : 5e-7));
    // Of the texture's part alone, the force points along the normal.
    const shape::Point f = pen.at({x, r.surface_m});
    const double step = 2 * pi / per_period;
    CHECK(-f.x / f.y == Approx(1.11072 * std::sin(step) / step).epsilon(3e-3));
    if (per_period == 60) CHECK(-f.x / f.y == Approx(1.11072).epsilon(5e-3));
  }
}

TEST_CASE("texture: as firm with texels of 10 mm to 0.1 mm by the split, and not without") {
  const std::vector<double> row = sine(8, 113);
  double before = 2;
  for (const double texel_mm : {10.0, 3.0, 1.0, 0.3, 0.1}) {
    LawRequest r;
    r.summary = "a sine";
    r.texel_m = 1e-3 * texel_mm;
    r.depth_m = r.texel_m;
    const law::Compiled c = law::compile_text(row_law(row, r), "sine.law", law::Target{});
    const Firmness f = firmness(c, row, r);
    if (std::getenv("FELTGATE_SHOW") != nullptr) {
      std::cout << texel_mm << " mm: split " << f.split << ", plane " << f.plane << "\n";
    }
    INFO(texel_mm << " mm: split " << f.split << ", plane " << f.plane);
    CHECK(f.split == Approx(1).margin(0.05));
    CHECK(f.plane < before);
    before = f.plane;
    if (texel_mm == 10.0) CHECK(f.plane > 0.7);
    if (texel_mm == 0.1) CHECK(f.plane < 0.1);
  }
}

TEST_CASE("texture: interpolated normals are nearer to the smooth curve than facets") {
  // Of a sine's slope, facets miss w t / sqrt(12) of it (constant over a texel t): 11.3 % with 16
  // texels a period. Interpolated ones miss 1 - sin(w t) / (w t) and what a line misses of the
  // curve, (w t)^2 / 6 + (w t)^2 / 12, 3.9 %; heights between pixels are low by (w t)^2 / 8 at
  // most, 1.9 %.
  const std::vector<double> row = sine(16, 113);
  LawRequest r;
  r.summary = "a sine";
  r.depth_m = 1e-3;
  std::array<double, 2> off{};
  for (const Normals normals : {Normals::interpolated, Normals::facets}) {
    r.normals = normals;
    const law::Law law = law::read_law_text(row_law(row, r), "sine.law", 100e3);
    shape::Pen pen(law);
    double squares = 0, all = 0;
    for (int i = 0; i < 160; ++i) {
      const double x = -8e-3 + 0.1e-3 * (i + 0.5), w = 2 * pi / 16e-3;
      // 56 texels, three periods and a half, lie left of the middle.
      const double angle = w * x + 7 * pi, h = 0.5e-3 + 0.5e-3 * std::sin(angle);
      const double slope = 0.5e-3 * w * std::cos(angle), n = 1 / std::sqrt(1 + slope * slope);
      const shape::Point smooth{-500 * h * slope * n, 500 * (h * n + 1e-3)};
      const shape::Point f = pen.at({x, r.surface_m - 1e-3});
      squares += (f.x - smooth.x) * (f.x - smooth.x);
      all += smooth.x * smooth.x;
    }
    off[normals == Normals::facets ? 1 : 0] = std::sqrt(squares / all);
  }
  if (std::getenv("FELTGATE_SHOW") != nullptr) {
    std::cout << "sideways force off by " << off[0] << ", facets " << off[1] << "\n";
  }
  INFO("interpolated " << off[0] << ", facets " << off[1]);
  CHECK(off[0] < 0.058);
  CHECK(off[1] > 0.09);
  CHECK(off[1] < 0.15);
}
