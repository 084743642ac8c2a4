// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The last step of reading a law: formulas of parameters become words of their own, and nodes that
// nothing needs go. Documentation: docs/laws.md
#pragma once

#include <string>

#include "law/graph.hpp"

namespace feltgate::law {

/// Calls `use` with every place from which a run's nodes are reached; kNone among them.
template <class Use>
void each_root(Law& law, Use use) {
  for (State& s : law.states) {
    use(s.next);
    use(s.follows);
  }
  for (Table& t : law.tables) {
    use(t.argument);
    use(t.body);
  }
  for (Line& l : law.lines) use(l.written);
  for (Output& o : law.outputs) use(o.value);
  for (Event& e : law.events) {
    use(e.value);
    use(e.condition);
  }
}

/// `graph` made the nodes of `law`, and is of no use afterwards.
void finish(Law& law, const Graph& graph, Diagnostics& diagnostics);

/// A node as a formula: "2*k/(a + b)"; "..." inside where it would get longer than 60 letters.
std::string formula(const Law& law, NodeId id);

}  // namespace feltgate::law
