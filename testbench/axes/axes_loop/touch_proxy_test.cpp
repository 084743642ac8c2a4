// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The proxy on meshes: queries against a look at all triangles, strokes at thin sheets, closed
// forms of cube, friction and ball.
// Documentation: docs/touch.md
#include <algorithm>
#include <cmath>
#include <limits>

#include "catch.hpp"
#include "feltgate/random.hpp"
#include "touch_meshes.hpp"

using namespace feltgate;
using namespace feltgate::test;
using plant::dot;
using plant::length;
using touch::Mesh;
using touch::Near;
using touch::Proxy;
using touch::ProxySettings;
using touch::Touched;

namespace {

Vec3 any(SplitMix64& random, double most) {
  return {random.between(-most, most), random.between(-most, most), random.between(-most, most)};
}
Vec3 direction(SplitMix64& random) {
  while (true) {
    const Vec3 v = any(random, 1);
    if (length(v) > 0.1 && length(v) < 1) return 1 / length(v) * v;
  }
}

/// The nearest point of a segment and of a triangle by search, not by cases: thirds of intervals.
double to_segment_m(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 ab = b - a;
  const double share = std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0);
  return length(p - a - share * ab);
}
double to_triangle_m(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  // Over the middle where all three sides have it inwards, else at a side.
  const Vec3 n = plant::cross(b - a, c - a);
  const bool over = dot(plant::cross(b - a, p - a), n) >= 0 &&
                    dot(plant::cross(c - b, p - b), n) >= 0 &&
                    dot(plant::cross(a - c, p - c), n) >= 0;
  if (over) return std::abs(dot(p - a, n)) / length(n);
  return std::min({to_segment_m(p, a, b), to_segment_m(p, b, c), to_segment_m(p, c, a)});
}
double to_mesh_m(const Mesh& m, Vec3 p) {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& t : m.triangles)
    best = std::min(best, to_triangle_m(p, m.at[t[0]], m.at[t[1]], m.at[t[2]]));
  return best;
}

}  // namespace

TEST_CASE("touch: the arctangent that every machine has alike") {
  CHECK(touch::arctangent(0.0, 0.0) == 0);
  CHECK(std::abs(touch::arctangent(0.0, -1.0) - std::atan2(0.0, -1.0)) < 4e-15);
  double worst = 0;
  for (int n = 0; n < 20000; ++n) {
    const double y = std::sin(0.7 * n), x = std::cos(1.3 * n);
    worst = std::max(worst, std::abs(touch::arctangent(y, x) - std::atan2(y, x)));
    CHECK(!std::isnan(touch::arctangent(y, x)));
  }
  CHECK(worst < 4e-15);
}

TEST_CASE("touch: the tree finds what a look at all triangles finds") {
  SplitMix64 random(11);
  for (const Soup& soup : {icosphere(0.03, 2), torus(0.02, 0.008, 12), open_plate(0.04, 1e-4, 5)}) {
    const Mesh mesh = touch::clean(soup);
    const touch::TriangleTree tree(mesh);
    for (int n = 0; n < 300; ++n) {
      const Vec3 p = any(random, 0.05);
      const Near near = tree.nearest(p);
      CHECK(near.distance_m == Approx(to_mesh_m(mesh, p)).margin(1e-12));
      CHECK(length(p - near.point_m) == Approx(near.distance_m).margin(1e-15));
      const double wide_m = random.between(0, 0.02);
      std::vector<Near> found;
      tree.within(p, wide_m, found);
      std::size_t all = 0;
      for (const auto& t : mesh.triangles)
        all += to_triangle_m(p, mesh.at[t[0]], mesh.at[t[1]], mesh.at[t[2]]) <= wide_m ? 1 : 0;
      CHECK(found.size() == all);
      // On the free way the ball touches nothing; at its end it does, or has arrived.
      const double radius_m = 1e-4;
      if (near.distance_m < 1.1 * radius_m) continue;
      const Vec3 way = any(random, 0.05);
      const double share = tree.free_way(p, way, radius_m);
      for (int k = 0; k <= 20; ++k)
        CHECK(to_mesh_m(mesh, p + k / 20.0 * share * way) > 0.998 * radius_m);
      if (share < 1) CHECK(to_mesh_m(mesh, p + share * way) < 1.002 * radius_m);
      // Straight to the nearest place, not all the way: it stops where it touches.
      const Vec3 at_it = (1 - 0.5 * radius_m / near.distance_m) * (near.point_m - p);
      const double straight = tree.free_way(p, at_it, radius_m);
      CHECK(straight * length(at_it) == Approx(near.distance_m - radius_m).margin(2e-3 * radius_m));
    }
  }
}

TEST_CASE("touch: 10 000 strokes at a plate of 0.1 mm, and at a sheet of none, never cross it") {
  SplitMix64 random(3);
  constexpr double side_m = 0.04;
  for (const double thick_m : {1e-4, 0.0}) {
    const Mesh mesh = touch::clean(thick_m > 0 ? open_plate(side_m, thick_m, 6) : sheet(side_m, 6));
    Proxy proxy(mesh, {});
    int crossed = 0, pressed = 0;
    double nearest_m = 1;
    for (int stroke = 0; stroke < 5000; ++stroke) {
      // From one side, somewhere over the plate, to the other and on, in steps of up to 10 mm; back
      // and forth. The middle of the ball must stay on its side while it is over the plate.
      const double side = stroke % 2 == 0 ? 1 : -1;
      const double in = 0.45 * side_m;
      Vec3 pen{random.between(-in, in), random.between(-in, in), side * random.between(1e-3, 0.02)};
      proxy.begin(pen);
      for (int step = 0; step < 12; ++step) {
        Vec3 to = pen + random.between(1e-6, 0.01) * direction(random);
        if (step % 3 == 0) to.z = -side * random.between(0, 0.02);
        to.x = std::clamp(to.x, -in, in);
        to.y = std::clamp(to.y, -in, in);
        pen = to;
        const Touched t = proxy.move(pen);
        crossed += proxy.at().z * side < 0.5 * thick_m ? 1 : 0;
        pressed += t.touching ? 1 : 0;
        nearest_m = std::min(nearest_m, std::abs(proxy.at().z) - 0.5 * thick_m);
      }
    }
    CHECK(crossed == 0);
    CHECK(pressed > 20000);
    CHECK(nearest_m > 9.9e-6);
  }
}

TEST_CASE("touch: a closed mesh is never entered, an edge of a sheet never cut") {
  SplitMix64 random(5);
  for (const Soup& soup :
       {icosphere(0.02, 2), torus(0.02, 0.008, 12), box({0.02, 0.01, 0.005}), sheet(0.03, 3)}) {
    const Mesh mesh = touch::clean(soup);
    for (const double friction : {0.0, 0.5}) {
      ProxySettings settings;
      settings.friction = friction;
      Proxy proxy(mesh, settings);
      Vec3 pen = 0.05 * direction(random);
      proxy.begin(pen);
      int inside = 0, near = 0;
      for (int n = 0; n < 1500; ++n) {
        pen = n % 50 == 0 ? any(random, 0.03) : pen + any(random, 2e-3);
        if (length(pen) > 0.05) pen = any(random, 0.03);
        proxy.move(pen);
        inside += std::abs(touch::winding(mesh, proxy.at())) > 0.5 && mesh.report.border_edges == 0
                      ? 1
                      : 0;
        near += to_mesh_m(mesh, proxy.at()) < 9.9e-6 ? 1 : 0;
      }
      CHECK(inside == 0);
      CHECK(near == 0);
    }
  }
  // Exactly in the plane of a sheet, towards its edge: it stops there.
  const Mesh plate = touch::clean(sheet(0.02, 1));
  Proxy proxy(plate, {});
  proxy.begin({0.02, 0.001, 0});
  const Touched t = proxy.move({0.005, 0.001, 0});
  CHECK(t.touching);
  CHECK(length(t.normal - Vec3{1, 0, 0}) < 1e-9);
  CHECK(t.depth_m == Approx(0.005));
}

TEST_CASE("touch: on a cube the proxy is where faces, edges and corners say") {
  constexpr double half = 0.02;
  const Mesh cube = touch::clean(box({half, half, half}));
  SplitMix64 random(9);
  // Inside of the walls: each coordinate by itself, up to three of them held.
  // (begin() refuses the inside, so the way in is through none: the walls are a cube without a
  // lid.)
  Soup open = box({half, half, half});
  open.triangles.erase(open.triangles.begin() + 2, open.triangles.begin() + 4);
  const Mesh room = touch::clean(open);
  Proxy in_room(room, {});
  in_room.begin({0, 0, 0.05});
  in_room.move({0, 0, 0});
  int corners = 0;
  for (int n = 0; n < 4000; ++n) {
    Vec3 pen = any(random, 0.03);
    pen.z = std::min(pen.z, 0.015);
    const Touched t = in_room.move(pen);
    const Vec3 should{std::clamp(pen.x, -half, half), std::clamp(pen.y, -half, half),
                      std::max(pen.z, -half)};
    // An axis that no wall holds may be a radius off one.
    CHECK(length(t.proxy_m - should) < 15e-6);
    if (!t.touching) continue;
    CHECK(t.depth_m == Approx(length(should - pen)).margin(15e-6));
    if (t.constraints == 3) {
      ++corners;
      CHECK(length(t.proxy_m - should) < 1e-9);
    }
  }
  CHECK(corners > 50);
  // Outside: down onto the upper face, over the edge. Until the pen leaves the cube sideways, the
  // face holds it straight above; beyond, it is free.
  Proxy proxy(cube, {});
  proxy.begin({0, 0.003, 0.03});
  for (double x = 0; x < 0.0205; x += 1e-4) {
    const Touched t = proxy.move({x, 0.003, 0.018});
    INFO(x);
    if (x < half - 1e-9) {
      CHECK(t.touching);
      CHECK(t.constraints == 1);
      CHECK(length(t.proxy_m - Vec3{x, 0.003, half}) < 1e-9);
      CHECK(length(t.normal - Vec3{0, 0, 1}) < 1e-9);
      CHECK(t.depth_m == Approx(0.002).margin(1e-9));
    } else if (x > half + 15e-6) {
      CHECK_FALSE(t.touching);
      CHECK(length(t.proxy_m - Vec3{x, 0.003, 0.018}) < 1e-9);
      CHECK(length(t.normal - Vec3{1, 0, 0}) < 1e-9);
      CHECK(t.point_m.x == Approx(half));
    }
  }
  // Over a corner, from outside: the nearest point of the cube, and the way to it.
  proxy.begin({0.03, 0.03, 0.03});
  const Touched corner = proxy.move({0.021, 0.022, 0.023});
  CHECK_FALSE(corner.touching);
  CHECK(length(corner.point_m - Vec3{half, half, half}) < 1e-12);
  CHECK(angle_rad(corner.normal, {1, 2, 3}) < 1e-9);
  CHECK_THROWS_WITH(proxy.begin({0.001, 0, 0}), Catch::Contains("inside"));
  CHECK_THROWS_WITH(proxy.begin({0, 0, half}), Catch::Contains("on the mesh"));
}

TEST_CASE("touch: in a groove of 60 degrees the proxy is nearest to the pen, not stuck to a wall") {
  // Above z = sqrt(3) |x| all is free: of a convex room the proxy is the nearest point.
  const double steep = std::sqrt(3.0);
  const Mesh groove = touch::clean(grid(2, 4, [&](double u, double v) {
    const double x = 0.06 * (u - 0.5);
    return Vec3{x, 0.2 * (v - 0.5), steep * std::abs(x)};
  }));
  Proxy proxy(groove, {});
  proxy.begin({0, 0, 0.03});
  SplitMix64 random(17);
  int at_bottom = 0, at_wall = 0;
  for (int n = 0; n < 4000; ++n) {
    const Vec3 pen{random.between(-0.02, 0.02), random.between(-0.02, 0.02),
                   random.between(-0.02, 0.03)};
    const Touched t = proxy.move(pen);
    // Along the wall on the pen's side, (1, sqrt(3)) / 2; below 0 the bottom is nearest.
    const double along_m = std::max(0.0, 0.5 * (std::abs(pen.x) + steep * pen.z));
    const bool free = pen.z >= steep * std::abs(pen.x);
    const double side = pen.x < 0 ? -0.5 : 0.5;
    const Vec3 should = free ? pen : Vec3{side * along_m, pen.y, 0.5 * steep * along_m};
    at_bottom += !free && along_m == 0 ? 1 : 0;
    at_wall += !free && along_m > 0 ? 1 : 0;
    // The ball's middle is up to two radii off the bottom.
    CHECK(length(t.proxy_m - should) < 21e-6);
  }
  CHECK((at_bottom > 500 && at_wall > 500));
}

TEST_CASE("touch: the friction cone holds the proxy, and lets it follow at its edge") {
  const Mesh floor = touch::clean(sheet(0.1, 8));
  ProxySettings settings;
  settings.friction = 0.4;
  Proxy proxy(floor, settings);
  proxy.begin({0, 0, 0.01});
  constexpr double depth = 0.002;
  proxy.move({0, 0, -depth});
  for (int n = 0; n < 100; ++n) {
    const double x = 1e-4 * n;
    const Touched t = proxy.move({x, 0, -depth});
    // 0.4 of the depth, and of the ball's radius.
    const double behind = std::min(x, 0.4 * (depth + 10e-6));
    CHECK(t.proxy_m.x == Approx(x - behind).margin(1e-9));
    CHECK(angle_rad(t.normal, {0, 0, 1}) ==
          Approx(std::atan(behind / (depth + 10e-6))).margin(1e-6));
  }
  // Back: it stays until the pen is at the other edge of the cone.
  const double stands = 0.0099 - 0.4 * (depth + 10e-6);
  CHECK(proxy.move({stands, 0, -depth}).proxy_m.x == Approx(stands).margin(1e-9));
  CHECK(proxy.move({stands - 5e-4, 0, -depth}).proxy_m.x == Approx(stands).margin(1e-9));
}

TEST_CASE("touch: on a ball of 1280 faces the normals are within a facet's angle of the sphere's") {
  constexpr double radius = 0.03;
  const Mesh ball = touch::clean(icosphere(radius, 3));
  // Of a facet: from its normal to the ways to its corners.
  double facet_rad = 0, edge_m = 0;
  for (const auto& t : ball.triangles) {
    const Vec3 a = ball.at[t[0]], b = ball.at[t[1]], c = ball.at[t[2]];
    for (const Vec3 v : {a, b, c})
      facet_rad = std::max(facet_rad, angle_rad(plant::cross(b - a, c - a), v));
    edge_m = std::max(edge_m, length(a - b));
  }
  CHECK(facet_rad < 0.1);
  double off_rad[2] = {};
  for (const bool shading : {false, true}) {
    SplitMix64 random(13);
    ProxySettings settings;
    settings.shading = shading;
    Proxy proxy(ball, settings);
    Vec3 at = direction(random);
    proxy.begin(0.04 * at);
    int touching = 0;
    double turns = 0;
    Vec3 before = at;
    for (int n = 0; n < 3000; ++n) {
      // 1 mm below the sphere, 0.2 mm further in each step.
      at = at + (2e-4 / radius) * plant::cross(Vec3{0.3, -0.5, 0.8}, at) + 1e-4 * direction(random);
      at = 1 / length(at) * at;
      const Touched t = proxy.move((radius - 1e-3) * at);
      touching += t.touching ? 1 : 0;
      off_rad[shading] = std::max(off_rad[shading], angle_rad(t.normal, t.proxy_m));
      if (n > 0) turns = std::max(turns, angle_rad(t.normal, before));
      before = t.normal;
      CHECK(t.depth_m > 1e-3 - radius * (1 - std::cos(facet_rad)) - 1e-6);
      CHECK(t.depth_m < 1e-3 + 1e-6);
    }
    CHECK(touching == 3000);
    // From facet to facet in one step, or a little at a time.
    if (shading)
      CHECK(turns < 0.03);
    else
      CHECK(turns > 0.08);
  }
  INFO(facet_rad << " " << off_rad[0] << " " << off_rad[1]);
  CHECK(off_rad[0] <= facet_rad + 1e-6);
  CHECK(off_rad[0] > 0.5 * facet_rad);
  CHECK(off_rad[1] < 0.2 * facet_rad);
}

TEST_CASE("touch: a hand that presses and gives way is as deep as its force says, in closed loop") {
  constexpr double press_n = 0.5, stiffness = 300, capstan_m = 0.01;
  for (const bool is_ball : {false, true}) {
    const Mesh mesh = touch::clean(is_ball ? icosphere(0.03, 3) : sheet(0.06, 4));
    touch::TouchRequest request;
    request.proxy.shading = true;
    request.host.stiffness_n_m = stiffness;
    request.host.damping_ns_m = 0.5;
    request.press_n = press_n;
    const double top_m = is_ball ? 0.03 : 0;
    request.stroke = {{0, {-0.01, 0.001, top_m + 3e-3}},
                      {0.02, {-0.01, 0.001, top_m + 3e-3}},
                      {0.04, {-0.01, 0.001, top_m}},
                      {0.2, {-0.01, 0.001, top_m}},
                      {0.35, {-0.0025, 0.001, top_m}}};
    const touch::TouchRun run = run_on(mesh, "twin,double", request);
    CHECK(run.result.broken.empty());
    CHECK(run.result.figures.at("faults") == 0);
    double least_n = 10, most_n = 0;
    for (const touch::TouchRow& row : run.rows) {
      if (row.time_s < 0.25) continue;
      least_n = std::min(least_n, row.force_n.z);
      most_n = std::max(most_n, row.force_n.z);
    }
    INFO(is_ball << " " << least_n << " " << most_n);
    // The slide's own friction, 0.26 N at most and of either sign, and what the mass takes over a
    // bend: 45 g (0.05 m/s)^2 / 30 mm, and at facets some of it at once.
    constexpr double dry_n = 2.6e-3 / capstan_m;
    CHECK(least_n > press_n - dry_n - 0.05);
    CHECK(most_n < press_n + dry_n + 0.05);
    if (!is_ball)
      CHECK(run.updates.back().touched.depth_m ==
            Approx(run.rows.back().force_n.z / stiffness).margin(30e-6));
  }
}

TEST_CASE("touch: a flat wall in floats has no seams either") {
  // Its triangles differ by 1e-7 in direction, and a corner has six of them.
  touch::Soup soup = sheet(0.06, 24);
  const Vec3 u{0.8, 0.36, 0.48}, v{-0.6, 0.48, 0.64}, up{0, -0.8, 0.6};
  const auto turned = [&](Vec3 at) { return at.x * u + at.y * v + at.z * up; };
  const auto in_floats = [](Vec3 at) {
    return Vec3{static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)};
  };
  for (Vec3& at : soup.at) at = in_floats(turned(at));
  const Mesh mesh = touch::clean(soup);
  SplitMix64 random(3);
  double farthest_m = 0;
  for (int stroke = 0; stroke < 40; ++stroke) {
    Proxy proxy(mesh, ProxySettings{});
    Vec3 at = any(random, 0.025), to = any(random, 0.025);
    at.z = 1e-3;
    proxy.begin(turned(at));
    for (int step = 0; step <= 100; ++step) {
      Vec3 pen = at + 0.01 * step * (to - at);
      pen.z = step < 5 ? 1e-3 * (1 - step) : -2e-3;
      const Touched t = proxy.move(turned(pen));
      if (step < 5) continue;
      REQUIRE(t.touching);
      pen.z = 10e-6;
      farthest_m = std::max(farthest_m, length(proxy.at() - turned(pen)));
    }
  }
  INFO(farthest_m << " m from the point over the pen");
  CHECK(farthest_m < 1e-6);
}
