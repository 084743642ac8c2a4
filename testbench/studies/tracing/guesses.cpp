// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/devices/shapes.md
#include "guesses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../shape/shape_case.hpp"

namespace feltgate::test {

namespace {

constexpr double kRadius_m = 2e-3;  ///< of the corners in the law
constexpr double kPace_m = 2e-3;    ///< in which a way is remembered
/// What tells shapes apart, each in the size of its own spread.
constexpr double kApart_m = 1.5e-3, kStiffness_share = 0.15, kDamping_ns_m = 0.01;
constexpr double kDegree = 3.14159265358979323846 / 180;

/// Places a pace apart on a closed line.
std::vector<Point> paced(const std::vector<Point>& line) {
  std::vector<Point> places;
  double left_m = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Point step = line[(i + 1) % line.size()] - line[i];
    const double size = shape::length(step);
    for (; left_m < size; left_m += kPace_m) places.push_back(line[i] + step * (left_m / size));
    left_m -= size;
  }
  return places;
}

std::vector<Point> about_its_middle(std::vector<Point> places) {
  Point sum{};
  for (const Point p : places) sum = sum + p;
  for (Point& p : places) p = p - sum * (1 / static_cast<double>(places.size()));
  return places;
}

/// Where the outline is, as far as it is known how deep the pen was.
std::vector<Point> surface(const Trace& trace, double stiffness_n_m) {
  std::vector<Point> places;
  for (const Touch& t : trace.touches) {
    const Point at = t.pen_m + t.force_n * (1 / stiffness_n_m);
    if (places.empty() || shape::length(at - places.back()) >= kPace_m) places.push_back(at);
  }
  return places;
}

/// The way as it is remembered; what is missing at its end is spread over all of it, for the
/// robot knows that it came back.
std::vector<Point> remembered(const std::vector<Point>& way, bool closed, const Memory& memory,
                              std::mt19937_64& random) {
  std::normal_distribution<double> error;
  std::vector<Point> places{way.front()};
  double off_rad = 0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Point step = way[i] - way[i - 1];
    const double cm = 100 * shape::length(step);
    off_rad += memory.degrees_per_root_cm * kDegree * std::sqrt(cm) * error(random);
    const double c = std::cos(off_rad), s = std::sin(off_rad);
    places.push_back(places.back() + Point{c * step.x - s * step.y, s * step.x + c * step.y});
  }
  if (!closed) return places;
  const Point missing = (way.back() - way.front()) - (places.back() - places.front());
  for (std::size_t i = 0; i < places.size(); ++i) {
    places[i] =
        places[i] + missing * (static_cast<double>(i) / static_cast<double>(way.size() - 1));
  }
  return places;
}

double nearest_m(Point p, const std::vector<Point>& places) {
  double least = std::numeric_limits<double>::infinity();
  for (const Point q : places) least = std::min(least, shape::length(p - q));
  return least;
}

/// Mean distance of the places of each from the other.
double apart_m(const std::vector<Point>& a, const std::vector<Point>& b) {
  double to_b = 0, to_a = 0;
  for (const Point p : a) to_b += nearest_m(p, b) / static_cast<double>(a.size());
  for (const Point p : b) to_a += nearest_m(p, a) / static_cast<double>(b.size());
  return 0.5 * (to_a + to_b);
}

}  // namespace

Guesser::Guesser() {
  for (std::size_t i = 0; i < kShapes.size(); ++i) {
    outlines_[i] = about_its_middle(
        paced(shape::sampled(shape::curve_of(kShapes[i].name, kRadius_m), 100).at));
  }
}

int Guesser::guess(const Trace& trace, const Cues& cues, const Memory& memory,
                   std::mt19937_64& random) const {
  const Material felt = felt_material(trace);
  const double stiffness = std::max(felt.stiffness_n_m, 1.0);
  const std::vector<Point> way = surface(trace, cues.stiffness ? stiffness : kHard_n_m);
  if (way.size() < 3) return 0;
  const std::vector<Point> places =
      about_its_middle(paced(remembered(way, trace.closed, memory, random)));
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < kShapes.size(); ++i) {
    double off = std::pow(apart_m(places, outlines_[i]) / kApart_m, 2);
    if (cues.stiffness) {
      off += std::pow(std::log(stiffness / kShapes[i].stiffness_n_m) / kStiffness_share, 2);
    }
    if (cues.damping)
      off += std::pow((felt.damping_ns_m - kShapes[i].damping_ns_m) / kDamping_ns_m, 2);
    if (off >= least) continue;
    least = off;
    best = static_cast<int>(i);
  }
  return best;
}

double right(const Confusion& guesses) {
  int hits = 0, all = 0;
  for (std::size_t of = 0; of < guesses.size(); ++of) {
    for (std::size_t as = 0; as < guesses.size(); ++as) {
      all += guesses[of][as];
      if (of == as) hits += guesses[of][as];
    }
  }
  return all > 0 ? static_cast<double>(hits) / all : 0;
}

}  // namespace feltgate::test
