// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lowers sums of products: terms, their common scale, the chain of instructions. Documentation:
// docs/laws.md
#include <algorithm>
#include <cmath>

#include "law/back_end.hpp"

namespace feltgate::law {

namespace {

constexpr double factor_limit = 131071;

double unit_of(double scale) { return scale / std::exp2(std::floor(std::log2(scale) + 1e-9)); }
int fraction_of(double scale) { return -static_cast<int>(std::floor(std::log2(scale) + 1e-9)); }

bool is_whole(double x) { return std::fabs(x - std::nearbyint(x)) <= 1e-12 * std::fabs(x); }

}  // namespace

/// Collects the factors of a node: numbers, parameters, other nodes.
void BackEnd::gather(NodeId id, bool root, Term& term) const {
  const Node& n = node(id);
  if (n.op == Op::constant) {
    term.number *= n.value;
  } else if (is_fixed(id)) {
    NodeId inner = id;
    if (n.op == Op::parameter) inner = law_.parameters[static_cast<std::size_t>(n.index)].derived;
    const Op op = inner < 0 ? Op::parameter : node(inner).op;
    if (op == Op::negate || op == Op::multiply || (op == Op::constant && inner >= 0)) {
      if (op == Op::constant) {
        term.number *= node(inner).value;
        return;
      }
      if (op == Op::negate) term.number = -term.number;
      for (const NodeId a : node(inner).arguments) gather(a, false, term);
    } else {
      term.fixed.push_back(id);
      std::sort(term.fixed.begin(), term.fixed.end());
    }
  } else if (n.op == Op::negate && (root || once(id))) {
    term.number = -term.number;
    gather(n.arguments[0], false, term);
  } else if (n.op == Op::multiply && (root || once(id))) {
    for (const NodeId a : n.arguments) gather(a, false, term);
  } else {
    term.factors.push_back(id);
  }
}

void BackEnd::collect(NodeId id, double number, bool root, std::vector<Term>& terms) const {
  const Node& n = node(id);
  const bool open = !is_fixed(id) && (root || once(id));
  if (open && (n.op == Op::add || n.op == Op::subtract)) {
    collect(n.arguments[0], number, false, terms);
    collect(n.arguments[1], n.op == Op::add ? number : -number, false, terms);
  } else if (open && n.op == Op::negate) {
    collect(n.arguments[0], -number, false, terms);
  } else {
    Term term;
    term.number = number;
    gather(id, root, term);
    if (term.number == 0) return;
    // A sum with only a sign before it becomes part of this sum.
    if (term.fixed.empty() && term.factors.size() == 1 && std::fabs(term.number) == 1 &&
        term.factors[0] != id && once(term.factors[0])) {
      collect(term.factors[0], term.number, false, terms);
      return;
    }
    if (term.fixed.empty() && term.factors.empty()) {
      for (Term& t : terms) {
        if (t.fixed.empty() && t.factors.empty()) {
          t.number += term.number;
          return;
        }
      }
    }
    terms.push_back(term);
  }
}

bool BackEnd::fits_factor(const Value& v) const { return v.size / v.scale <= factor_limit; }

/// The value, shortened to the bits of a factor if necessary.
Value BackEnd::narrow(const Value& v, NodeId id) {
  if (fits_factor(v)) return v;
  const double bits = std::ceil(std::log2(v.size / v.scale / (factor_limit - 8)));
  return align(v, v.scale * std::exp2(bits), id);
}

BackEnd::Multiply BackEnd::by_number(const Value& v, double ratio, NodeId id) {
  if (std::fabs(ratio) > factor_limit) {
    const Value more = align(v, v.scale / 65536, id);
    return by_number(more, ratio / 65536, id);
  }
  Multiply m;
  m.x = v.operand;
  double chosen = 0;
  for (int mode = 0; mode < 4; ++mode) {
    const double c = std::ldexp(ratio, EngineMap::shifts[mode]);
    if (std::fabs(c) > factor_limit) break;
    m.mode = mode;
    chosen = c;
    if (is_whole(c) && c != 0) break;
  }
  // A factor below 1 would lose bits of the product: two steps are used instead.
  if (std::fabs(chosen) < 1 && std::fabs(ratio) * v.size / v.scale >= 1) {
    const Value less = align(v, v.scale * 65536, id);
    return by_number(less, ratio * 65536, id);
  }
  m.y = constant(chosen);
  m.y_error = is_whole(chosen) ? 0 : std::fabs(chosen - std::nearbyint(chosen));
  return m;
}

/// Multiplication by a parameter word, with the most bits that a factor and the four shifts allow.
BackEnd::Multiply BackEnd::by_word(const Value& v, const Term& term, double scale, NodeId id) {
  const double size = fixed_size(term.fixed);
  Multiply m;
  m.x = v.operand;
  double word_scale = 0;
  for (int mode = 0; mode < 4; ++mode) {
    const double s = scale / (v.scale * term.number * std::exp2(EngineMap::shifts[mode]));
    if (size / std::fabs(s) > factor_limit) break;
    m.mode = mode;
    word_scale = s;
  }
  if (word_scale == 0) {
    const Value more = align(v, v.scale / 4096, id);
    return by_word(more, term, scale, id);
  }
  if (breaks(term.fixed, word_scale)) {
    const Value counted = product(v, in_ones(term.fixed), id);
    return by_number(counted, counted.scale * term.number / scale, id);
  }
  m.y = {From::word, word(term.fixed, word_scale)};
  return m;
}

BackEnd::Multiply BackEnd::pair(const Value& a, const Value& b, int mode, NodeId id) {
  Multiply m;
  m.mode = mode;
  if (fits_factor(b)) {
    m.x = a.operand;
    m.y = b.operand;
  } else if (fits_factor(a)) {
    m.x = b.operand;
    m.y = a.operand;
  } else {
    throw Unfit("neither factor fits in 18 bits", id);
  }
  return m;
}

/// a * b in a format of its own, with the most bits that fit.
Value BackEnd::product(const Value& first, const Value& second, NodeId id) {
  const Value a = first;
  const Value b = fits_factor(a) || fits_factor(second) ? second : narrow(second, id);
  const auto key = std::minmax(a.operand, b.operand);
  const auto found = products_.find(key);
  if (found != products_.end()) {
    Value known = found->second;  // scale and size are relative to those of the operands
    known.scale *= a.scale * b.scale;
    known.size *= a.size * b.size;
    return known;
  }
  const double size = a.operand == b.operand ? a.size * a.size : a.size * b.size;
  for (int mode = 0; mode < 4; ++mode) {
    const double scale = a.scale * b.scale * std::exp2(EngineMap::shifts[mode]);
    if (size / scale > 2147483647.0 * (1 - 1.0 / 512)) continue;
    const Multiply m = pair(a, b, mode, id);
    emit(EngineOp::mul, mode, m.x, m.y, scale, id);
    products_[key] = {last(), scale / (a.scale * b.scale), size / (a.size * b.size)};
    return {last(), scale, size};
  }
  throw Unfit("a product does not fit in 32 bits", id);
}

Value BackEnd::negated(const Value& v, NodeId id) {
  const auto found = negated_.find(v.operand);
  if (found != negated_.end()) return {found->second.operand, v.scale, v.size};
  const Operand zero = constant(0);
  emit(EngineOp::sub, 0, zero, v.operand, v.scale, id);
  return negated_[v.operand] = {last(), v.scale, v.size};
}

/// In x - 15 deg * n, where x stays at ends and n is whole: 15 deg. In this unit the steps are
/// exact and the ends are rounded as what the sum is compared with. Otherwise 0.
double BackEnd::step_of(const std::vector<Term>& terms) const {
  double step = 0;
  bool ends = false;
  for (const Term& t : terms) {
    if (!t.fixed.empty() || t.factors.size() > 1) return 0;
    if (t.factors.empty()) continue;
    if (node(t.factors[0]).whole) {
      if (step != 0) return 0;
      step = std::fabs(t.number);
    } else {
      ends = ends || has_ends(t.factors[0]);
    }
  }
  return ends ? step : 0;
}

double BackEnd::sum_scale(NodeId id, const std::vector<Term>& terms, double hint) {
  std::vector<double> plain, pairs;
  for (const Term& t : terms) {
    if (!t.fixed.empty()) continue;
    double scale = std::fabs(t.number);
    for (const NodeId f : t.factors) scale *= value(f).scale;
    if (t.factors.size() == 1) plain.push_back(scale);
    if (t.factors.size() == 2) pairs.push_back(scale);
  }
  const double size = span(id).size();
  const bool ones = std::all_of(plain.begin(), plain.end(), counts);
  if (node(id).whole && !(ones && (hint == 0 || counts(hint)))) {
    return chosen_scale(id, 1, 0, size);
  }
  if (const double step = step_of(terms); step != 0) {
    return chosen_scale(id, unit_of(step), std::max(20, fraction_of(step)), size);
  }
  if (terms.size() == 1 && plain.size() == 1 && hint != 0 && !same_unit(plain[0], hint)) {
    return chosen_scale(id, unit_of(hint), fraction_of(hint), size);
  }
  if (!plain.empty()) {
    // Takes the unit that most terms have, and of these the most bits that fit.
    double best = plain[0];
    int most = 0;
    for (const double p : plain) {
      int count = 0;
      for (const double q : plain) count += same_unit(p, q) ? 1 : 0;
      if (count > most) {
        most = count;
        best = p;
      }
    }
    for (const double p : plain) {
      if (same_unit(p, best) && p < best) best = p;
    }
    return chosen_scale(id, unit_of(best), fraction_of(best), size);
  }
  if (hint != 0 && (pairs.empty() || same_unit(hint, pairs[0]))) {
    return chosen_scale(id, unit_of(hint), fraction_of(hint), size);
  }
  if (!pairs.empty()) {
    const double unit = unit_of(pairs[0]);
    const int limit = largest_fraction(id, unit, size);
    int preferred = limit - 1;
    for (const int shift : EngineMap::shifts) {
      const int f = fraction_of(pairs[0]) - shift;
      if (f <= limit) {
        preferred = f;
        break;
      }
    }
    return chosen_scale(id, unit, preferred, size);
  }
  return chosen_scale(id, 1, largest_fraction(id, 1, size) - 1, size);
}

void BackEnd::add_term(const Term& term, double scale, NodeId id, Chain& chain) {
  if (term.factors.empty()) {
    Addend a;
    if (term.fixed.empty()) {
      const double exact = term.number / scale;
      a.operand = constant(exact, id);
      a.error = is_whole(exact) ? 0 : std::fabs(exact - std::nearbyint(exact));
    } else {
      const double s = scale / term.number;
      if (fixed_size(term.fixed) / std::fabs(s) > 2147483000.0) {
        throw Unfit("a parameter does not fit in 32 bits", id, scale);
      }
      if (breaks(term.fixed, s)) {
        chain.products.push_back(by_number(in_ones(term.fixed), term.number / scale, id));
        return;
      }
      // The instruction applies the sign of a plain word.
      a.operand = {From::word, word(term.fixed, std::fabs(s))};
      a.sign = s < 0 ? -1 : 1;
    }
    chain.addends.push_back(a);
    return;
  }
  Value v = value(term.factors[0]);
  const std::size_t last_factor = term.factors.size() - (term.fixed.empty() ? 1 : 0);
  for (std::size_t i = 1; i < last_factor; ++i) v = product(v, value(term.factors[i]), id);
  if (!term.fixed.empty()) {
    chain.products.push_back(by_word(v, term, scale, id));
    return;
  }
  if (term.factors.size() == 1) {
    if (chain.steps && has_ends(term.factors[0])) {
      v = with_ends(term.factors[0], scale / std::fabs(term.number), false);
    }
    const double ratio = v.scale * term.number / scale;
    if (same_scale(std::fabs(ratio), 1)) {
      chain.addends.push_back({v.operand, ratio < 0 ? -1 : 1, 0});
    } else {
      chain.products.push_back(by_number(v, ratio, id));
    }
    return;
  }
  Value w = value(term.factors.back());
  if (!fits_factor(v) && !fits_factor(w)) w = narrow(w, id);
  const double ratio = v.scale * w.scale * term.number / scale;
  for (int mode = 0; mode < 4; ++mode) {
    if (!same_scale(std::fabs(ratio), std::exp2(-EngineMap::shifts[mode]))) continue;
    if (ratio < 0) {
      // Negates the addend whose negation already exists, otherwise the last one.
      if (negated_.count(v.operand) != 0 && negated_.count(w.operand) == 0) std::swap(v, w);
      w = negated(w, id);
    }
    chain.products.push_back(pair(v, w, mode, id));
    return;
  }
  const Value t = product(v, w, id);
  chain.products.push_back(by_number(t, t.scale * term.number / scale, id));
}

/// Emits the chain; every step except the first continues from the result of the one before.
Value BackEnd::chain(const Chain& c, double scale, NodeId id) {
  std::vector<Addend> addends = c.addends;
  std::size_t next = 0;
  const auto find_plus = [&](std::size_t from) {
    for (std::size_t i = from; i < addends.size(); ++i) {
      if (addends[i].sign > 0) return i;
    }
    return addends.size();
  };
  std::size_t used = 0;
  // The value of the previous step is already in acc.
  bool running = false;
  if (!program_.steps.empty() && addends.size() + c.products.size() > 1) {
    for (std::size_t i = 0; i < addends.size() && !c.products.empty(); ++i) {
      if (addends[i].operand == last() && addends[i].sign > 0) {
        std::swap(addends[0], addends[i]);
        used = 1;
        running = true;
        break;
      }
    }
  }
  if (!running && !c.products.empty()) {
    const Multiply& m = c.products[next++];
    emit(EngineOp::mul, m.mode, m.x, m.y, scale, id).y_error = m.y_error;
    running = true;
  }
  if (!running) {
    const std::size_t plus = find_plus(0);
    if (plus == addends.size()) {
      emit(EngineOp::sub, 0, constant(0), addends[0].operand, scale, id).y_error = addends[0].error;
      used = 1;
    } else {
      std::swap(addends[0], addends[plus]);
      if (addends.size() == 1) return {addends[0].operand, scale, 0};
      Step& s = emit(addends[1].sign > 0 ? EngineOp::add : EngineOp::sub, 0, addends[0].operand,
                     addends[1].operand, scale, id);
      s.x_error = addends[0].error;
      s.y_error = addends[1].error;
      used = 2;
    }
  }
  for (; next < c.products.size(); ++next) {
    const Multiply& m = c.products[next];
    emit(EngineOp::mac, m.mode, m.x, m.y, scale, id).y_error = m.y_error;
  }
  for (; used < addends.size(); ++used) {
    const Addend& a = addends[used];
    emit(a.sign > 0 ? EngineOp::add : EngineOp::sub, 2, a.operand, {}, scale, id).x_error = a.error;
  }
  program_.steps.back().node = id;
  return {last(), scale, 0};
}

Value BackEnd::sum(NodeId id, double hint) {
  std::vector<Term> terms;
  collect(id, 1, true, terms);
  if (terms.size() == 1 && terms[0].factors.size() > 1) {
    NodeId by = -1;
    Term amount;
    for (const NodeId f : terms[0].factors) {
      if (turned(f, &by, &amount)) return turned_sum(id, terms[0], hint);
    }
  }
  if (terms.empty()) terms.push_back({0, {}, {}});
  // The value computed last is in acc; leaves stay in memory.
  const auto rank = [this](const Term& t) {
    const bool plain = t.fixed.empty() && t.factors.size() == 1;
    const Op op = plain ? node(t.factors[0]).op : Op::constant;
    const bool leaf = op == Op::input || op == Op::state || op == Op::parameter;
    return !plain ? 1 : leaf ? 0 : 2;
  };
  std::stable_sort(terms.begin(), terms.end(),
                   [&](const Term& a, const Term& b) { return rank(a) < rank(b); });
  for (const Term& t : terms) {
    const bool alone = t.fixed.empty() && t.factors.size() == 1;
    for (const NodeId f : t.factors) (void)value(f, alone ? hint / std::fabs(t.number) : 0);
  }
  // A value times a number is the same word with another scale, unless the user of the value needs
  // the first scale.
  const auto renamed = [&] {
    const double scale = value(terms[0].factors[0]).scale;
    return hint == 0 || same_unit(scale * terms[0].number, hint) || !same_unit(scale, hint);
  };
  if (terms.size() == 1 && terms[0].fixed.empty() && terms[0].factors.size() == 1 && renamed()) {
    Value v = value(terms[0].factors[0]);
    if (terms[0].number < 0) v = negated(v, id);
    v.scale *= std::fabs(terms[0].number);
    return v;
  }
  const double scale = sum_scale(id, terms, hint);
  Chain c;
  c.steps = step_of(terms) != 0;
  for (const Term& t : terms) add_term(t, scale, id, c);
  return chain(c, scale, id);
}

}  // namespace feltgate::law
