// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Meshes that tests of touch make, a writer of GLB files, and a run under the stylus. docs/touch.md
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "axes_fixture.hpp"
#include "catch.hpp"
#include "sim/touch/touch_run.hpp"

namespace feltgate::test {

using plant::Vec3;
using touch::Soup;

inline double angle_rad(Vec3 a, Vec3 b) {
  return std::atan2(plant::length(plant::cross(a, b)), plant::dot(a, b));
}

/// An icosahedron, each face split into four, `times` times; 20 * 4^times faces, corners on the
/// sphere.
inline Soup icosphere(double radius_m, int times) {
  Soup s;
  const double g = 0.5 * (1 + std::sqrt(5.0));
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-g, g}) {
      for (const Vec3 v : {Vec3{0, a, b}, Vec3{a, b, 0}, Vec3{b, 0, a}}) s.at.push_back(v);
    }
  }
  const auto near = [&](std::uint32_t a, std::uint32_t b) {
    return std::abs(plant::length(s.at[a] - s.at[b]) - 2) < 1e-9;
  };
  for (std::uint32_t a = 0; a < 12; ++a) {
    for (std::uint32_t b = a + 1; b < 12; ++b) {
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        if (!near(a, b) || !near(b, c) || !near(c, a)) continue;
        const Vec3 out = plant::cross(s.at[b] - s.at[a], s.at[c] - s.at[a]);
        if (plant::dot(out, s.at[a]) > 0) {
          s.triangles.push_back({a, b, c});
        } else {
          s.triangles.push_back({a, c, b});
        }
      }
    }
  }
  for (int n = 0; n < times; ++n) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, fresh] = middles.try_emplace(std::minmax(a, b), s.at.size());
      if (fresh) s.at.push_back(0.5 * (s.at[a] + s.at[b]));
      return found->second;
    };
    std::vector<touch::Triangle> finer;
    for (const auto& t : s.triangles) {
      const std::uint32_t ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
      for (const touch::Triangle part :
           {touch::Triangle{t[0], ab, ca}, touch::Triangle{ab, t[1], bc},
            touch::Triangle{ca, bc, t[2]}, touch::Triangle{ab, bc, ca}}) {
        finer.push_back(part);
      }
    }
    s.triangles = finer;
  }
  for (Vec3& v : s.at) v = radius_m / plant::length(v) * v;
  return s;
}

/// A box between -half and half; each face is a square of two triangles with corners of its own.
inline Soup box(Vec3 half_m) {
  Soup s;
  const auto corner = [&](int n) {
    return Vec3{n & 1 ? half_m.x : -half_m.x, n & 2 ? half_m.y : -half_m.y,
                n & 4 ? half_m.z : -half_m.z};
  };
  for (const auto& face : {std::array<int, 4>{0, 2, 3, 1}, std::array<int, 4>{4, 5, 7, 6},
                           std::array<int, 4>{0, 1, 5, 4}, std::array<int, 4>{2, 6, 7, 3},
                           std::array<int, 4>{0, 4, 6, 2}, std::array<int, 4>{1, 3, 7, 5}}) {
    const auto first = static_cast<std::uint32_t>(s.at.size());
    for (const int n : face) s.at.push_back(corner(n));
    s.triangles.push_back({first, first + 1, first + 2});
    s.triangles.push_back({first, first + 2, first + 3});
  }
  return s;
}

/// A grid of squares, `place` of (i / nu, j / nv). Rings have no seam, only double vertices there.
template <class Place>
Soup grid(std::uint32_t nu, std::uint32_t nv, Place&& place) {
  Soup s;
  for (std::uint32_t i = 0; i <= nu; ++i) {
    for (std::uint32_t j = 0; j <= nv; ++j) s.at.push_back(place(1.0 * i / nu, 1.0 * j / nv));
  }
  for (std::uint32_t i = 0; i < nu; ++i) {
    for (std::uint32_t j = 0; j < nv; ++j) {
      const std::uint32_t a = i * (nv + 1) + j, b = a + nv + 1;
      s.triangles.push_back({a, b, b + 1});
      s.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return s;
}
constexpr double full_turn = 6.283185307179586;
inline Soup torus(double ring_m, double tube_m, std::uint32_t n) {
  return grid(2 * n, n, [=](double u, double v) {
    const double out = ring_m + tube_m * std::cos(full_turn * v);
    return Vec3{out * std::cos(full_turn * u), out * std::sin(full_turn * u),
                tube_m * std::sin(full_turn * v)};
  });
}
/// A sheet without a thickness, in the plane z = 0.
inline Soup sheet(double side_m, std::uint32_t n) {
  return grid(n, n, [=](double u, double v) {
    return Vec3{side_m * (u - 0.5), side_m * (v - 0.5), 0};
  });
}
/// A plate of which the four sides are open: two sheets.
inline Soup open_plate(double side_m, double thick_m, std::uint32_t n) {
  Soup s = sheet(side_m, n), under = s;
  const auto first = static_cast<std::uint32_t>(s.at.size());
  for (Vec3& v : s.at) v.z += 0.5 * thick_m;
  for (const Vec3& v : under.at) s.at.push_back({v.x, v.y, -0.5 * thick_m});
  for (const auto& t : under.triangles)
    s.triangles.push_back({first + t[0], first + t[2], first + t[1]});
  return s;
}

template <class T>
void append(std::string& to, T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  to.append(bytes, sizeof(T));
}

/// The binary part of a GLB: positions as floats, in glTF's frame, then indices of 32 bits.
inline std::string binary_of(const Soup& s) {
  std::string bytes;
  for (const Vec3& v : s.at) {
    for (const double part : {v.x, v.z, -v.y}) append(bytes, static_cast<float>(part));
  }
  for (const auto& t : s.triangles) {
    for (const std::uint32_t n : t) append(bytes, n);
  }
  return bytes;
}

/// A GLB of its JSON and binary parts.
inline std::string glb_of(std::string json, std::string binary) {
  while (json.size() % 4 != 0) json += ' ';
  while (binary.size() % 4 != 0) binary += '\0';
  std::string bytes = "glTF";
  append(bytes, std::uint32_t{2});
  append(bytes, static_cast<std::uint32_t>(12 + 8 + json.size() +
                                           (binary.empty() ? 0 : 8 + binary.size())));
  append(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  if (binary.empty()) return bytes;
  append(bytes, static_cast<std::uint32_t>(binary.size()));
  return bytes + std::string("BIN\0", 4) + binary;
}

/// JSON of one primitive below `nodes`, with `buffer` as the further keys of its buffer.
inline std::string json_of(const Soup& s, const std::string& nodes,
                           const std::string& buffer = "") {
  const auto n = [](std::size_t k) { return std::to_string(k); };
  const std::size_t places = 12 * s.at.size(), indices = 12 * s.triangles.size();
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + nodes +
         R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"buffers":[{)" +
         buffer + R"("byteLength":)" + n(places + indices) +
         R"(}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":)" + n(places) +
         R"(},{"buffer":0,"byteOffset":)" + n(places) + R"(,"byteLength":)" + n(indices) +
         R"(}],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" +
         n(s.at.size()) + R"(,"min":[0,0,0],"max":[0,0,0]},{"bufferView":1,"componentType":5125,)" +
         R"("type":"SCALAR","count":)" + n(3 * s.triangles.size()) + "}]}";
}

inline void write_file(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}
inline void write_glb(const std::string& path, const Soup& s) {
  write_file(path, glb_of(json_of(s, R"({"mesh":0})"), binary_of(s)));
}

/// With planes that are 1 to 2 ms late, by the law of one plane or of two.
inline touch::TouchRun run_on(const touch::Mesh& mesh, const std::string& engine,
                              touch::TouchRequest request) {
  request.host.latency_s = request.host.jitter_s = 1e-3;
  const AxesScene scene = scene_named("stylus_cube");
  const DesignInfo& design = design_named("stylus_law");
  const auto law = make_axes_law(
      std::string(FELTGATE_ROOT) + "/rtl/laws/" + touch::law_of(request) + ".law", design, 3);
  AxesRunOptions options;
  options.design = "stylus_law";
  options.engine = engine;
  options.law = law.get();
  return touch::run_touch(mesh, request, scene, options, design.tick_hz);
}

}  // namespace feltgate::test
