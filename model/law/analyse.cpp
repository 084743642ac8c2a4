// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/laws.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "law/analysis.hpp"

namespace feltgate::law {

std::string beyond_text(double value, double lower, double upper) {
  // Uses as many digits as distinguish the value from the end that it exceeds.
  for (int digits = 6; digits < 17; ++digits) {
    const std::string text = fmt::format("{:.{}g}", value, digits);
    const double shown = std::strtod(text.c_str(), nullptr);
    if (shown < lower || shown > upper) return text;
  }
  return fmt::format("{:.17g}", value);
}

namespace analysis {

CellFacts Analysis::run() {
  facts_.steps.resize(program_.steps.size());
  facts_.margin.assign(program_.steps.size(), 0);
  wrong_.assign(program_.steps.size(), 0);
  if (explain_) facts_.reasons.resize(program_.steps.size());
  facts_.output_error.assign(law_.outputs.size(), 0);
  facts_.output_apart.assign(law_.outputs.size(), 0);
  for (const auto& [id, s] : cell_.sums) {
    if (!spans_[at(id)].within(s)) facts_.reachable = false;
  }
  for (std::size_t p = 0; p < law_.parameters.size(); ++p) {
    // The cell is empty if its ranges of a derived parameter and of the formula do not overlap.
    const NodeId from = law_.parameters[p].derived;
    if (from < 0 || spans_[at(from)].empty()) continue;
    if (both_of(cell_.parameters[p], spans_[at(from)]).empty()) facts_.reachable = false;
  }
  if (!facts_.reachable) return facts_;
  for (std::size_t i = 0; i < program_.steps.size(); ++i) {
    step_ = static_cast<int>(i);
    why_ = {};
    Fact f = result(program_.steps[i]);
    // The difference of two whole numbers is a whole number.
    if (program_.steps[i].whole) f.error = std::floor(f.error);
    narrow_by_law(program_.steps[i], &f);
    if (explain_) facts_.reasons[i] = why_;
    if (f.words.empty()) facts_.reachable = false;
    if (!facts_.reachable) return facts_;
    facts_.steps[i] = f;
    const Step& s = program_.steps[i];
    for (std::size_t o = 0; s.output >= 0 && o < law_.outputs.size(); ++o) {
      if (law_.outputs[o].axis != s.output) continue;
      const Span law = spans_[at(law_.outputs[o].value)];
      // The output counts in the torque's LSB, even if the step's node is only a part of the
      // output.
      const double lsb = std::ldexp(1.0, -target_.torque.fraction);
      facts_.output_error[o] = f.error * lsb;
      facts_.output_apart[o] =
          raised(std::max(f.words.hi * lsb - law.lo, law.hi - f.words.lo * lsb));
    }
  }
  states();
  return facts_;
}

void Analysis::margin(double words) {
  facts_.margin[at(step_)] = words;
  const bool wider = margins_ != nullptr && words > (*margins_)[at(step_)];
  wrong_[at(step_)] = step_ == swap_ || wider ? 1 : 0;
}

Fact Analysis::operand(const Operand& o, double extra) {
  switch (o.from) {
    case From::step: {
      Fact f = facts_.steps[at(o.index)];
      f.error += extra;
      return f;
    }
    case From::input: {
      const Input& input = law_.inputs[at(o.index)];
      const double scale = input.source == Source::position ? target_.count_rad()
                           : input.source == Source::velocity
                               ? std::ldexp(1.0, -target_.velocity.fraction)
                               : std::ldexp(1.0, -target_.torque.fraction);
      const Span s = cell_.inputs[at(o.index)];
      Span w = {std::max(word_low, std::ceil(s.lo / scale - 1e-6)),
                std::min(word_high, std::floor(s.hi / scale + 1e-6))};
      if (w.empty()) facts_.reachable = false;
      return {w, 0};
    }
    case From::state: {
      const StateUse& use = program_.states[at(o.index)];
      if (at(o.index) >= law_.states.size()) {
        return {{static_cast<double>(use.lower), static_cast<double>(use.upper)}, 0};
      }
      const double error = state_error_[at(o.index)] / use.scale;
      const Span s = cell_.states[at(o.index)];
      Span w = both_of({std::floor(s.lo / use.scale - error), std::ceil(s.hi / use.scale + error)},
                       {static_cast<double>(use.lower), static_cast<double>(use.upper)});
      if (w.empty()) facts_.reachable = false;
      return {w, error};
    }
    case From::word: {
      const Word& word = program_.words[at(o.index)];
      Span s{1, 1};
      for (const NodeId n : word.nodes) s = s * spans_[at(n)];
      const double a = s.lo / word.scale, b = s.hi / word.scale;
      const Span outward = outward_words(a, b);
      if (word.exact != 0) {
        // The words of the primary within the range, times the multiple.
        const double r = std::fabs(word.exact);
        const double lo = r * std::ceil(std::min(a, b) / r - 1e-6),
                     hi = r * std::floor(std::max(a, b) / r + 1e-6);
        if (lo > hi) return {outward, 0.5};
        return {{lo, hi}, 0};
      }
      return {outward, 0.5};
    }
    case From::constant: {
      const double c = program_.constants[at(o.index)];
      return {{c, c}, extra};
    }
    case From::none:
      break;
  }
  return {{0, 0}, 0};
}

Fact Analysis::checked(const Fact& f) {
  if (f.words.lo < word_low || f.words.hi > word_high) {
    fail("it can leave 32 bits");
    return {both_of(f.words, {word_low, word_high}), f.error};
  }
  return f;
}

Fact Analysis::multiplied(const Step& s, const Fact& x, const Fact& y, bool rounds) {
  if (y.words.lo < -131072 || y.words.hi > 131071) fail("a factor can leave 18 bits");
  const double p = power(s.mode);
  const Span product = exact_product(x.words, y.words, s.x == s.y);
  Fact f;
  const double half = rounds && s.mode > 0 ? 0.5 : 0;
  f.words = {std::floor(product.lo / p + half), std::floor(product.hi / p + half)};
  const double own = y.words.size() * x.error;
  f.error = (x.words.size() * y.error + own + x.error * y.error) / p;
  // A factor that is a multiple of the shift's power of two drops no bits.
  const bool exact = s.mode == 0 || (y.words.lo == y.words.hi && std::fmod(y.words.lo, p) == 0);
  if (!exact) f.error += rounds ? 0.5 : 1;
  const bool scaled = y.error == 0 && std::fma(y.words.size(), x.error, -own) == 0;
  if (!scaled || (x.error > 0 && !exact)) f.error = raised(f.error);
  return f;
}

Fact Analysis::result(const Step& s) {
  const Fact x = operand(s.x, s.x_error), y = operand(s.y, s.y_error);
  const Fact acc = takes_acc(s) ? facts_.steps[at(step_ - 1)] : Fact{};
  why_.x = x;
  why_.y = y;
  why_.acc = acc;
  switch (s.op) {
    case EngineOp::add: {
      Fact f;
      why_.between = blend(s, &f);
      if (why_.between) return f;
      const Fact& other = s.mode >= 2 ? acc : y;
      f = {{x.words.lo + other.words.lo, x.words.hi + other.words.hi},
           raised_sum(x.error, other.error)};
      return (s.mode & 1) != 0 ? wrapped(f) : checked(f);
    }
    case EngineOp::sub: {
      const Fact& a = s.mode == 2 ? acc : x;
      const Fact& b = s.mode == 2 ? x : y;
      return checked(
          {{a.words.lo - b.words.hi, a.words.hi - b.words.lo}, raised_sum(a.error, b.error)});
    }
    case EngineOp::mul:
      return checked(multiplied(s, x, y, true));
    case EngineOp::mac: {
      const Fact m = multiplied(s, x, y, true);
      return checked(
          {{acc.words.lo + m.words.lo, acc.words.hi + m.words.hi}, raised_sum(acc.error, m.error)});
    }
    case EngineOp::mlw: {
      Fact f = wrapped(multiplied(s, x, y, false));
      if (s.floors < 0) return f;
      // Law and words may round down to different numbers only near a whole number.
      f.error = 0;
      if (x.error > 0) margin(x.error);
      if (wrong(step_)) f.error = std::ceil(x.error / power(s.mode));
      return f;
    }
    case EngineOp::min: {
      const Fact f{least(x.words, y.words), std::max(x.error, y.error)};
      if (x.words.hi + x.error <= y.words.lo - y.error) return only(x, 1);
      if (y.words.hi + y.error <= x.words.lo - x.error) return only(y, 2);
      return f;
    }
    case EngineOp::max: {
      const Fact f{most(x.words, y.words), std::max(x.error, y.error)};
      if (x.words.hi + x.error <= y.words.lo - y.error) return only(y, 2);
      if (y.words.hi + y.error <= x.words.lo - x.error) return only(x, 1);
      return f;
    }
    case EngineOp::sel:
      return selected(s, x, y);
    case EngineOp::cmp:
      return compared(s, x, y);
    case EngineOp::lrp:
    case EngineOp::tab:
      return table_result(s, x);
    case EngineOp::tst:
      (void)table_result(s, x);
      return acc;
    case EngineOp::abs:
      if (s.x == s.y) return checked({amount(x.words), x.error});
      return checked(flipped(x, y));
    default:
      return takes_acc(s) ? acc : Fact{};
  }
}

Fact Analysis::wrapped(const Fact& f) {
  if (f.words.lo >= word_low && f.words.hi <= word_high) return f;
  return {{word_low, word_high}, f.error};
}

void Analysis::narrow_by_law(const Step& s, Fact* f) {
  if (s.node < 0 || s.turns) return;
  const Span law = spans_[at(s.node)] * (1 / s.scale);
  if (law.empty()) return;
  const Span words = {std::floor(law.lo - f->error - 1e-6), std::ceil(law.hi + f->error + 1e-6)};
  if (f->words.lo < words.lo || f->words.hi > words.hi) why_.law = law;
  f->words = both_of(f->words, words);
}

void Analysis::states() {
  step_ = -1;
  for (std::size_t i = 0; i < program_.states.size(); ++i) {
    const StateUse& use = program_.states[i];
    const bool hidden = i >= law_.states.size();
    if (use.next.from == From::none) {
      if (!hidden) facts_.state_error.push_back(0);
      continue;
    }
    const Fact f = operand(use.next, 0);
    if (!hidden) facts_.state_error.push_back(f.error * use.scale);
    require(f, use.lower, use.upper, use.scale, static_cast<int>(i));
  }
  for (std::size_t i = 0; i < program_.lines.size(); ++i) {
    const LineUse& use = program_.lines[i];
    const Fact f = operand(use.written, 0);
    facts_.state_error.push_back(f.error * use.scale);
    const Span values = program_.tables[at(use.table)].values;
    require(f, values.lo, values.hi, use.scale, use.pointer);
  }
}

void Analysis::require(const Fact& f, double lower, double upper, double scale, int state) {
  if (f.words.lo >= lower && f.words.hi <= upper) return;
  const double end = f.words.lo < lower ? f.words.lo : f.words.hi;
  facts_.unproven.push_back({-1, state, beyond_text(end * scale, lower * scale, upper * scale)});
}

}  // namespace analysis

CellFacts analyse(const Law& law, const Target& target, const Program& program, const Cell& cell,
                  const std::vector<double>& state_error, int swap, const std::vector<Span>* spans,
                  bool explain, const std::vector<double>* margins) {
  return analysis::Analysis(law, target, program, cell, state_error, swap, spans, explain, margins)
      .run();
}

}  // namespace feltgate::law
