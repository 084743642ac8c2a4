// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Which nodes a run needs, and which the host computes. Documentation: docs/law-compiler.md
#include "law/ranges.hpp"

namespace feltgate::law {

std::vector<NodeId> needed(const Law& law) {
  std::vector<char> wanted(law.nodes.size(), 0);
  std::vector<NodeId> stack;
  const auto want = [&](NodeId id) {
    if (id >= 0 && wanted[at(id)] == 0) {
      wanted[at(id)] = 1;
      stack.push_back(id);
    }
  };
  for (const Output& o : law.outputs) want(o.value);
  for (const Event& e : law.events) {
    want(e.value);
    want(e.condition);
  }
  for (const State& s : law.states) want(s.next);
  for (const Line& l : law.lines) want(l.written);
  while (!stack.empty()) {
    const NodeId id = stack.back();
    stack.pop_back();
    const Node& n = law.nodes[at(id)];
    for (const NodeId a : n.arguments) want(a);
    if (n.op == Op::parameter) want(law.parameters[at(n.index)].derived);
  }
  std::vector<NodeId> list;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (wanted[i] != 0) list.push_back(static_cast<NodeId>(i));
  }
  return list;
}

std::vector<char> fixed_nodes(const Law& law) {
  std::vector<char> fixed(law.nodes.size(), 0);
  for (std::size_t i = 0; i < law.nodes.size(); ++i) {
    const Node& n = law.nodes[i];
    switch (n.op) {
      case Op::constant:
        fixed[i] = 1;
        break;
      case Op::parameter:
        fixed[i] = law.parameters[at(n.index)].mailbox ? 0 : 1;
        break;
      case Op::input:
      case Op::state:
      case Op::line_read:
        break;
      default:
        fixed[i] = 1;
        for (const NodeId a : n.arguments) fixed[i] = static_cast<char>(fixed[i] & fixed[at(a)]);
    }
  }
  return fixed;
}

}  // namespace feltgate::law
