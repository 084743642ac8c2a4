// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lowers functions to table reads. Documentation: docs/laws.md
#include <fmt/format.h>

#include <cmath>

#include "law/back_end.hpp"

namespace feltgate::law {

namespace {

constexpr int most_table_words = EngineMap::table_words;

JetFunction jet_of(const Law& law, const Node& n) {
  if (has_pieces(n.op)) {
    return [op = n.op](const Span& x) { return function_of(op, Jet{x, {1, 1}, {0, 0}}); };
  }
  const Table& t = law.tables[at(n.index)];
  return [&law, &t](const Span& x) { return table_jet(law, t, x); };
}

}  // namespace

void BackEnd::count_tables() {
  std::map<std::pair<int, NodeId>, int> others;
  for (const NodeId id : needed(law_)) {
    const Node& n = node(id);
    if (is_fixed(id)) continue;
    sines_ = sines_ || n.op == Op::sine;
    cosines_ = cosines_ || n.op == Op::cosine;
    if (has_pieces(n.op)) {
      others[{static_cast<int>(n.op), n.arguments[0]}] = 1;
    }
    if (n.op == Op::lookup) others[{1000 + n.index, 0}] = 1;
  }
  for (const Array& a : law_.arrays) table_words_left_ -= static_cast<int>(a.values.size());
  for (const Line& l : law_.lines) table_words_left_ -= l.length;
  if (table_words_left_ < 0) {
    throw Refused(fmt::format("the arrays and delay lines need {} words of table memory, which has "
                              "{}",
                              most_table_words - table_words_left_, most_table_words),
                  "make them shorter");
  }
  // Tables with a number of segments get that many words plus one; the others share the rest.
  for (const auto& [key, one] : others) {
    if (key.first < 1000) continue;
    const int segments = law_.tables[at(key.first - 1000)].segments;
    if (segments == 0) continue;
    others[key] = 0;
    table_words_left_ -= segments + 1;
  }
  if (table_words_left_ < 0) {
    throw Refused(fmt::format("arrays, delay lines and tables ask for {} words of table memory, "
                              "which has {}",
                              most_table_words - table_words_left_, most_table_words),
                  "ask for fewer segments: each is a word, and one more for every table");
  }
  other_tables_ = 0;
  bool asked = false;
  for (const auto& [key, one] : others) {
    other_tables_ += one;
    asked = asked || one == 0;
  }
  if (!sines_ && !cosines_) return;
  if (choice_.sine_bits == 0) {
    // The table gets all the memory, or a share that leaves as much for every other table.
    const int share = table_words_left_ / (other_tables_ + 1);
    choice_.sine_bits = 8;
    while (choice_.sine_bits > 5 && (1 << choice_.sine_bits) * (cosines_ ? 5 : 4) / 4 > share + 8) {
      --choice_.sine_bits;
    }
    if (table_words_left_ == most_table_words && other_tables_ == 0 && !asked) {
      choice_.sine_bits = 9;
    }
  }
  const int turn = 1 << choice_.sine_bits;
  table_words_left_ -= choice_.sine_bits == 9 ? turn : cosines_ ? turn + turn / 4 : turn;
}

int BackEnd::place_table(const std::string& key, const TableUse& table) {
  program_.tables.push_back(table);
  return table_keys_[key] = static_cast<int>(program_.tables.size()) - 1;
}

/// Aligns the value to the table's scale before it is limited, if it fits: the limit is finer
/// there.
Value BackEnd::align_for_table(const Value& v, double scale, NodeId argument) {
  const bool fits = v.size / scale < 2e9 && scale < v.scale;
  return fits ? align(v, scale, argument) : v;
}

/// Limits the value to the domain of the law's own table.
Value BackEnd::limited(Value v, const Node& n, NodeId id) {
  if (n.op != Op::lookup) return v;
  const Table& table = law_.tables[at(n.index)];
  const Span range = span(n.arguments[0]);
  const Span domain = {table.domain.lower, table.domain.upper};
  // An excess of only the rounding of doubles is ignored.
  const double slack = 1e-9 * domain.width();
  if (range.lo < domain.lo - slack) {
    const double end = domain.lo / v.scale;
    emit(EngineOp::max, 0, v.operand, constant(std::ceil(end - 1e-9)), v.scale, id).y_error =
        std::ceil(end - 1e-9) - end;
    program_.steps.back().y.exact = end;
    v.operand = last();
  }
  if (range.hi > domain.hi + slack) {
    const double end = domain.hi / v.scale;
    emit(EngineOp::min, 0, v.operand, constant(std::floor(end + 1e-9)), v.scale, id).y_error =
        end - std::floor(end + 1e-9);
    program_.steps.back().y.exact = end;
    v.operand = last();
  }
  v.size = both_of(range, domain).size();
  return v;
}

/// Fraction bits that a table's values can have: a value has 20 bits and a slope has 16.
int BackEnd::value_fraction(const TableRequest& r) {
  const auto value = extended(r);
  double step = 0, largest = 0, before = 0;
  for (int i = 0; i <= r.count; ++i) {
    const double f = value((r.low + i) * r.argument_scale * 4096);
    if (i > 0) step = std::max(step, std::fabs(f - before));
    largest = std::max(largest, std::fabs(f));
    before = f;
  }
  const double room = std::min(524200 / std::max(largest, 1e-30), 32700 / std::max(step, 1e-30));
  return std::min(30, static_cast<int>(std::floor(std::log2(room))));
}

Value BackEnd::function(NodeId id) {
  const Node& n = node(id);
  const NodeId argument = n.arguments[0];
  if (n.op == Op::lookup && law_.tables[at(n.index)].periodic) return periodic(id);
  Span range = span(argument);
  const bool user = n.op == Op::lookup;
  const Table* table = user ? &law_.tables[at(n.index)] : nullptr;
  if (n.op == Op::root && range.lo < 0) {
    throw Refused(n.place, fmt::format("sqrt of what can be {:.4g}", range.lo),
                  "limit it, e.g. sqrt(max(x, 0))");
  }
  if (n.op == Op::reciprocal && range.lo <= 0 && range.hi >= 0) {
    throw Refused(n.place,
                  fmt::format("division by what goes from {:.4g} to {:.4g}", range.lo, range.hi),
                  "keep the divisor away from 0, e.g. max(x, 0.01)");
  }
  if (n.op == Op::logarithm && range.lo <= 0) {
    throw Refused(n.place, fmt::format("log of what can be {:.4g}", range.lo),
                  "limit it, e.g. log(max(x, 0.01))");
  }
  Value v = value(argument);
  if (user) range = both_of(range, {table->domain.lower, table->domain.upper});
  const int words = table_words_left_ / std::max(1, other_tables_);
  const bool asked = user && table->segments > 0;
  const int wanted = asked ? std::max(words, table->segments + 1) : words;
  if (wanted < 2) {
    throw Refused(n.place, "no table memory is left for this",
                  "ask for fewer segments of the other tables");
  }
  const auto first = [&](double scale) {
    return static_cast<int>(std::floor((range.lo / scale - 512) / 4096));
  };
  const auto count = [&](double scale) {
    return static_cast<int>(std::floor((range.hi / scale + 512) / 4096)) - first(scale) + 1;
  };
  if (range.width() <= 0 || !(range.width() < infinity)) {
    throw Refused(n.place, "the range of the table's argument has no end, or is a point",
                  "limit the argument with clamp");
  }
  double scale = v.scale;
  while (range.width() / scale / 4096 > 2.0 * most_table_words || count(scale) > wanted) scale *= 2;
  while (count(scale / 2) <= wanted && range.size() / (scale / 2) < 1e9) scale /= 2;
  if (count(v.scale) <= wanted && count(v.scale) > wanted / 4) scale = v.scale;
  const bool points = user && !table->points.empty();
  if (points) {
    // Points lie on samples, the same ones for every argument.
    scale = (table->domain.upper - table->domain.lower) / table->segments / 4096;
    const double start = table->domain.lower / scale / 4096;
    if (std::fabs(start - std::nearbyint(start)) > 1e-9) {
      throw Refused(table->place, "the first point is no whole number of segments from 0",
                    fmt::format("let the table {} begin at 0", table->name));
    }
  } else if (user && table->segments > 0) {
    // The segments of the law, if its first sample lies on a sample of the table.
    const double own = (table->domain.upper - table->domain.lower) / table->segments / 4096;
    const double start = table->domain.lower / own / 4096;
    const double ratio = v.scale / own;
    const double rounded = std::nearbyint(ratio * 4096) / 4096;
    const bool fine =
        std::fabs(ratio - (ratio > 32 ? std::nearbyint(ratio) : rounded)) < ratio * 1e-5;
    if (std::fabs(start - std::nearbyint(start)) < 1e-9 && fine) scale = own;
  }
  v = limited(align_for_table(v, scale, argument), n, id);
  v = align(v, scale, argument);
  TableRequest r;
  r.function = jet_of(law_, n);
  if (points) range = {table->domain.lower, table->domain.upper};
  r.domain = range;
  r.argument_scale = scale;
  r.low = first(scale);
  r.count = count(scale);
  r.limit = 524287;
  const std::string shape = fmt::format("{} {} {:a} {} {} {:a} {:a}", static_cast<int>(n.op),
                                        n.index, scale, r.low, r.count, range.lo, range.hi);
  const auto [sampled, is_new] = choice_.fractions.try_emplace(shape);
  if (is_new) sampled->second = value_fraction(r);
  const int fraction = sampled->second;
  // A table through points is stored once, like an array: its first reader chooses the scale.
  const std::string memory = fmt::format("points {}", n.index);
  const auto same = memory_scales_.find(memory);
  r.value_scale = points && same != memory_scales_.end()
                      ? same->second
                      : chosen_scale(id, 1, fraction, span(id).size());
  if (points) memory_scales_[memory] = r.value_scale;
  if (-std::log2(r.value_scale) > fraction + 0.5) throw Unfit("a table's value has 20 bits", id);
  const std::string key = fmt::format("{} {} {:a} {} {} {:a}", static_cast<int>(n.op), n.index,
                                      scale, r.low, r.count, r.value_scale);
  auto found = table_keys_.find(key);
  int index = found == table_keys_.end() ? -1 : found->second;
  if (index < 0) {
    const std::string full = key + fmt::format(" {:a} {:a}", range.lo, range.hi);
    auto known = choice_.made.find(full);
    if (known == choice_.made.end()) {
      TableUse t = make_table(r);
      t.what = user                     ? table->name
               : n.op == Op::root       ? "sqrt"
               : n.op == Op::reciprocal ? "1/x"
               : n.op == Op::logarithm  ? "log"
                                        : "exp";
      known = choice_.made.emplace(full, t).first;
    }
    index = place_table(key, known->second);
  }
  Step& s = emit(EngineOp::lrp, 0, v.operand, {}, r.value_scale, id);
  s.table = index;
  s.argument_scale = scale;
  s.node = id;
  return {last(), r.value_scale, 0};
}

/// The argument in turns, `turn` turns per word, modulo 2^32 words; one turn is `period`. Every
/// product wraps, for any number of turns: MLW multiplies a word by a whole number.
Operand BackEnd::phase(NodeId id, double turn, double period) {
  std::vector<Term> terms;
  collect(id, 1, true, terms);
  std::vector<Multiply> products;
  std::vector<Addend> addends;
  for (const Term& t : terms) {
    const double number = t.number / period / turn;  // words per unit of the factors
    if (t.factors.empty()) {
      if (t.fixed.empty()) {
        const double words = number - std::nearbyint(number * turn) / turn;
        if (std::fabs(words) > 2147483647.0) throw Unfit("a phase does not fit", id);
        addends.push_back({constant(words), 1, std::fabs(words - std::nearbyint(words))});
      } else {
        // A factor of many turns has fewer bits, and MLW drops its whole turns.
        double by = 1;
        while (fixed_size(t.fixed) * std::fabs(number) / by > 2147483000.0) by *= 2;
        if (by > 65536) throw Unfit("a phase parameter does not fit in 32 bits", id);
        const Operand own{From::word, word(t.fixed, by / number)};
        if (by == 1) addends.push_back({own, 1, 0});
        if (by > 1) products.push_back({own, constant(by), 0, 0});
      }
      continue;
    }
    Value v = value(t.factors[0]);
    for (std::size_t i = 1; i < t.factors.size(); ++i) v = product(v, value(t.factors[i]), id);
    double ratio = number * v.scale;
    const Value before = v;
    const double size = t.fixed.empty() ? 1 : fixed_size(t.fixed);
    while (size * std::fabs(ratio) > 131071) {
      const double by =
          std::min(65536.0, std::exp2(std::ceil(std::log2(size * std::fabs(ratio) / 131071))));
      emit(EngineOp::mlw, 0, v.operand, constant(by), v.scale / by, id).turns = true;
      v = {last(), v.scale / by, v.size};
      ratio = number * v.scale;
    }
    if (t.fixed.empty()) {
      Multiply m = by_number(v, ratio, id);
      products.push_back(m);
      const double left =
          ratio - std::ldexp(program_.constants[at(m.y.index)], -EngineMap::shifts[m.mode]);
      if (std::fabs(left) * v.size / v.scale > 0.5 && m.y_error > 0) {
        // The remainder of the first factor gets bits of its own; it is not a whole multiple of a
        // wrapped value.
        products.back().y_error = 0;
        products.back().y.exact = program_.constants[at(m.y.index)];
        products.push_back(by_number(before, left * before.scale / v.scale, id));
      }
    } else {
      Multiply m;
      m.x = v.operand;
      double best = 0;
      for (int mode = 0; mode < 4; ++mode) {
        const double s = 1 / (ratio * std::exp2(EngineMap::shifts[mode]));
        if (size / std::fabs(s) > 131071 || (best != 0 && size / std::fabs(best) > 512)) break;
        best = s;
        m.mode = mode;
      }
      m.y = {From::word, word(t.fixed, best)};
      products.push_back(m);
    }
  }
  const auto in_turns = [&](Step& s) { s.turns = true; };
  if (products.empty() && addends.size() == 1) return addends[0].operand;
  Operand so_far;
  for (const Multiply& m : products) {
    Step& s = emit(EngineOp::mlw, m.mode, m.x, m.y, turn, id);
    s.y_error = m.y_error;
    in_turns(s);
    if (so_far.from != From::none) in_turns(emit(EngineOp::add, 3, so_far, {}, turn, id));
    so_far = last();
  }
  std::size_t used = 0;
  if (products.empty()) {
    Step& s = emit(EngineOp::add, 1, addends[0].operand, addends[1].operand, turn, id);
    s.x_error = addends[0].error;
    s.y_error = addends[1].error;
    in_turns(s);
    used = 2;
  }
  for (; used < addends.size(); ++used) {
    Step& s = emit(EngineOp::add, 3, addends[used].operand, {}, turn, id);
    s.x_error = addends[used].error;
    in_turns(s);
  }
  return last();
}

Value BackEnd::sine(NodeId id) {
  const Node& n = node(id);
  const bool cosine = n.op == Op::cosine;
  const int bits = choice_.sine_bits;
  const double turn = std::ldexp(1.0, bits == 9 ? -21 : -32);
  Operand x;
  const std::string phase_key = fmt::format("phase {}", n.arguments[0]);
  const auto known = table_keys_.find(phase_key);
  if (known != table_keys_.end()) {
    x = {From::step, known->second};
  } else {
    x = phase(n.arguments[0], turn, 2 * pi);
    if (bits < 9) {
      // Takes the upper bits of the turn: an index and 12 bits.
      const int drop = 20 - bits;
      const int mode = drop == 12 ? 1 : 2;
      Step& s = emit(EngineOp::mlw, mode, x, constant(std::exp2(EngineMap::shifts[mode] - drop)),
                     std::ldexp(1.0, -12 - bits), id);
      s.turns = true;
      x = last();
    }
    if (x.from == From::step) table_keys_[phase_key] = x.index;
  }
  const double scale = chosen_scale(id, 1, 18, 1);
  const int fraction = static_cast<int>(std::lround(-std::log2(scale)));
  if (fraction > 18) throw Unfit("a table's value has 20 bits", id);
  // With up to 17 bits the value fits a factor; 1 itself does not fit, so the largest word is
  // below.
  const std::int32_t one = fraction <= 17 ? 131071 : 524287;
  const std::string table = fmt::format("sine {} {}", bits, fraction);
  const auto found = table_keys_.find(table);
  if (found == table_keys_.end() && ++sine_tables_ > 1) throw Unfit("one table of sines", id);
  const std::string made_key = table + (cosines_ ? " c" : "");
  auto ready = choice_.made.find(made_key);
  if (ready == choice_.made.end()) {
    ready = choice_.made
                .emplace(made_key,
                         bits == 9 ? sine_turn(one, scale) : sine_part(bits, cosines_, one, scale))
                .first;
  }
  const int index = found == table_keys_.end() ? place_table(table, ready->second) : found->second;
  Step& s = emit(EngineOp::lrp, 0, x, {}, scale, id);
  s.table = index;
  s.offset = cosine ? 1 << (bits - 2) : 0;
  s.argument_scale = std::ldexp(1.0, -12 - bits);
  s.node = id;
  return {last(), scale, 0};
}

}  // namespace feltgate::law
