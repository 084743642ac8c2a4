// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lowers truth values to comparisons that set the flag. Documentation: docs/laws.md
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

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

// Lowers reads of array elements whose index is computed in the run.

Value BackEnd::element(NodeId id) {
  const Node& n = node(id);
  const Array& array = law_.arrays[at(n.index)];
  const double last_index = static_cast<double>(array.values.size()) - 1;
  const Span range = span(n.arguments[0]);
  const NodeId of = n.arguments[0];
  Value v =
      node(of).whole ? align({whole_word(of), 1, range.size()}, 1.0 / 4096, of) : floor_word(of, 0);
  if (range.lo < 0) {
    emit(EngineOp::max, 0, v.operand, constant(0), v.scale, id);
    v.operand = last();
  }
  if (range.hi >= last_index + 1) {
    emit(EngineOp::min, 0, v.operand, constant(last_index / v.scale), v.scale, id);
    v.operand = last();
  }
  double size = 0;
  for (const double a : array.values) size = std::max(size, std::fabs(a));
  const std::string memory = fmt::format("array {}", n.index);
  const auto same = memory_scales_.find(memory);
  const double scale = same != memory_scales_.end()
                           ? same->second
                           : chosen_scale(id, 1, largest_fraction(id, 1, size), size);
  if (n.whole && scale > 1) throw Unfit("a whole element counts in ones", id);
  memory_scales_[memory] = scale;
  const std::string key = fmt::format("array {} {:.17g}", n.index, scale);
  auto found = table_keys_.find(key);
  int index = found == table_keys_.end() ? -1 : found->second;
  if (index < 0) {
    TableUse t;
    t.what = array.name;
    t.proof = "rounded numbers";
    for (const double a : array.values) {
      const auto w = static_cast<std::int32_t>(std::lround(a / scale));
      if (w * scale != a) t.error = 0.5;
      t.words.push_back(static_cast<std::uint32_t>(w));
      t.values =
          t.words.size() == 1 ? Span{double(w), double(w)} : hull(t.values, {double(w), double(w)});
    }
    index = place_table(key, t);
  }
  Step& s = emit(EngineOp::tab, 0, v.operand, {}, scale, id);
  s.table = index;
  s.node = id;
  s.condition = id;
  s.floors = n.arguments[0];
  s.margin_scale = v.scale;
  return {last(), scale, 0};
}

// Lowers delay lines: rings at the end of the table memory, each with a state word that holds its
// next write index.

namespace {
constexpr double place = 4096;  // weight of the index in the operand word of TAB and TST
}  // namespace

void BackEnd::begin_lines() {
  for (std::size_t i = 0; i < law_.lines.size(); ++i) {
    const Line& l = law_.lines[i];
    const double size = std::max({std::fabs(l.range.lower), std::fabs(l.range.upper), 1e-9});
    LineUse use;
    use.pointer = static_cast<int>(law_.states.size() + law_.events.size() + i);
    use.scale = std::ldexp(1.0, 1 - largest_fraction(l.written, 1, size));
    TableUse t;
    t.line = static_cast<int>(i);
    t.what = l.name;
    t.proof = "a delay line";
    t.words.assign(at(l.length), 0);
    t.values = hull({0, 0}, {std::nearbyint(l.range.lower / use.scale),
                             std::nearbyint(l.range.upper / use.scale)});
    program_.tables.push_back(t);
    use.table = static_cast<int>(program_.tables.size()) - 1;
    program_.lines.push_back(use);
    StateUse& pointer = program_.states[at(use.pointer)];
    pointer.upper = static_cast<std::int32_t>(l.length * place - 1);
  }
}

Value BackEnd::line_read(NodeId id) {
  const Node& n = node(id);
  const Line& l = law_.lines[at(n.index)];
  const LineUse use = program_.lines[at(n.index)];
  const Operand pointer{From::state, use.pointer};
  const double length = l.length;
  Operand index = pointer;
  const Node& back = node(n.arguments[0]);
  if (back.op != Op::constant || std::floor(back.value) != length) {
    Operand ago;
    if (back.op == Op::constant) {
      ago = constant(std::clamp(std::floor(back.value), 1.0, length) * place);
    } else {
      if (is_fixed(n.arguments[0])) {
        throw Refused(n.place, "a delay that only depends on parameters",
                      "make it a state or a mailbox, or a number");
      }
      emit(EngineOp::max, 0, rounded_down(n.arguments[0]), constant(1), 1, id);
      emit(EngineOp::min, 0, last(), constant(length), 1, id);
      emit(EngineOp::mul, 0, last(), constant(place), 1 / place, id);
      ago = last();
    }
    emit(EngineOp::sub, 0, pointer, ago, 1 / place, id);
    const Operand before = last();
    emit(EngineOp::add, 0, before, constant(length * place), 1 / place, id);
    const Operand around = last();
    emit(EngineOp::cmp, 0, before, constant(0), 1 / place, id);
    emit(EngineOp::sel, 0, around, before, 1 / place, id);
    flag_ = -1;
    index = last();
  }
  Step& s = emit(EngineOp::tab, 0, index, {}, use.scale, id);
  s.table = use.table;
  s.node = id;
  return {last(), use.scale, 0};
}

void BackEnd::write_lines() {
  std::vector<Value> values;
  std::vector<double> errors(law_.lines.size(), 0);
  for (std::size_t i = 0; i < law_.lines.size(); ++i) {
    values.push_back(at_scale(law_.lines[i].written, program_.lines[i].scale, &errors[i]));
  }
  for (std::size_t i = 0; i < law_.lines.size(); ++i) {
    LineUse& use = program_.lines[i];
    const NodeId written = law_.lines[i].written;
    const Operand pointer{From::state, use.pointer};
    const Operand zero = constant(0);
    Step& kept = emit(EngineOp::add, 0, values[i].operand, zero, use.scale, written);
    kept.x_error = errors[i];
    kept.node = written;
    use.written = last();
    emit(EngineOp::tst, 0, pointer, {}, use.scale, written).table = use.table;
    emit(EngineOp::add, 0, pointer, constant(place), 1 / place, written);
    const Operand next = last();
    emit(EngineOp::cmp, 0, next, constant(law_.lines[i].length * place), 1 / place, written);
    emit(EngineOp::sel, 0, next, zero, 1 / place, written);
    program_.states[at(use.pointer)].next = last();
  }
  flag_ = -1;
}

// Makes the constant ends of a limited value in the scale of what decides, so that a value that
// stays at an end is on the right side there.

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
  const bool clipped_before = std::exchange(clipped_, false);
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
  // Of a clipped value, a part that goes beyond the whole result's range is not the law's.
  const bool as_the_law = !clipped_ || span(id).within(ends.range);
  if (map.factor == 1 && map.offset == 0 && as_the_law) s.node = id;
  clipped_ = clipped_ || clipped_before;
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
  clipped_ = true;
  emit(EngineOp::max, 0, v.operand, constant(std::floor(keep.lo / v.scale), id), v.scale, id);
  emit(EngineOp::min, 0, last(), constant(std::ceil(keep.hi / v.scale), id), v.scale, id);
  return {last(), v.scale, keep.size() + v.scale};
}

}  // namespace feltgate::law
