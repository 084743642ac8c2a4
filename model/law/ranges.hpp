// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Computes the ranges of a law's nodes by interval arithmetic over a cell of its inputs, parameters
// and states. Documentation: docs/laws.md
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "law/law.hpp"
#include "law/spans.hpp"
#include "law/target.hpp"

namespace feltgate::law {

/// Thrown when the compiler refuses a law: place, reason and mend in one text.
class Refused : public std::invalid_argument {
 public:
  Refused(const Place& place, const std::string& reason, const std::string& mend)
      : std::invalid_argument(reason + "; " + mend), place(place), reason(reason), mend(mend) {}
  Refused(const std::string& reason, const std::string& mend) : Refused(Place{}, reason, mend) {}
  Place place;
  std::string reason, mend;
};

/// A box of values, in the order of Law::inputs, ::parameters, ::states.
struct Cell {
  std::vector<Span> inputs, parameters, states;
  /// Sums of squares or amounts, and the part of their range to which the cell is confined.
  std::vector<std::pair<NodeId, Span>> sums;
};

/// The cell of all values that the law declares or that the design's formats can hold.
Cell whole_cell(const Law& law, const Target& target);

/// Whether the compiler makes tables of its own for the function.
inline bool has_pieces(Op op) {
  return op == Op::root || op == Op::reciprocal || op == Op::exponential || op == Op::logarithm;
}

/// Whether the node is a function of one number, which function_of() computes.
inline bool is_function(Op op) {
  return has_pieces(op) || op == Op::sine || op == Op::cosine || op == Op::arctangent;
}
/// Its value over a span or a jet.
template <typename T>
T function_of(Op op, const T& x) {
  switch (op) {
    case Op::sine:
      return sine(x);
    case Op::cosine:
      return cosine(x);
    case Op::root:
      return root(x);
    case Op::reciprocal:
      return inverse(x);
    case Op::exponential:
      return exponential(x);
    case Op::logarithm:
      return logarithm(x);
    default:
      return arctangent(x);
  }
}

/// The range of every node over the cell; a truth value has a part of [0, 1]. Nodes that occur only
/// in bodies of tables have an empty range.
std::vector<Span> ranges(const Law& law, const Cell& cell);

/// ranges() of one law over many cells: less work for each. The law must not change meanwhile.
class RangesOf {
 public:
  explicit RangesOf(const Law& law);
  ~RangesOf();
  RangesOf(const RangesOf&) = delete;
  RangesOf& operator=(const RangesOf&) = delete;
  /// The ranges over the cell, valid until the next call.
  const std::vector<Span>& over(const Cell& cell);
  /// Narrows the cell's inputs and states to what its sums allow.
  void narrow_by_sums(Cell* cell);

 private:
  class Work;
  const Law& law_;
  std::unique_ptr<Work> work_;  ///< made with the first cell
};

/// The sums of squares or amounts that a reciprocal is of, e.g. x^2 + y^2 of 1 / sqrt(x^2 + y^2).
std::vector<NodeId> sums_of(const Law& law);
/// The cell with these sums, over their whole ranges.
Cell with_sums(const Law& law, Cell cell);

/// What the cell's sums, and Law::known, say about every node's range. `spans`: the ranges without.
std::vector<Span> limits_by_sums(const Law& law, const Cell& cell, const std::vector<Span>& spans);
/// The range of a product. In a cell with sums, that of x / r with r >= |x| is -1 .. 1; formats are
/// chosen without, because words may lie outside where their error is large.
Span product_range(const Law& law, const Cell& cell, const std::vector<Span>& spans, const Node& n);

/// A table's body, or a function of a node, as a jet of its argument.
Jet table_jet(const Law& law, const Table& table, const Span& argument);
double table_value(const Law& law, const Table& table, double argument);

/// Narrows the range of a node x - y if requirement `r` orders these two nodes: to at least 0 for
/// y <= x, to at most 0 for x <= y.
void narrow_difference(const Node& n, const Requirement& r, double* lower, double* upper);

/// Nodes that outputs, events and states need, arguments before users.
std::vector<NodeId> needed(const Law& law);

/// Per node, an interval to which its value may be clamped without a change of any root of the law:
/// beyond it, every user has the same value. min(x, 1) needs x up to 1, x < 2 needs it a little
/// further than 2; a user that is not looked at needs all of it. Empty for nodes without users.
std::vector<Span> interest(const Law& law, const std::vector<Span>& spans);
/// How far beyond the range of the other operand a compared value still matters to interest(): more
/// than the comparison's strip, or words decide otherwise than the law.
double room_beside(const Span& own, const Span& other);

/// Per node, whether the host can compute it: it depends only on constants and on parameters that
/// are not mailboxes.
std::vector<char> fixed_nodes(const Law& law);

}  // namespace feltgate::law
