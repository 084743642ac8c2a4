// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Meshes of GLB files: import, what is refused, edges, components, genus; and under the stylus in
// closed loop. Documentation: docs/touch.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "catch.hpp"
#include "touch_meshes.hpp"

using namespace feltgate;
using namespace feltgate::test;
using plant::length;
using touch::Mesh;

namespace {

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

Soup read(const std::string& json, const std::string& binary) {
  const std::string path = temporary("feltgate_touch_glb.glb");
  write_file(path, glb_of(json, binary));
  return touch::read_glb(path);
}

/// The largest distance of two soups' vertices.
double apart(const Soup& a, const Soup& b) {
  REQUIRE(a.at.size() == b.at.size());
  double most = 0;
  for (std::size_t n = 0; n < a.at.size(); ++n) most = std::max(most, length(a.at[n] - b.at[n]));
  return most;
}

/// A cube with its positions as whole numbers of type T, -1 to 1 or 0 to 1 times the largest, each
/// vertex padded to four bytes as glTF asks; read, and how far off the cube's own vertices.
template <class T>
double quantized(int component, bool normalized) {
  const Soup cube = box({0.01, 0.02, 0.03});
  const bool sign = std::is_signed_v<T>;
  const double most = std::numeric_limits<T>::max(), side = 0.08;
  std::string places;
  for (const Vec3& v : cube.at) {
    for (const double part : {v.x, v.z, -v.y}) {
      const double unit = sign ? 2 * part / side : part / side + 0.5;
      append(places, static_cast<T>(std::lround(unit * most)));
    }
    places.append((4 - 3 * sizeof(T) % 4) % 4, '\0');
  }
  const std::size_t stride = (3 * sizeof(T) + 3) / 4 * 4;
  std::string binary = binary_of(cube).substr(12 * cube.at.size());  // the indices
  const std::size_t indices = binary.size();
  binary += places;
  const double scale = side / (sign ? 2 : 1) / (normalized ? 1 : most), to = sign ? 0 : -0.5 * side;
  const auto three = [](double v) { return fmt::format("[{0:.17g},{0:.17g},{0:.17g}]", v); };
  return apart(
      read(
          fmt::format(
              R"({{"asset":{{"version":"2.0"}},"extensionsRequired":["KHR_mesh_quantization"],)"
              R"("nodes":[{{"mesh":0,"scale":{},"translation":{}}}],"meshes":[{{"primitives":[)"
              R"({{"attributes":{{"POSITION":0}},"indices":1}}]}}],"buffers":[{{"byteLength":{}}}],)"
              R"("bufferViews":[{{"buffer":0,"byteOffset":{},"byteLength":{},"byteStride":{}}},)"
              R"({{"buffer":0,"byteLength":{}}}],"accessors":[{{"bufferView":0,"componentType":{},)"
              R"("normalized":{},"type":"VEC3","count":{}}},{{"bufferView":1,"componentType":5125,)"
              R"("type":"SCALAR","count":{}}}]}})",
              three(scale), three(to), binary.size(), indices, places.size(), stride, indices,
              component, normalized, cube.at.size(), 3 * cube.triangles.size()),
          binary),
      cube);
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

TEST_CASE(
    "touch: strips, fans, lists without indices, small indices and interleaved data are read") {
  // A square of glTF's z = 0 that looks at the one who sees it, corners with 12 bytes between them;
  // then indices of 16 bits for a strip and of 8 bits for a fan.
  std::string binary;
  for (const auto& [x, y] : {std::pair{0.F, 0.F}, {1.F, 0.F}, {0.F, 1.F}, {1.F, 1.F}}) {
    for (const float v : {x, y, 0.F, 9.F, 9.F, 9.F}) append(binary, v);
  }
  for (const int n : {0, 1, 2, 3}) append(binary, static_cast<std::uint16_t>(n));
  binary += std::string("\0\1\3\2", 4);
  const auto told_of = [&](const std::string& primitive) {
    const std::string path = temporary("feltgate_touch_kinds.glb");
    write_file(
        path,
        glb_of(
            R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},)" +
                primitive +
                R"(}]}],"buffers":[{"byteLength":108}],"bufferViews":[{"buffer":0,"byteLength":96,"byteStride":24},)"
                R"({"buffer":0,"byteOffset":96,"byteLength":8},{"buffer":0,"byteOffset":104,"byteLength":4}],"accessors":[)"
                R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":4},{"bufferView":1,"componentType":5123,"type":"SCALAR","count":4},)"
                R"({"bufferView":2,"componentType":5121,"type":"SCALAR","count":4}]})",
            binary));
    const Soup s = touch::read_glb(path);
    Vec3 area{};
    for (const auto& f : s.triangles)
      area = area + 0.5 * plant::cross(s.at[f[1]] - s.at[f[0]], s.at[f[2]] - s.at[f[0]]);
    return std::pair{s.triangles.size(), area.y};
  };
  // glTF's z is the device's -y; the whole square is seen from there.
  CHECK(told_of(R"("indices":1,"mode":5)") == std::pair<std::size_t, double>{2, -1});
  CHECK(told_of(R"("indices":2,"mode":6)") == std::pair<std::size_t, double>{2, -1});
  CHECK(told_of(R"("mode":4)") == std::pair<std::size_t, double>{1, -0.5});
}

TEST_CASE("touch: a file that is broken, empty, huge or not alone is refused in one line") {
  const Soup cube = box({0.01, 0.01, 0.01});
  const std::string json = json_of(cube, R"({"mesh":0})"), binary = binary_of(cube);
  const std::string whole = glb_of(json, binary);
  CHECK(told(whole) == "read");
  CHECK(told("").find("too short") == 0);
  // An old container; extensions that its writer says are needed, and one that is only of looks.
  CHECK(told(std::string(whole).replace(4, 1, "\1")).find("glTF 1, and 2 is read; ") == 0);
  const auto required = [&](const std::string& name, const std::string& part) {
    return told(glb_of(
        replaced(part, R"("scene":0)", R"("extensionsRequired":[")" + name + R"("],"scene":0)"),
        binary));
  };
  CHECK(required("KHR_materials_unlit", json) == "read");
  // As meshopt leaves the buffer that its decoder fills.
  CHECK(required("EXT_meshopt_compression", replaced(json, R"("byteLength":)", R"("byteLength":9)"))
            .find("needs the extension EXT_meshopt_compression, which is not read; ") == 0);
  CHECK(told("solid cube, a file of another kind").find("no GLB file") == 0);
  CHECK(told(whole.substr(0, whole.size() - 100)).find("cut off") == 0);
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
  CHECK(with("5126", "5125").find("positions that are neither floats nor whole numbers") == 0);
  std::string nan = binary, far = binary;
  const float none = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(&nan[24], &none, 4);
  CHECK(told(glb_of(json, nan)) ==
        "vertex 2 of a primitive is not finite; export it again as binary glTF, .glb");
  const std::uint32_t index = 24;
  std::memcpy(&far[12 * 24], &index, 4);
  CHECK(told(glb_of(json, far)).find("index 24 of 24 vertices; export") == 0);
}

TEST_CASE("touch: quantized positions are read, in every type that KHR_mesh_quantization has") {
  for (const bool normalized : {false, true}) {
    CHECK(quantized<std::int8_t>(5120, normalized) < 0.04 / 127);
    CHECK(quantized<std::uint8_t>(5121, normalized) < 0.08 / 255);
    CHECK(quantized<std::int16_t>(5122, normalized) < 0.04 / 32767);
    CHECK(quantized<std::uint16_t>(5123, normalized) < 0.08 / 65535);
  }
}

TEST_CASE("touch: morph targets move vertices by the weights of the mesh, or of its node") {
  const Soup cube = box({0.01, 0.02, 0.03});
  std::string binary = binary_of(cube);
  const std::size_t begin = binary.size();
  // Two targets: everything to glTF's x by 1 mm; a copy of the cube, which doubles it.
  for (std::size_t n = 0; n < cube.at.size(); ++n) {
    for (const float part : {1e-3F, 0.F, 0.F}) append(binary, part);
  }
  binary += binary_of(cube).substr(0, 12 * cube.at.size());
  const std::string plain = json_of(cube, R"({"mesh":0 })");
  std::string json = replaced(plain, R"("indices":1})",
                              R"("indices":1,"targets":[{"POSITION":2},{"POSITION":3}]})");
  json = replaced(json, fmt::format(R"("buffers":[{{"byteLength":{}}}])", begin),
                  fmt::format(R"("buffers":[{{"byteLength":{}}}])", binary.size()));
  json = replaced(json, R"(}],"accessors":[)",
                  fmt::format(R"(}},{{"buffer":0,"byteOffset":{},"byteLength":{}}}],"accessors":[)",
                              begin, binary.size() - begin));
  json.resize(json.size() - 2);
  json += fmt::format(R"(,{{"bufferView":2,"componentType":5126,"type":"VEC3","count":{0}}},)"
                      R"({{"bufferView":2,"byteOffset":{1},"componentType":5126,"type":"VEC3",)"
                      R"("count":{0}}}]}})",
                      cube.at.size(), 12 * cube.at.size());
  CHECK(apart(read(json, binary), cube) < 1e-9);
  const auto moved = [&](double x_mm, double grown) {
    Soup s = cube;
    for (Vec3& v : s.at) v = (1 + grown) * v + Vec3{1e-3 * x_mm, 0, 0};
    return s;
  };
  const std::string of_mesh =
      replaced(json, R"(}]}],"buffers")", R"(}],"weights":[2,0.5]}],"buffers")");
  CHECK(apart(read(of_mesh, binary), moved(2, 0.5)) < 1e-8);
  const std::string of_node = replaced(of_mesh, R"("mesh":0 )", R"("mesh":0,"weights":[-1,0])");
  CHECK(apart(read(of_node, binary), moved(-1, 0)) < 1e-8);
  CHECK(told(glb_of(replaced(of_mesh, "[2,0.5]", "[2,0.5,1]"), binary))
            .find("more weights than morph") != std::string::npos);
}

TEST_CASE("touch: instances of EXT_mesh_gpu_instancing are read, turned, scaled and moved") {
  const Soup cube = box({0.01, 0.02, 0.03});
  std::string binary = binary_of(cube);
  const std::size_t begin = binary.size();
  for (const float part : {1.F, 2.F, 3.F, -1.F, 0.F, 0.F}) append(binary, part);  // translation
  for (const int part : {0, 0, 0, 127, 0, 90, 0, 90}) append(binary, static_cast<char>(part));
  for (const float part : {1.F, 1.F, 1.F, 2.F, 1.F, 1.F}) append(binary, part);  // scale
  std::string json = json_of(
      cube,
      R"({"mesh":0,"translation":[0,0,5],"extensions":{"EXT_mesh_gpu_instancing":{"attributes":)"
      R"({"TRANSLATION":2,"ROTATION":3,"SCALE":4}}}})");
  json = replaced(json, fmt::format(R"("buffers":[{{"byteLength":{}}}])", begin),
                  fmt::format(R"("buffers":[{{"byteLength":{}}}])", binary.size()));
  json = replaced(
      json, R"(}],"accessors":[)",
      fmt::format(R"(}},{{"buffer":0,"byteOffset":{},"byteLength":56}}],"accessors":[)", begin));
  json.resize(json.size() - 2);
  json +=
      R"(,{"bufferView":2,"componentType":5126,"type":"VEC3","count":2},)"
      R"({"bufferView":2,"byteOffset":24,"componentType":5120,"normalized":true,"type":"VEC4","count":2},)"
      R"({"bufferView":2,"byteOffset":32,"componentType":5126,"type":"VEC3","count":2}],)"
      R"("extensionsUsed":["EXT_mesh_gpu_instancing"]})";
  const Soup s = read(json, binary);
  REQUIRE(s.at.size() == 2 * cube.at.size());
  CHECK(s.triangles.size() == 2 * cube.triangles.size());
  CHECK(s.extensions.empty());
  for (std::size_t n = 0; n < cube.at.size(); ++n) {
    const Vec3 v = cube.at[n];
    // glTF's x, y, z are the device's x, z, -y; then a turn by 90 degrees about glTF's y.
    CHECK(length(s.at[n] - (v + Vec3{1, -8, 2})) < 1e-6);
    CHECK(length(s.at[cube.at.size() + n] - Vec3{-1 - v.y, -5 + 2 * v.x, v.z}) < 1e-6);
  }
  CHECK(
      told(glb_of(replaced(json, R"("type":"VEC3","count":2}],)", R"("type":"VEC3","count":1}],)"),
                  binary))
          .find("attributes of instances that differ in number") != std::string::npos);
  CHECK(told(glb_of(replaced(json, R"("TRANSLATION":2)", R"("TRANSLATION":"a")"), binary))
            .find("an attribute of instances that is no accessor") != std::string::npos);
}

TEST_CASE("touch: what is left out of a GLB file is told") {
  const Soup cube = box({0.01, 0.02, 0.03});
  std::string json = json_of(cube, R"({"mesh":0})");
  json.resize(json.size() - 1);
  const Soup s = read(json + R"(,"extensionsUsed":["KHR_node_visibility","KHR_materials_unlit"],)"
                             R"("animations":[{"channels":[{"sampler":0,"target":{"node":0,)"
                             R"("path":"translation"}}],"samplers":[{"input":0,"output":0}]}]})",
                      binary_of(cube));
  CHECK(s.extensions == std::vector<std::string>{"KHR_node_visibility"});
  CHECK(s.animations == 1);
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

namespace {

/// From above onto a ball of 30 mm, then 0.2 m/s on a great circle that leans by 30 degrees, 2 mm
/// below the sphere; 7.14 rad/s.
touch::Stroke around_ball(double until_s) {
  touch::Stroke stroke;
  const auto at = [](double radius_m, double turn_rad) {
    const double out = radius_m * std::cos(turn_rad);
    return Vec3{std::cos(0.5236) * out, std::sin(0.5236) * out, radius_m * std::sin(turn_rad)};
  };
  stroke.push_back({0, at(0.033, 0.7)});
  for (int n = 0; 0.015 + n * 1e-3 <= until_s; ++n) {
    stroke.push_back({0.015 + n * 1e-3, at(0.028, 0.7 + 7.142857e-3 * n)});
  }
  return stroke;
}

touch::TouchRun run_ball(const Mesh& mesh, double until_s, bool shading) {
  touch::TouchRequest request;
  request.proxy.shading = shading;
  request.host.stiffness_n_m = 300;
  request.stroke = around_ball(until_s);
  return run_on(mesh, "twin,double", request);
}

}  // namespace

TEST_CASE("touch: the stylus feels the ball of facets as the sphere says, in closed loop") {
  const Mesh ball = touch::clean(icosphere(0.03, 3));
  constexpr double facet_rad = 0.0953, flat_m = 0.137e-3;  // 30 mm (1 - cos) of a facet
  for (const bool shading : {false, true}) {
    const touch::TouchRun run = run_ball(ball, 0.1, shading);
    CHECK(run.result.broken.empty());
    CHECK(run.result.figures.at("faults") == 0);
    CHECK(run.result.figures.at("plane_age_s.max") < 3.1e-3);
    double least_n = 1, most_n = 0, off_rad = 0;
    for (const touch::TouchRow& row : run.rows) {
      if (row.time_s < 0.025) continue;
      least_n = std::min(least_n, length(row.force_n));
      most_n = std::max(most_n, length(row.force_n));
      off_rad = std::max(off_rad, angle_rad(row.force_n, row.pen_m));
    }
    INFO(least_n << " " << most_n << " " << off_rad);
    // A plane turns from the pen by 7.14 rad/s for 3.1 ms; the pen is counted to 15 um along each
    // axis, which is 0.9 mrad of the way out.
    const double old_rad = 7.143 * 3.1e-3 + 1e-3;
    CHECK(off_rad < (shading ? 0.2 : 1) * facet_rad + old_rad);
    CHECK(off_rad > 0.01);
    const double counts_m = 27e-6, old_m = 28e-3 * old_rad * old_rad / 2;
    // A facet that the pen has left is higher beyond its edge.
    const double beyond_m = 28e-3 * old_rad * 2 * facet_rad;
    CHECK(least_n > 300 * (2e-3 - flat_m - counts_m));
    CHECK(most_n < 300 * (2e-3 + old_m + counts_m + beyond_m));
  }
}

TEST_CASE("touch: a stroke over a mesh goes over its top; one of a file is refused with its line") {
  const Mesh ring = touch::clean(torus(0.02, 0.008, 24));
  const touch::Stroke over = touch::stroke_over(ring, touch::TriangleTree(ring), 2e-3, 0.1);
  for (std::size_t n = 2; n + 1 < over.size(); ++n) {
    // 2 mm below the circle of the tube, less a facet; over the hole not lower than its equator.
    const Vec3 at = over[n].at_m;
    const double out = std::abs(at.x) - 0.02;
    const double top_m = std::abs(out) < 0.008 ? std::sqrt(0.008 * 0.008 - out * out) : 0;
    if (at.x * at.x > 0.013 * 0.013) CHECK(at.z == Approx(top_m - 2e-3).margin(3e-4));
    CHECK(plant::length(at - over[n - 1].at_m) / (over[n].time_s - over[n - 1].time_s) ==
          Approx(0.1));
  }
  const std::string path = temporary("feltgate_stroke.csv");
  const auto told = [&](const std::string& rows) {
    std::ofstream(path) << "time_s,x_m,y_m,z_m\n" << rows;
    try {
      return std::to_string(touch::read_stroke(path).size());
    } catch (const std::invalid_argument& error) {
      return std::string(error.what()).substr(path.size());
    }
  };
  CHECK(told("1,0,0,0.1\n1.5,0.01,0,0.1\r\n") == "2");
  CHECK(told("1,0,0,0.1\n1.5,0.01,0,nan\n").find(":3: not four numbers") == 0);
  CHECK(told("1,0,0,0.1\n1.5,0.01,0\n").find(":3: not four numbers") == 0);
  CHECK(told("1,0,0,0.1\n1,0.01,0,0\n").find(":3: time does not go on") == 0);
  CHECK(told("1,0,0,0.3\n").find(":2: beyond the pen's") == 0);
  CHECK(told("0,0,0,0.04\n1e-9,0.2,0,0.03\n").find(":3: 200 mm in 1e-06 ms, faster than 5") == 0);
  CHECK(told("0,0,0,0.04\n0.04,0.2,0,0.04\n") == "2");
  CHECK(told(std::string("0,0,0,0.1\n1,0,0,0.1\0junk\n", 25)).find(":3: not four") == 0);
  CHECK_THROWS_WITH(touch::read_stroke("/nope.csv"), "/nope.csv: cannot be read; check the path");
  CHECK(told("1,0,0,0.1\n").find(":2: fewer than two rows") == 0);
}

TEST_CASE("touch: each part is as stiff as its material, from the file into the law") {
  // Two halves of one floor, left and right of x = 0.
  Soup halves = sheet(0.06, 4);
  const std::size_t left = halves.triangles.size() / 2;
  const auto n = [](std::size_t k) { return std::to_string(k); };
  std::string json =
      replaced(json_of(halves, R"({"mesh":0})"), R"("indices":1})",
               R"("indices":1,"material":1},{"attributes":{"POSITION":0},"indices":2})");
  json = replaced(json, R"("buffers")",
                  R"("materials":[{"name":"unused"},{"name":"moss"}],"buffers")");
  json = replaced(json, R"("count":)" + n(3 * halves.triangles.size()),
                  R"("count":)" + n(3 * left) +
                      R"(},{"bufferView":1,"componentType":5125,"byteOffset":)" + n(12 * left) +
                      R"(,"type":"SCALAR","count":)" + n(3 * left));
  const std::string path = temporary("feltgate_touch_halves.glb");
  write_file(path, glb_of(json, binary_of(halves)));
  const Mesh mesh = touch::clean(touch::read_glb(path));
  CHECK(mesh.materials == std::vector<std::string>{"moss", "none"});
  touch::TouchRequest request;
  request.host.stiffness_n_m = 400;
  request.materials["moss"] = {100, 0, 0};
  request.stroke = {
      {0, {-0.02, 0.001, 0.004}}, {0.02, {-0.02, 0.001, -0.002}}, {0.12, {0.02, 0.001, -0.002}}};
  const touch::TouchRun run = run_on(mesh, "twin,double", request);
  CHECK(run.result.broken.empty());
  int soft = 0, hard = 0;
  for (const touch::TouchRow& row : run.rows) {
    if (row.time_s < 0.03) continue;
    // 3 ms at 0.4 m/s: so long it may still be the other one.
    const bool is_soft = row.pen_m.x<0, is_hard = row.pen_m.x> 1.3e-3;
    (is_soft ? soft : hard) += is_soft || is_hard ? 1 : 0;
    if (is_soft || is_hard)
      CHECK(row.force_n.z == Approx(is_soft ? 0.2 : 0.8).margin(is_soft ? 2e-3 : 8e-3));
  }
  CHECK((soft > 30 && hard > 30));
}
