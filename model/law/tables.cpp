// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/law-compiler.md
#include "law/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace feltgate::law {

namespace {

constexpr int fraction = 4096;
constexpr int pieces = 8;

/// A segment: where it begins and ends, what is asked, what was chosen.
struct Segment {
  double from, to;
  std::int32_t value, slope;
};

/// The error of a chord's line against the function, both in words: by the curvature, whose largest
/// effect is width^2/8 of it in the middle.
double by_curvature(const TableRequest& r, const Segment& s) {
  const Jet j = r.function({s.from, s.to});
  const double h = s.to - s.from;
  const double bend = h * h / 8 / r.value_scale;
  const Span curved = j.d2 * Span{-bend, 0};  // function - chord
  if (!(curved.size() < infinity)) return infinity;
  const auto at_end = [&](double x, double line) {
    return r.function({x, x}).v * (1 / r.value_scale) - Span{line, line};
  };
  const Span ends = hull(at_end(s.from, s.value), at_end(s.to, double{1} * s.value + s.slope));
  return up((ends + hull(curved, {0, 0})).size());
}

/// The same by the slope: pieces, the function in the middle of each, and how far it can go.
double by_slope(const TableRequest& r, const Segment& s) {
  double worst = 0;
  const double h = (s.to - s.from) / pieces;
  for (int i = 0; i < pieces; ++i) {
    const Span x = {s.from + h * i, s.from + h * (i + 1)};
    const Jet j = r.function(x);
    const auto line = [&](double t) { return s.value + s.slope * (t - s.from) / (s.to - s.from); };
    const Span whole = j.v * (1 / r.value_scale) -
                       Span{std::min(line(x.lo), line(x.hi)), std::max(line(x.lo), line(x.hi))};
    double error = whole.size();
    const Span relative =
        j.d1 * (1 / r.value_scale) - Span{s.slope / (s.to - s.from), s.slope / (s.to - s.from)};
    if (relative.size() < infinity) {
      const double middle = x.middle();
      const Span there =
          r.function({middle, middle}).v * (1 / r.value_scale) - Span{line(middle), line(middle)};
      error = std::min(error, there.size() + relative.size() * h / 2);
    }
    worst = std::max(worst, error);
  }
  return up(worst * (1 + 1e-12));
}

}  // namespace

TableUse make_table(const TableRequest& r) {
  TableUse t;
  t.low = r.low;
  t.values = {infinity, -infinity};
  bool curvature = true;
  const double width = r.argument_scale * fraction;
  const auto value = [&](double x) {
    const double inside = std::clamp(x, r.domain.lo, r.domain.hi);
    return r.function({inside, inside}).v.middle() / r.value_scale;
  };
  const double limit = r.limit;
  for (int i = 0; i < r.count; ++i) {
    const double from = (r.low + i) * width, to = from + width;
    const double a = value(from), b = value(to);
    double least_error = 0, most_error = 0;
    for (int k = 1; k < pieces; ++k) {
      const double share = static_cast<double>(k) / pieces;
      const double e = value(from + share * width) - (a + (b - a) * share);
      least_error = std::min(least_error, e);
      most_error = std::max(most_error, e);
    }
    const double shift = (least_error + most_error) / 2;
    Segment s{};
    s.value = static_cast<std::int32_t>(std::clamp(std::nearbyint(a + shift), -limit, limit));
    const double end = std::clamp(std::nearbyint(b + shift), -limit, limit);
    s.slope = static_cast<std::int32_t>(std::clamp(end - s.value, -32768.0, 32767.0));
    if (i > 0) {
      const std::uint64_t before = t.words.back();
      const int there = engine_table_value(before) + engine_table_slope(before);
      t.jump = std::max(t.jump, std::fabs(static_cast<double>(s.value - there)));
    }
    t.words.push_back(engine_table_word(s.value, s.slope));
    t.values = hull(t.values, {static_cast<double>(std::min(s.value, s.value + s.slope)),
                               static_cast<double>(std::max(s.value, s.value + s.slope))});
    t.slope = std::max(t.slope, std::fabs(static_cast<double>(s.slope)) / fraction);
    // What is proven of the part of the segment within the domain.
    Segment inside = s;
    const double x0 = std::clamp(from, r.domain.lo, r.domain.hi);
    const double x1 = std::clamp(to, r.domain.lo, r.domain.hi);
    if (x1 - x0 < width * 1e-3) {
      // Only an end lies in it: the line leaves the end's value by no more than its slope.
      t.error = std::max(t.error, std::fabs(value(x0) - s.value) + std::abs(s.slope));
      continue;
    }
    double error = 0;
    if (x0 == from && x1 == to) {
      inside.from = from;
      inside.to = to;
      error = by_curvature(r, inside);
      if (!(error < infinity)) {
        curvature = false;
        error = by_slope(r, inside);
      }
    } else {
      // A cut segment: its line over the part, an end each way.
      const auto line = [&](double x) { return s.value + s.slope * (x - from) / width; };
      const Jet j = r.function({x0, x1});
      const Span ends = hull(Span{value(x0) - line(x0), value(x0) - line(x0)},
                             Span{value(x1) - line(x1), value(x1) - line(x1)});
      const double h = x1 - x0;
      const Span curved = j.d2 * Span{-h * h / 8 / r.value_scale, 0};
      error = curved.size() < infinity
                  ? up((ends + hull(curved, {0, 0})).size())
                  : up((j.v * (1 / r.value_scale) -
                        Span{std::min(line(x0), line(x1)), std::max(line(x0), line(x1))})
                           .size());
    }
    t.error = std::max(t.error, error);
  }
  t.error = up(t.error * (1 + 1e-9));
  t.proof = curvature ? "second derivative by intervals"
                      : "second derivative by intervals, slope over eighths where it has none";
  return t;
}

namespace {

Jet sine_of_turns(const Span& x) { return sine(Jet{x * (2 * pi), {2 * pi, 2 * pi}, {0, 0}}); }

}  // namespace

TableUse sine_turn(std::int32_t limit, double value_scale) {
  TableRequest r{sine_of_turns, {-0.5, 0.5}, std::ldexp(1.0, -21), -256, 512, value_scale, limit};
  TableUse t = make_table(r);
  // Word 0 of the memory is index 0.
  std::rotate(t.words.begin(), t.words.begin() + 256, t.words.end());
  t.low = 0;
  t.wraps = true;
  t.what = "sine, 512 segments a turn";
  return t;
}

TableUse sine_part(int bits, bool cosines, std::int32_t limit, double value_scale) {
  const int count = 1 << bits;
  TableRequest r{sine_of_turns, {-0.5, cosines ? 0.75 : 0.5},        std::ldexp(1.0, -12 - bits),
                 -count / 2,    cosines ? count + count / 4 : count, value_scale,
                 limit};
  TableUse t = make_table(r);
  t.what = fmt::format("sine, {} segments a turn", count);
  return t;
}

}  // namespace feltgate::law
