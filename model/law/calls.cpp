// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lowers calls: the functions of the language, and tables. Documentation: docs/laws.md
#include <fmt/format.h>

#include <string>

#include "law/lowering.hpp"

namespace feltgate::law {

namespace {

constexpr double kFastest = 1.8;  ///< largest ratio of lowpass frequency to rate: exp(-2 pi 1.8)

}  // namespace

bool Lowering::takes(const Expression& e, std::size_t count, const char* form) {
  if (e.arguments.size() == count) return true;
  report(e.offset, e.name + " with " + fmt::format("{}", e.arguments.size()) + " arguments",
         std::string("write ") + form);
  return false;
}

NodeId Lowering::call(const Expression& e) {
  Symbol* const symbol = scope_.find(e.name);
  if (symbol != nullptr) {
    symbol->used = true;
    if (symbol->kind == Statement::Kind::table) return call_table(e, *symbol);
    report(e.offset, "\"" + e.name + "\" is no function", "between factors stands *");
    return kNone;
  }
  if (!is_function(e.name)) return unknown(e, "function", true);
  if (e.name == "min" || e.name == "max") return call_extreme(e);
  if (e.name == "clamp") return clamp(e);
  if (e.name == "sgn") return sign(e);
  if (e.name == "sin") return trigonometric(e, Op::sine);
  if (e.name == "cos") return trigonometric(e, Op::cosine);
  if (e.name == "sqrt") return root(e);
  if (e.name == "lowpass") return lowpass(e);
  if (e.name == "floor") return floor_call(e);
  if (e.name == "round") return round_call(e);
  if (e.name == "mod") return mod(e);
  if (e.name == "noise") return noise(e);
  if (e.name == "atan2") return angle(e);
  if (e.name == "abs") {
    return takes(e, 1, "abs(x)") ? graph_.absolute(number_of(e.arguments[0]), at(e.offset)) : kNone;
  }
  if (e.name == "exp") {
    if (!takes(e, 1, "exp(x)")) return kNone;
    return graph_.function(Op::exponential, number_in(e.arguments[0], kNumber, "the argument"),
                           at(e.offset));
  }
  if (e.name == "log") {
    if (!takes(e, 1, "log(x)")) return kNone;
    return graph_.function(Op::logarithm, number_in(e.arguments[0], kNumber, "the argument"),
                           at(e.offset));
  }
  report(e.offset, "a sum without a range", "write sum(i in 0 .. 3: EXPRESSION)");
  return kNone;
}

NodeId Lowering::call_table(const Expression& e, Symbol& symbol) {
  const std::string form = e.name + "(x)";
  if (!takes(e, 1, form.c_str())) return kNone;
  const NodeId x = number_of(e.arguments[0]);
  if (x == kNone || symbol.index < 0) return kNone;
  const Table& table = law_.tables[static_cast<std::size_t>(symbol.index)];
  const Unit wanted = graph_.node(table.argument).unit;
  const NodeId fitting = number_in(e.arguments[0], wanted, "the argument of " + e.name);
  return graph_.lookup(symbol.index, fitting, graph_.node(table.body).unit, at(e.offset));
}

NodeId Lowering::call_extreme(const Expression& e) {
  if (e.arguments.size() < 2) {
    report(e.offset, e.name + " with one argument", "write " + e.name + "(a, b)");
    return kNone;
  }
  NodeId result = number_of(e.arguments[0]);
  for (std::size_t i = 1; i < e.arguments.size(); ++i) {
    NodeId next = number_of(e.arguments[i]);
    if (!fit(result, next, *e.arguments[i - 1], *e.arguments[i], e.arguments[i]->offset, "and")) {
      return kNone;
    }
    result = e.name == "min" ? graph_.smaller(result, next, at(e.offset))
                             : graph_.larger(result, next, at(e.offset));
  }
  return result;
}

NodeId Lowering::clamp(const Expression& e) {
  if (!takes(e, 3, "clamp(x, lower, upper)")) return kNone;
  const ExpressionPtr &ex = e.arguments[0], &el = e.arguments[1], &eu = e.arguments[2];
  NodeId x = number_of(ex), lower = number_of(el), upper = number_of(eu);
  if (!fit(x, lower, *ex, *el, el->offset, "and") || !fit(x, upper, *ex, *eu, eu->offset, "and")) {
    return kNone;
  }
  if (graph_.is_constant(lower) && graph_.is_constant(upper) &&
      graph_.node(lower).value > graph_.node(upper).value) {
    report(e.offset, "the ends of clamp are upside down", "write clamp(x, lower, upper)");
    return kNone;
  }
  const Place place = at(e.offset);
  return graph_.smaller(graph_.larger(x, lower, place), upper, place);
}

NodeId Lowering::sign(const Expression& e) {
  if (!takes(e, 1, "sgn(x)")) return kNone;
  const Place place = at(e.offset);
  const NodeId x = number_of(e.arguments[0]);
  if (x == kNone) return kNone;
  const NodeId below = graph_.less(x, graph_.constant(0, graph_.node(x).unit, place), place);
  return graph_.select(below, graph_.constant(-1, kNumber, place),
                       graph_.constant(1, kNumber, place), place);
}

NodeId Lowering::trigonometric(const Expression& e, Op op) {
  if (!takes(e, 1, op == Op::sine ? "sin(x)" : "cos(x)")) return kNone;
  return graph_.function(op, number_in(e.arguments[0], kNumber, "the angle"), at(e.offset));
}

NodeId Lowering::root(const Expression& e) {
  if (!takes(e, 1, "sqrt(x)")) return kNone;
  const NodeId x = number_of(e.arguments[0]);
  if (x == kNone) return kNone;
  for (const int exponent : graph_.node(x).unit.exponents) {
    if (exponent % 2 == 0) continue;
    report(e.offset, "the square root of " + unit_words(*e.arguments[0], x),
           "its argument's unit must be a square: m^2, or a number");
    return kNone;
  }
  return graph_.function(Op::root, x, at(e.offset));
}

/// y += (1 - exp(-2 pi f dt)) (x - y): the step response of the filter is exact at every rate.
NodeId Lowering::lowpass(const Expression& e) {
  if (!takes(e, 2, "lowpass(x, 144 Hz)")) return kNone;
  const Place place = at(e.offset);
  const NodeId x = number_of(e.arguments[0]);
  const NodeId f = number_in(e.arguments[1], kPerSecond, "the frequency of lowpass");
  const NodeId dt = step_time(place);
  if (x == kNone || f == kNone || dt == kNone) return kNone;
  if (graph_.is_constant(f) && graph_.node(f).value <= 0) {
    report(e.offset, "a lowpass whose frequency is not above 0", "write lowpass(x, 144 Hz)");
    return kNone;
  }
  if (!graph_.is_fixed(f)) {
    report(e.offset, "a lowpass whose frequency changes during a run",
           "make the frequency a constant or a param");
    return kNone;
  }
  const Node frequency = graph_.node(f);
  const double highest =
      frequency.op == Op::parameter
          ? law_.parameters[static_cast<std::size_t>(frequency.index)].range.upper
          : frequency.value;
  // Above, the next value equals the input to all bits of a factor.
  if (highest > kFastest * law_.rate_hz) {
    report(e.offset,
           fmt::format("a lowpass of {:.6g} Hz in a law that runs at {:.6g} Hz, which passes all",
                       highest, law_.rate_hz),
           fmt::format("write a frequency to {:.6g} Hz, or no lowpass", law_.rate_hz / 2));
    return kNone;
  }
  const NodeId turns = graph_.multiply(
      graph_.multiply(graph_.constant(-2 * kPi, kNumber, place), dt, place), f, place);
  const NodeId share = graph_.subtract(graph_.constant(1, kNumber, place),
                                       graph_.function(Op::exponential, turns, place), place);
  const auto known = filters_.find({x, share});
  if (known != filters_.end()) return known->second;
  State s;
  s.name = "lowpass_" + fmt::format("{}", filters_.size() + 1);
  s.unit = graph_.node(x).unit;
  s.unit_text = s.unit == kNumber ? "" : text_of(s.unit);
  s.follows = x;
  s.place = place;
  const auto index = static_cast<int>(law_.states.size());
  law_.states.push_back(s);
  const NodeId y = graph_.leaf(Op::state, index, s.unit, place);
  const NodeId next =
      graph_.add(y, graph_.multiply(share, graph_.subtract(x, y, place), place), place);
  law_.states[static_cast<std::size_t>(index)].next = next;
  filters_[{x, share}] = next;
  return next;
}

}  // namespace feltgate::law
