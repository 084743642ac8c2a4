// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Builds a law's nodes: merges equal nodes, folds constants, and collects the factors that are
// fixed during a run. Documentation: docs/laws.md
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "law/diagnostics.hpp"
#include "law/law.hpp"

namespace feltgate::law {

/// No node: its error is already reported. Every function accepts it and returns it.
inline constexpr NodeId kNone = -1;

class Graph {
 public:
  /// Both must outlive the graph.
  Graph(Law& law, Diagnostics& diagnostics) : law_(law), diagnostics_(diagnostics) {}

  const Node& node(NodeId id) const { return law_.nodes[static_cast<std::size_t>(id)]; }
  /// Whether the host knows the node's value: it depends only on constants and on parameters that
  /// are not mailboxes.
  bool is_fixed(NodeId id) const { return fixed_[static_cast<std::size_t>(id)]; }
  bool is_constant(NodeId id) const { return node(id).op == Op::constant; }

  NodeId constant(double value, const Unit& unit, Place place);
  NodeId truth(bool value, Place place);
  /// A parameter, input or state.
  NodeId leaf(Op op, int index, const Unit& unit, Place place);
  /// The node of the variable in a table's body.
  NodeId table_argument(int table, const Unit& unit, Place place);

  /// Operand kinds (number or truth value) and units must fit; min, max and the values of select
  /// need equal units.
  NodeId add(NodeId a, NodeId b, Place place);
  NodeId subtract(NodeId a, NodeId b, Place place);
  NodeId multiply(NodeId a, NodeId b, Place place);
  NodeId divide(NodeId a, NodeId b, Place place);
  NodeId negate(NodeId a, Place place);
  NodeId absolute(NodeId a, Place place);
  NodeId smaller(NodeId a, NodeId b, Place place);
  NodeId larger(NodeId a, NodeId b, Place place);
  NodeId less(NodeId a, NodeId b, Place place);
  NodeId both(NodeId a, NodeId b, Place place);
  NodeId either(NodeId a, NodeId b, Place place);
  NodeId opposite(NodeId a, Place place);
  NodeId select(NodeId condition, NodeId yes, NodeId no, Place place);
  /// sine, cosine, root, exponential, logarithm
  NodeId function(Op op, NodeId a, Place place);
  NodeId lookup(int table, NodeId a, const Unit& unit, Place place);
  NodeId element(int array, NodeId a, Place place);
  NodeId line_read(int line, NodeId a, const Unit& unit, Place place);

 private:
  using Key = std::tuple<Op, std::vector<NodeId>, int, double, bool, std::array<int, 4>>;

  NodeId make(Op op, std::vector<NodeId> arguments, const Unit& unit, Place place, int index = -1,
              double value = 0, bool truth = false);
  /// A product of fixed nodes: at most one number, in front, and no sign inside.
  NodeId fixed_product(NodeId a, NodeId b, Place place);
  /// `factor` (fixed) times `a` (changes during a run); `factor` merges with a fixed factor of `a`
  /// where possible.
  NodeId scale(NodeId factor, NodeId a, Place place);
  NodeId extreme(Op op, NodeId a, NodeId b, Place place);
  /// Whether `id` is a product with a fixed first factor.
  bool is_scaled(NodeId id) const;
  bool is_value(NodeId id, double value) const;
  NodeId argument(NodeId id, std::size_t i) const { return node(id).arguments[i]; }

  Law& law_;
  Diagnostics& diagnostics_;
  std::vector<bool> fixed_;
  std::map<Key, NodeId> known_;
};

}  // namespace feltgate::law
