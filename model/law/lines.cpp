// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lowers delay lines: rings at the end of the table memory, each with a state word that holds its
// next write index. Documentation: docs/laws.md
#include <cmath>

#include "law/back_end.hpp"

namespace feltgate::law {

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
