// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Meshes to touch that need no file from elsewhere: a ball or a torus, as GLB files under CC0. The
// same request gives the same bytes. Documentation: docs/touch.md
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/touch/touch.hpp"

namespace feltgate::touch {

constexpr std::int64_t least_made_faces = 36, most_made_faces = 600'000;

/// An icosahedron, each face cut into n * n, with corners on the sphere of radius 1.
inline Soup made_ball(std::int64_t most_faces) {
  const auto n = static_cast<int>(std::sqrt(static_cast<double>(most_faces) / 20));
  const double g = 0.5 * (1 + std::sqrt(5.0));
  std::vector<Vec3> corner;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-g, g})
      for (const Vec3 v : {Vec3{0, a, b}, Vec3{a, b, 0}, Vec3{b, 0, a}}) corner.push_back(v);
  }
  const auto near = [](Vec3 a, Vec3 b) { return std::abs(plant::length(a - b) - 2) < 1e-9; };
  Soup s;
  std::map<std::array<long long, 3>, std::uint32_t> known;
  for (std::size_t i = 0; i < 12 * 12 * 12; ++i) {
    const Vec3 a = corner[i / 144], b = corner[i / 12 % 12], c = corner[i % 12];
    // Once each, the one that begins with its first corner, counter-clockwise from outside.
    const bool once = i / 144 < std::min(i / 12 % 12, i % 12) && near(a, b) && near(b, c);
    if (!once || !near(c, a) || plant::dot(plant::cross(b - a, c - a), a) < 0) continue;
    const auto at = [&](int to_b, int to_c) {
      const Vec3 v = double(n - to_b - to_c) * a + double(to_b) * b + double(to_c) * c;
      const auto [found, fresh] = known.try_emplace(
          {std::llround(1e3 * v.x), std::llround(1e3 * v.y), std::llround(1e3 * v.z)},
          static_cast<std::uint32_t>(s.at.size()));
      if (fresh) s.at.push_back(1 / plant::length(v) * v);
      return found->second;
    };
    for (int p = 0; p < n; ++p) {
      for (int q = 0; p + q < n; ++q) {
        s.triangles.push_back({at(p, q), at(p + 1, q), at(p, q + 1)});
        if (p + q + 1 < n) s.triangles.push_back({at(p + 1, q), at(p + 1, q + 1), at(p, q + 1)});
      }
    }
  }
  return s;
}

/// A torus about the vertical of 2 n times n squares, each cut into two.
inline Soup made_torus(std::int64_t most_faces) {
  const auto n = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(most_faces)) / 2);
  const double step = 3.14159265358979323846 / n;
  Soup s;
  for (std::uint32_t i = 0; i < 2 * n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const double u = step * i, v = 2 * step * j, out = 1 + 0.4 * std::cos(v);
      s.at.push_back({out * std::cos(u), out * std::sin(u), 0.4 * std::sin(v)});
      const auto at = [n](std::uint32_t a, std::uint32_t b) { return a % (2 * n) * n + b % n; };
      s.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      s.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return s;
}

/// "ball" or "torus" of at most so many faces, from least_made_faces to most_made_faces; closed;
/// its largest side is `size_m`. Errors: std::invalid_argument for another shape or number.
inline Soup made_mesh(const std::string& shape, std::int64_t most_faces, double size_m) {
  if (shape != "ball" && shape != "torus")
    throw std::invalid_argument("--make " + shape + ": choose ball or torus");
  if (most_faces < least_made_faces || most_faces > most_made_faces) {
    throw std::invalid_argument(fmt::format("--make {}: of {} to {} faces; choose --faces so",
                                            shape, least_made_faces, most_made_faces));
  }
  Soup s = shape == "ball" ? made_ball(most_faces) : made_torus(most_faces);
  (void)place(s, {size_m, {}});
  return s;
}

/// A GLB file of it, in glTF's frame: y up.
inline std::string glb_of(const Soup& s, const std::string& generator) {
  std::string binary, file = "glTF";
  const auto append = [](std::string& to, auto value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    to.append(bytes, sizeof value);
  };
  std::array<float, 3> low{}, high{};
  for (const Vec3& v : s.at) {
    const double parts[] = {v.x, v.z, -v.y};
    for (std::size_t n = 0; n < 3; ++n) {
      const auto part = static_cast<float>(parts[n]);
      low[n] = std::min(low[n], part);
      high[n] = std::max(high[n], part);
      append(binary, part);
    }
  }
  for (const Triangle& t : s.triangles)
    for (const std::uint32_t n : t) append(binary, n);
  const std::size_t places = 12 * s.at.size(), indices = 12 * s.triangles.size();
  std::string json = fmt::format(
      R"({{"asset":{{"version":"2.0","generator":"{}","copyright":"CC0-1.0"}},"scene":0,)"
      R"("scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[)"
      R"({{"attributes":{{"POSITION":0}},"indices":1}}]}}],"buffers":[{{"byteLength":{}}}],)"
      R"("bufferViews":[{{"buffer":0,"byteLength":{}}},)"
      R"({{"buffer":0,"byteOffset":{},"byteLength":{}}}],)"
      R"("accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":{},)"
      R"("min":[{:.9g},{:.9g},{:.9g}],"max":[{:.9g},{:.9g},{:.9g}]}},)"
      R"({{"bufferView":1,"componentType":5125,"type":"SCALAR","count":{}}}]}})",
      generator, places + indices, places, places, indices, s.at.size(), low[0], low[1], low[2],
      high[0], high[1], high[2], 3 * s.triangles.size());
  json.resize((json.size() + 3) / 4 * 4, ' ');
  append(file, std::uint32_t{2});
  append(file, static_cast<std::uint32_t>(28 + json.size() + binary.size()));
  append(file, static_cast<std::uint32_t>(json.size()));
  file += "JSON" + json;
  append(file, static_cast<std::uint32_t>(binary.size()));
  return file + std::string("BIN\0", 4) + binary;
}

}  // namespace feltgate::touch
