// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Truth values: comparisons that set the flag. Documentation: docs/law-compiler.md
#include "law/back_end.hpp"

namespace feltgate::law {

/// Computes what a condition compares, so that nothing comes between its comparisons.
void BackEnd::lower_leaves(NodeId condition) {
  const Node& n = node(condition);
  if (n.op == Op::less) {
    for (const NodeId a : n.arguments) {
      if (!is_fixed(a)) (void)value(a);
    }
    const double scale = common_scale(condition, n.arguments, 0, false);
    for (const NodeId a : n.arguments) {
      double error = 0;
      (void)at_scale(a, scale, &error);
    }
    return;
  }
  if (n.op != Op::both && n.op != Op::either && n.op != Op::opposite) {
    throw Refused(n.place, "this is no comparison", "write one, e.g. 0 < x");
  }
  for (const NodeId a : n.arguments) lower_leaves(a);
}

void BackEnd::compare(NodeId leaf, int mode) {
  const Node& n = node(leaf);
  const double scale = common_scale(leaf, n.arguments, 0, false);
  double x_error = 0, y_error = 0;
  const Value x = at_scale(n.arguments[0], scale, &x_error);
  const Value y = at_scale(n.arguments[1], scale, &y_error);
  Step& s = emit(EngineOp::cmp, mode, x.operand, y.operand, scale, leaf);
  s.x_error = x_error;
  s.y_error = y_error;
  s.condition = leaf;
  s.scale = scale;
}

/// A comparison that can be joined to the flag by `or`, `and`.
bool BackEnd::simple(NodeId condition, bool opposite) const {
  const Node& n = node(condition);
  if (n.op == Op::opposite) return simple(n.arguments[0], !opposite);
  return n.op == Op::less && !opposite;
}

/// Sets the flag to the condition, or to its opposite; returns the step that did last.
int BackEnd::raise(NodeId condition, bool opposite) {
  const Node& n = node(condition);
  if (n.op == Op::opposite) return raise(n.arguments[0], !opposite);
  if (n.op == Op::less) {
    compare(condition, opposite ? 3 : 0);
    return last().index;
  }
  const bool all = (n.op == Op::both) != opposite;
  NodeId first = n.arguments[0], second = n.arguments[1];
  // What the flag is already need not be compared again.
  if (!opposite && flag_ == second) std::swap(first, second);
  if (!simple(second, opposite) && (opposite || flag_ != first)) std::swap(first, second);
  if (simple(second, opposite)) {
    if (opposite || flag_ != first) raise(first, opposite);
    NodeId leaf = second;
    while (node(leaf).op == Op::opposite) leaf = node(leaf).arguments[0];
    compare(leaf, all ? 2 : 1);
    return last().index;
  }
  const Operand kept = {From::step, raise(second, opposite)};
  raise(first, opposite);
  const Operand zero = constant(0);
  Step& s = emit(EngineOp::cmp, all ? 2 : 1, zero, kept, 1, condition);
  s.condition = condition;
  return last().index;
}

/// The flag is the condition; its leaves have been computed.
void BackEnd::flag(NodeId condition) {
  if (flag_ == condition) return;
  raise(condition, false);
  flag_ = condition;
}

}  // namespace feltgate::law
