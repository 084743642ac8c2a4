// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lowers reads of array elements whose index is computed in the run. Documentation:
// docs/laws.md
#include <cmath>

#include <fmt/format.h>

#include "law/back_end.hpp"

namespace feltgate::law {

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

}  // namespace feltgate::law
