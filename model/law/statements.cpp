// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lowers statements, in the order of the file.
#include <algorithm>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "feltgate/nearest.hpp"
#include "law/lowering.hpp"

namespace feltgate::law {

namespace {

using Kind = Statement::Kind;

constexpr int kMostAxes = 3;

bool is_definition(Kind kind) {
  return kind != Kind::set && kind != Kind::next && kind != Kind::loop && kind != Kind::out &&
         kind != Kind::event && kind != Kind::rate && kind != Kind::require;
}

std::string quoted(const std::string& name) { return "\"" + name + "\""; }

}  // namespace

Lowering::Lowering(std::string_view text, double rate_hz, Law& law, Diagnostics& diagnostics)
    : places_(text),
      rate_hz_(rate_hz),
      law_(law),
      diagnostics_(diagnostics),
      graph_(law, diagnostics) {
  law_.rate_hz = rate_hz;
}

void Lowering::run(const std::vector<Statement>& statements) {
  for (const Statement& s : statements) {
    if (is_definition(s.kind)) defined_.emplace(s.name, at(s.name_offset));
    if (s.kind == Kind::rate) law_.own_rate = true;
  }
  for (const Statement& s : statements) statement(s);
  check_ends(statements.empty() ? nullptr : &statements.back());
  note_unused(scope_.close());
  note_unread();
  const auto before = [](const Unused& a, const Unused& b) {
    return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
  };
  std::sort(law_.unused.begin(), law_.unused.end(), before);
}

void Lowering::statement(const Statement& s) {
  if (loops_ > 0 && s.kind != Kind::let && s.kind != Kind::var && s.kind != Kind::set &&
      s.kind != Kind::loop) {
    report(s.offset, "a loop holds let, var, set and for, and nothing else",
           "write this outside of the loop");
    return;
  }
  switch (s.kind) {
    case Kind::param:
    case Kind::mailbox:
      return parameter(s);
    case Kind::state:
    case Kind::phase:
      return state(s);
    case Kind::boolean:
      return boolean(s);
    case Kind::let:
    case Kind::var:
      return let(s);
    case Kind::set:
      return set(s);
    case Kind::next:
      return next(s);
    case Kind::table:
      return table(s);
    case Kind::array:
      return array(s);
    case Kind::line:
      return line(s);
    case Kind::loop:
      return loop(s);
    case Kind::out:
      return out(s);
    case Kind::event:
      return event(s);
    case Kind::rate:
      return rate(s);
    case Kind::require:
      return require(s);
  }
}

void Lowering::define(const Statement& s, Symbol symbol) {
  symbol.kind = s.kind;
  symbol.place = at(s.name_offset);
  const Symbol* const first = scope_.find(s.name);
  if (first != nullptr) {
    report(
        s.name_offset,
        quoted(s.name) + " is defined twice; first in line " + fmt::format("{}", first->place.line),
        "choose another name");
    return;
  }
  // The name is defined in spite of the error: one message is enough.
  if (is_reserved(s.name)) {
    report(s.name_offset, quoted(s.name) + " is a name that the language brings along",
           "choose another name");
  } else if (unit_symbol(s.name)) {
    report(s.name_offset, quoted(s.name) + " is a unit and no name", "choose another name");
  }
  scope_.define(s.name, symbol);
}

void Lowering::parameter(const Statement& s) {
  const Quantity q = quantity(s);
  Parameter p;
  Symbol symbol;
  if (s.kind == Kind::mailbox) {
    Unit unit;
    p.mailbox = true;
    if (constant_of(s.age, "max_age", p.max_age_s, unit) &&
        (!(unit == kSecond) || p.max_age_s <= 0)) {
      report(s.age->offset, "max_age is no time above 0", "write max_age 5 ms");
    }
  }
  if (q.good) {
    p.name = s.name;
    p.unit_text = q.unit_text;
    p.unit = q.unit;
    p.to_si = q.to_si;
    p.initial = q.value;
    p.range = q.range;
    p.whole = s.whole;
    p.place = at(s.name_offset);
    const auto index = static_cast<int>(law_.parameters.size());
    law_.parameters.push_back(p);
    symbol.node = graph_.leaf(Op::parameter, index, q.unit, p.place);
    symbol.unit_text = q.unit_text;
  }
  define(s, symbol);
}

void Lowering::state(const Statement& s) {
  const Quantity q = quantity(s);
  Symbol symbol;
  if (q.good) {
    State state;
    state.name = s.name;
    state.unit_text = q.unit_text;
    state.unit = q.unit;
    state.initial = q.value;
    state.range = q.range;
    state.phase = s.kind == Kind::phase;
    state.whole = s.whole;
    state.place = at(s.name_offset);
    symbol.index = static_cast<int>(law_.states.size());
    law_.states.push_back(state);
    symbol.node = graph_.leaf(Op::state, symbol.index, q.unit, state.place);
    symbol.unit_text = q.unit_text;
  }
  define(s, symbol);
}

/// A truth-valued state: a whole state, 0 or 1; its readers compare it.
void Lowering::boolean(const Statement& s) {
  const NodeId first = truth_of(s.value);
  Symbol symbol;
  if (first != kNone && !graph_.is_constant(first)) {
    report(s.value->offset, "the first value of " + quoted(s.name) + " is not constant",
           "write bool " + s.name + " = false");
  } else if (first != kNone) {
    State state;
    state.name = s.name;
    state.initial = graph_.node(first).value;
    state.range = {0, 1};
    state.whole = true;
    state.place = at(s.name_offset);
    symbol.index = static_cast<int>(law_.states.size());
    law_.states.push_back(state);
    symbol.node =
        graph_.less(graph_.constant(0, kNumber, state.place),
                    graph_.leaf(Op::state, symbol.index, kNumber, state.place), state.place);
  }
  define(s, symbol);
}

void Lowering::let(const Statement& s) {
  defining_ = s.name;
  Symbol symbol;
  symbol.node = value_of(s.value);
  defining_.clear();
  define(s, symbol);
}

void Lowering::set(const Statement& s) {
  const NodeId value = value_of(s.value);
  Symbol* const symbol = scope_.find(s.name);
  if (symbol == nullptr || symbol->kind != Kind::var) {
    report(s.name_offset, quoted(s.name) + " is no var", "write above: var " + s.name + " = ...");
    return;
  }
  if (value == kNone || symbol->node == kNone) {
    symbol->node = kNone;
    return;
  }
  if (graph_.node(value).truth != graph_.node(symbol->node).truth) {
    report(s.value->offset, "a condition and a number in one var", "use two vars");
    return;
  }
  const Unit unit = graph_.node(symbol->node).unit;
  symbol->node = graph_.node(value).truth ? value : number_in(s.value, unit, quoted(s.name));
}

void Lowering::next(const Statement& s) {
  Symbol* const symbol = scope_.find(s.name);
  const bool is_truth = symbol != nullptr && symbol->kind == Kind::boolean;
  const NodeId value = is_truth ? truth_of(s.value) : number_of(s.value);
  const bool is_state =
      symbol != nullptr && (symbol->kind == Kind::state || symbol->kind == Kind::phase || is_truth);
  if (!is_state && (symbol == nullptr || symbol->kind != Kind::line)) {
    std::vector<std::string> names;
    for (const State& state : law_.states) names.push_back(state.name);
    for (const Line& line : law_.lines) names.push_back(line.name);
    report(s.name_offset, quoted(s.name) + " is no state, phase, bool or line",
           config::did_you_mean(s.name, names) + "write above: state " + s.name + " = ...");
    return;
  }
  if (!has_next_.insert(s.name).second) {
    report(s.name_offset, "a second next of " + quoted(s.name), "write one: next NAME = if ...");
    return;
  }
  if (symbol->index < 0 || value == kNone) return;
  const auto index = static_cast<std::size_t>(symbol->index);
  if (is_truth) {
    const Place place = at(s.value->offset);
    law_.states[index].next = graph_.select(value, graph_.constant(1, kNumber, place),
                                            graph_.constant(0, kNumber, place), place);
    return;
  }
  const Unit unit = is_state ? law_.states[index].unit : law_.lines[index].unit;
  const NodeId written = number_in(s.value, unit, quoted(s.name));
  (is_state ? law_.states[index].next : law_.lines[index].written) = written;
}

void Lowering::loop(const Statement& s) {
  const auto [from, to] = loop_range(s.lower, s.upper);
  if (scope_.find(s.variable) != nullptr || unit_symbol(s.variable)) {
    report(s.offset, quoted(s.variable) + " has a meaning already", "choose another name");
    return;
  }
  ++loops_;
  for (int i = from; i <= to; ++i) {
    count_step(s.offset);
    scope_.open();
    Symbol counter;
    counter.node = graph_.constant(i, kNumber, at(s.offset));
    counter.used = true;
    scope_.define(s.variable, counter);
    for (const Statement& inner : s.body) statement(inner);
    note_unused(scope_.close());
  }
  --loops_;
}

void Lowering::out(const Statement& s) {
  any_out_ = true;
  if (s.name != "torque") {
    report(s.name_offset, "unknown output " + quoted(s.name), "write out torque = ...");
    return;
  }
  Output o;
  o.name = s.name;
  o.axis = s.index ? whole_of(s.index, "an axis", 0, kMostAxes - 1) : 0;
  o.place = at(s.name_offset);
  const bool known = std::any_of(law_.outputs.begin(), law_.outputs.end(),
                                 [&](const Output& other) { return other.axis == o.axis; });
  if (known) {
    report(s.name_offset, "a second torque of axis " + fmt::format("{}", o.axis),
           "add both in one expression, or write torque[1] for another axis");
    return;
  }
  o.value = number_in(s.value, kNewtonMetre, "torque");
  law_.outputs.push_back(o);
}

void Lowering::event(const Statement& s) {
  Event e;
  e.name = s.name;
  e.place = at(s.name_offset);
  e.number = static_cast<int>(law_.events.size()) + 1;
  for (const Event& other : law_.events) {
    if (other.name != s.name) continue;
    report(s.name_offset,
           "the event " + quoted(s.name) + " is defined twice; first in line " +
               fmt::format("{}", other.place.line),
           "choose another name, or join the conditions with or");
  }
  e.value = s.value ? number_of(s.value) : graph_.constant(0, kNumber, e.place);
  e.condition = truth_of(s.condition);
  if (e.condition != kNone && graph_.is_constant(e.condition)) {
    report(s.condition->offset, "a condition that never changes", "compare an input or a state");
  }
  law_.events.push_back(e);
}

void Lowering::rate(const Statement& s) {
  const bool second = std::exchange(rate_read_, true);
  double hz = 0;
  Unit unit;
  if (!constant_of(s.value, "the rate", hz, unit)) return;
  if (!(unit == kPerSecond) || !(hz > 0)) {
    report(s.value->offset, "the rate is no frequency above 0", "write rate = 40 kHz");
    return;
  }
  if (second) {
    report(s.offset, "a second rate", "write one");
    return;
  }
  if (!(rate_hz_ > 0)) law_.rate_hz = hz;
}

void Lowering::note_unused(const std::map<std::string, Symbol>& symbols) {
  for (const auto& [name, symbol] : symbols) {
    // A loop's body is read once for each round.
    const auto same = [&, place = symbol.place](const Unused& u) {
      return u.place.line == place.line && u.place.column == place.column;
    };
    const bool known = std::any_of(law_.unused.begin(), law_.unused.end(), same);
    if (!symbol.used && !known) law_.unused.push_back({name, symbol.place});
  }
}

/// Notes the states and lines of the file that neither an output nor an event depends on, even if
/// their own next values read them.
void Lowering::note_unread() {
  if (!diagnostics_.empty()) return;
  std::vector<char> needed(law_.nodes.size(), 0), read(law_.states.size(), 0),
      heard(law_.lines.size(), 0);
  const auto need = [&](NodeId id) { needed[static_cast<std::size_t>(id)] = 1; };
  for (const Output& o : law_.outputs) need(o.value);
  for (const Event& e : law_.events) need(e.value), need(e.condition);
  for (bool more = true; more;) {
    more = false;
    for (std::size_t i = needed.size(); i-- > 0;) {
      if (needed[i] == 0) continue;
      const Node& n = law_.nodes[i];
      for (const NodeId a : n.arguments) need(a);
      if (n.op != Op::state && n.op != Op::line_read) continue;
      const auto index = static_cast<std::size_t>(n.index);
      if (std::exchange((n.op == Op::state ? read : heard)[index], 1) != 0) continue;
      need(n.op == Op::state ? law_.states[index].next : law_.lines[index].written);
      more = true;
    }
  }
  const auto note = [&](const std::string& name, const Place& place) {
    const auto same = [&](const Unused& u) { return u.name == name; };
    const auto defined = defined_.find(name);
    // Filters and noise have states of their own, which no statement defines.
    if (defined == defined_.end() || defined->second.line != place.line ||
        defined->second.column != place.column ||
        std::any_of(law_.unused.begin(), law_.unused.end(), same)) {
      return;
    }
    law_.unused.push_back({name, place});
  };
  for (std::size_t i = 0; i < read.size(); ++i) {
    if (read[i] == 0) note(law_.states[i].name, law_.states[i].place);
  }
  for (std::size_t i = 0; i < heard.size(); ++i) {
    if (heard[i] == 0) note(law_.lines[i].name, law_.lines[i].place);
  }
}

void Lowering::check_ends(const Statement* last) {
  for (const State& s : law_.states) {
    if (s.follows != kNone || has_next_.count(s.name) != 0) continue;
    diagnostics_.add(s.place, "the state " + quoted(s.name) + " has no next",
                     "write below: next " + s.name + " = ...");
  }
  for (const Line& l : law_.lines) {
    if (has_next_.count(l.name) != 0) continue;
    diagnostics_.add(l.place, "nothing is written into the line " + quoted(l.name),
                     "write below: next " + l.name + " = ...");
  }
  if (any_out_) return;
  diagnostics_.add(last == nullptr ? Place{} : at(last->offset), "the law has no output",
                   "write out torque = ...");
}

// Lowers the `require` statements of a law.

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
