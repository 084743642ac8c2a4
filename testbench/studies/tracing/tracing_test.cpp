// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The study of hidden shapes without people: a blind robot on the twin. docs/devices/shapes.md
#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <regex>
#include <tuple>

#include <fmt/format.h>

#include "../shape/shape_case.hpp"
#include "blind_robot.hpp"
#include "catch.hpp"
#include "mismatch.hpp"
#include "touch_meshes.hpp"

using namespace feltgate::test;

namespace {

/// What was traced once: the twin does the same again.
class Traces {
 public:
  const Trace& of(std::size_t shape, const Cues& cues, std::size_t start) {
    const double k = cues.stiffness ? kShapes[shape].stiffness_n_m : kHard_n_m;
    const double b = cues.damping ? kShapes[shape].damping_ns_m : kSlippery_ns_m;
    const auto [at, is_new] = known_.try_emplace({shape, k, b, start});
    if (is_new) at->second = traced(static_cast<int>(shape), k, b, kStarts.at(start));
    return at->second;
  }

 private:
  std::map<std::tuple<std::size_t, double, double, std::size_t>, Trace> known_;
};

/// A hundred lives of each trace.
Confusion lives(const Guesser& guesser, Traces& traces, const Cues& cues, const Memory& memory) {
  std::mt19937_64 random(1);
  Confusion guesses{};
  for (std::size_t shape = 0; shape < kShapes.size(); ++shape) {
    for (std::size_t start = 0; start < 2; ++start) {
      const Trace& trace = traces.of(shape, cues, start);
      for (int life = 0; life < 100; ++life) {
        ++guesses[shape][static_cast<std::size_t>(guesser.guess(trace, cues, memory, random))];
      }
    }
  }
  return guesses;
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
  Traces traces;
  const Cues cues{true, true};
  for (std::size_t shape = 0; shape < kShapes.size(); shape += whole_run() ? 1 : 3) {
    INFO(kShapes[shape].name);
    const Trace& trace = traces.of(shape, cues, shape % kStarts.size());
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
  Traces traces;
  const std::array<Cues, 4> all{{{false, false}, {true, false}, {false, true}, {true, true}}};
  std::string text = "degrees per root cm  none  stiffness  damping  both, % right\n";
  for (const double error : {0.0, 5.0, 10.0, 15.0, 20.0, 30.0, 40.0}) {
    text += fmt::format("{:>4}", error);
    for (const Cues& cues : all) {
      text += fmt::format("  {:>6.1f}", 100 * right(lives(guesser, traces, cues, {error})));
    }
    text += "\n";
  }
  for (const Cues& cues : {all.front(), all.back()}) {
    const Confusion guesses = lives(guesser, traces, cues, {kLikePeople});
    text += fmt::format("\n{} degrees, cues {}\n", kLikePeople, cues.damping ? "both" : "none");
    for (std::size_t shape = 0; shape < kShapes.size(); ++shape) {
      text += fmt::format("{:<10}", kShapes[shape].name);
      for (const int n : guesses[shape]) text += fmt::format("{:>6}", n);
      text += fmt::format("   {:.1f} s\n", traces.of(shape, cues, 0).seconds);
    }
  }
  text += "\nfelt from each start, N/m and Ns/m\n";
  for (std::size_t shape = 0; shape < kShapes.size(); ++shape) {
    text += fmt::format("{:<10}", kShapes[shape].name);
    for (std::size_t start = 0; start < 2; ++start) {
      const Material felt = felt_material(traces.of(shape, all.back(), start));
      text += fmt::format("  {:>5.1f} {:>7.4f}", felt.stiffness_n_m, felt.damping_ns_m);
    }
    text += "\n";
  }
  std::fputs(text.c_str(), stdout);
}

// The blind robot on meshes of more and more faces: the hidden shapes as walls of triangles under
// the proxy of feltgate touch, beside the exact curve. docs/devices/shapes.md

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
