// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The blind robot on meshes of more and more faces: the hidden shapes as walls of triangles under
// the proxy of feltgate touch, beside the exact curve. docs/devices/shapes.md
#include <fmt/format.h>

#include <cstdio>
#include <functional>

#include "../shape/shape_case.hpp"
#include "guesses.hpp"
#include "mismatch.hpp"
#include "touch_meshes.hpp"

using namespace feltgate::test;
namespace touch = feltgate::touch;
namespace shape = feltgate::shape;
using feltgate::Plane;
using feltgate::PlaneHostSettings;
namespace plant = feltgate::plant;

namespace {

constexpr int kLives = 200, kFewLives = 60;
using Search = std::function<Plane(Vec3)>;

shape::Curve curve_of(std::size_t number) { return shape::curve_of(kShapes[number].name, 2e-3); }

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
Trace felt(const Search& search, Point start_m, double patience_s = most_patience_s) {
  PlaneHostSettings host;
  host.latency_s = host.jitter_s = 1e-3;
  host.stiffness_n_m = kHard_n_m;
  host.search = [&](Vec3 pen_m) { return std::pair{search(pen_m), host}; };
  return traced("local_plane", {}, start_m, patience_s, host);
}
Trace felt_mesh(const touch::Mesh& mesh, Point start_m) {
  touch::Proxy proxy(mesh, {});
  proxy.begin({start_m.x, start_m.y, 0});
  return felt(
      [&](Vec3 pen_m) {
        const touch::Touched t = proxy.move(pen_m);
        return Plane{t.point_m, t.normal};
      },
      start_m);
}
Trace felt_curve(const shape::Curve& curve, Point start_m) {
  return felt(
      [&](Vec3 pen_m) {
        const shape::Nearest near = shape::nearest(curve, {pen_m.x, pen_m.y});
        return Plane{{near.at.x, near.at.y, 0}, {near.along.y, -near.along.x, 0}};
      },
      start_m);
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

/// The same way as a robot that draws it without a twin, a proxy or a hand: the edges themselves.
Trace drawn(const std::vector<Point>& at) {
  Trace trace;
  trace.closed = true;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Point step = at[(i + 1) % at.size()] - at[i];
    const double points = std::ceil(shape::length(step) / 0.1e-3);
    for (double k = 0; k < points; ++k)
      trace.touches.push_back({0, at[i] + step * (k / points), {}});
  }
  return trace;
}

/// Whether each life of a trace is right; a life forgets the same in every trace of a shape.
std::vector<bool> lives_of(const Guesser& guesser, const Trace& trace, std::size_t of,
                           double degrees, int lives = kLives) {
  std::vector<bool> right;
  for (int life = 0; life < lives; ++life) {
    std::mt19937_64 random(1000 * of + static_cast<std::size_t>(life));
    right.push_back(guesser.guess(trace, {}, {degrees}, random) == static_cast<int>(of));
  }
  return right;
}
double hits_of(const std::vector<bool>& right) {
  return static_cast<double>(std::count(right.begin(), right.end(), true));
}

/// Where 95 % of the binomial's luck may have its share: E. Wilson, 1927.
std::array<double, 2> wilson(double hits, double all) {
  constexpr double z = 1.959964;
  const double share = hits / all, middle = (share + z * z / (2 * all)) / (1 + z * z / all);
  const double half =
      z * std::sqrt(share * (1 - share) / all + z * z / (4 * all * all)) / (1 + z * z / all);
  return {middle - half, middle + half};
}

/// The shape that shares most of its area, both about the middles of their areas: a raster of
/// 0.5 mm, no distances.
int most_shared(const std::vector<Point>& at) {
  constexpr int cells = 180;
  constexpr double cell_m = 0.5e-3;
  const auto raster = [&](const std::vector<Point>& p) {
    double area = 0;
    Point middle{};
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Point a = p[i], b = p[(i + 1) % p.size()];
      area += 0.5 * shape::cross(a, b);
      middle = middle + (a + b) * (shape::cross(a, b) / 6);
    }
    middle = middle * (1 / area);
    std::vector<bool> in;
    for (int n = 0; n < cells * cells; ++n) {
      const Point q =
          middle + Point{n % cells - cells / 2 + 0.5, n / cells - cells / 2 + 0.5} * cell_m;
      bool inside = false;
      for (std::size_t i = 0; i < p.size(); ++i) {
        const Point a = p[i], b = p[(i + 1) % p.size()];
        if ((a.y > q.y) != (b.y > q.y) && q.x < a.x + (b.x - a.x) * (q.y - a.y) / (b.y - a.y))
          inside = !inside;
      }
      in.push_back(inside);
    }
    return in;
  };
  const std::vector<bool> is = raster(at);
  int best = 0;
  double most = -1;
  for (std::size_t s = 0; s < kShapes.size(); ++s) {
    const std::vector<bool> other = raster(shape::sampled(curve_of(s), 100).at);
    double both = 0, either = 0;
    for (std::size_t n = 0; n < is.size(); ++n) {
      both += is[n] && other[n] ? 1 : 0;
      either += is[n] || other[n] ? 1 : 0;
    }
    if (both / either <= most) continue;
    most = both / either;
    best = static_cast<int>(s);
  }
  return best;
}

/// What a test asks of a trace around a mesh; the judge draws the shape, the robot has the label.
struct Verdict {
  double off_m = 0;            ///< felt places off the edges, what 95 % do not exceed
  double hits = 0, drawn = 0;  ///< right lives, and those of the drawn way
  bool on_edges() const { return off_m < 0.1e-3; }
  bool above_chance() const { return wilson(hits, kFewLives)[0] > 1.0 / kShapes.size(); }
  bool as_drawn() const {
    const double share = (hits + drawn) / (2 * kFewLives);
    return std::abs(hits - drawn) <= 3 * std::sqrt(2 * kFewLives * share * (1 - share));
  }
  bool holds() const { return on_edges() && above_chance() && as_drawn(); }
};
Verdict verdict(const Guesser& guesser, const Trace& trace, const std::vector<Point>& at,
                std::size_t of, std::size_t label) {
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
  return {off.empty() ? INFINITY : touch::quantile(off, 0.95),
          hits_of(lives_of(guesser, trace, label, kLikePeople, kFewLives)),
          hits_of(lives_of(guesser, drawn(at), of, kLikePeople, kFewLives))};
}

/// One row for a mesh of each number of vertices around; 0 is the exact curve. The last column is
/// beside the first row.
void print_table(const std::vector<int>& rows) {
  const Guesser guesser;
  const double all = kShapes.size() * kLives;
  std::fputs(
      "faces, edge mm, closed of 7 | named of 7, by shared area | % right at 5, 10, 20 degrees"
      " | 95 % of luck at 10 | drawn at 10 | beside the first row at 10, percentage points\n",
      stdout);
  std::vector<bool> first;
  for (const int n : rows) {
    int closed = 0, named = 0, shared = 0;
    double edge_m = 0, drawn_hits = 0, faces = 0;
    std::array<std::vector<bool>, 3> right;
    for (std::size_t s = 0; s < kShapes.size(); ++s) {
      const shape::Curve curve = curve_of(s);
      const std::vector<Point> at = shape::sampled(curve, n > 0 ? n : 1000).at;
      Trace trace;
      if (n > 0) {
        const touch::Mesh mesh = wall(at, curve.length_m);
        faces = static_cast<double>(mesh.triangles.size());
        edge_m += curve.length_m / n / kShapes.size();
        trace = felt_mesh(mesh, kStarts[0]);
      } else {
        trace = felt_curve(curve, kStarts[0]);
      }
      closed += trace.closed ? 1 : 0;
      named += hits_of(lives_of(guesser, trace, s, 0, 1)) > 0 ? 1 : 0;
      shared += most_shared(at) == static_cast<int>(s) ? 1 : 0;
      for (std::size_t e = 0; e < right.size(); ++e) {
        const auto lives = lives_of(guesser, trace, s, std::array{5.0, kLikePeople, 20.0}[e]);
        right[e].insert(right[e].end(), lives.begin(), lives.end());
      }
      drawn_hits += hits_of(lives_of(guesser, drawn(at), s, kLikePeople));
    }
    if (first.empty()) first = right[1];
    double won = 0, lost = 0;  // lives that are right only here, only in the first row
    for (std::size_t i = 0; i < first.size(); ++i) {
      won += right[1][i] && !first[i] ? 1 : 0;
      lost += first[i] && !right[1][i] ? 1 : 0;
    }
    const double more = 100 * (won - lost) / all;
    const double luck = 196 * std::sqrt(won + lost - (won - lost) * (won - lost) / all) / all;
    const auto [low, high] = wilson(hits_of(right[1]), all);
    fmt::print(
        "{:>7} {:>5.2f} {} | {} {} | {:>5.1f} {:>5.1f} {:>5.1f} | {:.1f} to {:.1f} | {:>5.1f} | "
        "{:+.1f} +- {:.1f}\n",
        n > 0 ? fmt::format("{}", faces) : "exact", 1e3 * edge_m, closed, named, shared,
        100 * hits_of(right[0]) / all, 100 * hits_of(right[1]) / all, 100 * hits_of(right[2]) / all,
        100 * low, 100 * high, 100 * drawn_hits / all, more, luck);
    std::fflush(stdout);
  }
}

}  // namespace

TEST_CASE("tracing: a mesh is felt where its edges are and named as often as its drawing") {
  const Guesser guesser;
  for (std::size_t s = whole_run() ? 0 : 1; s < kShapes.size();
       s += whole_run() ? 1 : kShapes.size()) {
    const shape::Curve curve = curve_of(s);
    const std::vector<Point> at = shape::sampled(curve, 12).at;
    const touch::Mesh mesh = wall(at, curve.length_m);
    CHECK(mesh.triangles.size() == 24);
    CHECK(most_shared(at) == static_cast<int>(s));
    const Trace trace = felt_mesh(mesh, kStarts[0]);
    CHECK(trace.closed);
    CHECK(hits_of(lives_of(guesser, trace, s, 0, 1)) == 1);
    const Verdict is = verdict(guesser, trace, at, s, s);
    const Verdict wrong = verdict(guesser, felt_vertices(mesh, kStarts[0], 3), at, s, s);
    INFO(kShapes[s].name << ": " << is.off_m << " m off, " << is.hits << " right, " << is.drawn
                         << " drawn; by vertices " << wrong.off_m << " m, " << wrong.hits);
    CHECK(is.holds());
    // What must not pass: vertices in place of faces, and the labels of other shapes.
    CHECK_FALSE(wrong.on_edges());
    CHECK_FALSE(wrong.holds());
    if (s == 1) CHECK_FALSE(wrong.as_drawn());
    CHECK_FALSE(verdict(guesser, trace, at, s, (s + 1) % kShapes.size()).as_drawn());
  }
}

TEST_CASE("tracing: luck is a binomial's") {
  // The sum of the binomial beyond the ends of the interval is 2.5 % each, as far as Wilson is
  // right.
  for (const double hits : {60.0, 350.0, 540.0}) {
    const auto [low, high] = wilson(hits, 700);
    double above = 0, below = 0;
    for (double k = 0; k <= 700; ++k) {
      const double ways = std::lgamma(701) - std::lgamma(k + 1) - std::lgamma(701 - k);
      const auto of = [&](double p) {
        return std::exp(ways + k * std::log(p) + (700 - k) * std::log1p(-p)) *
               (k == hits ? 0.5 : 1);
      };
      above += k >= hits ? of(low) : 0;
      below += k <= hits ? of(high) : 0;
    }
    CHECK(above == Approx(0.025).margin(0.005));
    CHECK(below == Approx(0.025).margin(0.005));
  }
}

TEST_CASE("tracing: how often the robot is right on a coarse mesh", "[.table]") {
  print_table({0, 4, 6, 8, 10});
}
TEST_CASE("tracing: how often the robot is right on a fine mesh", "[.table]") {
  print_table({1000, 320, 100, 32, 16, 12, 0});
}
