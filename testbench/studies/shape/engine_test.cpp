// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Laws of shapes and of fields of heights as words: proven, and the same bits in the interpreter,
// in the engine's twin and in its RTL. Documentation: docs/devices/shapes.md
#include "catch.hpp"
#include "law_same_bits.hpp"
#include "shape_case.hpp"
#include "studies/texture/texture_law.hpp"

using namespace feltgate;
namespace law = feltgate::law;

namespace {

std::int32_t word(double value) { return static_cast<std::int32_t>(std::lround(value)); }

}  // namespace

TEST_CASE("the law of a shape is proven, within its bound, fits, and has the same bits in RTL") {
  // An engine of three axes needs three torques.
  const std::string third = "out torque[2] = 0.1 Nm * sin(position[2])\n";
  for (const int vertices : {20, 100}) {
    const auto fish = shape::sampled(shape::curve_of("fish", 2e-3), vertices);
    const law::Compiled c =
        law::compile_text(shape::law_text(fish, {"a fish"}) + third, "fish.law", law::Target{});
    CHECK(c.bound.unproven.empty());
    CHECK(c.rate_hz >= 40e3);
    // 30 mm deep at 200 N/m are 6 N along each axis: of 1.2 Nm the bound is some per cent.
    for (const double bound : c.bound.output) CHECK(bound < 0.02);
    // In and out of the shape, all around it.
    const int felt = test::same_bits(c, 400, [&](int step) {
      const double angle = 0.013 * step, away = 0.028 + 0.012 * std::sin(0.057 * step);
      const auto a = shape::cranks({away * std::cos(angle), 0.12 + away * std::sin(angle)});
      const double count = c.target.count_rad();
      return std::array<std::int32_t, 3>{word(a[0] / count), word(a[1] / count), 3 * step};
    });
    CHECK(felt > 30);
    CHECK(felt < 350);
  }
}

TEST_CASE("a field of heights has the same bits in RTL") {
  const auto valley =
      texture::read_png(std::string(FELTGATE_ROOT) + "/vectors/textures/valley.png");
  texture::LawRequest r{"a valley", 2e-3, 8e-3};
  for (const auto normals : {texture::Normals::interpolated, texture::Normals::facets}) {
    r.normals = normals;
    // All over the field and beyond it, from above to 5 mm below black, in counts of 15 um.
    const int felt = test::same_bits(
        law::compile_text(texture::field_law(valley, r), "valley.law", law::Target{}), 400,
        [](int step) {
          return std::array<std::int32_t, 3>{word(1200 * std::sin(0.31 * step)),
                                             word(1200 * std::sin(0.17 * step + 1)),
                                             word(200 + 500 * std::sin(0.057 * step))};
        });
    // Sideways only on the walls, which are half of the field, and in it.
    CHECK(felt > 60);
    CHECK(felt < 300);
  }
}
