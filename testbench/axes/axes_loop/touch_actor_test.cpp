// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Meshes that move under a pen that is held, materials, and edges by both of their planes, in
// closed loop, against closed forms. docs/touch.md
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include <sys/wait.h>

#include "catch.hpp"
#include "sim/touch/make_glb.hpp"
#include "touch_meshes.hpp"

namespace feltgate::test {
namespace {

using plant::length;
using touch::Mesh;

/// Rodrigues' formula: v turned about `by_rad` by its length.
Vec3 turned(Vec3 v, Vec3 by_rad) {
  const double rad = length(by_rad), c = std::cos(rad), s = std::sin(rad);
  const Vec3 k = 1 / rad * by_rad;
  return c * v + s * plant::cross(k, v) + (1 - c) * plant::dot(k, v) * k;
}

TEST_CASE("touch: a mesh that moves, turns about any direction and grows, as a rigid body's") {
  // About its middle (5, -2, 3) mm, not about the frame's.
  Soup soup = box({0.02, 0.01, 0.03});
  const Vec3 middle{0.005, -0.002, 0.003};
  for (Vec3& v : soup.at) v = v + middle;
  const Mesh mesh = touch::clean(soup);
  SplitMix64 random(3);
  const auto some = [&](double most) {
    return Vec3{random.between(-most, most), random.between(-most, most),
                random.between(-most, most)};
  };
  for (int run = 0; run < 300; ++run) {
    // It turns at one rate about one direction, so that its speed has a closed form.
    const Vec3 at = some(0.05), speed = some(0.2), turn = some(2);
    const double rad_s = random.between(-5, 5), scale = random.between(0.2, 4),
                 grows_1_s = random.between(-1, 1);
    const touch::Actor actor(
        mesh, {{0, at, turn, scale},
               {0.1, at + 0.1 * speed, (1 + 0.1 * rad_s) * turn, scale + 0.1 * grows_1_s}});
    const double t = random.between(0, 0.099), size = scale + t * grows_1_s;
    const Vec3 p = some(0.03), arm = turned(p - middle, (1 + t * rad_s) * turn);
    const Vec3 is = actor.in_device(p, t);
    CHECK(length(is - (middle + at + t * speed + size * arm)) < 1e-12);
    CHECK(length(actor.in_mesh(is, t) - p) < 1e-12);
    const Vec3 goes = speed + grows_1_s * arm + size * rad_s * plant::cross(turn, arm);
    CHECK(length(actor.velocity_m_s(p, t) - goes) < 1e-5 + 1e-4 * length(goes));
    touch::Touched found;
    found.point_m = p, found.normal = 1 / length(p) * p, found.depth_m = 1e-3;
    const touch::Touched told = actor.in_device(found, t);
    CHECK(length(told.point_m - is) == 0);
    CHECK(length(told.normal - turned(found.normal, (1 + t * rad_s) * turn)) < 1e-12);
    CHECK(told.depth_m == Approx(1e-3 * size));
    CHECK(length(actor.velocity_m_s(p, 0.2)) == 0);
  }
}

TEST_CASE("touch: a ball that grows under the pen pushes it, and damps by the speed between both") {
  // Its top rises by 20 mm/s; the pen is held 1 mm above where it was.
  const Mesh ball = touch::clean(icosphere(0.02, 4));
  touch::TouchRequest request;
  request.proxy.shading = true;
  request.host.stiffness_n_m = 300;
  request.stroke = {{0, {0, 0, 0.021}}, {0.2, {0, 0, 0.021}}};
  request.mesh_way = {{0, {}, {}, 1}, {0.2, {}, {}, 1.2}};
  touch::TouchRun runs[2];
  for (const int n : {0, 1}) {
    request.host.damping_ns_m = n;
    runs[n] = run_on(ball, "twin,double", request);
    CHECK(runs[n].result.broken.empty());
  }
  int felt = 0;
  for (std::size_t n = 0; n < runs[0].rows.size(); ++n) {
    const touch::TouchRow &bare = runs[0].rows[n], &damped = runs[1].rows[n];
    if (bare.time_s < 0.06) continue;
    ++felt;
    const double deep_m = 0.02 * bare.time_s - 1e-3;
    // A plane is up to 3.1 ms old; the facets' planes are up to 20 um below the ball.
    CHECK(bare.force_n.z < 300 * (deep_m + 30e-6));
    CHECK(bare.force_n.z > 300 * (deep_m - 0.02 * 3.1e-3 - 60e-6));
    if (deep_m > 0.2e-3) CHECK(damped.force_n.z - bare.force_n.z == Approx(1 * 0.02).margin(3e-3));
  }
  CHECK(felt > 130);
}

TEST_CASE("touch: a plate that slides under a held pen takes it along, by friction and no more") {
  const Mesh plate = touch::clean(box({0.08, 0.08, 0.005}));
  touch::TouchRequest request;
  request.host.stiffness_n_m = 300;
  request.host.friction = 0.5;
  request.stroke = {{0, {0, 0, 0.007}}, {0.03, {0, 0, 0.003}}, {0.3, {0, 0, 0.003}}};
  // 5 Ns/m of grip: 0.05 N at 10 mm/s, and from 60 mm/s on half of 0.6 N.
  request.mesh_way = {{0, {}}, {0.1, {}}, {0.2, {1e-3, 0, 0}}, {0.3, {1e-3, 0.02, 0}}};
  const touch::TouchRun run = run_on(plate, "twin,double", request);
  CHECK(run.result.broken.empty());
  int felt = 0;
  for (const touch::TouchRow& row : run.rows) {
    if (row.time_s < 0.045) continue;
    const auto within = [&](double from, double to) {
      return row.time_s > from + 4e-3 && row.time_s < to;
    };
    Vec3 drag{};
    if (within(0.1, 0.2)) drag = {5 * 0.01, 0, 0};
    if (within(0.2, 0.3)) drag = {0, 0.5 * 0.6, 0};
    if (!within(0.045, 0.1) && length(drag) == 0) continue;
    ++felt;
    CHECK(length(row.force_n - Vec3{drag.x, drag.y, 0.6}) < 300 * 30e-6);
  }
  CHECK(felt > 230);
}

TEST_CASE("touch: the parts of a vibrating material are felt by its frequency, the others not") {
  // A plate of two halves, stone to the right; both are pressed 2 mm deep for 0.1 s.
  Soup soup = box({0.03, 0.03, 0.005});
  Soup right = box({0.03, 0.03, 0.005});
  soup.materials = {"moss", "slab"};
  soup.parts.assign(soup.triangles.size(), 0);
  const auto first = static_cast<std::uint32_t>(soup.at.size());
  for (const Vec3& v : right.at) soup.at.push_back(v + Vec3{0.061, 0, 0});
  for (const touch::Triangle& t : right.triangles) {
    soup.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    soup.parts.push_back(1);
  }
  const Mesh mesh = touch::clean(soup);
  for (const bool slab : {false, true}) {
    const double x = slab ? 0.061 : 0;
    touch::TouchRequest request;
    request.host.stiffness_n_m = 300;
    request.materials["slab"] = {300, 0, 0, 0.2, 50};
    request.stroke = {{0, {x, 0, 0.007}}, {0.03, {x, 0, 0.003}}, {0.145, {x, 0, 0.003}}};
    const touch::TouchRun run = run_on(mesh, "twin,double", request);
    CHECK(run.result.broken.empty());
    // Five periods of 20 ms, a row a millisecond.
    double sum = 0, squares = 0, sine = 0, cosine = 0;
    int rows = 0;
    for (const touch::TouchRow& row : run.rows) {
      if (row.time_s < 0.0405 || rows == 100) continue;
      ++rows;
      const double off = row.force_n.z - 0.6, angle = full_turn * 50 * row.time_s;
      sum += off, squares += off * off, sine += off * std::sin(angle),
          cosine += off * std::cos(angle);
    }
    CHECK(rows == 100);
    CHECK(sum / rows == Approx(0).margin(300 * 20e-6));
    const double amplitude_n = 2 * std::hypot(sine, cosine) / rows;
    CHECK(amplitude_n == Approx(slab ? 0.2 : 0).margin(4e-3));
    CHECK(squares / rows == Approx(amplitude_n * amplitude_n / 2).margin(2e-5));
  }
  touch::TouchRequest both;
  both.proxy.edges = true;
  both.materials["slab"] = {300, 0, 0, 0.2, 50};
  both.stroke = {{0, {0, 0, 0.007}}, {0.03, {0, 0, 0.003}}};
  CHECK_THROWS_WITH(run_on(mesh, "twin", both), Catch::Contains("no room for a vibration"));
}

/// The most that the force changes from one row to the next, 1 ms later.
double most_change_n(const touch::TouchRun& run, double from_s) {
  double most = 0;
  for (std::size_t n = 1; n < run.rows.size(); ++n) {
    if (run.rows[n - 1].time_s < from_s) continue;
    most = std::max(most, length(run.rows[n].force_n - run.rows[n - 1].force_n));
  }
  return most;
}

touch::TouchRequest edge_stroke(touch::Stroke stroke, bool edges) {
  touch::TouchRequest request;
  request.proxy.edges = edges;
  request.host.stiffness_n_m = 300;
  request.stroke = std::move(stroke);
  return request;
}

TEST_CASE(
    "touch: off a cube and into it again, one plane steps by all of the force, two by nothing") {
  // 2 mm deep over the upper face and off it at 0.1 m/s, then back in from the side, 1.5 mm deep.
  const Mesh cube = touch::clean(box({0.02, 0.02, 0.02}));
  const touch::Stroke over = {{0, {0.012, 0.003, 0.023}},
                              {0.03, {0.012, 0.003, 0.018}},
                              {0.14, {0.023, 0.003, 0.018}},
                              {0.185, {0.0185, 0.003, 0.018}},
                              {0.2, {0.0185, 0.003, 0.018}}};
  const touch::TouchRun one = run_on(cube, "twin,double", edge_stroke(over, false));
  const touch::TouchRun two = run_on(cube, "twin,double", edge_stroke(over, true));
  CHECK((one.result.broken.empty() && two.result.broken.empty()));
  INFO(one.result.figures.at("plane_step_n.max")
       << " N, " << most_change_n(one, 0.04) << " N; " << two.result.figures.at("plane_step_n.max")
       << " N, " << most_change_n(two, 0.04) << " N");
  // The pen is counted to 15 um.
  CHECK(one.result.figures.at("plane_step_n.max") == Approx(0.6).margin(5e-3));
  CHECK(most_change_n(one, 0.04) > 0.55);
  CHECK(two.result.figures.at("plane_step_n.max") < 1e-3);
  // A way of 0.1 mm and two counts of an energy whose force changes by at most K (1 + d / (1.4
  // mm)).
  CHECK(most_change_n(two, 0.04) < 300 * 0.13e-3 * (1 + 2 / 1.414));
  for (const touch::TouchRow& row : two.rows) {
    if (row.time_s > 0.04 && row.pen_m.x < 0.0169)
      CHECK(length(row.force_n - Vec3{0, 0, 0.6}) < 300 * 30e-6);
    if (row.time_s > 0.12 && row.pen_m.x > 0.02001) CHECK(length(row.force_n) < 300 * 20e-6);
  }
  // In again from the side, the side holds it, but for what the rounded edge takes: 0.0625 mm.
  const Vec3 end = two.rows.back().force_n;
  CHECK(end.x > 0.29);
  CHECK(length(end) < 0.46);
}

TEST_CASE("touch: both walls of a groove push at once, and do not wait for a plane") {
  // Two slopes of 45 degrees; the pen is led across, 2 mm below the bottom.
  const Mesh groove = touch::clean(grid(2, 2, [](double u, double v) {
    return Vec3{0.04 * (u - 0.5), 0.04 * (v - 0.5), std::abs(0.04 * (u - 0.5))};
  }));
  const touch::Stroke across = {
      {0, {-0.004, 0.003, 0.008}}, {0.04, {-0.004, 0.003, -0.002}}, {0.12, {0.004, 0.003, -0.002}}};
  double off_n[2] = {};
  for (const bool edges : {false, true}) {
    const touch::TouchRun run = run_on(groove, "twin,double", edge_stroke(across, edges));
    CHECK(run.result.broken.empty());
    for (const touch::TouchRow& row : run.rows) {
      if (row.time_s < 0.05) continue;
      // To the nearest free point: the bottom, or a slope.
      const Vec3 at = row.pen_m;
      const double aside = std::abs(at.x) <= -at.z ? 0 : (std::abs(at.x) + at.z) / 2;
      const Vec3 to{at.x < 0 ? -aside : aside, at.y, aside};
      off_n[edges] = std::max(off_n[edges], length(row.force_n - 300 * (to - at)));
    }
  }
  INFO(off_n[0] << " N with one plane, " << off_n[1] << " N with two");
  // 0.1 m/s for 1 to 3 ms with one, counts and a run of the engine with two.
  CHECK((off_n[0] > 0.03 && off_n[0] < 300 * 0.1 * 3.1e-3 * 1.1));
  CHECK(off_n[1] < 300 * 30e-6);
}

TEST_CASE("touch: over a cube's edge, RTL and twin in every clock", "[lockstep]") {
  const touch::TouchRun run = run_on(touch::clean(box({0.02, 0.02, 0.02})), "all",
                                     edge_stroke({{0, {0.016, 0.003, 0.022}},
                                                  {0.01, {0.016, 0.003, 0.018}},
                                                  {0.016, {0.0165, 0.003, 0.018}},
                                                  {0.026, {0.0202, 0.003, 0.018}}},
                                                 true));
  CHECK(run.result.lock_step);
  CHECK(run.result.mismatches == 0);
  CHECK(run.result.clocks > 1'200'000);
  CHECK(run.result.broken.empty());
  CHECK(run.result.figures.at("tau_ref_nm.0.max") > 2e-3);
  CHECK(run.result.figures.at("tau_ref_nm.2.max") > 3e-3);
}

TEST_CASE("touch: materials by name have the shares of their scenes") {
  for (const touch::MaterialPreset& preset : touch::material_presets) {
    std::ifstream file(FELTGATE_ROOT + ("/vectors/scenes/material_" + std::string(preset.name)) +
                       ".toml");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    const auto value = [&](const std::string& key) {
      const auto at = text.find("\n" + key + " = ");
      return at == std::string::npos ? 0 : std::stod(text.substr(at + key.size() + 4));
    };
    INFO(preset.name);
    CHECK(preset.hardness == value("hardness"));
    CHECK(preset.damping == Approx(value("damping") / 50));  // of 50 mNm s/rad
    CHECK(preset.friction == value("dynamic"));
    CHECK(preset.vibration == Approx(value("vibration") / 0.1));
    CHECK(preset.frequency_hz == value("frequency"));
    CHECK(touch::material_of(preset, 400).stiffness_n_m == Approx(400 * value("hardness")));
  }
}

}  // namespace
}  // namespace feltgate::test

// The command feltgate touch: what it tells, refuses and makes.

using namespace feltgate;
using namespace feltgate::test;
using touch::Mesh;

TEST_CASE("touch: the command tells of a mesh, and refuses in one line without writing") {
  const std::string ball = temporary("feltgate_touch_ball.glb"),
                    cut = temporary("feltgate_touch_cut.glb");
  const std::string json = temporary("feltgate_touch.json"), said = temporary("feltgate_touch.txt");
  const Soup sphere = icosphere(0.03, 2);
  const std::string whole = glb_of(json_of(sphere, R"({"mesh":0})"), binary_of(sphere));
  write_file(ball, whole);
  write_file(cut, whole.substr(0, 2000));
  std::string text;
  const auto run = [&](const std::string& words) {
    std::filesystem::remove(json);
    const std::string line =
        std::string(FELTGATE_BUILD_DIR) + "/feltgate_touch touch " + words + " > " + said + " 2>&1";
    const int status = std::system(line.c_str());
    std::ifstream file(said);
    text.assign(std::istreambuf_iterator<char>(file), {});
    return WEXITSTATUS(status);
  };
  CHECK(run(ball + " --mesh-only --json " + json) == 0);
  CHECK(text.find("V - E + F = 162 - 480 + 320 = 2, closed, genus 0") != std::string::npos);
  CHECK(std::filesystem::exists(json));
  CHECK(run(ball + " --mesh-only --faces 100") == 0);
  CHECK(text.find("of 320 faces: ") != std::string::npos);
  CHECK(text.find("warning") == std::string::npos);
  CHECK(run(ball + " --mesh-only --faces 40") == 0);
  CHECK(text.find("% of its size away: another shape is felt; take more") != std::string::npos);
  CHECK(run(ball + " --size 20mm --speed 1m/s --json " + json) == 0);
  CHECK(text.find("engine off the law") != std::string::npos);
  CHECK(run(ball + " --size 20mm --speed 1m/s --material none=stone") == 0);
  const std::string fine = temporary("feltgate_touch_fine.glb");
  CHECK(run("--make ball --faces 80000 -o " + fine) == 0);
  CHECK(text.find("79380 faces, 39692 vertices, 60.0 mm; CC0-1.0") != std::string::npos);
  const std::string fast = temporary("feltgate_touch_fast.csv");
  write_file(fast, "time_s,x_m,y_m,z_m\n0,0,0,0.04\n0.0005,0,0,0.04\n");
  CHECK(run(ball + " --stroke " + fast) == 2);
  CHECK(text.find(fast + ":3: the stroke ends after 0.5 ms and a plane may take 12 ms") !=
        std::string::npos);
  CHECK(run(ball + " --faces 2.5") == 2);
  CHECK(text.find("2.5 is not a whole number from 0 to 4000000") != std::string::npos);
  CHECK(run(ball + " --engine rtl") == 2);
  CHECK(text.find("--engine rtl: this program has the twin alone; ") != std::string::npos);
  for (const std::string& words :
       {cut, ball + " --faces 3", ball + " --latency 100ms --size 1mm --speed 1",
        ball + " --make ball -o x", ball + " -o x", std::string("--make cone -o x"),
        std::string("--make ball --faces 20 -o x"), said + ".none", ball + " --centre nan 0 0",
        ball + " --size 0.5m --centre 0.1 0 0", ball + " --stroke " + ball,
        ball + " --material moss=1,2,3", ball + " --material none=1,2",
        ball + " --mesh-only --csv x", ball + " --edges --drag 1.5",
        ball + " --material none=steel", ball + " --engine fast", ball + " --faces -1"}) {
    INFO(words);
    CHECK(run(words + " --json " + json) == 2);
    CHECK(std::count(text.begin(), text.end(), '\n') == 1);
    CHECK(text.find("feltgate: ") == 0);
    CHECK_FALSE(std::filesystem::exists(json));
  }
}

TEST_CASE("touch: the meshes that the command makes are closed, outwards and as large as asked") {
  const std::string path = temporary("feltgate_touch_made.glb"), again = path + "2";
  const auto report = [&](const std::string& shape, std::int64_t faces) {
    const std::string bytes = touch::glb_of(touch::made_mesh(shape, faces, 0.06), "test");
    CHECK(bytes == touch::glb_of(touch::made_mesh(shape, faces, 0.06), "test"));
    write_file(path, bytes);
    const Soup read = touch::read_glb(path);
    double far_m = 0;
    for (const Vec3& v : read.at) far_m = std::max(far_m, std::abs(v.x));
    CHECK(far_m == Approx(0.03).epsilon(0.02));
    return touch::clean(read).report;
  };
  for (const std::int64_t faces : {36, 1280, 1999, 20480}) {
    for (const std::string shape : {"ball", "torus"}) {
      INFO(shape << " " << faces);
      const auto r = report(shape, faces);
      CHECK((r.welded == 0 && r.degenerate == 0 && r.duplicates == 0 && r.turned == 0));
      REQUIRE(r.components.size() == 1);
      const touch::Component& c = r.components[0];
      CHECK((c.faces <= faces && c.faces > faces / 2));
      CHECK(c.genus() == (shape == "ball" ? 0 : 1));
      CHECK(c.volume_m3 > 0);
      // Of the sphere, and 2 pi^2 R r^2 of the torus with r = 0.4 R, R + r = 30 mm.
      const double round_m3 =
          shape == "ball" ? 113.1e-6 : 2 * 9.8696 * 0.16 * std::pow(0.03 / 1.4, 3);
      if (faces > 1000) CHECK(c.volume_m3 == Approx(round_m3).epsilon(0.05));
    }
  }
  // The ball is that of the tests: every corner of one is a corner of the other.
  const Soup made = touch::made_mesh("ball", 1280, 0.06), tested = icosphere(0.03, 3);
  CHECK(made.triangles.size() == 1280);
  const Mesh mesh = touch::clean(made);
  CHECK(touch::hausdorff_m(mesh, touch::clean(tested)) < 1e-4);
}
