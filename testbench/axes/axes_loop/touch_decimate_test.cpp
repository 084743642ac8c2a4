// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Fewer faces of a mesh: what they keep, how far they are off, and the step of the force at an
// edge; each against closed forms. docs/touch.md
#include <algorithm>
#include <cmath>
#include <vector>

#include "touch_meshes.hpp"

namespace feltgate::test {
namespace {

using plant::length;
using touch::clean;
using touch::Mesh;

constexpr double degree = 3.14159265358979323846 / 180;

/// Two planes that fall to both sides of the line x = 0, z = 0; their normals differ by `turn_rad`.
Soup roof(double turn_rad) {
  const double fall = std::tan(turn_rad / 2);
  return grid(2, 1, [=](double u, double v) {
    const double x = 0.08 * (u - 0.5);
    return Vec3{x, 0.08 * (v - 0.5), -fall * std::abs(x)};
  });
}

TEST_CASE("touch: fewer faces of a torus are a torus, near by as the closed form says") {
  constexpr double ring_m = 0.03, tube_m = 0.01;
  const Mesh all = clean(torus(ring_m, tube_m, 60));
  CHECK(all.triangles.size() == 14400);
  const Mesh few = clean(touch::decimate(all, 1500));
  CHECK(few.triangles.size() <= 1500);
  CHECK(few.triangles.size() > 1300);
  REQUIRE(few.report.components.size() == 1);
  CHECK(few.report.components[0].genus() == 1);
  CHECK(few.report.border_edges == 0);
  // The distance from the smooth torus needs no mesh.
  const auto off_m = [&](const Mesh& mesh) {
    double most = 0;
    for (const auto& t : mesh.triangles) {
      const Vec3 at = (1.0 / 3) * (mesh.at[t[0]] + mesh.at[t[1]] + mesh.at[t[2]]);
      most = std::max(most, std::abs(std::hypot(std::hypot(at.x, at.y) - ring_m, at.z) - tube_m));
    }
    return most;
  };
  const double apart_m = touch::hausdorff_m(few, all);
  CHECK(apart_m > off_m(few) - off_m(all));
  CHECK(apart_m < 2 * off_m(few));
  CHECK(apart_m < 0.5e-3);
  // Around the tube a face turns by 6 degrees; of a tenth of the faces by three times that.
  CHECK(touch::jumps_of(all).largest_rad == Approx(full_turn / 60).epsilon(0.01));
  CHECK(touch::jumps_of(few).most_rad > 2 * full_turn / 60);
  CHECK(touch::jumps_of(few).most_rad < 6 * full_turn / 60);
}

TEST_CASE("touch: the distance of two meshes is that of a corner that moved, from both sides") {
  const Mesh flat = clean(sheet(0.06, 10));
  Soup dented = sheet(0.06, 10);
  dented.at[60].z -= 1.25e-3;  // its middle
  const Mesh dent = clean(dented);
  CHECK(std::abs(touch::hausdorff_m(flat, dent) - 1.25e-3) < 1e-9);
  CHECK(std::abs(touch::hausdorff_m(dent, flat) - 1.25e-3) < 1e-9);
  CHECK(touch::hausdorff_m(flat, flat) < 1e-15);
  // A part that one of them lacks counts too.
  CHECK(touch::hausdorff_m(clean(sheet(0.04, 4)), flat) > 0.013);
}

TEST_CASE("touch: a dent of few edges is told as the largest turn, not as that of most") {
  Soup dented = sheet(0.06, 40);
  dented.at[41 * 20 + 20].z -= 1e-3;
  const touch::Jumps jumps = touch::jumps_of(clean(dented));
  CHECK(jumps.largest_rad > 0.5);
  CHECK(jumps.most_rad < 1e-9);
}

TEST_CASE("touch: a flat sheet of two materials needs few faces, and no gap opens between them") {
  Soup two = sheet(0.06, 16);
  two.materials = {"left", "right"};
  two.parts.clear();
  for (const auto& t : two.triangles) {
    const double x = two.at[t[0]].x + two.at[t[1]].x + two.at[t[2]].x;
    two.parts.push_back(x < 0 ? 0 : 1);
  }
  const Mesh all = clean(two);
  const Mesh few = clean(touch::decimate(all, 200));
  CHECK(few.triangles.size() < all.triangles.size() / 2);
  CHECK(few.report.components.size() == 1);
  CHECK(few.report.components[0].border_loops == 1);
  CHECK(touch::hausdorff_m(few, all) < 1e-8);
  for (std::size_t n = 0; n < few.triangles.size(); ++n) {
    const auto& t = few.triangles[n];
    const double x = few.at[t[0]].x + few.at[t[1]].x + few.at[t[2]].x;
    CHECK((x < 0) == (few.parts[n] == 0));
  }
}

TEST_CASE("touch: over an edge the force steps by K d 2 sin(phi / 2)") {
  for (const double turn_rad : {5 * degree, 15 * degree, 30 * degree}) {
    const Mesh mesh = clean(roof(turn_rad));
    CHECK(std::abs(touch::jumps_of(mesh).largest_rad - turn_rad) < 1e-9);
    CHECK(std::abs(touch::jumps_of(mesh).most_rad - turn_rad) < 1e-9);
    touch::Proxy proxy(mesh, {});
    constexpr double depth_m = 2e-3;
    const auto pen = [&](double x) {
      return Vec3{x, 1e-3,
                  -std::tan(turn_rad / 2) * std::abs(x) - depth_m / std::cos(turn_rad / 2)};
    };
    proxy.begin(pen(-0.02) + Vec3{0, 0, 0.01});
    double step = 0, deep_m = 0;
    Vec3 before{};
    for (int n = 0; n <= 4000; ++n) {
      const touch::Touched t = proxy.move(pen(-0.02 + 1e-5 * n));
      REQUIRE(t.touching);
      const Vec3 force = t.depth_m * t.normal;  // of a spring of 1 N/m
      const double jumped = n > 0 ? plant::length(force - before) : 0;
      if (jumped > step) deep_m = std::max(t.depth_m, plant::length(before));
      step = std::max(step, jumped);
      before = force;
    }
    INFO(turn_rad / degree << " degrees: " << step << " N, at a depth of " << deep_m << " m");
    CHECK(std::abs(step / (deep_m * 2 * std::sin(turn_rad / 2)) - 1) < 0.05);
  }
}

}  // namespace
}  // namespace feltgate::test
