// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The command feltgate touch: what it tells, refuses and makes. Documentation: docs/touch.md
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "catch.hpp"
#include "sim/touch/make_glb.hpp"
#include "touch_meshes.hpp"

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
  const std::string open = temporary("feltgate_touch_open.glb");
  write_glb(open, sheet(0.06, 2));
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
  CHECK(run(ball + " --size 20mm --speed 1m/s --distance --material none=stone") == 0);
  // What merging opened is open for a signed distance too.
  const std::string fine = temporary("feltgate_touch_fine.glb");
  CHECK(run("--make ball --faces 80000 -o " + fine) == 0);
  CHECK(text.find("79380 faces, 39692 vertices, 60.0 mm; CC0-1.0") != std::string::npos);
  CHECK(run(fine + " --mesh-only --faces 8000") == 0);
  const bool opened = text.find("edges more at a border") != std::string::npos;
  CHECK(run(fine + " --faces 8000 --distance --speed 1") == (opened ? 2 : 0));
  const std::string fast = temporary("feltgate_touch_fast.csv");
  write_file(fast, "time_s,x_m,y_m,z_m\n0,0,0,0.04\n0.0005,0,0,0.04\n");
  CHECK(run(ball + " --stroke " + fast) == 2);
  CHECK(text.find(fast + ":3: the stroke ends after 0.5 ms and a plane may take 12 ms") !=
        std::string::npos);
  CHECK(run(ball + " --faces 2.5") == 2);
  CHECK(text.find("2.5 is not a whole number from 0 to 4000000") != std::string::npos);
  CHECK(run(ball + " --engine rtl") == 2);
  CHECK(text.find("--engine rtl: this program has the twin alone; ") != std::string::npos);
  for (const std::string& words : {cut,
                                   ball + " --faces 3",
                                   ball + " --latency 100ms --size 1mm --speed 1",
                                   ball + " --make ball -o x",
                                   ball + " -o x",
                                   std::string("--make cone -o x"),
                                   std::string("--make ball --faces 20 -o x"),
                                   said + ".none",
                                   ball + " --centre nan 0 0",
                                   ball + " --size 0.5m --centre 0.1 0 0",
                                   ball + " --stroke " + ball,
                                   ball + " --material moss=1,2,3",
                                   ball + " --material none=1,2",
                                   ball + " --mesh-only --csv x",
                                   open + " --distance",
                                   ball + " --edges --drag 1.5",
                                   ball + " --edges --distance",
                                   ball + " --material none=steel",
                                   ball + " --engine fast",
                                   ball + " --faces -1"}) {
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
