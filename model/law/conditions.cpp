// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lowers truth values to comparisons that set the flag. Documentation: docs/laws.md
#include <cmath>

#include "law/back_end.hpp"

namespace feltgate::law {

/// Computes the operands of a condition first, so that its comparisons are consecutive.
void BackEnd::lower_leaves(NodeId condition) {
  const Node& n = node(condition);
  if (n.op == Op::less) {
    for (const NodeId a : n.arguments) {
      if (!is_fixed(a)) (void)value(a);
    }
    const double scale = common_scale(condition, n.arguments, 0, false);
    for (const int side : {0, 1}) {
      double error = 0;
      (void)compared(condition, side, scale, &error);
    }
    return;
  }
  if (n.op != Op::both && n.op != Op::either && n.op != Op::opposite) {
    throw Refused(n.place, "this is no comparison", "write one, e.g. 0 < x");
  }
  for (const NodeId a : n.arguments) lower_leaves(a);
}

/// The whole number to compare with: a word is below `exact` if it is below the next larger whole
/// number, and above `exact` if it is above the next smaller one.
Operand BackEnd::threshold(double exact, bool above) {
  const double near = std::nearbyint(exact);
  const bool whole = std::fabs(exact - near) <= 1e-12 * std::fabs(exact);
  Operand o = constant(whole ? near : above ? std::ceil(exact) : std::floor(exact));
  o.exact = exact;
  return o;
}

/// One side of a comparison, as a word or constant of this scale.
Value BackEnd::compared(NodeId leaf, int side, double scale, double* error) {
  const NodeId id = node(leaf).arguments[static_cast<std::size_t>(side)];
  Term term;
  if (is_fixed(id)) gather(id, true, term);
  if (!is_fixed(id) || !term.fixed.empty()) return at_scale(id, scale, error);
  const double exact = term.number / scale;
  if (choice_.stays->at(node(leaf).arguments[static_cast<std::size_t>(1 - side)], term.number)) {
    // The word of the value that the other side stays at.
    *error = std::fabs(exact - std::nearbyint(exact));
    if (*error < 1e-12 * std::fabs(exact)) *error = 0;
    return {constant(exact), scale, std::fabs(term.number)};
  }
  return {threshold(exact, side == 1), scale, std::fabs(term.number)};
}

void BackEnd::compare(NodeId leaf, int mode) {
  const Node& n = node(leaf);
  const double scale = common_scale(leaf, n.arguments, 0, false);
  double x_error = 0, y_error = 0;
  const Value x = compared(leaf, 0, scale, &x_error);
  const Value y = compared(leaf, 1, scale, &y_error);
  Step& s = emit(EngineOp::cmp, mode, x.operand, y.operand, scale, leaf);
  s.x_error = x_error;
  s.y_error = y_error;
  s.condition = leaf;
  s.scale = scale;
  flag_ = -1;  // the flag is no longer what an earlier condition left there
}

/// Whether the condition is one comparison, which can be joined to the flag by `or` or `and`.
bool BackEnd::simple(NodeId condition, bool opposite) const {
  const Node& n = node(condition);
  if (n.op == Op::opposite) return simple(n.arguments[0], !opposite);
  return n.op == Op::less && !opposite;
}

/// Sets the flag to the condition, or to its opposite; returns the last step that set it.
int BackEnd::raise(NodeId condition, bool opposite) {
  const Node& n = node(condition);
  if (n.op == Op::opposite) return raise(n.arguments[0], !opposite);
  if (n.op == Op::less) {
    compare(condition, opposite ? 3 : 0);
    return last().index;
  }
  const bool all = (n.op == Op::both) != opposite;
  NodeId first = n.arguments[0], second = n.arguments[1];
  // The condition that the flag already holds need not be compared again.
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

/// Sets the flag to the condition, whose leaves have been computed.
void BackEnd::flag(NodeId condition) {
  if (flag_ == condition) return;
  raise(condition, false);
  flag_ = condition;
}

}  // namespace feltgate::law
