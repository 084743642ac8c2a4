// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A stylus on three slides: worlds by their nearest planes, RTL and twin, and a field of heights.
// Documentation: docs/devices/three-axes.md
#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "axes_fixture.hpp"
#include "catch.hpp"
#include "feltgate/random.hpp"
#include "studies/texture/image.hpp"
#include "studies/texture/texture_law.hpp"

using namespace feltgate;
using namespace feltgate::test;
using plant::Vec3;
using World = PlaneHostSettings::World;

namespace {

const char* const kAxes[] = {"x", "y", "z"};

Vec3 of_axes(const Rows& rows, std::size_t row, const std::string& before,
             const std::string& after) {
  double v[3];
  for (std::size_t n = 0; n < 3; ++n) v[n] = rows.of(row, before + kAxes[n] + after);
  return {v[0], v[1], v[2]};
}
Vec3 asked_n(const Rows& rows, std::size_t row) {
  return 100.0 * Vec3{rows.of(row, "tau_ref_nm.0"), rows.of(row, "tau_ref_nm.1"),
                      rows.of(row, "tau_ref_nm.2")};
}

PlaneHostSettings world_of(World world, double radius_m) {
  PlaneHostSettings w;
  w.axes = 3;
  w.world = world;
  w.centre_m = {0.01, -0.02, 0.005};
  w.radius_m = radius_m;
  w.stiffness_n_m = 300;
  return w;
}

}  // namespace

TEST_CASE("stylus: the nearest plane of sphere and cube is no farther than any of their points") {
  SplitMix64 random(1);
  constexpr double half = 0.02;
  for (const World kind : {World::kSphere, World::kCube}) {
    const PlaneHostSettings w = world_of(kind, half);
    for (int k = 0; k < 300; ++k) {
      const auto any = [&](double most) {
        return Vec3{random.between(-most, most), random.between(-most, most),
                    random.between(-most, most)};
      };
      const Vec3 pen = w.centre_m + any(2 * half);
      const Plane plane = nearest_plane(w, pen);
      CHECK(plant::length(plane.normal) == Approx(1));
      const Vec3 on = plane.point_m - w.centre_m, way = pen - plane.point_m;
      const double radius = kind == World::kSphere
                                ? plant::length(on)
                                : std::max({std::abs(on.x), std::abs(on.y), std::abs(on.z)});
      CHECK(radius == Approx(half));
      // Straight across the surface, out of it or into it.
      CHECK(std::abs(plant::dot(way, plane.normal)) == Approx(plant::length(way)).margin(1e-12));
      for (int other = 0; other < 50; ++other) {
        Vec3 at = any(half);
        if (kind == World::kSphere) {
          at = half / plant::length(at) * at;
        } else {
          double* const parts[] = {&at.x, &at.y, &at.z};
          *parts[other % 3] = other % 2 == 0 ? half : -half;
        }
        CHECK(plant::length(pen - w.centre_m - at) >= plant::length(way) - 1e-12);
      }
    }
  }
  // From inside, the centre too has a plane.
  CHECK(nearest_plane(world_of(World::kSphere, half), {0.01, -0.02, 0.005}).normal.z == 1);
}

TEST_CASE("stylus: a sphere, RTL and twin in every clock", "[lockstep]") {
  AxesScene scene = scene_named("stylus_sphere");
  scene.scenario.duration_s = 0.03;
  scene.scenario.expectations.clear();
  const AxesResult r = run_scene(scene, "all");
  CHECK(r.mismatches == 0);
  CHECK(r.clocks == 1'500'000);
  CHECK(r.broken.empty());
  CHECK(r.figures.at("planes_arrived") > 20);
  CHECK(r.figures.at("tau_ref_nm.0.max") > 1e-3);
  CHECK(r.figures.at("tau_ref_nm.1.max") > 1e-3);
}

TEST_CASE(
    "stylus: the force on a sphere is that of the plane in force; its tilt is the pose's age") {
  const Rows rows(scene_named("stylus_sphere"), 10);
  const PlaneHostSettings world = *scene_named("stylus_sphere").plane;
  int pressed = 0, bad_forces = 0, bad_tilts = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    // It moves from 20 ms on; poses of before are all the same.
    if (rows.of(i, "time_s") < 0.03) continue;
    const Vec3 pen = of_axes(rows, i, "pen_", "_m");
    const Vec3 normal = of_axes(rows, i, "plane_normal_", "");
    const Plane plane{world.centre_m + world.radius_m * normal, normal};
    const Vec3 felt = asked_n(rows, i), is = spring_force(world, plane, pen);
    // Where an update was in the last 60 us, ten words of it may be on their way.
    bool fresh = false;
    for (std::size_t j = i - 7; j <= i; ++j) fresh |= rows.of(j, "plane_step_n") > 0;
    const Vec3 before = of_axes(rows, i - 7, "plane_normal_", "");
    fresh |= plant::length(before - normal) > 0;
    ++pressed;
    // A count, 15 um, of 300 N/m along each axis, and what the pen does in 20 us.
    if (!fresh) bad_forces += plant::length(felt - is) > 300 * (1.8 * 15.4e-6 + 4e-6) ? 1 : 0;
    const double off = rows.of(i, "plane_tilt_rad") - 7.14 * rows.of(i, "plane_age_s");
    bad_tilts += std::abs(off) > 1.5e-3 ? 1 : 0;
  }
  CHECK(pressed > 4000);
  CHECK(bad_forces == 0);
  CHECK(bad_tilts == 0);
}

TEST_CASE(
    "stylus: laws, fields of heights and device have one capstan, law and host one rounding") {
  const auto text = [](const std::string& path) {
    std::ifstream file(FELTGATE_ROOT + ("/" + path));
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  CHECK(texture::capstan_m == 10e-3);
  for (const std::string law : {"local_space", "local_edge"})
    CHECK(text("rtl/laws/" + law + ".law").find("\nlet R = 0.01 m\n") != std::string::npos);
  CHECK(text("rtl/laws/local_edge.law").find("\nlet round = 1 mm ") != std::string::npos);
  CHECK(edge_round_m == 1e-3);
  CHECK(text("vectors/devices/stylus.toml").find("\nradius_m = 0.01 ") != std::string::npos);
}

TEST_CASE("stylus: a valley of a field of heights throws it with facets, not with shading") {
  const texture::Image valley =
      texture::read_png(std::string(FELTGATE_ROOT) + "/vectors/textures/valley.png");
  const auto swing_m = [&](texture::Normals normals) {
    texture::LawRequest r;
    r.summary = "a valley";
    r.texel_m = 2e-3;
    r.depth_m = 8e-3;
    r.stiffness_n_per_m = 500;
    r.normals = normals;
    const std::string path = temporary("feltgate_valley.law");
    std::ofstream(path) << texture::field_law(valley, r);
    AxesScene scene = scene_named("stylus_floor");
    scene.plane.reset();
    scene.scenario.law = path;
    scene.scenario.duration_s = 0.6;
    scene.scenario.expectations.clear();
    // The bottom is 1 mm beside the middle, 3.2 mm high. The pen falls in from beside it, pressed
    // with 1 N and with 0.5 Ns/m along each axis.
    const double start_m[] = {2e-3, 0.4e-3, 3e-3};
    auto& setup = std::get<StylusSetup>(scene.device);
    plant::LeverParameters& slide = setup.parameters.lever.lever;
    slide.viscous_nm_s_rad = 0.5 * slide.radius_m * slide.radius_m;
    for (std::size_t n = 0; n < 3; ++n) {
      setup.hand[n] = {};
      setup.hand[n].start_rad = start_m[n] / slide.radius_m;
    }
    plant::HandPhase& push = setup.hand[2].phases.emplace_back();
    push.kind = plant::HandPhase::Kind::kTorque;
    plant::Segment down;
    down.kind = plant::Segment::Kind::kMinimumJerk;
    down.duration_s = 0.1;
    down.to = -1.0 * slide.radius_m;
    push.profile = {down};
    const AxesResult r2 = run_scene(scene, "twin,double");
    CHECK(r2.broken.empty());
    CHECK(r2.figures.at("faults") == 0);
    return r2.figures.at("pen_x_m.swing");
  };
  const double facets_m = swing_m(texture::Normals::facets);
  const double shaded_m = swing_m(texture::Normals::interpolated);
  INFO(facets_m << " " << shaded_m);
  // A relay of 0.6 N that is T late, on 45 g with 0.5 Ns/m: from end to end 8 / pi * 0.6 N * T /
  // 0.5 Ns/m. T is at least a run, 20 us, and at most 0.1 ms of winding more; the
  // brushes' voltage, which helps a current to reverse, makes most of that go away.
  CHECK(facets_m > 55e-6);
  CHECK(facets_m < 370e-6);
  // To a count and the dither of one more.
  CHECK(shaded_m < 25e-6);
}

TEST_CASE("stylus: a world or a hand that cannot be is refused with its line") {
  const auto told = [](const std::string& rest) {
    return refusal(scene_head("stylus", "local_space") + rest);
  };
  const std::string rest = "rate_hz = 50\nstiffness_n_m = 100\n";
  CHECK(told("[plane]\nsphere_m = [0, 0, 0, 0.01]\n" + rest) == "read");
  CHECK(told("[plane]\ncube_m = [0, 0, 0, 0]\n" + rest).find(":9: not what a world") == 0);
  CHECK(told("[plane]\nsphere_m = [0, 0, 0, 0.01]\nedges = true\n" + rest)
            .find(":10: only a cube has edges") == 0);
  CHECK(told("[plane]\ncircle_m = [0, 0.1, 0.01]\n" + rest).find("sphere_m = [x, y, z, radius]") !=
        std::string::npos);
  CHECK(
      told("[plane]\nfloor_m = [0]\nsends = \"force\"\n" + rest).find(":10: a force is for two") ==
      0);
  CHECK(told("[hand]\nstart_m = [0, 0]\n").find("not three numbers") != std::string::npos);
  CHECK(told("[hand]\n[[hand.phase]]\nkind = \"force\"\n").find("none of \"x\", \"y\" and \"z\"") !=
        std::string::npos);
  CHECK(told("[hand]\nstart_m = [0, 0, 0.1]\n[[hand.phase]]\nkind = \"free\"\n") == "read");
}
