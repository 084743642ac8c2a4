// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What values a law's nodes can take, by intervals over a cell of its inputs, parameters and
// states. Documentation: docs/law-compiler.md
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "law/law.hpp"
#include "law/spans.hpp"
#include "law/target.hpp"

namespace feltgate::law {

/// What the compiler refuses: place, reason and mend in one text.
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
};

/// Everything that the law declares or the design's formats hold.
Cell whole_cell(const Law& law, const Target& target);

/// A function that gets tables of the compiler's own.
inline bool has_pieces(Op op) {
  return op == Op::root || op == Op::reciprocal || op == Op::exponential || op == Op::logarithm;
}

/// Every node's range over the cell; truth values are parts of [0, 1]. Nodes that only the bodies
/// of tables have are empty.
std::vector<Span> ranges(const Law& law, const Cell& cell);

/// A table's body, or a function of a node, as a jet of its argument.
Jet table_jet(const Law& law, const Table& table, const Span& argument);
double table_value(const Law& law, const Table& table, double argument);

/// x - y is not below 0 where y <= x is required; the same nodes, in the same numbers.
void narrow_difference(const Node& n, const Requirement& r, double* lower, double* upper);

/// Nodes that outputs, events and states need, arguments before users.
std::vector<NodeId> needed(const Law& law);

/// Depends on nothing but constants and parameters that are no mailbox: the host can compute it.
std::vector<char> fixed_nodes(const Law& law);

}  // namespace feltgate::law
