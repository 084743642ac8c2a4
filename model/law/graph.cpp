// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "law/graph.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "law/ranges.hpp"
#include "law/units.hpp"

namespace feltgate::law {

namespace {

constexpr std::size_t kMostNodes = 20'000;

/// Whether a node is certainly a whole number.
bool is_whole(const Law& law, const Node& n) {
  const auto index = static_cast<std::size_t>(n.index);
  const auto argument = [&](std::size_t i) {
    return law.nodes[static_cast<std::size_t>(n.arguments[i])].whole;
  };
  switch (n.op) {
    case Op::constant:
      return std::floor(n.value) == n.value;
    case Op::parameter:
      return law.parameters[index].whole;
    case Op::state:
      return law.states[index].whole;
    case Op::element: {
      const std::vector<double>& all = law.arrays[index].values;
      return std::all_of(all.begin(), all.end(), [](double x) { return std::floor(x) == x; });
    }
    case Op::select:
      return argument(1) && argument(2);
    case Op::negate:
    case Op::absolute:
      return argument(0);
    case Op::add:
    case Op::subtract:
    case Op::multiply:
    case Op::minimum:
    case Op::maximum:
      return argument(0) && argument(1);
    default:
      return false;
  }
}

bool any_none(std::initializer_list<NodeId> ids) {
  return std::any_of(ids.begin(), ids.end(), [](NodeId id) { return id == kNone; });
}

}  // namespace

NodeId Graph::make(Op op, std::vector<NodeId> arguments, const Unit& unit, Place place, int index,
                   double value, bool truth) {
  if (value == 0) value = 0;  // -0 is 0
  Key key{op, arguments, index, value, truth, unit.exponents};
  const auto found = known_.find(key);
  if (found != known_.end()) return found->second;
  if (law_.nodes.size() >= kMostNodes) {
    diagnostics_.add(place, "a law of more than 20000 operations",
                     "make the loops shorter; the engine's program has 512");
    return kNone;
  }
  bool fixed = op != Op::input && op != Op::state && op != Op::line_read;
  if (op == Op::parameter) fixed = !law_.parameters[static_cast<std::size_t>(index)].mailbox;
  for (const NodeId a : arguments) fixed = fixed && is_fixed(a);
  Node n;
  n.op = op;
  n.arguments = std::move(arguments);
  n.index = index;
  n.value = value;
  n.truth = truth;
  n.unit = unit;
  n.place = place;
  n.whole = is_whole(law_, n);
  law_.nodes.push_back(std::move(n));
  fixed_.push_back(fixed);
  const auto id = static_cast<NodeId>(law_.nodes.size()) - 1;
  known_.emplace(std::move(key), id);
  return id;
}

NodeId Graph::constant(double value, const Unit& unit, Place place) {
  if (!std::isfinite(value) || std::abs(value) > kLargest) {
    diagnostics_.add(place, "a value that is not finite", "numbers lie between -1e300 and 1e300");
    return kNone;
  }
  return make(Op::constant, {}, unit, place, -1, value);
}

NodeId Graph::truth(bool value, Place place) {
  return make(Op::constant, {}, kNumber, place, -1, value ? 1 : 0, true);
}

NodeId Graph::leaf(Op op, int index, const Unit& unit, Place place) {
  return make(op, {}, unit, place, index);
}

NodeId Graph::table_argument(int table, const Unit& unit, Place place) {
  return make(Op::input, {}, unit, place, -1, table);
}

bool Graph::is_value(NodeId id, double value) const {
  return is_constant(id) && !node(id).truth && node(id).value == value;
}

bool Graph::is_scaled(NodeId id) const {
  return node(id).op == Op::multiply && is_fixed(argument(id, 0)) && !is_fixed(argument(id, 1));
}

NodeId Graph::add(NodeId a, NodeId b, Place place) {
  if (any_none({a, b})) return kNone;
  if (is_constant(a) && is_constant(b)) {
    return constant(node(a).value + node(b).value, node(a).unit, place);
  }
  if (is_value(a, 0)) return b;
  if (is_value(b, 0)) return a;
  if (node(b).op == Op::negate) return subtract(a, argument(b, 0), place);
  if (node(a).op == Op::negate) return subtract(b, argument(a, 0), place);
  return make(Op::add, {std::min(a, b), std::max(a, b)}, node(a).unit, place);
}

NodeId Graph::subtract(NodeId a, NodeId b, Place place) {
  if (any_none({a, b})) return kNone;
  if (is_constant(a) && is_constant(b)) {
    return constant(node(a).value - node(b).value, node(a).unit, place);
  }
  if (a == b) return constant(0, node(a).unit, place);
  if (is_value(b, 0)) return a;
  if (is_value(a, 0)) return negate(b, place);
  if (node(b).op == Op::negate) return add(a, argument(b, 0), place);
  return make(Op::subtract, {a, b}, node(a).unit, place);
}

NodeId Graph::multiply(NodeId a, NodeId b, Place place) {
  if (any_none({a, b})) return kNone;
  const Unit unit = node(a).unit + node(b).unit;
  if (is_constant(a) && is_constant(b)) {
    return constant(node(a).value * node(b).value, unit, place);
  }
  if (is_value(a, 0) || is_value(b, 0)) return constant(0, unit, place);
  if (is_fixed(b) && !is_fixed(a)) std::swap(a, b);
  if (is_fixed(a) == is_fixed(b) && a > b) std::swap(a, b);
  if (is_constant(b)) std::swap(a, b);
  if (node(a).unit == kNumber && is_value(a, 1)) return b;
  if (node(a).unit == kNumber && is_value(a, -1)) return negate(b, place);
  if (is_fixed(b)) return fixed_product(a, b, place);
  // From here on, b changes during a run.
  if (is_fixed(a)) return scale(a, b, place);
  if (node(a).op == Op::negate) return negate(multiply(argument(a, 0), b, place), place);
  if (node(b).op == Op::negate) return negate(multiply(a, argument(b, 0), place), place);
  return make(Op::multiply, {a, b}, unit, place);
}

NodeId Graph::fixed_product(NodeId a, NodeId b, Place place) {
  const auto has_number = [&](NodeId id) {
    return node(id).op == Op::multiply && is_constant(argument(id, 0));
  };
  if (node(b).op == Op::negate) return negate(multiply(a, argument(b, 0), place), place);
  if (node(a).op == Op::negate) return negate(multiply(argument(a, 0), b, place), place);
  if (has_number(b)) {
    const NodeId number = argument(b, 0), rest = argument(b, 1);
    return is_constant(a) ? multiply(multiply(a, number, place), rest, place)
                          : multiply(number, multiply(a, rest, place), place);
  }
  if (has_number(a)) {
    return multiply(argument(a, 0), multiply(argument(a, 1), b, place), place);
  }
  return make(Op::multiply, {a, b}, node(a).unit + node(b).unit, place);
}

NodeId Graph::scale(NodeId factor, NodeId a, Place place) {
  const Node n = node(a);
  if (n.op == Op::negate) return multiply(negate(factor, place), n.arguments[0], place);
  if (n.op == Op::select && is_fixed(n.arguments[1]) && is_fixed(n.arguments[2])) {
    return select(n.arguments[0], multiply(factor, n.arguments[1], place),
                  multiply(factor, n.arguments[2], place), place);
  }
  if (n.op == Op::multiply) {
    const NodeId first = n.arguments[0], second = n.arguments[1];
    if (is_scaled(a)) return multiply(multiply(factor, first, place), second, place);
    if (is_scaled(first) && is_scaled(second)) {
      const NodeId factors = multiply(argument(first, 0), argument(second, 0), place);
      return multiply(multiply(factor, factors, place),
                      multiply(argument(first, 1), argument(second, 1), place), place);
    }
    if (is_scaled(first)) return multiply(scale(factor, first, place), second, place);
    if (is_scaled(second)) return multiply(first, scale(factor, second, place), place);
  }
  return make(Op::multiply, {factor, a}, node(factor).unit + n.unit, place);
}

NodeId Graph::divide(NodeId a, NodeId b, Place place) {
  if (any_none({a, b})) return kNone;
  const Unit unit = kNumber - node(b).unit;
  if (is_constant(b)) {
    if (node(b).value == 0) {
      diagnostics_.add(place, "a division by 0", "the divisor must not be 0");
      return kNone;
    }
    if (is_constant(a)) return constant(node(a).value / node(b).value, node(a).unit + unit, place);
    return multiply(a, constant(1 / node(b).value, unit, place), place);
  }
  return multiply(a, make(Op::reciprocal, {b}, unit, place), place);
}

NodeId Graph::negate(NodeId a, Place place) {
  if (a == kNone) return kNone;
  const Node n = node(a);
  if (n.op == Op::constant) return constant(-n.value, n.unit, place);
  if (n.op == Op::negate) return n.arguments[0];
  if (n.op == Op::subtract) return subtract(n.arguments[1], n.arguments[0], place);
  const bool numbered = n.op == Op::multiply && is_constant(n.arguments[0]);
  if (is_scaled(a) || numbered) {
    return multiply(negate(n.arguments[0], place), n.arguments[1], place);
  }
  return make(Op::negate, {a}, n.unit, place);
}

NodeId Graph::absolute(NodeId a, Place place) {
  if (a == kNone) return kNone;
  const Node n = node(a);
  if (n.op == Op::constant) return constant(std::abs(n.value), n.unit, place);
  if (n.op == Op::absolute) return a;
  if (n.op == Op::negate) return absolute(n.arguments[0], place);
  return make(Op::absolute, {a}, n.unit, place);
}

NodeId Graph::extreme(Op op, NodeId a, NodeId b, Place place) {
  if (any_none({a, b})) return kNone;
  if (a == b) return a;
  if (is_constant(a) && is_constant(b)) {
    return (node(a).value < node(b).value) == (op == Op::minimum) ? a : b;
  }
  return make(op, {std::min(a, b), std::max(a, b)}, node(a).unit, place);
}

NodeId Graph::smaller(NodeId a, NodeId b, Place place) { return extreme(Op::minimum, a, b, place); }
NodeId Graph::larger(NodeId a, NodeId b, Place place) { return extreme(Op::maximum, a, b, place); }

NodeId Graph::less(NodeId a, NodeId b, Place place) {
  if (any_none({a, b})) return kNone;
  if (a == b) return truth(false, place);
  if (is_constant(a) && is_constant(b)) return truth(node(a).value < node(b).value, place);
  return make(Op::less, {a, b}, kNumber, place, -1, 0, true);
}

NodeId Graph::both(NodeId a, NodeId b, Place place) {
  if (any_none({a, b})) return kNone;
  if (is_constant(a)) return node(a).value != 0 ? b : a;
  if (is_constant(b)) return node(b).value != 0 ? a : b;
  if (a == b) return a;
  if (node(a).op == Op::opposite && node(b).op == Op::opposite) {
    return opposite(either(argument(a, 0), argument(b, 0), place), place);
  }
  return make(Op::both, {std::min(a, b), std::max(a, b)}, kNumber, place, -1, 0, true);
}

NodeId Graph::either(NodeId a, NodeId b, Place place) {
  if (any_none({a, b})) return kNone;
  if (is_constant(a)) return node(a).value != 0 ? a : b;
  if (is_constant(b)) return node(b).value != 0 ? b : a;
  if (a == b) return a;
  if (node(a).op == Op::opposite && node(b).op == Op::opposite) {
    return opposite(both(argument(a, 0), argument(b, 0), place), place);
  }
  return make(Op::either, {std::min(a, b), std::max(a, b)}, kNumber, place, -1, 0, true);
}

NodeId Graph::opposite(NodeId a, Place place) {
  if (a == kNone) return kNone;
  if (is_constant(a)) return truth(node(a).value == 0, place);
  if (node(a).op == Op::opposite) return argument(a, 0);
  return make(Op::opposite, {a}, kNumber, place, -1, 0, true);
}

NodeId Graph::select(NodeId condition, NodeId yes, NodeId no, Place place) {
  if (any_none({condition, yes, no})) return kNone;
  if (is_constant(condition)) return node(condition).value != 0 ? yes : no;
  if (yes == no) return yes;
  if (node(condition).op == Op::opposite) return select(argument(condition, 0), no, yes, place);
  if (node(yes).truth) {
    return either(both(condition, yes, place), both(opposite(condition, place), no, place), place);
  }
  return make(Op::select, {condition, yes, no}, node(yes).unit, place);
}

NodeId Graph::function(Op op, NodeId a, Place place) {
  if (a == kNone) return kNone;
  const Node n = node(a);
  Unit unit = n.unit;
  for (int& exponent : unit.exponents) exponent /= op == Op::root ? 2 : 1;
  if (n.op != Op::constant) return make(op, {a}, unit, place);
  if (op == Op::root && n.value < 0) {
    diagnostics_.add(place, "the square root of a number below 0",
                     "its argument must be 0 or more");
    return kNone;
  }
  if (op == Op::logarithm) {
    if (n.value > 0) return constant(std::log(n.value), unit, place);
    diagnostics_.add(place, "the logarithm of a number that is not above 0",
                     "its argument must be above 0");
    return kNone;
  }
  const double value = op == Op::sine         ? std::sin(n.value)
                       : op == Op::cosine     ? std::cos(n.value)
                       : op == Op::root       ? std::sqrt(n.value)
                       : op == Op::arctangent ? std::atan(n.value)
                                              : std::exp(n.value);
  return constant(value, unit, place);
}

NodeId Graph::lookup(int table, NodeId a, const Unit& unit, Place place) {
  if (a == kNone || !is_constant(a)) {
    return a == kNone ? kNone : make(Op::lookup, {a}, unit, place, table);
  }
  const Table& t = law_.tables[static_cast<std::size_t>(table)];
  const double x = node(a).value;
  const double inside = t.periodic ? x : std::clamp(x, t.domain.lower, t.domain.upper);
  return constant(table_value(law_, t, inside), unit, place);
}

NodeId Graph::element(int array, NodeId a, Place place) {
  if (a == kNone) return kNone;
  const Array& from = law_.arrays[static_cast<std::size_t>(array)];
  if (!is_constant(a)) return make(Op::element, {a}, from.unit, place, array);
  return constant(from.values[static_cast<std::size_t>(node(a).value)], from.unit, place);
}

NodeId Graph::line_read(int line, NodeId a, const Unit& unit, Place place) {
  return a == kNone ? kNone : make(Op::line_read, {a}, unit, place, line);
}

}  // namespace feltgate::law
