// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lowers expressions: values, operators, conditions.
#include <fmt/format.h>

#include <cmath>

#include "feltgate/nearest.hpp"
#include "law/lowering.hpp"

namespace feltgate::law {

namespace {

constexpr int kMostPower = 8;
constexpr int kMostAxes = 3;
constexpr long kMostSteps = 300'000;
constexpr double kMostRuns = 2e9;  ///< that `time` counts

}  // namespace

void Lowering::count_step(std::size_t offset) {
  if (++steps_ <= kMostSteps) return;
  report(offset, "loops of more than 300000 steps", "make the loops shorter");
  throw TooLong();
}

NodeId Lowering::value_of(const ExpressionPtr& e) {
  using Kind = Expression::Kind;
  count_step(e->offset);
  switch (e->kind) {
    case Kind::number:
      return graph_.constant(e->value * e->unit.to_si, e->unit.unit, at(e->offset));
    case Kind::name:
      return named(*e);
    case Kind::call:
      return call(*e);
    case Kind::index:
      return indexed(*e);
    case Kind::unary:
      return unary(*e);
    case Kind::binary:
      return binary(*e);
    case Kind::power:
      return power(*e);
    case Kind::choice:
      return choice(*e);
    case Kind::reduce:
      return reduce(*e);
  }
  return kNone;
}

NodeId Lowering::number_of(const ExpressionPtr& e) {
  const NodeId id = value_of(e);
  if (id == kNone || !graph_.node(id).truth) return id;
  report(e->offset, "a condition where a number must stand", "write if CONDITION then 1 else 0");
  return kNone;
}

NodeId Lowering::truth_of(const ExpressionPtr& e) {
  const NodeId id = value_of(e);
  if (id == kNone || graph_.node(id).truth) return id;
  report(e->offset, "a number where a condition must stand", "compare it: x > 0");
  return kNone;
}

NodeId Lowering::number_in(const ExpressionPtr& e, const Unit& unit, const std::string& what) {
  const NodeId id = number_of(e);
  if (id == kNone || graph_.node(id).unit == unit) return id;
  if (graph_.is_constant(id) && graph_.node(id).value == 0 && graph_.node(id).unit == kNumber) {
    return graph_.constant(0, unit, at(e->offset));
  }
  report(e->offset, what + " is in " + text_of(unit) + ", not in " + unit_words(*e, id),
         "check the formula's units, factor by factor");
  return kNone;
}

std::string Lowering::unit_words(const Expression& e, NodeId node) {
  const Unit unit = graph_.node(node).unit;
  std::string written = e.unit_text;
  if (e.kind == Expression::Kind::name || e.kind == Expression::Kind::index) {
    const Symbol* const symbol = scope_.find(e.name);
    if (symbol != nullptr) written = symbol->unit_text;
    if (symbol == nullptr && e.name == "position") written = "rad";
    if (symbol == nullptr && e.name == "velocity") written = "rad/s";
  }
  return written.empty() ? text_of(unit) : written;
}

bool Lowering::fit(NodeId& a, NodeId& b, const Expression& ea, const Expression& eb,
                   std::size_t offset, const std::string& joint) {
  if (a == kNone || b == kNone) return false;
  const Unit ua = graph_.node(a).unit, ub = graph_.node(b).unit;
  if (ua == ub) return true;
  const auto is_zero = [&](NodeId id) {
    return graph_.is_constant(id) && graph_.node(id).value == 0 && graph_.node(id).unit == kNumber;
  };
  if (is_zero(a)) {
    a = graph_.constant(0, ub, at(offset));
  } else if (is_zero(b)) {
    b = graph_.constant(0, ua, at(offset));
  } else {
    report(offset, unit_words(ea, a) + " " + joint + " " + unit_words(eb, b) + ": units differ",
           unit_mend(a, b, ub == kNumber ? unit_words(ea, a) : unit_words(eb, b)));
    return false;
  }
  return true;
}

/// The mend for two unequal units; `unit` is the unit of the side that has one.
std::string Lowering::unit_mend(NodeId a, NodeId b, std::string unit) {
  if (unit == "1/s") unit = "rad/s";
  for (const NodeId id : {a, b}) {
    if (!graph_.is_constant(id) || !(graph_.node(id).unit == kNumber)) continue;
    return fmt::format("write {:.6g} {}", graph_.node(id).value, unit);
  }
  return "both sides need the same unit";
}

NodeId Lowering::unknown(const Expression& e, const char* what, bool functions) {
  const auto later = defined_.find(e.name);
  if (e.name == defining_) {
    report(e.offset, "\"" + e.name + "\" is used in its own definition",
           "a value of the run before is a state: state NAME = ..., next NAME = ...");
  } else if (later != defined_.end()) {
    report(e.offset,
           "\"" + e.name + "\" is used before its definition in line " +
               fmt::format("{}", later->second.line),
           "move the definition up");
  } else if (unit_symbol(e.name)) {
    report(e.offset, "the unit \"" + e.name + "\" without a number",
           "write 1 " + e.name + "; names of units are no names of values");
  } else {
    std::vector<std::string> candidates = scope_.names();
    for (const std::string& given : given_names()) {
      if (is_function(given) == functions) candidates.push_back(given);
    }
    const std::string guess = config::nearest(e.name, candidates);
    std::string known = "define it above with param, let or state";
    if (functions) {
      known = "there are";
      for (const std::string& given : given_names()) {
        if (is_function(given)) known += " " + given + ",";
      }
      known += " and what table defines above";
    }
    report(e.offset, std::string("unknown ") + what + " \"" + e.name + "\"",
           guess.empty() ? known : "did you mean \"" + guess + "\"?");
  }
  return kNone;
}

NodeId Lowering::step_time(Place place) {
  law_.timed = true;
  // The file's rate holds from its statement on, even if the caller replaces the rate.
  const bool below = law_.own_rate && !rate_read_;
  if (law_.rate_hz > 0 && !below) return graph_.constant(1 / law_.rate_hz, kSecond, place);
  diagnostics_.add(place, "dt and filters need a rate", "write above: rate = 40 kHz");
  return kNone;
}

/// The time since the scene began: a state counts the runs. It is exact, and stands still at its
/// end.
NodeId Lowering::since_start(Place place) {
  const NodeId dt = step_time(place);
  if (dt == kNone) return kNone;
  if (runs_state_ < 0) {
    State s;
    s.name = "time";
    s.range = {0, kMostRuns};
    s.whole = true;
    s.counts_runs = true;
    s.place = place;
    runs_state_ = static_cast<int>(law_.states.size());
    law_.states.push_back(s);
    const NodeId now = graph_.leaf(Op::state, runs_state_, kNumber, place);
    const NodeId more = graph_.add(now, graph_.constant(1, kNumber, place), place);
    law_.states[law::at(runs_state_)].next =
        graph_.smaller(more, graph_.constant(kMostRuns, kNumber, place), place);
    has_next_.insert(s.name);
  }
  return graph_.multiply(dt, graph_.leaf(Op::state, runs_state_, kNumber, place), place);
}

NodeId Lowering::given_value(const Expression& e, const std::string& name, int axis) {
  const Place place = at(e.offset);
  if (name == "true" || name == "false") return graph_.truth(name == "true", place);
  if (name == "pi") return graph_.constant(kPi, kNumber, place);
  if (name == "dt") return step_time(place);
  if (name == "time") return since_start(place);
  const Source source = name == "position"   ? Source::position
                        : name == "velocity" ? Source::velocity
                                             : Source::tau_hat;
  std::size_t index = 0;
  while (index < law_.inputs.size() &&
         (law_.inputs[index].source != source || law_.inputs[index].axis != axis)) {
    ++index;
  }
  if (index == law_.inputs.size()) {
    const std::string as = axis == 0 ? name : name + "[" + fmt::format("{}", axis) + "]";
    law_.inputs.push_back({source, axis, as});
  }
  const Unit unit = source == Source::position   ? kNumber
                    : source == Source::velocity ? kPerSecond
                                                 : kNewtonMetre;
  return graph_.leaf(Op::input, static_cast<int>(index), unit, place);
}

NodeId Lowering::named(const Expression& e) {
  Symbol* const symbol = scope_.find(e.name);
  if (symbol == nullptr) {
    if (is_function(e.name)) {
      report(e.offset, "the function \"" + e.name + "\" without its argument",
             "write " + e.name + "(...)");
      return kNone;
    }
    if (e.name == "torque") {
      report(e.offset, "\"torque\" is an output and cannot be read",
             "give the expression a name with let");
      return kNone;
    }
    if (is_given_value(e.name) && defined_.count(e.name) == 0) return given_value(e, e.name, 0);
    return unknown(e, "name", false);
  }
  symbol->used = true;
  using Kind = Statement::Kind;
  if (symbol->kind == Kind::table) {
    report(e.offset, "the table \"" + e.name + "\" without its argument",
           "write " + e.name + "(...)");
    return kNone;
  }
  if (symbol->kind == Kind::array || symbol->kind == Kind::line) {
    report(e.offset, "\"" + e.name + "\" without the number of its element",
           "write " + e.name + "[1]");
    return kNone;
  }
  return symbol->node;
}

NodeId Lowering::indexed(const Expression& e) {
  Symbol* const symbol = scope_.find(e.name);
  const auto last = [](std::size_t count) { return static_cast<int>(count) - 1; };
  if (symbol == nullptr) {
    if (e.name != "position" && e.name != "velocity" && e.name != "tau_hat") {
      return unknown(e, "name", false);
    }
    return given_value(e, e.name, whole_of(e.arguments[0], "an axis", 0, kMostAxes - 1));
  }
  symbol->used = true;
  const bool is_array = symbol->kind == Statement::Kind::array;
  if (!is_array && symbol->kind != Statement::Kind::line) {
    report(e.offset, "\"" + e.name + "\" has no elements", "only arrays and lines have: NAME[k]");
    return kNone;
  }
  const NodeId k = number_in(e.arguments[0], kNumber, "the number of an element");
  if (k == kNone || symbol->index < 0) return kNone;
  const auto index = static_cast<std::size_t>(symbol->index);
  if (graph_.is_constant(k)) {
    const int least = is_array ? 0 : 1;
    const int most = is_array ? last(law_.arrays[index].values.size()) : law_.lines[index].length;
    const int wanted = whole_of(e.arguments[0], "the number of an element", least, most);
    if (wanted != graph_.node(k).value) return kNone;
  }
  if (is_array) return graph_.element(symbol->index, k, at(e.offset));
  return graph_.line_read(symbol->index, k, law_.lines[index].unit, at(e.offset));
}

NodeId Lowering::unary(const Expression& e) {
  if (e.name == "not") return graph_.opposite(truth_of(e.arguments[0]), at(e.offset));
  return graph_.negate(number_of(e.arguments[0]), at(e.offset));
}

NodeId Lowering::binary(const Expression& e) {
  const Place place = at(e.offset);
  const ExpressionPtr &ea = e.arguments[0], &eb = e.arguments[1];
  if (e.name == "and" || e.name == "or") {
    const NodeId a = truth_of(ea), b = truth_of(eb);
    return e.name == "and" ? graph_.both(a, b, place) : graph_.either(a, b, place);
  }
  if (e.name.find_first_of("<>=") != std::string::npos) return compare(e);
  NodeId a = number_of(ea), b = number_of(eb);
  if (e.name == "*") return graph_.multiply(a, b, place);
  if (e.name == "/") return graph_.divide(a, b, place);
  if (!fit(a, b, *ea, *eb, e.offset, e.name)) return kNone;
  return e.name == "+" ? graph_.add(a, b, place) : graph_.subtract(a, b, place);
}

NodeId Lowering::compare(const Expression& e) {
  const Place place = at(e.offset);
  ExpressionPtr left = e.arguments[0];
  // a < b < c: both comparisons.
  NodeId before = kNone;
  const bool chained = left->kind == Expression::Kind::binary && !left->brackets &&
                       left->name.find_first_of("<>=") != std::string::npos;
  if (chained) {
    before = value_of(left);
    left = left->arguments[1];
  }
  const bool equality = e.name == "==" || e.name == "!=";
  NodeId a = equality ? value_of(left) : number_of(left);
  NodeId b = equality ? value_of(e.arguments[1]) : number_of(e.arguments[1]);
  if (a == kNone || b == kNone) return kNone;
  if (graph_.node(a).truth != graph_.node(b).truth) {
    report(e.offset, "a condition and a number beside \"" + e.name + "\"",
           "compare the number first, in brackets: (x > 0) " + e.name + " held");
    return kNone;
  }
  if (!fit(a, b, *left, *e.arguments[1], e.offset, e.name)) return kNone;
  if (equality) {
    const NodeId c = equal(e, a, b);
    return chained ? graph_.both(before, c, place) : c;
  }
  const bool swapped = e.name[0] == '>';
  const bool or_equal = e.name.size() == 2;
  // a <= b is the opposite of b < a.
  NodeId c = swapped != or_equal ? graph_.less(b, a, place) : graph_.less(a, b, place);
  if (or_equal) c = graph_.opposite(c, place);
  return chained ? graph_.both(before, c, place) : c;
}

NodeId Lowering::equal(const Expression& e, NodeId a, NodeId b) {
  const Place place = at(e.offset);
  if (graph_.node(a).truth) {
    if (graph_.is_constant(a)) std::swap(a, b);
    if (graph_.is_constant(b)) {
      return (graph_.node(b).value != 0) == (e.name == "==") ? a : graph_.opposite(a, place);
    }
    a = zero_or_one(a, place);
    b = zero_or_one(b, place);
  }
  if (!graph_.node(a).whole || !graph_.node(b).whole) {
    report(e.offset, "\"" + e.name + "\" between numbers that are never quite the same",
           "compare with <, <=, > or >=, or make both whole");
    return kNone;
  }
  NodeId differ = graph_.less(a, b, place);
  differ = graph_.either(differ, graph_.less(b, a, place), place);
  return e.name == "==" ? graph_.opposite(differ, place) : differ;
}

/// A condition as 0 or 1; of a bool it is the state itself.
NodeId Lowering::zero_or_one(NodeId truth, Place place) {
  const Node& n = graph_.node(truth);
  if (n.op == Op::less && graph_.is_constant(n.arguments[0])) {
    const Node& state = graph_.node(n.arguments[1]);
    const bool is_bool = graph_.node(n.arguments[0]).value == 0 && state.op == Op::state &&
                         state.whole && law_.states[law::at(state.index)].range.lower == 0 &&
                         law_.states[law::at(state.index)].range.upper == 1;
    if (is_bool) return n.arguments[1];
  }
  return graph_.select(truth, graph_.constant(1, kNumber, place),
                       graph_.constant(0, kNumber, place), place);
}

NodeId Lowering::power(const Expression& e) {
  const NodeId base = number_of(e.arguments[0]);
  const int exponent = std::abs(e.value) <= kMostPower ? static_cast<int>(e.value) : 0;
  if (exponent == 0) {
    report(e.offset, "a power that is no whole number from 1 to 8 or -8 to -1",
           "write products of smaller powers");
    return kNone;
  }
  // Uses repeated squares, so that x^4 takes two products.
  NodeId result = kNone, square = base;
  for (int rest = std::abs(exponent); rest > 0; rest /= 2) {
    if (rest % 2 != 0) {
      result = result == kNone ? square : graph_.multiply(result, square, at(e.offset));
    }
    if (rest > 1) square = graph_.multiply(square, square, at(e.offset));
  }
  if (exponent > 0) return result;
  return graph_.divide(graph_.constant(1, kNumber, at(e.offset)), result, at(e.offset));
}

NodeId Lowering::choice(const Expression& e) {
  const NodeId condition = truth_of(e.arguments[0]);
  const ExpressionPtr &ea = e.arguments[1], &eb = e.arguments[2];
  NodeId a = value_of(ea), b = value_of(eb);
  if (a == kNone || b == kNone) return kNone;
  if (graph_.node(a).truth != graph_.node(b).truth) {
    report(e.offset, "a condition and a number as the two values of an if",
           "both must be numbers, or both conditions");
    return kNone;
  }
  if (!fit(a, b, *ea, *eb, e.offset, "or")) return kNone;
  return graph_.select(condition, a, b, at(e.offset));
}

NodeId Lowering::reduce(const Expression& e) {
  const auto [from, to] = loop_range(e.arguments[0], e.arguments[1]);
  NodeId result = kNone;
  const ExpressionPtr& body = e.arguments[2];
  if (scope_.find(e.variable) != nullptr) {
    report(e.offset, "\"" + e.variable + "\" is defined already", "choose another name");
    return kNone;
  }
  for (int i = from; i <= to; ++i) {
    scope_.open();
    Symbol counter;
    counter.node = graph_.constant(i, kNumber, at(e.offset));
    scope_.define(e.variable, counter);
    NodeId one = number_of(body);
    scope_.close();
    if (one == kNone) return kNone;
    if (i == from) {
      result = one;
    } else if (!fit(result, one, *body, *body, body->offset, "and")) {
      return kNone;
    } else {
      const Place place = at(e.offset);
      result = e.name == "sum"   ? graph_.add(result, one, place)
               : e.name == "min" ? graph_.smaller(result, one, place)
                                 : graph_.larger(result, one, place);
    }
  }
  return result;
}

}  // namespace feltgate::law
