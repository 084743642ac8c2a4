// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lowers the `require` statements of a law. Documentation: docs/laws.md
#include "law/lowering.hpp"

namespace feltgate::law {

void Lowering::require(const Statement& s) {
  const NodeId condition = truth_of(s.condition);
  if (condition != kNone) require(condition, true, s.condition->offset);
}

/// Adds the requirement that `condition` is true, or false if not `holds`.
void Lowering::require(NodeId condition, bool holds, std::size_t offset) {
  const Node n = graph_.node(condition);
  if (graph_.is_constant(condition) || !graph_.is_fixed(condition)) {
    report(offset, "a requirement of what is no parameter",
           "compare parameters; what runs or mailboxes change is limited with clamp");
  } else if (n.op == Op::opposite) {
    require(n.arguments[0], !holds, offset);
  } else if (n.op == (holds ? Op::both : Op::either)) {
    require(n.arguments[0], holds, offset);
    require(n.arguments[1], holds, offset);
  } else if (n.op == Op::less) {
    const NodeId a = n.arguments[0], b = n.arguments[1];
    law_.requirements.push_back({holds ? a : b, holds ? b : a, holds, at(offset)});
  } else {
    report(offset, "a requirement with a choice", "write a require for each, without or");
  }
}

}  // namespace feltgate::law
