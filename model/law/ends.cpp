// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Makes the constant ends of a limited value in the scale of what decides, so that a value that
// stays at an end is on the right side there. Documentation: docs/laws.md
#include <algorithm>
#include <cmath>

#include "law/back_end.hpp"

namespace feltgate::law {

namespace {

bool chooses(Op op) { return op == Op::minimum || op == Op::maximum || op == Op::select; }

}  // namespace

/// Whether the node is limited, or chosen, by what is fixed, or is a whole number if `or_whole`. A
/// sum or a product with a number may stand around it.
bool BackEnd::has_ends(NodeId id, bool or_whole) const {
  const Node& n = node(id);
  if (is_fixed(id)) return false;
  if (or_whole && n.whole) return true;
  if (chooses(n.op)) {
    const std::size_t first = n.op == Op::select ? 1 : 0;
    return std::any_of(n.arguments.begin() + static_cast<std::ptrdiff_t>(first), n.arguments.end(),
                       [&](NodeId a) { return is_fixed(a) || has_ends(a, or_whole); });
  }
  if (n.op == Op::negate) return has_ends(n.arguments[0], or_whole);
  if (n.op != Op::add && n.op != Op::subtract && n.op != Op::multiply) return false;
  const auto number = [this](NodeId a) { return node(a).op == Op::constant; };
  return (number(n.arguments[0]) && has_ends(n.arguments[1], or_whole)) ||
         (number(n.arguments[1]) && has_ends(n.arguments[0], or_whole));
}

/// The node in words of `scale`, with its ends rounded to that scale: down, or to the nearest word.
Value BackEnd::with_ends(NodeId id, double scale, bool down) {
  const auto key = std::tuple(id, scale, down);
  if (const auto found = ended_.find(key); found != ended_.end()) return found->second;
  return ended_[key] = with_ends(id, Map{1, 0}, Ends{scale, span(id), down});
}

/// `map` of the node. What stands around a choice goes into its ends.
Value BackEnd::with_ends(NodeId id, const Map& map, const Ends& ends) {
  const Node& n = node(id);
  const auto number = [this](NodeId a) { return node(a).op == Op::constant; };
  const auto constant_of = [this](NodeId a) { return node(a).value; };
  if (n.op == Op::constant || n.whole || !has_ends(id, true)) return mapped(id, map, ends);
  const NodeId a = n.arguments[0], b = n.op == Op::negate ? a : n.arguments[1];
  switch (n.op) {
    case Op::negate:
      return with_ends(a, {-map.factor, map.offset}, ends);
    case Op::add:
      return number(a) ? with_ends(b, map.after(1, constant_of(a)), ends)
                       : with_ends(a, map.after(1, constant_of(b)), ends);
    case Op::subtract:
      return number(a) ? with_ends(b, map.after(-1, constant_of(a)), ends)
                       : with_ends(a, map.after(1, -constant_of(b)), ends);
    case Op::multiply:
      return number(a) ? with_ends(b, map.after(constant_of(a), 0), ends)
                       : with_ends(a, map.after(constant_of(b), 0), ends);
    default:
      break;
  }
  const bool choose = n.op == Op::select;
  if (choose) lower_leaves(n.arguments[0]);
  const Value x = with_ends(n.arguments[choose ? 1 : 0], map, ends);
  const Value y = with_ends(n.arguments[choose ? 2 : 1], map, ends);
  if (choose) flag(n.arguments[0]);
  const bool least = (n.op == Op::minimum) == (map.factor > 0);
  Step& s = emit(choose  ? EngineOp::sel
                 : least ? EngineOp::min
                         : EngineOp::max,
                 0, x.operand, y.operand, ends.scale, id);
  s.x_error = x.error;
  s.y_error = y.error;
  if (map.factor == 1 && map.offset == 0) s.node = id;
  if (choose) s.condition = n.arguments[0];
  return {last(), ends.scale, ends.range.size()};
}

/// `map` of a node that is not chosen by something fixed.
Value BackEnd::mapped(NodeId id, const Map& map, const Ends& ends) {
  if (node(id).op == Op::constant) {
    const double exact = (map.factor * node(id).value + map.offset) / ends.scale;
    const double near = std::nearbyint(exact);
    const bool whole = std::fabs(exact - near) <= 1e-9 + 1e-14 * std::fabs(exact);
    Value v{constant(whole || !ends.down ? near : std::floor(exact), id), ends.scale, 0};
    v.error = whole ? 0 : std::fabs(exact - v.operand.exact);
    return v;
  }
  const double factor = std::fabs(map.factor);
  Value v;
  if (is_fixed(id)) {
    v = at_scale(id, ends.scale / factor, &v.error);
  } else {
    v = clipped(value(id), map, ends, id);
  }
  v.scale *= factor;
  v.size *= factor;
  if (!is_fixed(id)) v = align(v, ends.scale, id);
  if (map.factor < 0) v = negated(v, id);
  if (map.offset == 0) return v;
  const double exact = map.offset / ends.scale;
  emit(EngineOp::add, 0, v.operand, constant(exact), ends.scale, id).y_error =
      std::fabs(exact - std::nearbyint(exact));
  return {last(), ends.scale, v.size + std::fabs(map.offset)};
}

/// The value, limited where its words would leave 32 bits in the scale of the ends. What lies
/// beyond the range of the result is as good as the next value there.
Value BackEnd::clipped(Value v, const Map& map, const Ends& ends, NodeId id) {
  const double size = std::fabs(map.factor) * v.size + std::fabs(map.offset);
  if (size / ends.scale < 2147483647.0 * (1 - 1.0 / 256)) return v;
  const double room = 1 + ends.range.width() / 16;
  Span keep{(ends.range.lo - room - map.offset) / map.factor,
            (ends.range.hi + room - map.offset) / map.factor};
  if (keep.lo > keep.hi) std::swap(keep.lo, keep.hi);
  if (!(keep.size() < v.size)) return v;
  emit(EngineOp::max, 0, v.operand, constant(std::floor(keep.lo / v.scale), id), v.scale, id);
  emit(EngineOp::min, 0, last(), constant(std::ceil(keep.hi / v.scale), id), v.scale, id);
  return {last(), v.scale, keep.size() + v.scale};
}

}  // namespace feltgate::law
