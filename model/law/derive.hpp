// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The last step of reading a law: formulas of parameters become derived words, and unused nodes are
// removed. Documentation: docs/laws.md
#pragma once

#include <string>
#include <vector>

#include "law/graph.hpp"
#include "law/law.hpp"

namespace feltgate::law {

/// Calls `use` with every root of the graph of a law or a const law (kNone included).
template <class AnyLaw, class Use>
void each_root(AnyLaw& law, Use use) {
  for (auto& s : law.states) {
    use(s.next);
    use(s.follows);
  }
  for (auto& t : law.tables) {
    use(t.argument);
    use(t.body);
  }
  for (auto& l : law.lines) use(l.written);
  for (auto& o : law.outputs) use(o.value);
  for (auto& e : law.events) {
    use(e.value);
    use(e.condition);
  }
}

/// Finishes `law`, whose nodes `graph` made; `graph` must not be used afterwards.
void finish(Law& law, const Graph& graph, Diagnostics& diagnostics);

/// A node as a formula: "2*k/(a + b)"; "..." replaces inner parts beyond 60 characters.
std::string formula(const Law& law, NodeId id);

// Computes the range of a formula of parameters by interval arithmetic.

/// Thrown when a formula has no value somewhere in the ranges of its parameters.
struct NoRange {
  std::string what, mend;
};

/// The range of `node`, which may depend only on constants and parameters; `ranges` holds the
/// ranges of its arguments, by node. Each end is rounded outward by one double; constants and
/// parameters are exact. Throws NoRange when a divisor can be 0, a root's argument can be below 0,
/// or a value can exceed 1e300.
Range host_range(const Law& law, const Node& node, const std::vector<Range>& ranges);

}  // namespace feltgate::law
