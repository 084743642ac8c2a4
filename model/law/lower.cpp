// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lowers values and selections, and aligns their formats. Documentation: docs/laws.md
#include <cmath>

#include "law/back_end.hpp"

namespace feltgate::law {

constexpr double kLeastSteps = 256;  ///< of the range of a state that is no whole number

bool same_unit(double a, double b) {
  const double bits = std::log2(std::fabs(a / b));
  return std::fabs(bits - std::nearbyint(bits)) < 1e-12;
}
bool counts(double scale) { return scale <= 1 && same_unit(scale, 1); }
bool same_scale(double a, double b) { return std::fabs(a / b - 1) < 1e-12; }

BackEnd::BackEnd(const Law& law, const Target& target, const std::vector<Span>& spans,
                 Choice& choice)
    : law_(law),
      target_(target),
      spans_(spans),
      choice_(choice),
      fixed_(fixed_nodes(law)),
      users_(law.nodes.size(), 0) {
  if (choice_.stays == nullptr) choice_.stays = std::make_shared<const Stays>(law);
  for (const NodeId id : needed(law)) {
    for (const NodeId a : node(id).arguments) ++users_[static_cast<std::size_t>(a)];
  }
  const auto use = [this](NodeId id) {
    if (id >= 0) ++users_[static_cast<std::size_t>(id)];
  };
  for (const Output& o : law.outputs) use(o.value);
  for (const State& s : law.states) use(s.next);
  for (const Event& e : law.events) use(e.value);
  for (const Line& l : law.lines) use(l.written);
}

Program lower(const Law& law, const Target& target, const std::vector<Span>& spans,
              Choice& choice) {
  return BackEnd(law, target, spans, choice).run();
}

Step& BackEnd::emit(EngineOp op, int mode, Operand x, Operand y, double scale, NodeId origin) {
  Step s;
  s.op = op;
  s.mode = mode;
  s.x = x;
  s.y = y;
  s.scale = scale;
  if (origin >= 0) s.place = node(origin).place;
  program_.steps.push_back(s);
  return program_.steps.back();
}

int BackEnd::word(const std::vector<NodeId>& nodes, double scale) {
  for (std::size_t i = 0; i < program_.words.size(); ++i) {
    const Word& w = program_.words[i];
    if (w.nodes == nodes && same_scale(w.scale, scale)) return static_cast<int>(i);
  }
  Word w;
  w.nodes = nodes;
  w.scale = scale;
  program_.words.push_back(w);
  return static_cast<int>(program_.words.size()) - 1;
}

Operand BackEnd::constant(double value, NodeId of) {
  if (!(std::fabs(value) <= 2147483647.0)) throw Unfit("a constant does not fit in 32 bits", of);
  const auto c = static_cast<std::int32_t>(std::nearbyint(value));
  for (std::size_t i = 0; i < program_.constants.size(); ++i) {
    if (program_.constants[i] == c) return {From::constant, static_cast<int>(i), value};
  }
  program_.constants.push_back(c);
  return {From::constant, static_cast<int>(program_.constants.size()) - 1, value};
}

double BackEnd::fixed_size(const std::vector<NodeId>& nodes) const {
  double size = 1;
  for (const NodeId id : nodes) size *= span(id).size();
  return size;
}

int BackEnd::largest_fraction(NodeId id, double unit, double size) const {
  if (!(size < infinity)) {
    throw Refused(node(id).place, "the range of this has no end",
                  "limit what it is made of, e.g. with clamp or a larger lower end of a divisor");
  }
  // A product with 0 has a size of some 1e-324, because intervals are rounded outwards.
  if (size < 1e-100) return 30;
  const double limit = 2147483647.0 * (1 - 1.0 / 512) - 8;
  return static_cast<int>(std::floor(std::log2(limit * unit / size)));
}

/// Scale of a node with a format of its own: the chosen one, or at most `preferred` fraction bits.
double BackEnd::chosen_scale(NodeId id, double unit, int preferred, double size) {
  const auto found = choice_.fraction.find(id);
  const int most = largest_fraction(id, unit, size);
  const Op op = node(id).op;
  const int least = op == Op::state ? law_.states[at(node(id).index)].least_fraction : 0;
  if (choice_.uniform > 0 && (op == Op::state || op == Op::select || op == Op::parameter)) {
    preferred = std::max(choice_.uniform, least);
  }
  int fraction = std::min(preferred, most);
  if (found != choice_.fraction.end()) {
    if (found->second > most) throw Unfit("a value does not fit in 32 bits", id);
    fraction = found->second;
    // Of a value that reaches no output any step would be as good.
    if (node(id).whole && std::ldexp(unit, -fraction) > 1) {
      throw Unfit("a whole value counts in ones", id);
    }
    if (least > 0 && fraction < least) throw Unfit("noise repeats early in fewer bits", id);
  }
  choice_.fraction[id] = fraction;
  return std::ldexp(unit, -fraction);
}

Value BackEnd::value(NodeId id, double hint) {
  const auto found = values_.find(id);
  if (found != values_.end()) return found->second;
  Value v = compute(id, hint);
  v.size = span(id).size();
  return values_[id] = v;
}

Value BackEnd::compute(NodeId id, double hint) {
  const Node& n = node(id);
  switch (n.op) {
    case Op::input: {
      const Input& input = law_.inputs[static_cast<std::size_t>(n.index)];
      const double scale = input.source == Source::position ? target_.count_rad()
                           : input.source == Source::velocity
                               ? std::ldexp(1.0, -target_.velocity.fraction)
                               : std::ldexp(1.0, -target_.torque.fraction);
      return {{From::input, n.index}, scale, 0};
    }
    case Op::state:
      return state(id);
    case Op::parameter:
      return mailbox(id);
    case Op::add:
    case Op::subtract:
    case Op::multiply:
    case Op::negate:
      return sum(id, hint);
    case Op::minimum:
    case Op::maximum:
    case Op::select:
      return selection(id, hint);
    case Op::absolute:
      return absolute(id, hint);
    case Op::sine:
    case Op::cosine:
      return sine(id);
    case Op::root:
    case Op::reciprocal:
    case Op::exponential:
    case Op::logarithm:
    case Op::lookup:
      return function(id);
    case Op::element:
      return element(id);
    case Op::line_read:
      return line_read(id);
    default:
      throw Refused(n.place, "a truth value cannot be a number here", "write: condition ? 1 : 0");
  }
}

/// Whether a word of this scale cannot hold a whole parameter's value exactly, as it must.
bool BackEnd::breaks(const std::vector<NodeId>& fixed, double word_scale) const {
  if (fixed.size() != 1) return false;
  const Node& n = node(fixed[0]);
  const double ones = 1 / word_scale;
  return n.op == Op::parameter && n.whole &&
         std::fabs(ones - std::nearbyint(ones)) > 1e-12 * std::fabs(ones);
}

/// The word of a whole parameter, with scale 1.
Value BackEnd::in_ones(const std::vector<NodeId>& fixed) {
  return {{From::word, word(fixed, 1)}, 1, fixed_size(fixed)};
}

/// A fixed node as a word or constant of this scale; for another node, its value aligned to it.
Value BackEnd::at_scale(NodeId id, double scale, double* error) {
  *error = 0;
  if (!is_fixed(id)) {
    const Value v = value(id, scale);
    return choice_.stays->decides(id) && !same_scale(v.scale, scale) ? with_ends(id, scale, false)
                                                                     : align(v, scale, id);
  }
  Term term;
  gather(id, true, term);
  if (!term.factors.empty()) throw std::logic_error("a formula of parameters has other factors");
  if (fixed_size(term.fixed) * std::fabs(term.number) / scale > 2147483000.0) {
    throw Unfit("it does not fit in 32 bits", id, scale);
  }
  if (term.fixed.empty()) {
    const double exact = term.number / scale;
    *error = std::fabs(exact - std::nearbyint(exact));
    if (*error < 1e-12 * std::fabs(exact)) *error = 0;
    return {constant(exact), scale, std::fabs(term.number)};
  }
  if (breaks(term.fixed, scale / term.number)) {
    Value v = in_ones(term.fixed);
    v.scale *= std::fabs(term.number);
    v.size *= std::fabs(term.number);
    v = align(v, scale, id);
    return term.number < 0 ? negated(v, id) : v;
  }
  return {{From::word, word(term.fixed, scale / term.number)}, scale, span(id).size()};
}

Value BackEnd::align(const Value& v, double scale, NodeId id) {
  if (same_scale(v.scale, scale)) return v;
  for (const auto& [from, to] : aligned_) {
    if (from.operand == v.operand && same_scale(to.scale, scale) &&
        same_scale(from.scale, v.scale)) {
      return to;
    }
  }
  if (v.size / scale > 2147483647.0 * (1 - 1.0 / 512)) {
    throw Unfit("a value does not fit in 32 bits", id, scale);
  }
  const Multiply m = by_number(v, v.scale / scale, id);
  emit(EngineOp::mul, m.mode, m.x, m.y, scale, id).y_error = m.y_error;
  const Value to{last(), scale, v.size};
  aligned_.push_back({v, to});
  return to;
}

/// Common scale of several nodes: the unit of the first node that is not fixed, with its fraction
/// bits or the chosen ones.
double BackEnd::common_scale(NodeId id, const std::vector<NodeId>& children, double hint,
                             bool chosen) {
  double scale = 0, size = 0;
  for (const NodeId c : children) size = std::max(size, span(c).size());
  for (const NodeId c : children) {
    if (is_fixed(c)) continue;
    const Value v = value(c, hint);
    if (scale == 0) {
      scale = v.scale;
    } else if (chosen ? v.scale > scale : v.scale < scale) {
      // A selection uses the smaller number of bits, a comparison the larger one if all fit.
      if (same_unit(v.scale, scale)) scale = v.scale;
    }
  }
  const bool whole =
      std::all_of(children.begin(), children.end(), [this](NodeId c) { return node(c).whole; });
  if (whole && (chosen || !is_fixed(children[0]) == !is_fixed(children[1]))) {
    // Whole numbers count in ones, or in parts of one.
    if (scale == 0 && !counts(hint)) hint = 0;
    if (scale != 0 && !counts(scale)) scale = 1;
  }
  const double unit_scale = scale == 0 ? 1.0 : scale;
  const double unit = unit_scale / std::exp2(std::floor(std::log2(unit_scale) + 1e-9));
  if (scale == 0 && hint != 0) scale = hint;
  const int preferred = scale == 0 ? 30 : -static_cast<int>(std::lround(std::log2(scale / unit)));
  if (!chosen) {
    // An input whose own word has this scale fits as it is, although it fills the word.
    size = 0;
    for (const NodeId c : children) {
      const bool own = node(c).op == Op::input && same_scale(value(c).scale, scale);
      if (!own) size = std::max(size, span(c).size());
    }
    return std::ldexp(unit, -std::min(preferred, largest_fraction(id, unit, size)));
  }
  return chosen_scale(id, unit, preferred, size);
}

Value BackEnd::selection(NodeId id, double hint) {
  const Node& n = node(id);
  if (flips(id)) {
    const NodeId x = node(n.arguments[0]).arguments[0];
    const Value sign = value(x);
    const Value v = value(n.arguments[2], hint);
    Step& s = emit(EngineOp::abs, 0, sign.operand, v.operand, v.scale, id);
    s.node = id;
    s.condition = n.arguments[0];
    s.margin_scale = sign.scale;
    return {last(), v.scale, 0};
  }
  const bool choose = n.op == Op::select;
  const NodeId a = n.arguments[choose ? 1 : 0], b = n.arguments[choose ? 2 : 1];
  if (choose) lower_leaves(n.arguments[0]);
  const double scale = common_scale(id, {a, b}, hint, true);
  double a_error = 0, b_error = 0;
  const Value x = at_scale(a, scale, &a_error), y = at_scale(b, scale, &b_error);
  if (choose) flag(n.arguments[0]);
  Step& s = emit(choose                ? EngineOp::sel
                 : n.op == Op::minimum ? EngineOp::min
                                       : EngineOp::max,
                 0, x.operand, y.operand, scale, id);
  s.x_error = a_error;
  s.y_error = b_error;
  s.node = id;
  if (choose) s.condition = n.arguments[0];
  return {last(), scale, 0};
}

Value BackEnd::absolute(NodeId id, double hint) {
  const Value v = value(node(id).arguments[0], hint);
  emit(EngineOp::abs, 0, v.operand, v.operand, v.scale, id).node = id;
  return {last(), v.scale, 0};
}

Value BackEnd::state(NodeId id) {
  const int index = node(id).index;
  const State& s = law_.states[static_cast<std::size_t>(index)];
  const double size = std::max(std::fabs(s.range.lower), std::fabs(s.range.upper));
  // A whole number has a word in this unit alone.
  double unit = s.whole ? 1 : s.phase ? s.range.upper - s.range.lower : state_unit(s.next, 8);
  if (unit == 0) unit = 1;
  unit /= std::exp2(std::floor(std::log2(unit) + 1e-9));
  const int preferred = s.whole ? 0 : std::min(largest_fraction(id, unit, size) - 1, 28);
  const double scale = chosen_scale(id, unit, preferred, size);
  if (s.whole && scale > 1) throw Unfit("a whole state counts in ones", id);
  // The words of the ends are at most half a step beside them.
  const double steps = (s.range.upper - s.range.lower) / scale;
  if (steps < (s.whole ? 2 : kLeastSteps)) throw Unfit("a state's format holds no value", id);
  program_.states[static_cast<std::size_t>(index)].scale = scale;
  return {{From::state, index}, scale, size};
}

Value BackEnd::mailbox(NodeId id) {
  const double size = span(id).size();
  // A factor must fit in 18 bits, and few values need more.
  const int factor = static_cast<int>(std::floor(std::log2(131071.0 / std::max(size, 1e-9))));
  const double scale = chosen_scale(id, 1, factor, size);
  return {{From::word, word({id}, scale)}, scale, size};
}

}  // namespace feltgate::law
