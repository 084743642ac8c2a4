// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A field of 16 x 16 as words: the interpreter, the engine's twin and its RTL with three axes, bit
// for bit. Documentation: docs/devices/shapes.md
#include "law_same_bits.hpp"
#include "texture_case.hpp"

using namespace feltgate;
using namespace feltgate::texture;

TEST_CASE("a field in the interpreter, the engine's twin and its RTL: the same bits") {
  const Image valley = read_png(std::string(FELTGATE_ROOT) + "/vectors/textures/valley.png");
  LawRequest r;
  r.summary = "a valley";
  r.texel_m = 2e-3;
  r.depth_m = 8e-3;
  r.surface_m = 0;
  for (const Normals normals : {Normals::interpolated, Normals::facets}) {
    r.normals = normals;
    const law::Compiled c = law::compile_text(field_law(valley, r), "valley.law", law::Target{});
    constexpr int steps = 400;
    // All over the field and beyond it, from above to 5 mm below black, in counts of 15 um.
    const int felt = test::same_bits(c, steps, [](int step) {
      return std::array<std::int32_t, 3>{
          static_cast<std::int32_t>(std::lround(1200 * std::sin(0.31 * step))),
          static_cast<std::int32_t>(std::lround(1200 * std::sin(0.17 * step + 1))),
          static_cast<std::int32_t>(std::lround(200 + 500 * std::sin(0.057 * step)))};
    });
    // Sideways only on the walls, which are half of the field, and in it.
    CHECK(felt > 60);
    CHECK(felt < steps - 100);
  }
}
