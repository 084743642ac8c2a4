// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Meshes of GLB files: import, what is refused, edges, components and genus.
// Documentation: docs/touch.md
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "catch.hpp"
#include "feltgate/random.hpp"
#include "touch_meshes.hpp"

using namespace feltgate;
using namespace feltgate::test;
using plant::length;

namespace {

std::string temporary(const std::string& name) {
  return (std::filesystem::temp_directory_path() / name).string();
}

/// What is said of a file, without its name.
std::string told(const std::string& bytes) {
  const std::string path = temporary("feltgate_touch_told.glb");
  write_file(path, bytes);
  try {
    (void)touch::read_glb(path);
  } catch (const std::invalid_argument& error) {
    const std::string what = error.what();
    CHECK(what.find('\n') == std::string::npos);
    CHECK(what.find(path + ": ") == 0);
    return what.substr(path.size() + 2);
  }
  return "read";
}
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("touch: a GLB file comes into the device's frame by its nodes' transforms") {
  const std::string path = temporary("feltgate_touch.glb");
  const Soup cube = box({0.01, 0.02, 0.03});
  write_glb(path, cube);
  const Soup plain = touch::read_glb(path);
  REQUIRE(plain.at.size() == 24);
  for (std::size_t n = 0; n < 24; ++n) CHECK(length(plain.at[n] - cube.at[n]) < 1e-9);
  CHECK(plain.triangles == cube.triangles);
  // glTF's z looks at the one who sees it, so it is the device's -y. A parent that moves by 1 along
  // it and turns by 90 degrees about glTF's y, the device's z; a child that doubles x.
  const std::string nodes =
      R"({"children":[1],"translation":[0,0,1],"rotation":[0,0.70710678,0,0.70710678]},)"
      R"({"mesh":0,"scale":[-2,1,1]})";
  write_file(path, glb_of(json_of(cube, nodes), binary_of(cube)));
  const Soup turned = touch::read_glb(path);
  for (std::size_t n = 0; n < 24; ++n) {
    const Vec3 v = cube.at[n];
    CHECK(length(turned.at[n] - Vec3{-v.y, -2 * v.x - 1, v.z}) < 1e-7);
  }
  // A mirror keeps the faces' outer side out.
  CHECK(touch::clean(turned).report.components.at(0).volume_m3 == Approx(2 * 8 * 6e-6));
  Soup placed = turned;
  touch::Placing placing;
  placing.centre_m = {0.01, 0.02, 0.03};
  CHECK(touch::place(placed, placing) == Approx(1));
  placing.size_m = 0.03;
  CHECK(touch::place(placed, placing) == Approx(0.5));
  CHECK(placed.at[7].z - 0.03 == Approx(0.5 * cube.at[7].z));
  placing.size_m = 0.6;
  CHECK_THROWS_WITH(touch::place(placed, placing), Catch::Contains("--size"));
}

TEST_CASE("touch: a file that is broken, empty, huge or not alone is refused in one line") {
  const Soup cube = box({0.01, 0.01, 0.01});
  const std::string json = json_of(cube, R"({"mesh":0})"), binary = binary_of(cube);
  const std::string whole = glb_of(json, binary);
  CHECK(told(whole) == "read");
  CHECK(told("").find("too short") == 0);
  CHECK(told("solid cube, a file of another kind").find("no GLB file") == 0);
  CHECK(told(whole.substr(0, whole.size() - 100)).find("cut off") == 0);
  // Whatever is cut off or changed is refused or read, and never a crash: run with a sanitizer,
  // this looks at every access.
  for (std::size_t length = 0; length < whole.size(); length += 7)
    CHECK(told(whole.substr(0, length)) != "read");
  SplitMix64 random(7);
  for (int n = 0; n < 400; ++n) {
    std::string bad = whole;
    for (int k = 0; k < 3; ++k) {
      bad[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(bad.size())))] =
          static_cast<char>(random.below(256));
    }
    CHECK_FALSE(told(bad).empty());
  }
  const auto with = [&](const std::string& from, const std::string& to) {
    return told(glb_of(replaced(json, from, to), binary));
  };
  CHECK(told(glb_of(R"({"asset":{"version":"2.0"}})", "")).find("no triangles") == 0);
  CHECK(told(glb_of(json_of(cube, R"({"mesh":0})", R"("uri":"other.bin",)"), "")) ==
        "needs the file other.bin beside it; export as one .glb");
  CHECK(with(R"("count":24)", R"("count":25)").find("an accessor that reaches beyond") == 0);
  CHECK(with(R"("count":24)", R"("count":4000000000000000000)") != "read");
  CHECK(with(R"("nodes":[{"mesh":0})", R"("nodes":[{"mesh":0,"children":[0]})")
            .find("node 0 is below two") == 0);
  CHECK(with(R"({"mesh":0})", R"({"mesh":7})") != "read");
  CHECK(with(R"({"mesh":0})", R"({"mesh":0,"scale":[1e400,1,1]})") != "read");
  CHECK(with("5126", "5122").find("positions that are no floats") == 0);
  std::string nan = binary, far = binary;
  const float none = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(&nan[24], &none, 4);
  CHECK(told(glb_of(json, nan)) == "vertex 2 of a primitive is not finite");
  const std::uint32_t index = 24;
  std::memcpy(&far[12 * 24], &index, 4);
  CHECK(told(glb_of(json, far)) == "index 24 of 24 vertices");
}

TEST_CASE("touch: edges, components and genus of a mesh are told, and its sides turned to one") {
  const auto of = [](const Soup& s) { return touch::clean(s).report; };
  const auto ball = of(icosphere(0.03, 3));
  CHECK(ball.triangles_read == 1280);
  CHECK(ball.vertices_read == 642);
  REQUIRE(ball.components.size() == 1);
  CHECK(ball.components[0].genus() == 0);
  CHECK(ball.components[0].volume_m3 == Approx(4.0 / 3 * 3.14159 * 27e-6).epsilon(0.02));
  const auto cube = of(box({0.01, 0.01, 0.01}));
  CHECK(cube.welded == 16);
  CHECK((cube.border_edges == 0 && cube.inverted_edges == 0 && cube.nonmanifold_edges == 0));
  CHECK(cube.components.at(0).edges == 18);
  CHECK(cube.components[0].genus() == 0);
  const auto ring = of(torus(0.02, 0.008, 16));
  REQUIRE(ring.components.size() == 1);
  CHECK(ring.components[0].euler() == 0);
  CHECK(ring.components[0].genus() == 1);
  const auto plate = of(open_plate(0.04, 1e-4, 4));
  REQUIRE(plate.components.size() == 2);
  CHECK(plate.border_edges == 32);
  CHECK(plate.components[0].border_loops == 1);
  CHECK(plate.components[0].genus() == 0);
  // One face turned: its three edges are, and it is turned back.
  Soup inverted = icosphere(0.03, 1);
  std::swap(inverted.triangles[5][0], inverted.triangles[5][1]);
  CHECK(of(inverted).inverted_edges == 3);
  CHECK(of(inverted).turned == 1);
  CHECK(of(inverted).components[0].genus() == 0);
  // Three faces at an edge; a face twice; one without an area; a strip with a twist.
  Soup fin = box({0.01, 0.01, 0.01});
  fin.at.push_back({0.02, 0.02, 0.02});
  fin.triangles.push_back({fin.triangles[0][0], fin.triangles[0][1], 24});
  CHECK(of(fin).nonmanifold_edges == 1);
  CHECK_FALSE(of(fin).components[0].genus().has_value());
  fin = box({0.01, 0.01, 0.01});
  fin.triangles.push_back({fin.triangles[3][1], fin.triangles[3][0], fin.triangles[3][2]});
  fin.triangles.push_back({0, 0, 1});
  CHECK(of(fin).duplicates == 1);
  CHECK(of(fin).degenerate == 1);
  CHECK(of(fin).components[0].genus() == 0);
  const Soup strip = grid(24, 2, [](double u, double v) {
    const double turn = full_turn * u, wide = 0.01 * (v - 0.5);
    const double out = 0.02 + wide * std::cos(turn / 2);
    return Vec3{out * std::cos(turn), out * std::sin(turn), wide * std::sin(turn / 2)};
  });
  CHECK_FALSE(of(strip).components.at(0).orientable);
  CHECK(of(strip).components[0].border_loops == 1);
  // Two balls that touch in a corner are two.
  Soup two = icosphere(0.01, 0);
  const Soup other = two;
  const Vec3 by = 2.0 * two.at[0];
  for (const Vec3& v : other.at) two.at.push_back(v + by);
  for (const auto& t : other.triangles) two.triangles.push_back({t[0] + 12, t[1] + 12, t[2] + 12});
  REQUIRE(of(two).components.size() == 2);
  CHECK(of(two).components[1].genus() == 0);
}
