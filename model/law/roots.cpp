// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lowers the results of a run: outputs, events and states. Documentation: docs/laws.md
#include <cmath>

#include "law/back_end.hpp"

namespace feltgate::law {

/// Unit of the value that a state will receive, so that it needs no conversion; 0 if unknown.
double BackEnd::state_unit(NodeId id, int depth) const {
  if (depth == 0 || id < 0 || is_fixed(id)) return 0;
  const Node& n = node(id);
  switch (n.op) {
    case Op::input:
      return law_.inputs[at(n.index)].source == Source::position ? target_.count_rad() : 1;
    case Op::state:
      return 0;
    case Op::add:
    case Op::subtract:
    case Op::minimum:
    case Op::maximum:
    case Op::negate:
    case Op::absolute:
    case Op::select:
      for (std::size_t i = n.op == Op::select ? 1 : 0; i < n.arguments.size(); ++i) {
        const double unit = state_unit(n.arguments[i], depth - 1);
        if (unit != 0) return unit;
      }
      return 0;
    case Op::multiply: {
      double unit = 1;
      for (const NodeId a : n.arguments) {
        if (!is_fixed(a)) {
          const double u = state_unit(a, depth - 1);
          if (u == 0) return 0;
          unit *= u;
        }
      }
      return unit;
    }
    default:
      return 1;
  }
}

void BackEnd::outputs() {
  const double scale = std::ldexp(1.0, -target_.torque.fraction);
  for (const Output& o : law_.outputs) {
    double error = 0;
    const Value v = at_scale(o.value, scale, &error);
    Step& s = emit(EngineOp::add, 0, v.operand, constant(0), scale, o.value);
    s.x_error = error;
    s.node = o.value;
    s.output = o.axis;
    s.place = o.place;
  }
}

void BackEnd::events() {
  for (std::size_t i = 0; i < law_.events.size(); ++i) {
    const Event& e = law_.events[i];
    const int held = static_cast<int>(law_.states.size() + i);
    Value v;
    double error = 0;
    const double size = span(e.value).size();
    if (is_fixed(e.value)) {
      v = at_scale(e.value, std::ldexp(1.0, -std::min(24, largest_fraction(e.value, 1, size))),
                   &error);
    } else {
      v = value(e.value);
    }
    lower_leaves(e.condition);
    flag_ = -1;
    const Operand now = {From::step, raise(e.condition, false)};
    // The event happens if the condition holds and did not hold in the previous run.
    emit(EngineOp::cmp, 0, {From::state, held}, now, 1, e.condition).condition = e.condition;
    flag_ = -1;
    Step& branch = emit(EngineOp::brf, 1, {}, {}, 1, e.condition);
    branch.skip = 1;
    Step& s = emit(EngineOp::add, 0, v.operand, constant(0), v.scale, e.value);
    s.x_error = error;
    s.event = e.number;
    s.place = e.place;
    StateUse& use = program_.states[at(held)];
    use.next = now;
    use.upper = 1;
  }
}

Operand BackEnd::whole_word(NodeId id) {
  double error = 0;
  Operand o = is_fixed(id) ? at_scale(id, 1, &error).operand : align(value(id), 1, id).operand;
  if (o.from == From::word) {
    emit(EngineOp::add, 0, o, constant(0), 1, id);
    o = last();
  }
  if (o.from == From::step) program_.steps[at(o.index)].whole = true;
  return o;
}

/// The node in 4096th parts, of which the next step keeps the whole numbers.
Value BackEnd::floor_word(NodeId id, double hint) {
  constexpr double fine = 1.0 / 4096;
  double error = 0;
  if (is_fixed(id)) return at_scale(id, fine, &error);
  return has_ends(id, true) ? with_ends(id, fine, true) : align(value(id, hint), fine, id);
}

Operand BackEnd::rounded_down(NodeId id) {
  if (node(id).op == Op::constant) return constant(std::floor(node(id).value));
  const Value v = floor_word(id, 1.0 / 4096);
  Step& s = emit(EngineOp::mlw, 1, v.operand, constant(1), 1, id);
  s.floors = id;
  s.condition = id;
  s.margin_scale = v.scale;
  return last();
}

Value BackEnd::next_state(const State& s, double scale) {
  double error = 0;
  if (s.whole) {
    // The value is rounded down, as the law language defines.
    const double size = span(s.next).size();
    if (is_fixed(s.next) && node(s.next).whole) return at_scale(s.next, scale, &error);
    const Operand down = node(s.next).whole ? whole_word(s.next) : rounded_down(s.next);
    return align({down, 1, size}, scale, s.next);
  }
  Value v = at_scale(s.next, scale, &error);
  if (error > 0) {
    // A constant that is not a whole number of words: its rounding error is the state's error.
    emit(EngineOp::add, 0, v.operand, constant(0), scale, s.next).x_error = error;
    v.operand = last();
  }
  if (!s.phase) return v;
  const double width = s.range.upper - s.range.lower;
  const Span n = span(s.next);
  // A sum of two phases lies below two turns; its range is rounded up.
  const double most = width * (1 + 1e-12);
  if (n.lo < s.range.lower - most || n.hi > s.range.upper + most) {
    throw Refused(s.place, "the phase can step by more than a whole turn in a run",
                  "limit its rate with clamp, or run the law faster");
  }
  const Operand turn = constant(width / scale);
  if (n.hi >= s.range.upper) {
    const Operand end = threshold(s.range.upper / scale, true);
    emit(EngineOp::sub, 0, v.operand, turn, scale, s.next);
    const Operand less = last();
    emit(EngineOp::cmp, 0, v.operand, end, scale, s.next).condition = s.next;
    emit(EngineOp::sel, 0, v.operand, less, scale, s.next).condition = s.next;
    v.operand = last();
  }
  if (n.lo < s.range.lower) {
    const Operand end = threshold(s.range.lower / scale, true);
    emit(EngineOp::add, 0, v.operand, turn, scale, s.next);
    const Operand more = last();
    emit(EngineOp::cmp, 0, v.operand, end, scale, s.next).condition = s.next;
    emit(EngineOp::sel, 0, more, v.operand, scale, s.next).condition = s.next;
    v.operand = last();
  }
  flag_ = -1;
  return v;
}

void BackEnd::states() {
  for (std::size_t i = 0; i < law_.states.size(); ++i) {
    const State& s = law_.states[i];
    // The state's format is chosen at its first read, or else here.
    NodeId own = -1;
    for (const NodeId id : needed(law_)) {
      if (node(id).op == Op::state && node(id).index == static_cast<int>(i)) own = id;
    }
    if (own < 0) continue;
    const double scale = value(own).scale;
    Value v = next_state(s, scale);
    if (v.operand.from == From::state && v.operand.index != static_cast<int>(i)) {
      // The old value of another state: it must be read before any state is written.
      emit(EngineOp::add, 0, v.operand, constant(0), scale, s.next).node = s.next;
      v.operand = last();
    }
    StateUse& use = program_.states[i];
    use.next = v.operand;
    use.scale = scale;
    use.initial = static_cast<std::int32_t>(std::lround(s.initial / scale));
    use.lower = static_cast<std::int32_t>(std::lround(s.range.lower / scale));
    use.upper = static_cast<std::int32_t>(std::lround(s.range.upper / scale)) - (s.phase ? 1 : 0);
  }
}

/// Removes unused steps; merges a copy to an output into the step that computes the value.
void BackEnd::finish() {
  std::vector<Step>& steps = program_.steps;
  const auto register_uses = [&](int i) {
    int uses = 0;
    for (const Step& s : steps) {
      uses += (s.x == Operand{From::step, i} ? 1 : 0) + (s.y == Operand{From::step, i} ? 1 : 0);
    }
    for (const StateUse& s : program_.states) uses += s.next == Operand{From::step, i} ? 1 : 0;
    return uses;
  };
  std::vector<char> copied(steps.size(), 0);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    Step& s = steps[i];
    if (s.output < 0 || s.x.from != From::step) continue;
    Step& from = steps[at(s.x.index)];
    if (from.output >= 0 || from.event >= 0 || from.op == EngineOp::cmp) continue;
    if (register_uses(s.x.index) != 1) continue;
    from.output = s.output;
    from.place = s.place;
    copied[i] = 1;
    s.output = -1;
    s.x = {};
  }
  std::vector<char> kept(steps.size(), 0);
  // The flag joins comparisons: each one needs the earlier comparisons that it continues.
  for (std::size_t i = steps.size(); i-- > 0;) {
    const Step& s = steps[i];
    if (s.output >= 0 || s.event >= 0 || s.op == EngineOp::brf || s.op == EngineOp::tst) {
      kept[i] = 1;
    }
    for (const StateUse& u : program_.states) {
      if (u.next == Operand{From::step, static_cast<int>(i)}) kept[i] = 1;
    }
    if (kept[i] == 0 || copied[i] != 0) {
      kept[i] = 0;
      continue;
    }
    for (const Operand& o : {s.x, s.y}) {
      if (o.from == From::step) kept[at(o.index)] = 1;
    }
    if (takes_acc(s)) kept[i - 1] = 1;
    const bool flagged = s.op == EngineOp::sel || s.op == EngineOp::brf ||
                         (s.op == EngineOp::cmp && (s.mode == 1 || s.mode == 2));
    for (std::size_t k = i; flagged && k-- > 0;) {
      if (steps[k].op == EngineOp::cmp) {
        kept[k] = 1;
        break;
      }
    }
  }
  std::vector<int> to(steps.size(), -1);
  std::vector<Step> left;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (kept[i] == 0) continue;
    to[i] = static_cast<int>(left.size());
    left.push_back(steps[i]);
    for (Operand* o : {&left.back().x, &left.back().y}) {
      if (o->from == From::step) o->index = to[at(o->index)];
    }
  }
  for (StateUse& u : program_.states) {
    if (u.next.from == From::step) u.next.index = to[at(u.next.index)];
  }
  for (LineUse& l : program_.lines) l.written.index = to[at(l.written.index)];
  steps = std::move(left);
}

Program BackEnd::run() {
  program_.states.resize(law_.states.size() + law_.events.size() + law_.lines.size());
  count_tables();
  begin_lines();
  if (choice_.states_first) states();
  events();
  outputs();
  if (!choice_.states_first) states();
  write_lines();
  finish();
  return std::move(program_);
}

}  // namespace feltgate::law
