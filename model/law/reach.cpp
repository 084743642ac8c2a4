// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/laws.md
#include "law/reach.hpp"

#include <algorithm>

namespace feltgate::law {

namespace {

constexpr std::size_t kMostCells = 16;  ///< of one side of a condition
constexpr int kMostSides = 1000;        ///< looked at for a value

class Reach {
 public:
  Reach(const Law& law, RangesOf& ranges) : law_(law), ranges_(ranges) {}

  Span of(NodeId id, const Cell& cell) {
    const Node& n = law_.nodes[at(id)];
    if (n.op != Op::select || ++sides_ > kMostSides) return ranges_.over(cell)[at(id)];
    Span all{1, 0};
    for (const bool truth : {true, false}) {
      for (const Cell& part : where(n.arguments[0], truth, cell)) {
        all = hull(all, of(n.arguments[truth ? 1 : 2], part));
      }
    }
    return all;
  }

 private:
  /// Cells that together hold every value of `cell` with which the condition is `truth`.
  std::vector<Cell> where(NodeId condition, bool truth, const Cell& cell) {
    const Node& n = law_.nodes[at(condition)];
    if (n.op == Op::opposite) return where(n.arguments[0], !truth, cell);
    if (n.op == Op::less) return compared(n, truth, cell);
    if (n.op != Op::both && n.op != Op::either) return {cell};
    std::vector<Cell> all;
    if ((n.op == Op::both) == truth) {  // both sides say something
      for (const Cell& first : where(n.arguments[0], truth, cell)) {
        for (Cell& second : where(n.arguments[1], truth, first)) all.push_back(std::move(second));
      }
    } else {
      all = where(n.arguments[0], truth, cell);
      for (Cell& other : where(n.arguments[1], truth, cell)) all.push_back(std::move(other));
    }
    if (all.size() > kMostCells) return {cell};
    return all;
  }

  std::vector<Cell> compared(const Node& n, bool truth, Cell cell) {
    const NodeId x = n.arguments[0], y = n.arguments[1];
    const Span a = ranges_.over(cell)[at(x)], b = ranges_.over(cell)[at(y)];
    // Whole numbers that are not the same are one apart.
    const double apart = truth && law_.nodes[at(x)].whole && law_.nodes[at(y)].whole ? 1 : 0;
    const bool possible =
        truth ? narrow(x, {-infinity, b.hi - apart}, &cell) &&
                    narrow(y, {a.lo + apart, infinity}, &cell)
              : narrow(x, {b.lo, infinity}, &cell) && narrow(y, {-infinity, a.hi}, &cell);
    if (!possible) return {};
    return {cell};
  }

  /// Narrows what the node reads to `to`; false if nothing is left.
  bool narrow(NodeId id, const Span& to, Cell* cell) const {
    const Node& n = law_.nodes[at(id)];
    if (n.op == Op::constant) return n.value >= to.lo && n.value <= to.hi;
    Span* const own = n.op == Op::state                   ? &cell->states[at(n.index)]
                      : n.op == Op::parameter             ? &cell->parameters[at(n.index)]
                      : n.op == Op::input && n.index >= 0 ? &cell->inputs[at(n.index)]
                                                          : nullptr;
    if (own == nullptr) return true;
    *own = both_of(*own, to);
    return !own->empty();
  }

  const Law& law_;
  RangesOf& ranges_;
  int sides_ = 0;
};

}  // namespace

Span reach(const Law& law, RangesOf& ranges, NodeId id, const Cell& cell) {
  return Reach(law, ranges).of(id, cell);
}

}  // namespace feltgate::law
