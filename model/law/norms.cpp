// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Ranges of x / r with r >= |x|, and cells that are parts of a sum of squares or amounts.
// Documentation: docs/law-compiler.md
#include "law/ranges.hpp"

#include <algorithm>

namespace feltgate::law {

namespace {

/// What a sum's part of its range says about the nodes below it.
class Limits {
 public:
  Limits(const Law& law, const std::vector<Span>& spans)
      : law_(law), spans_(spans), limits_(spans.size(), whole_line()) {}

  std::vector<Span> run(const Cell& cell) {
    for (const auto& [id, range] : law_.known) limits_[at(id)] = {range.lower, range.upper};
    for (const auto& [id, s] : cell.sums) {
      limit(id, s);
      limit_terms(id, s.hi);
    }
    return std::move(limits_);
  }

 private:
  const Node& node(NodeId id) const { return law_.nodes[at(id)]; }

  /// The node's value lies in `s`; so do those of which it is a limit, a negative or a multiple.
  void limit(NodeId id, Span s) {
    limits_[at(id)] = both_of(limits_[at(id)], s);
    const Node& n = node(id);
    if (n.op == Op::negate) limit(n.arguments[0], -s);
    if (n.arguments.size() != 2) return;
    const int c = node(n.arguments[0]).op == Op::constant ? 0 : 1;
    if (node(n.arguments[at(c)]).op != Op::constant) return;
    const double number = node(n.arguments[at(c)]).value;
    const NodeId other = n.arguments[at(1 - c)];
    if (n.op == Op::multiply && number != 0) limit(other, s * inverse(Span{number, number}));
    if (n.op == Op::maximum) limit(other, {number < s.lo ? s.lo : -infinity, s.hi});
    if (n.op == Op::minimum) limit(other, {s.lo, number > s.hi ? s.hi : infinity});
  }

  /// The terms of a sum that is at most `most`.
  void limit_terms(NodeId id, double most) {
    const Node& n = node(id);
    const auto arg = [&](int i) { return n.arguments[at(i)]; };
    if (n.op == Op::add) {
      for (int i = 0; i < 2; ++i) limit_terms(arg(i), up(most - spans_[at(arg(1 - i))].lo));
    } else if (n.op == Op::absolute) {
      limit(arg(0), {-most, most});
    } else if (n.op == Op::multiply && arg(0) == arg(1)) {
      const double end = root(Span{0, most}).hi;
      limit(arg(0), {-end, end});
    } else if (n.op == Op::multiply && node(arg(0)).op == Op::constant && node(arg(0)).value > 0) {
      limit_terms(arg(1), up(most / node(arg(0)).value));
    }
  }

  const Law& law_;
  const std::vector<Span>& spans_;
  std::vector<Span> limits_;
};

/// Whether r >= |x|: a root of x^2 and more, or |x| and more.
bool reaches(const Law& law, const std::vector<Span>& spans, NodeId r, NodeId x, bool squared) {
  const Node& n = law.nodes[at(r)];
  const auto arg = [&](int i) { return n.arguments[at(i)]; };
  if (n.op == Op::root && !squared) return reaches(law, spans, arg(0), x, true);
  if (n.op == Op::absolute && !squared) return arg(0) == x;
  if (n.op == Op::multiply && squared) return arg(0) == x && arg(1) == x;
  if (n.op == Op::maximum)
    return reaches(law, spans, arg(0), x, squared) || reaches(law, spans, arg(1), x, squared);
  if (n.op != Op::add) return false;
  return (spans[at(arg(0))].lo >= 0 && reaches(law, spans, arg(1), x, squared)) ||
         (spans[at(arg(1))].lo >= 0 && reaches(law, spans, arg(0), x, squared));
}

/// The number of squares and amounts of which the node is a sum; -1: of something else, too.
int count_terms(const Law& law, NodeId id) {
  const Node& n = law.nodes[at(id)];
  if (n.op == Op::constant) return n.value >= 0 ? 0 : -1;
  if (n.op == Op::absolute) return 1;
  if (n.op != Op::multiply && n.op != Op::add) return -1;
  if (n.op == Op::multiply && n.arguments[0] == n.arguments[1]) return 1;
  const int a = count_terms(law, n.arguments[0]), b = count_terms(law, n.arguments[1]);
  if (n.op == Op::multiply) return law.nodes[at(n.arguments[0])].op == Op::constant ? a + b : -1;
  return a < 0 || b < 0 ? -1 : a + b;
}

void find_sums(const Law& law, NodeId id, std::vector<NodeId>* found) {
  const Node& n = law.nodes[at(id)];
  if (count_terms(law, id) >= 2) {
    if (std::find(found->begin(), found->end(), id) == found->end()) found->push_back(id);
    return;
  }
  if (n.op != Op::root && n.op != Op::minimum && n.op != Op::maximum && n.op != Op::add) return;
  for (const NodeId a : n.arguments) find_sums(law, a, found);
}

}  // namespace

std::vector<Span> limits_by_sums(const Law& law, const Cell& cell, const std::vector<Span>& spans) {
  return Limits(law, spans).run(cell);
}

/// k x / r with r >= |x| lies between -|k| and |k|.
Span product_range(const Law& law, const Cell& cell, const std::vector<Span>& spans,
                   const Node& n) {
  const Span all = spans[at(n.arguments[0])] * spans[at(n.arguments[1])];
  // Formats are chosen without this: words may lie outside where their error is large.
  for (int i = 0; i < 2 && !cell.sums.empty(); ++i) {
    const Node& r = law.nodes[at(n.arguments[at(i)])];
    if (r.op != Op::reciprocal) continue;
    NodeId x = n.arguments[at(1 - i)];
    Span k{1, 1};
    const Node& scaled = law.nodes[at(x)];
    const bool by = scaled.op == Op::multiply && scaled.arguments[0] != scaled.arguments[1];
    if (by && (law.nodes[at(scaled.arguments[0])].op == Op::constant ||
               law.nodes[at(scaled.arguments[0])].op == Op::parameter)) {
      k = spans[at(scaled.arguments[0])];
      x = scaled.arguments[1];
    }
    const Span inside = both_of(all, {-k.size(), k.size()});
    if (reaches(law, spans, r.arguments[0], x, false) && !inside.empty()) return inside;
  }
  return all;
}

std::vector<NodeId> sums_of(const Law& law) {
  std::vector<NodeId> found;
  for (const NodeId id : needed(law)) {
    const Node& n = law.nodes[at(id)];
    if (n.op == Op::reciprocal) find_sums(law, n.arguments[0], &found);
  }
  return found;
}

Cell with_sums(const Law& law, Cell cell) {
  const std::vector<Span> spans = ranges(law, cell);
  for (const NodeId id : sums_of(law)) {
    if (spans[at(id)].size() < infinity) cell.sums.emplace_back(id, spans[at(id)]);
  }
  return cell;
}

void narrow_by_sums(const Law& law, Cell* cell) {
  if (cell->sums.empty()) return;
  const std::vector<Span> spans = ranges(law, *cell);
  for (const NodeId id : needed(law)) {
    const Node& n = law.nodes[at(id)];
    if (n.op == Op::input) cell->inputs[at(n.index)] = spans[at(id)];
    if (n.op == Op::state) cell->states[at(n.index)] = spans[at(id)];
  }
}

}  // namespace feltgate::law
