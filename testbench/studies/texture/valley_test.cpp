// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A valley of a 16 x 16 field in the engine's words, under a mass behind a winding: facets throw it
// from wall to wall, interpolated normals let it rest. Documentation: docs/devices/shapes.md
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "texture_case.hpp"

using namespace feltgate;
using namespace feltgate::texture;

namespace {

constexpr double kMass_kg = 0.045, kDamping_ns_m = 0.5, kWinding_s = 0.2e-3, kPress_n = 1.0;
constexpr double kTexel_m = 2e-3, kDepth_m = 8e-3, kStiffness_n_m = 500;

/// What is left of a way across the valley: largest less smallest place across it in the last part.
double swing_m(Normals normals) {
  const Image valley = read_png(std::string(FELTGATE_ROOT) + "/vectors/textures/valley.png");
  LawRequest r;
  r.summary = "a valley";
  r.texel_m = kTexel_m;
  r.depth_m = kDepth_m;
  r.stiffness_n_per_m = kStiffness_n_m;
  r.surface_m = 0;
  r.normals = normals;
  const law::Compiled c = law::compile_text(field_law(valley, r), "valley.law", law::Target{});
  REQUIRE(c.bound.unproven.empty());
  Words words(c);
  // Four steps of the mass to a run.
  constexpr int parts = 4;
  const double dt = 1 / c.rate_hz / parts;
  // The bottom is the column 8 of 0 to 15; the pen begins 1 mm beside it, and over it.
  const double bottom_m = 0.5 * kTexel_m;
  std::array<double, 3> x{bottom_m + 1e-3, 0.4e-3, 3e-3}, v{}, felt{};
  double least = 1, most = -1;
  const int runs = static_cast<int>(1.5 * c.rate_hz);
  for (int run = 0; run < runs; ++run) {
    std::array<std::int32_t, 3> counts{};
    for (std::size_t i = 0; i < 3; ++i) {
      counts[i] = static_cast<std::int32_t>(std::floor(x[i] / capstan_m / c.target.count_rad()));
    }
    const auto torque = words.torque_nm(counts);
    for (int part = 0; part < parts; ++part) {
      for (std::size_t i = 0; i < 3; ++i) {
        felt[i] += dt / kWinding_s * (torque[i] / capstan_m - felt[i]);
        // Upright the hand damps more, so that only what goes across is looked at.
        const double b = i == 2 ? 2.0 : kDamping_ns_m;
        const double force = felt[i] - b * v[i] - (i == 2 ? kPress_n : 0.0);
        v[i] += dt * force / kMass_kg;
        x[i] += dt * v[i];
      }
    }
    if (run > runs * 2 / 3) {
      least = std::min(least, x[0]);
      most = feltgate::larger(most, x[0]);
    }
  }
  return most - least;
}

}  // namespace

TEST_CASE("a valley: a limit cycle with facets, quiet with interpolated normals") {
  // Pressed with P = 1 N, 2 mm deep, on a bottom 3.2 mm high between walls with slopes of +-0.6:
  // sideways P * 0.6, which changes sign at the bottom. Behind the winding's lag T, on the mass m
  // with damping b, such a relay F swings where the phase is -180 degrees, w^2 = b / (m T), with
  // the amplitude 4 F / pi * T m / (b (m + b T)) (describing function): 0.305 mm, 0.61 mm from end
  // to end; half a run of 10 us more lag makes it 0.64. Interpolated, the slope grows from 0 over a
  // texel: a spring of 300 N/m at most, below b / T = 2500 N/m, quiet but for a count (0.015 mm) to
  // each side.
  const double facets = swing_m(Normals::facets), shaded = swing_m(Normals::interpolated);
  if (std::getenv("FELTGATE_SHOW") != nullptr) {
    std::cout << "swing across: facets " << 1e3 * facets << " mm, interpolated " << 1e3 * shaded
              << " mm\n";
  }
  INFO("facets " << facets << " m, interpolated " << shaded << " m");
  CHECK(facets > 0.5e-3);
  CHECK(facets < 0.75e-3);
  CHECK(shaded < 0.04e-3);
}
