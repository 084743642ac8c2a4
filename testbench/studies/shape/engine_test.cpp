// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Shapes as words: the law compiled and proven, the interpreter, the engine's twin and its RTL bit
// for bit. Documentation: docs/devices/shapes.md
#include <cmath>

#include "catch.hpp"
#include "law_same_bits.hpp"
#include "shape_case.hpp"

using namespace feltgate;
using namespace feltgate::test;
namespace law = feltgate::law;

namespace {

law::Compiled compiled(const shape::Curve& curve, int vertices) {
  return law::compile_text(shape::text_of(curve, vertices), "shape.law", law::Target{});
}

constexpr int steps = 400;

/// Counts of the cranks for a pen path that goes in and out of the shape, all around it.
std::array<std::int32_t, 2> counts(const law::Target& target, int step) {
  const double angle = 0.013 * step, away = 0.028 + 0.012 * std::sin(0.057 * step);
  const auto a = shape::cranks({away * std::cos(angle), 0.12 + away * std::sin(angle)});
  return {static_cast<std::int32_t>(std::lround(a[0] / target.count_rad())),
          static_cast<std::int32_t>(std::lround(a[1] / target.count_rad()))};
}

/// Interpreter, twin and RTL of the engine along that way.
void same_bits(const law::Compiled& c) {
  const int felt = test::same_bits(c, steps, [&](int step) {
    const auto n = counts(c.target, step);
    return std::array<std::int32_t, 3>{n[0], n[1], 3 * step};
  });
  CHECK(felt > 30);
  CHECK(felt < steps - 50);
}

}  // namespace

TEST_CASE("the law of a shape is proven, within its bound, and fits the memories") {
  const shape::Curve fish = shape::curve_of("fish", 2e-3);
  for (const int vertices : {20, 100}) {
    const law::Compiled c = compiled(fish, vertices);
    INFO(vertices << " vertices, " << c.assembled.instructions.size() << " instructions");
    CHECK(c.bound.unproven.empty());
    CHECK(c.rate_hz >= 40e3);
    // 30 mm deep at 200 N/m are 6 N along each axis: of 1.2 Nm the bound is some per cent.
    for (const double bound : c.bound.output) CHECK(bound < 0.02);
    for (std::size_t i = 0; i < c.law.states.size(); ++i) {
      const law::State& s = c.law.states[i];
      if (!s.whole) CHECK(c.program.states[i].scale <= (s.range.upper - s.range.lower) / 4000);
    }
  }
}

TEST_CASE("a texture is proven too, beside 80 vertices") {
  shape::LawRequest request;
  request.texture = true;
  const law::Compiled c = law::compile_text(
      shape::law_text(shape::sampled(shape::curve_of("fish", 2e-3), shape::most_measured_vertices),
                      request),
      "shape.law", law::Target{});
  CHECK(c.bound.unproven.empty());
  for (const double bound : c.bound.output) CHECK(bound < 0.03);
}

TEST_CASE("shapes in the interpreter, the engine's twin and its RTL: the same bits") {
  // An engine of three axes needs three torques.
  const std::string third = "out torque[2] = 0.1 Nm * sin(position[2])\n";
  const shape::Curve fish = shape::curve_of("fish", 2e-3);
  same_bits(law::compile_text(shape::text_of(fish, 100) + third, "shape.law", law::Target{}));
  shape::LawRequest rough;
  rough.texture = true;
  same_bits(law::compile_text(shape::law_text(shape::sampled(fish, 80), rough) + third, "shape.law",
                              law::Target{}));
  std::vector<shape::Polygon> two;
  for (const char* name : {"horseshoe", "fish"}) {
    two.push_back(shape::sampled(shape::curve_of(name, 2e-3), 40));
  }
  std::string text = shape::law_text(two, shape::LawRequest{}) + third;
  const std::string first = "param shape = 0 in";
  text.replace(text.find(first), first.size(), "param shape = 1 in");
  same_bits(law::compile_text(text, "shape.law", law::Target{}));
}
