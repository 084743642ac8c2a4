// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lowers functions that are composed of others: the passes after the reader do not know them.
// Documentation: docs/laws.md
#include <fmt/format.h>

#include <cmath>

#include "law/lowering.hpp"

namespace feltgate::law {

namespace {

constexpr int kMostWhole = 64;    ///< largest number of values of floor
constexpr int kMostRanged = 128;  ///< largest number of calls that use their argument's range
constexpr int kNoiseBits = 20;    ///< of noise's two phases, which repeat after 2^21 runs
constexpr double kLeastShare = 1.0 / 128;  ///< of the ranges of x and y: the floor of |x| + |y|

}  // namespace

/// The range of a node by the file's declarations; an input has no limits.
Span Lowering::range_of(NodeId id, const Expression& e) {
  if (++ranged_ > kMostRanged) {
    report(e.offset, fmt::format("more than {} calls of floor, mod and atan2", kMostRanged),
           "make the loops shorter; the engine's program has 512");
    throw TooLong();
  }
  Law part = law_;
  part.outputs = {Output{"", 0, id, {}}};
  part.events.clear();
  Cell cell;
  cell.inputs.assign(part.inputs.size(), whole_line());
  for (const Parameter& p : part.parameters)
    cell.parameters.push_back({p.range.lower, p.range.upper});
  for (State& s : part.states) {
    s.next = kNone;
    cell.states.push_back(s.follows == kNone ? Span{s.range.lower, s.range.upper} : whole_line());
  }
  for (Line& l : part.lines) l.written = kNone;
  return ranges(part, cell)[static_cast<std::size_t>(id)];
}

/// floor(x), as an element of an array of whole numbers with index x.
NodeId Lowering::floored(NodeId x, const Expression& e) {
  const Place place = at(e.offset);
  if (x == kNone || graph_.node(x).whole) return x;
  if (graph_.is_constant(x))
    return graph_.constant(std::floor(graph_.node(x).value), kNumber, place);
  if (graph_.is_fixed(x)) {
    report(e.offset, e.name + " of what only depends on parameters",
           "make a parameter of it, which may be whole");
    return kNone;
  }
  const Span range = range_of(x, e);
  const double first = std::floor(range.lo), count = std::floor(range.hi) - first + 1;
  if (!(count <= kMostWhole)) {
    report(
        e.offset,
        count < infinity ? fmt::format("{} of what takes {:.6g} whole numbers", e.name, count)
                         : e.name + " of what has no end",
        fmt::format("limit it with clamp to {} of them; what repeats for ever is a periodic table",
                    kMostWhole));
    return kNone;
  }
  if (floor_array_ < 0) {
    floor_array_ = static_cast<int>(law_.arrays.size());
    law_.arrays.push_back({own_name("floor", place), kNumber, {}, place});
  }
  std::vector<double>& all = law_.arrays[static_cast<std::size_t>(floor_array_)].values;
  while (static_cast<double>(all.size()) < count) all.push_back(static_cast<double>(all.size()));
  const NodeId from = graph_.constant(first, kNumber, place);
  return graph_.add(graph_.element(floor_array_, graph_.subtract(x, from, place), place), from,
                    place);
}

NodeId Lowering::floor_call(const Expression& e) {
  if (!takes(e, 1, "floor(x)")) return kNone;
  return floored(number_in(e.arguments[0], kNumber, "the argument of floor"), e);
}

/// floor(x + 0.5): halves go up.
NodeId Lowering::round_call(const Expression& e) {
  if (!takes(e, 1, "round(x)")) return kNone;
  const NodeId x = number_in(e.arguments[0], kNumber, "the argument of round");
  if (x == kNone || graph_.node(x).whole) return x;
  const Place place = at(e.offset);
  return floored(graph_.add(x, graph_.constant(0.5, kNumber, place), place), e);
}

/// x - m floor(x / m), from 0 to m.
NodeId Lowering::mod(const Expression& e) {
  if (!takes(e, 2, "mod(x, 15 deg)")) return kNone;
  const ExpressionPtr &ex = e.arguments[0], &em = e.arguments[1];
  const Place place = at(e.offset);
  NodeId x = number_of(ex), m = number_of(em);
  if (!fit(x, m, *ex, *em, em->offset, "and")) return kNone;
  const Node period = graph_.node(m);
  if (!graph_.is_constant(m) || !(period.value > 0)) {
    report(em->offset, "the period of mod is no constant above 0", "write mod(x, 15 deg)");
    return kNone;
  }
  NodeId inside = x, most = m;
  if (graph_.node(x).whole && period.whole) {
    most = graph_.constant(period.value - 1, period.unit, place);
    // Moves x midway between whole numbers, where rounding cannot reach another one.
    inside = graph_.add(x, graph_.constant(0.5, kNumber, place), place);
  }
  const NodeId periods = floored(graph_.divide(inside, m, place), e);
  const NodeId rest = graph_.subtract(x, graph_.multiply(m, periods, place), place);
  const NodeId zero = graph_.constant(0, period.unit, place);
  return graph_.smaller(graph_.larger(rest, zero, place), most, place);
}

/// A name for an internal table or array that does not occur in the file.
std::string Lowering::own_name(std::string name, Place place) {
  while (defined_.count(name) != 0) name += "_";
  defined_.emplace(name, place);
  return name;
}

/// The angle, 0 to pi, by c = x / (|x| + |y|): pi/2 -+ (pi/4 + atan(2 |c| - 1)).
int Lowering::angle_table(Place place) {
  if (angle_table_ >= 0) return angle_table_;
  const auto number = [&](double value) { return graph_.constant(value, kNumber, place); };
  angle_table_ = static_cast<int>(law_.tables.size());
  Table t;
  t.name = own_name("atan2", place);
  t.domain = {-1, 1};
  t.argument = graph_.table_argument(angle_table_, kNumber, place);
  t.place = place;
  const auto quarter = [&](NodeId c) {
    const NodeId q = graph_.multiply(number(2), graph_.larger(c, number(0), place), place);
    return graph_.add(number(kPi / 4),
                      graph_.function(Op::arctangent, graph_.subtract(q, number(1), place), place),
                      place);
  };
  const NodeId right = graph_.subtract(number(kPi / 2), quarter(t.argument), place);
  t.body = graph_.add(right, quarter(graph_.negate(t.argument, place)), place);
  law_.tables.push_back(t);
  return angle_table_;
}

/// atan2(y, x), without a comparison other than y < 0. Near (0, 0), a floor replaces |x| + |y|.
NodeId Lowering::angle(const Expression& e) {
  if (!takes(e, 2, "atan2(y, x)")) return kNone;
  const ExpressionPtr &ey = e.arguments[0], &ex = e.arguments[1];
  const Place place = at(e.offset);
  NodeId y = number_of(ey), x = number_of(ex);
  if (!fit(y, x, *ey, *ex, ex->offset, "and")) return kNone;
  if (graph_.is_constant(y) && graph_.is_constant(x)) {
    const double a = graph_.node(y).value, b = graph_.node(x).value;
    return graph_.constant(a == 0 && b == 0 ? kPi / 2 : std::atan2(a, b), kNumber, place);
  }
  if (in_table_ || (graph_.is_fixed(y) && graph_.is_fixed(x))) {
    report(e.offset, in_table_ ? "atan2 in a table" : "atan2 of what only depends on parameters",
           in_table_ ? "take it out of the table, into its argument" : "make a parameter of it");
    return kNone;
  }
  const double ends = range_of(y, e).size() + range_of(x, e).size();
  if (!(ends < infinity)) {
    report(e.offset, "atan2 of what has no end",
           "limit both with clamp, the smallest range is the most exact one");
    return kNone;
  }
  const NodeId least = graph_.constant(ends * kLeastShare, graph_.node(x).unit, place);
  const NodeId sum = graph_.add(graph_.absolute(x, place), graph_.absolute(y, place), place);
  const NodeId across = graph_.divide(x, graph_.larger(sum, least, place), place);
  const NodeId upper = graph_.lookup(angle_table(place), across, kNumber, place);
  // A limit beyond 0 does not change the sign: y without it may be exact.
  for (const Node* n = &graph_.node(y); n->op == Op::minimum || n->op == Op::maximum;
       n = &graph_.node(y)) {
    const int c = graph_.is_constant(n->arguments[0]) ? 0 : 1;
    const double end = graph_.node(n->arguments[law::at(c)]).value;
    if (!graph_.is_constant(n->arguments[law::at(c)])) break;
    if (n->op == Op::minimum ? end < 0 : end >= 0) break;
    y = n->arguments[law::at(1 - c)];
  }
  const NodeId below = graph_.less(y, graph_.constant(0, graph_.node(y).unit, place), place);
  return graph_.select(below, graph_.negate(upper, place), upper, place);
}

/// Noise: a phase whose increment is a second phase with a constant increment. It takes all values
/// equally often, and over many runs it is uncorrelated with its earlier values.
NodeId Lowering::noise(const Expression& e) {
  if (!takes(e, 1, "noise(1)")) return kNone;
  const Place place = at(e.offset);
  const int seed = whole_of(e.arguments[0], "the seed of noise", 0, 9999);
  const auto known = noises_.find(seed);
  if (known != noises_.end()) return known->second;
  const auto number = [&](double value) { return graph_.constant(value, kNumber, place); };
  // Fractions of a turn in units of 2^-20: each seed has its own.
  const auto part = [](double x) { return std::floor((x - std::floor(x)) * 0x1p20) * 0x1p-20; };
  const double irrational = part(0.6180339887498949 + seed * 0.0137719);
  const double step = std::floor(irrational * 0x1p19) * 0x1p-19 + 0x1p-20;  // odd
  NodeId before = number(step);
  for (int i = 0; i < 2; ++i) {
    State s;
    s.name = fmt::format("noise_{}{}", seed, i == 0 ? "_step" : "");
    s.initial = part((seed + 1) * (i == 0 ? 0.7548776662466927 : 0.5698402909980532));
    s.range = {0, 1};
    s.phase = true;
    s.least_fraction = kNoiseBits;
    s.place = place;
    const auto index = static_cast<int>(law_.states.size());
    law_.states.push_back(s);
    const NodeId now = graph_.leaf(Op::state, index, kNumber, place);
    law_.states[static_cast<std::size_t>(index)].next = graph_.add(now, before, place);
    has_next_.insert(s.name);
    before = now;
  }
  return noises_[seed] =
             graph_.subtract(graph_.multiply(number(2), before, place), number(1), place);
}

}  // namespace feltgate::law
