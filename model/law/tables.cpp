// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/laws.md
#include "law/back_end.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "feltgate/largest.hpp"

namespace feltgate::law {

namespace {

constexpr int fraction = 4096;
constexpr int pieces = 8;  // parts of a segment that are examined to find its shift

/// A segment: its ends, and the words chosen for it.
struct Segment {
  double from, to;
  std::int32_t value, slope;
};

constexpr int most_halvings = 20;
constexpr int most_looks = 400;

/// The error of a segment's line against the function over x, both in words. The curvature bounds
/// it: its largest effect is curvature * width^2/8, in the middle. At a kink the span is halved
/// repeatedly; the smallest part is bounded by the slope.
double line_error(const TableRequest& r, const Segment& s, const Span& x, int depth, int* looks) {
  const Jet j = r.function(x);
  const double h = x.hi - x.lo;
  const auto line = [&](double t) { return s.value + s.slope * ((t - s.from) / (s.to - s.from)); };
  const auto apart = [&](double t) {
    return r.function({t, t}).v * (1 / r.value_scale) - Span{down(line(t)), up(line(t))};
  };
  const double bend = up(h * h / 8 / r.value_scale);
  const Span curved = j.d2 * Span{-bend, 0};  // function - chord
  // The difference cannot exceed that of the ranges of both.
  const Span whole = j.v * (1 / r.value_scale) -
                     Span{std::min(line(x.lo), line(x.hi)), std::max(line(x.lo), line(x.hi))};
  if (curved.size() < infinity) {
    const double bent = up((hull(apart(x.lo), apart(x.hi)) + hull(curved, {0, 0})).size());
    return std::min(bent, up(whole.size() * (1 + 1e-12)));
  }
  if (depth < most_halvings && ++*looks < most_looks) {
    return std::max(line_error(r, s, {x.lo, x.middle()}, depth + 1, looks),
                    line_error(r, s, {x.middle(), x.hi}, depth + 1, looks));
  }
  const double gradient = s.slope / (s.to - s.from);
  const Span relative = j.d1 * (1 / r.value_scale) - Span{gradient, gradient};
  double error = whole.size();
  if (relative.size() < infinity) {
    error = std::min(error, apart(x.middle()).size() + relative.size() * h / 2);
  }
  return up(error * (1 + 1e-12));
}

}  // namespace

std::function<double(double)> extended(const TableRequest& r) {
  const double width = r.argument_scale * fraction;
  const auto at = [&r](double x) { return r.function({x, x}).v.middle(); };
  const double first = std::ceil(r.domain.lo / width), last = std::floor(r.domain.hi / width);
  const auto rise = [&](double end, double sample) {
    const double part = sample - end;
    if (first > last || std::fabs(part) < width * 1e-3) return 0.0;
    return (at(sample) - at(end)) / part;
  };
  const double low = rise(r.domain.lo, first * width), high = rise(r.domain.hi, last * width);
  return [&r, at, low, high](double x) {
    const double inside = std::clamp(x, r.domain.lo, r.domain.hi);
    return at(inside) + (x - inside) * (x < inside ? low : high);
  };
}

TableUse make_table(const TableRequest& r) {
  TableUse t;
  t.low = r.low;
  t.values = {infinity, -infinity};
  bool halved = false;
  const double width = r.argument_scale * fraction;
  const auto value = [&, f = extended(r)](double x) { return f(x) / r.value_scale; };
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
    t.jumps.push_back(0);
    if (i > 0) {
      const std::uint64_t before = t.words.back();
      const int there = engine_table_value(before) + engine_table_slope(before);
      t.jumps.back() = std::fabs(static_cast<double>(s.value - there));
      t.jump = larger(t.jump, t.jumps.back());
    }
    t.words.push_back(engine_table_word(s.value, s.slope));
    t.values = hull(t.values, {static_cast<double>(std::min(s.value, s.value + s.slope)),
                               static_cast<double>(std::max(s.value, s.value + s.slope))});
    t.slope = std::max(t.slope, std::fabs(static_cast<double>(s.slope)) / fraction);
    // Proves the part of the segment within the domain.
    s.from = from;
    s.to = to;
    const Span inside = {std::clamp(from, r.domain.lo, r.domain.hi),
                         std::clamp(to, r.domain.lo, r.domain.hi)};
    // For a segment outside the domain: the point where its line meets the domain's end.
    int looks = 0;
    const double error = line_error(r, s, inside, 0, &looks);
    halved = halved || looks > 0;
    t.errors.push_back(up(error * (1 + 1e-9)));
    t.error = larger(t.error, t.errors.back());
  }
  const auto slope = [&t](std::size_t i) {
    return std::fabs(static_cast<double>(engine_table_slope(t.words[i]))) / fraction;
  };
  for (std::size_t i = 0; i < t.words.size(); ++i) {
    t.steep.push_back(
        std::max({slope(i), slope(i > 0 ? i - 1 : i), slope(std::min(i + 1, t.words.size() - 1))}));
  }
  t.proof = halved ? "second derivative by intervals, in halves where it has none"
                   : "second derivative by intervals";
  return t;
}

namespace {

Jet sine_of_turns(const Span& x) { return sine(Jet{x * (2 * pi), {2 * pi, 2 * pi}, {0, 0}}); }

}  // namespace

TableUse sine_turn(std::int32_t limit, double value_scale) {
  TableRequest r{sine_of_turns, {-0.5, 0.5}, std::ldexp(1.0, -21), -256, 512, value_scale, limit};
  TableUse t = make_table(r);
  // Rotates the words so that word 0 of the memory is index 0.
  std::rotate(t.words.begin(), t.words.begin() + 256, t.words.end());
  std::rotate(t.errors.begin(), t.errors.begin() + 256, t.errors.end());
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

// Lowers periodic tables: their argument is in turns, as that of the sine.

namespace {

/// Treats the first and the last segment as neighbours.
void join_ends(TableUse& t, bool whole_segments) {
  const std::size_t last = t.words.size() - 1;
  t.steep.front() = t.steep.back() = t.slope;
  t.errors.front() = t.errors.back() = t.error;
  t.jumps.clear();
  if (!whole_segments) return;  // half of one segment at each end
  const int end = engine_table_value(t.words[last]) + engine_table_slope(t.words[last]);
  t.jump =
      std::max(t.jump, std::fabs(static_cast<double>(engine_table_value(t.words.front()) - end)));
}

}  // namespace

Value BackEnd::periodic(NodeId id) {
  const Node& n = node(id);
  const Table& table = law_.tables[at(n.index)];
  const double period = table.domain.upper - table.domain.lower;
  const int words = table_words_left_ / std::max(1, other_tables_);
  int segments = table.segments;
  if (segments == 0) {
    if (words < 2) {
      throw Refused(n.place, "no table memory is left for this",
                    "ask for fewer segments of the other tables");
    }
    segments = 1 << static_cast<int>(std::log2(words));
  }
  const double start = table.domain.lower / period * segments;
  if (!table.points.empty() && std::fabs(start - std::nearbyint(start)) > 1e-9) {
    throw Refused(table.place, "the first point is no whole number of segments from 0",
                  fmt::format("let the table {} begin at 0", table.name));
  }
  const Operand turns = phase(n.arguments[0], std::ldexp(1.0, -32), period);
  // Takes the upper bits of the turn: an index and 12 bits.
  constexpr int drop = 27;  // of mode 3
  Step& index = emit(EngineOp::mlw, 3, turns, constant(std::ldexp(segments, drop - 20)),
                     1 / (4096.0 * segments), id);
  index.turns = true;
  const Operand x = last();
  TableRequest r;
  r.function = [this, &table](const Span& at) { return table_jet(law_, table, at); };
  r.argument_scale = period / segments / 4096;
  r.low = -(segments + 1) / 2;
  r.count = segments + segments % 2;
  r.domain = Span{1.0 * r.low, 1.0 * r.low + r.count} * (period / segments);
  r.limit = 524287;
  const int fraction = value_fraction(r);
  // The table is stored once: its first reader chooses the scale for all.
  const std::string memory = fmt::format("periodic {}", n.index);
  const auto same = memory_scales_.find(memory);
  r.value_scale =
      same != memory_scales_.end() ? same->second : chosen_scale(id, 1, fraction, span(id).size());
  memory_scales_[memory] = r.value_scale;
  if (-std::log2(r.value_scale) > fraction + 0.5) throw Unfit("a table's value has 20 bits", id);
  auto placed = table_keys_.find(memory);
  if (placed == table_keys_.end()) {
    const std::string key = fmt::format("{} {} {:.17g}", memory, segments, r.value_scale);
    auto made = choice_.made.find(key);
    if (made == choice_.made.end()) {
      TableUse t = make_table(r);
      join_ends(t, segments % 2 == 0);
      t.what = table.name;
      made = choice_.made.emplace(key, t).first;
    }
    place_table(memory, made->second);
    placed = table_keys_.find(memory);
  }
  Step& s = emit(EngineOp::lrp, 0, x, {}, r.value_scale, id);
  s.table = placed->second;
  s.argument_scale = r.argument_scale;
  s.node = id;
  return {last(), r.value_scale, 0};
}

}  // namespace feltgate::law
