// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What optimisers and animators put into GLB files: quantized positions, weights of morph targets,
// instances, and extensions that are left out. Documentation: docs/touch.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

namespace {

/// Replaces one part of a JSON text.
std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

Soup read(const std::string& json, const std::string& binary) {
  const std::string path = temporary("feltgate_touch_glb.glb");
  write_file(path, glb_of(json, binary));
  return touch::read_glb(path);
}

std::string error(const std::string& json, const std::string& binary) {
  try {
    (void)read(json, binary);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "read";
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
  std::string json =
      with(plain, R"("indices":1})", R"("indices":1,"targets":[{"POSITION":2},{"POSITION":3}]})");
  json = with(json, fmt::format(R"("buffers":[{{"byteLength":{}}}])", begin),
              fmt::format(R"("buffers":[{{"byteLength":{}}}])", binary.size()));
  json = with(json, R"(}],"accessors":[)",
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
      with(json, R"(}]}],"buffers")", R"(}],"weights":[2,0.5]}],"buffers")");
  CHECK(apart(read(of_mesh, binary), moved(2, 0.5)) < 1e-8);
  const std::string of_node = with(of_mesh, R"("mesh":0 )", R"("mesh":0,"weights":[-1,0])");
  CHECK(apart(read(of_node, binary), moved(-1, 0)) < 1e-8);
  CHECK(error(with(of_mesh, "[2,0.5]", "[2,0.5,1]"), binary).find("more weights than morph") !=
        std::string::npos);
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
  json = with(json, fmt::format(R"("buffers":[{{"byteLength":{}}}])", begin),
              fmt::format(R"("buffers":[{{"byteLength":{}}}])", binary.size()));
  json = with(
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
  CHECK(error(with(json, R"("type":"VEC3","count":2}],)", R"("type":"VEC3","count":1}],)"), binary)
            .find("attributes of instances that differ in number") != std::string::npos);
  CHECK(error(with(json, R"("TRANSLATION":2)", R"("TRANSLATION":"a")"), binary)
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
