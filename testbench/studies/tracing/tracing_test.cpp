// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The study of hidden shapes without people: a blind robot on the twin, on the shapes of the law
// and on a mesh under the proxy of feltgate touch. docs/devices/shapes.md
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <regex>

#include <fmt/format.h>

#include "../shape/shape_case.hpp"
#include "blind_robot.hpp"
#include "catch.hpp"
#include "mismatch.hpp"
#include "touch_meshes.hpp"

using namespace feltgate::test;
namespace touch = feltgate::touch;
namespace shape = feltgate::shape;
using feltgate::Plane;
using feltgate::PlaneHostSettings;
namespace plant = feltgate::plant;

namespace {

Trace traced_with(std::size_t shape, const Cues& cues, std::size_t start) {
  const double k = cues.stiffness ? kShapes[shape].stiffness_n_m : kHard_n_m;
  const double b = cues.damping ? kShapes[shape].damping_ns_m : kSlippery_ns_m;
  return traced(static_cast<int>(shape), k, b, kStarts.at(start));
}

std::string paging_script(const std::string& name) {
  std::ifstream in(FELTGATE_SOURCE_DIR "/scripts/web_page/" + name);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("tracing: the shapes' materials are those of the page's game") {
  const std::string pen = paging_script("pen.js"), game = paging_script("game.js");
  const auto value = [&](const std::string& name) {
    std::smatch found;
    REQUIRE(std::regex_search(pen, found, std::regex("\\b" + name + " = ([0-9.]+)")));
    return std::stod(found[1]);
  };
  for (const Shape& shape : kShapes) {
    INFO(shape.name);
    std::smatch found;
    const std::regex entry(std::string(shape.name) + R"(: \[(\w+), (\w+)\])");
    REQUIRE(std::regex_search(game, found, entry));
    CHECK(value(found[1]) == shape.stiffness_n_m);
    CHECK(value(found[2]) == shape.damping_ns_m);
  }
}

TEST_CASE("tracing: every shape is walked around and named, its material felt") {
  const Guesser guesser;
  std::mt19937_64 random(1);
  const Cues cues{true, true};
  // Otherwise a soft one and a sticky one.
  for (std::size_t shape = whole_run() ? 0 : 3; shape < kShapes.size();
       shape += whole_run() ? 1 : 3) {
    INFO(kShapes[shape].name);
    const Trace trace = traced_with(shape, cues, shape % kStarts.size());
    CHECK(trace.closed);
    const Material felt = felt_material(trace);
    CHECK(felt.stiffness_n_m == Approx(kShapes[shape].stiffness_n_m).epsilon(0.1));
    CHECK(felt.damping_ns_m == Approx(kShapes[shape].damping_ns_m).margin(0.01));
    CHECK(guesser.guess(trace, {}, {}, random) == static_cast<int>(shape));
    CHECK(guesser.guess(trace, cues, {}, random) == static_cast<int>(shape));
  }
}

TEST_CASE("tracing: how often the robot is right, with cues and without", "[.table]") {
  const Guesser guesser;
  for (const Cues& cues : {Cues{}, Cues{true, false}, Cues{false, true}, Cues{true, true}}) {
    std::mt19937_64 random(1);
    int right = 0, lives = 0;
    for (std::size_t shape = 0; shape < kShapes.size(); ++shape) {
      for (std::size_t start = 0; start < 2; ++start) {
        const Trace trace = traced_with(shape, cues, start);
        for (int life = 0; life < 100; ++life, ++lives) {
          right += guesser.guess(trace, cues, {kLikePeople}, random) == static_cast<int>(shape);
        }
      }
    }
    fmt::print("{} degrees per root cm, cues: stiffness {}, damping {}: {:.1f} % right\n",
               kLikePeople, cues.stiffness, cues.damping, 100.0 * right / lives);
  }
}

namespace {

using Search = std::function<Plane(Vec3)>;

/// A wall along the outline of so many vertices, a tenth of it high, upright; two faces are about
/// as wide as high. The pen goes around it a little above its middle.
touch::Mesh wall(const std::vector<Point>& at, double around_m) {
  const auto n = static_cast<std::uint32_t>(at.size());
  return touch::clean(grid(n, std::max(1u, n / 10), [&](double u, double v) {
    const Point p = at[static_cast<std::size_t>(std::lround(u * n)) % n];
    return Vec3{p.x, p.y, 0.1 * around_m * (v - 0.487)};
  }));
}

/// The robot walks around what a host finds at each pose, 1000 a second, 1 to 2 ms late.
Trace felt(const Search& search, Point start_m, double patience_s) {
  PlaneHostSettings host;
  host.latency_s = host.jitter_s = 1e-3;
  host.stiffness_n_m = kHard_n_m;
  host.search = [&](Vec3 pen_m) { return std::pair{search(pen_m), host}; };
  return traced("local_plane", {}, start_m, patience_s, host);
}
Trace felt_mesh(const touch::Mesh& mesh, Point start_m, double patience_s) {
  touch::Proxy proxy(mesh, {});
  proxy.begin({start_m.x, start_m.y, 0});
  return felt(
      [&](Vec3 pen_m) {
        const touch::Touched t = proxy.move(pen_m);
        return Plane{t.point_m, t.normal};
      },
      start_m, patience_s);
}
/// A wrong proxy: the nearest vertex, with the mean normal of its faces.
Trace felt_vertices(const touch::Mesh& mesh, Point start_m, double patience_s) {
  return felt(
      [&](Vec3 pen_m) {
        std::uint32_t best = 0;
        for (std::uint32_t v = 0; v < mesh.at.size(); ++v) {
          if (plant::length(mesh.at[v] - pen_m) < plant::length(mesh.at[best] - pen_m)) best = v;
        }
        Vec3 out{};
        for (const touch::Triangle& t : mesh.triangles) {
          if (std::count(t.begin(), t.end(), best) > 0) out = out + mesh.normal(t);
        }
        return Plane{mesh.at[best], 1 / plant::length(out) * out};
      },
      start_m, patience_s);
}

/// Distance of the felt places from the edges that 95 % do not exceed.
double off_m(const Trace& trace, const std::vector<Point>& at) {
  std::vector<double> off;
  for (const auto* felt : {&trace.probed, &trace.touches}) {
    for (const Touch& t : *felt) {
      const Point p = t.pen_m + t.force_n * (1 / kHard_n_m);
      double least = INFINITY;
      for (std::size_t i = 0; i < at.size(); ++i) {
        const Point edge = at[(i + 1) % at.size()] - at[i];
        const double share = std::clamp(dot(p - at[i], edge) / dot(edge, edge), 0.0, 1.0);
        least = std::min(least, shape::length(p - at[i] - edge * share));
      }
      off.push_back(least);
    }
  }
  std::sort(off.begin(), off.end());
  return off.empty() ? INFINITY : touch::quantile(off, 0.95);
}

}  // namespace

TEST_CASE("tracing: a mesh of 24 faces is felt where its edges are, and named") {
  const Guesser guesser;
  std::mt19937_64 random(1);
  for (std::size_t s = whole_run() ? 0 : 1; s < (whole_run() ? kShapes.size() : 2); ++s) {
    INFO(kShapes[s].name);
    const shape::Curve curve = shape::curve_of(kShapes[s].name, 2e-3);
    const std::vector<Point> at = shape::sampled(curve, 12).at;
    const touch::Mesh mesh = wall(at, curve.length_m);
    CHECK(mesh.triangles.size() == 24);
    // Otherwise a part of the way.
    const Trace trace = felt_mesh(mesh, kStarts[0], whole_run() ? most_patience_s : 2);
    CHECK(off_m(trace, at) < 0.1e-3);
    if (whole_run()) {
      CHECK(trace.closed);
      CHECK(guesser.guess(trace, {}, {}, random) == static_cast<int>(s));
    }
    // What must not pass: vertices in place of faces.
    CHECK(off_m(felt_vertices(mesh, kStarts[0], 2), at) > 0.1e-3);
  }
}
