// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lowers selections that only change a sign to one ABS, in place of a comparison and a selection.
// Documentation: docs/laws.md
#include <algorithm>

#include "law/back_end.hpp"

namespace feltgate::law {

/// Whether the node has the form x < 0 ? -v : v.
bool BackEnd::flips(NodeId id) const {
  const Node& n = node(id);
  if (n.op != Op::select || is_fixed(n.arguments[1]) || is_fixed(n.arguments[2])) return false;
  const Node& c = node(n.arguments[0]);
  if (c.op != Op::less || is_fixed(c.arguments[0])) return false;
  const Node& zero = node(c.arguments[1]);
  if (zero.op != Op::constant || zero.value != 0) return false;
  if (node(n.arguments[1]).op == Op::negate &&
      node(n.arguments[1]).arguments[0] == n.arguments[2]) {
    return true;
  }
  Term a, b;
  gather(n.arguments[1], true, a);
  gather(n.arguments[2], true, b);
  return a.number == -b.number && a.fixed == b.fixed && a.factors == b.factors;
}

/// Whether the node has the form x < 0 ? -c : c with c of numbers and parameters; gives x and c.
bool BackEnd::turned(NodeId id, NodeId* by, Term* amount) const {
  const Node& n = node(id);
  if (n.op != Op::select || !is_fixed(n.arguments[1]) || !is_fixed(n.arguments[2])) return false;
  const Node& c = node(n.arguments[0]);
  if (c.op != Op::less || is_fixed(c.arguments[0])) return false;
  const Node& zero = node(c.arguments[1]);
  if (zero.op != Op::constant || zero.value != 0) return false;
  Term a, b;
  gather(n.arguments[1], true, a);
  gather(n.arguments[2], true, b);
  if (a.number != -b.number || a.fixed != b.fixed) return false;
  *by = c.arguments[0];
  *amount = b;
  return true;
}

/// A product with a sign among its factors: ABS transfers the sign from one word to another.
Value BackEnd::turned_sum(NodeId id, Term term, double hint) {
  NodeId by = -1, sign = -1;
  Term amount;
  for (auto f = term.factors.begin(); f != term.factors.end(); ++f) {
    if (!turned(*f, &by, &amount)) continue;
    sign = *f;
    term.factors.erase(f);
    break;
  }
  term.number *= amount.number;
  term.fixed.insert(term.fixed.end(), amount.fixed.begin(), amount.fixed.end());
  std::sort(term.fixed.begin(), term.fixed.end());
  const Value x = value(by);
  for (const NodeId f : term.factors) (void)value(f);
  const double scale = sum_scale(id, {term}, hint);
  Chain c;
  add_term(term, scale, id, c);
  const Value v = chain(c, scale, id);
  if (v.operand.from == From::step)
    program_.steps[static_cast<std::size_t>(v.operand.index)].node = -1;
  Step& s = emit(EngineOp::abs, 0, x.operand, v.operand, scale, id);
  s.node = id;
  s.condition = node(sign).arguments[0];
  s.margin_scale = x.scale;
  return {last(), scale, 0};
}

}  // namespace feltgate::law
