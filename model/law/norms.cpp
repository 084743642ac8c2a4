// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Ranges of x / r with r >= |x|, and cells that are parts of a sum of squares or amounts.
// Documentation: docs/laws.md
#include "law/ranges.hpp"

#include <algorithm>
#include <utility>

namespace feltgate::law {

namespace {

/// What a sum's part of its range says about the nodes below it.
class Limits {
 public:
  Limits(const Law& law, const std::vector<Span>& spans)
      : law_(law),
        spans_(spans),
        limits_(spans.size(), whole_line()),
        most_(spans.size(), infinity) {}

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

  /// The terms of a sum that is at most `most`. A node that is read twice is limited again only by
  /// less.
  void limit_terms(NodeId id, double most) {
    if (!(most < most_[at(id)])) return;
    most_[at(id)] = most;
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
  std::vector<double> most_;
};

/// Whether a node r is at least |x|: a root of x^2 and more, or |x| and more.
class AtLeast {
 public:
  AtLeast(const Law& law, const std::vector<Span>& spans, NodeId x)
      : law_(law), spans_(spans), x_(x), missed_(spans.size(), 0) {}

  bool of(NodeId r, bool squared = false) {
    char& missed = missed_[at(r)];
    const char bit = squared ? 2 : 1;
    if ((missed & bit) != 0 || !reaches(law_.nodes[at(r)], squared)) {
      missed = static_cast<char>(missed | bit);
      return false;
    }
    return true;
  }

 private:
  bool reaches(const Node& n, bool squared) {
    const auto arg = [&](int i) { return n.arguments[at(i)]; };
    const auto positive = [&](int i) { return spans_[at(arg(i))].lo >= 0; };
    if (n.op == Op::root && !squared) return of(arg(0), true);
    if (n.op == Op::absolute && !squared) return arg(0) == x_;
    if (n.op == Op::multiply && squared) return arg(0) == x_ && arg(1) == x_;
    if (n.op == Op::maximum) return of(arg(0), squared) || of(arg(1), squared);
    return n.op == Op::add &&
           ((positive(0) && of(arg(1), squared)) || (positive(1) && of(arg(0), squared)));
  }

  const Law& law_;
  const std::vector<Span>& spans_;
  NodeId x_;
  std::vector<char> missed_;
};

/// For each node the number of squares and amounts of which it is a sum; -1: of something else,
/// too.
std::vector<int> terms(const Law& law) {
  constexpr int kMost = 1000;  // more count as many: a sum of itself doubles
  std::vector<int> count(law.nodes.size(), -1);
  // Arguments come before the nodes that read them.
  for (std::size_t i = 0; i < count.size(); ++i) {
    const Node& n = law.nodes[i];
    const auto arg = [&](int k) { return n.arguments[at(k)]; };
    const auto of = [&](int k) { return count[at(arg(k))]; };
    if (n.op == Op::constant && n.value >= 0) count[i] = 0;
    if (n.op == Op::absolute || (n.op == Op::multiply && arg(0) == arg(1))) count[i] = 1;
    if (n.op == Op::multiply && arg(0) != arg(1) && law.nodes[at(arg(0))].op == Op::constant &&
        of(0) == 0) {
      count[i] = of(1);
    }
    if (n.op == Op::add && of(0) >= 0 && of(1) >= 0) count[i] = std::min(of(0) + of(1), kMost);
  }
  return count;
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
    if (AtLeast(law, spans, x).of(r.arguments[0]) && !inside.empty()) return inside;
  }
  return all;
}

std::vector<NodeId> sums_of(const Law& law) {
  const std::vector<int> count = terms(law);
  std::vector<NodeId> found, next;
  std::vector<char> seen(law.nodes.size(), 0);
  for (const NodeId id : needed(law)) {
    const Node& n = law.nodes[at(id)];
    if (n.op == Op::reciprocal) next.push_back(n.arguments[0]);
  }
  while (!next.empty()) {
    const NodeId id = next.back();
    next.pop_back();
    if (std::exchange(seen[at(id)], 1) != 0) continue;
    const Node& n = law.nodes[at(id)];
    if (count[at(id)] >= 2) {
      found.push_back(id);
    } else if (n.op == Op::root || n.op == Op::minimum || n.op == Op::maximum || n.op == Op::add) {
      next.insert(next.end(), n.arguments.begin(), n.arguments.end());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

Cell with_sums(const Law& law, Cell cell) {
  const std::vector<Span> spans = ranges(law, cell);
  for (const NodeId id : sums_of(law)) {
    if (spans[at(id)].size() < infinity) cell.sums.emplace_back(id, spans[at(id)]);
  }
  return cell;
}

}  // namespace feltgate::law
