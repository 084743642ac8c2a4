// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Ranges and errors of steps over a cell. Documentation: docs/law-compiler.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "law/bound.hpp"

namespace feltgate::law {

namespace {

constexpr double word_low = -2147483648.0, word_high = 2147483647.0;
std::size_t at(int i) { return static_cast<std::size_t>(i); }

double power(int mode) { return std::exp2(EngineMap::shifts[mode]); }

class Analysis {
 public:
  Analysis(const Law& law, const Target& target, const Program& program, const Cell& cell,
           const std::vector<double>& state_error, int swap, const std::vector<Span>* spans)
      : law_(law),
        target_(target),
        program_(program),
        cell_(cell),
        state_error_(state_error),
        swap_(swap),
        spans_(spans != nullptr ? *spans : ranges(law, cell)) {}

  CellFacts run() {
    facts_.steps.resize(program_.steps.size());
    facts_.margin.assign(program_.steps.size(), 0);
    facts_.output_error.assign(law_.outputs.size(), 0);
    for (std::size_t i = 0; i < program_.steps.size(); ++i) {
      step_ = static_cast<int>(i);
      Fact f = result(program_.steps[i]);
      narrow_by_law(program_.steps[i], &f);
      if (f.words.empty()) facts_.reachable = false;
      if (!facts_.reachable) return facts_;
      facts_.steps[i] = f;
      const Step& s = program_.steps[i];
      for (std::size_t o = 0; s.output >= 0 && o < law_.outputs.size(); ++o) {
        if (law_.outputs[o].axis == s.output) facts_.output_error[o] = f.error * s.scale;
      }
    }
    states();
    return facts_;
  }

 private:
  void fail(const std::string& reason) { facts_.unproven.push_back({step_, -1, reason}); }

  Fact operand(const Operand& o, double extra) {
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
        Span w =
            both_of({std::floor(s.lo / use.scale - error), std::ceil(s.hi / use.scale + error)},
                    {static_cast<double>(use.lower), static_cast<double>(use.upper)});
        if (w.empty()) facts_.reachable = false;
        return {w, error};
      }
      case From::word: {
        const Word& word = program_.words[at(o.index)];
        Span s{1, 1};
        for (const NodeId n : word.nodes) s = s * spans_[at(n)];
        const double a = s.lo / word.scale, b = s.hi / word.scale;
        if (word.exact != 0) {
          // The primary's words within the range, times the multiple.
          const double r = std::fabs(word.exact);
          const double lo = r * std::ceil(std::min(a, b) / r - 1e-6),
                       hi = r * std::floor(std::max(a, b) / r + 1e-6);
          if (lo > hi) return {{std::floor(std::min(a, b)), std::ceil(std::max(a, b))}, 0.5};
          return {{lo, hi}, 0};
        }
        return {{std::floor(std::min(a, b)), std::ceil(std::max(a, b))}, 0.5};
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

  Fact checked(const Fact& f) {
    if (f.words.lo < word_low || f.words.hi > word_high) {
      fail("it can leave 32 bits");
      return {both_of(f.words, {word_low, word_high}), f.error};
    }
    return f;
  }

  Fact multiplied(const Step& s, const Fact& x, const Fact& y, bool rounds) {
    if (y.words.lo < -131072 || y.words.hi > 131071) fail("a factor can leave 18 bits");
    const double p = power(s.mode);
    const Span product = exact_product(x.words, y.words, s.x == s.y);
    Fact f;
    const double half = rounds && s.mode > 0 ? 0.5 : 0;
    f.words = {std::floor(product.lo / p + half), std::floor(product.hi / p + half)};
    f.error = (x.words.size() * y.error + y.words.size() * x.error + x.error * y.error) / p;
    // A power of two that the shift takes back drops nothing.
    const bool exact = s.mode == 0 || (y.words.lo == y.words.hi && std::fmod(y.words.lo, p) == 0);
    if (!exact) f.error += rounds ? 0.5 : 1;
    return f;
  }

  /// y + a * (x - y) with a in 0 .. 1: between x and y, and their errors do not add.
  bool blend(const Step& s, Fact* f) {
    if (s.op != EngineOp::add || s.mode != 2 || step_ == 0) return false;
    const Step& m = program_.steps[at(step_ - 1)];
    if (m.op != EngineOp::mul || m.x.from != From::step) return false;
    const Step& d = program_.steps[at(m.x.index)];
    if (d.op != EngineOp::sub || std::fabs(d.scale / s.scale - 1) > 1e-12) return false;
    // x - y of two words, or of the result before and a word.
    const bool chained = d.mode == 2 && d.x == s.x;
    if (!chained && !(d.mode == 0 && d.y == s.x)) return false;
    const Fact a = operand(m.y, m.y_error), y = operand(s.x, s.x_error),
               x = chained ? facts_.steps[at(m.x.index - 1)] : operand(d.x, d.x_error),
               difference = operand(m.x, 0);
    const double p = power(m.mode);
    if (a.words.lo < 0 || a.words.hi > p) return false;
    const auto error = [&](double share) { return (1 - share) * y.error + share * x.error; };
    f->words = hull(x.words, y.words);
    f->error = std::max(error(a.words.lo / p), error(a.words.hi / p)) +
               a.error * (difference.words.size() + difference.error) / p + 0.5;
    return true;
  }

  Fact table_result(const Step& s, const Fact& x) {
    const TableUse& t = program_.tables[at(s.table)];
    if (t.line >= 0) {
      if (x.words.lo < 0 || x.words.hi >= 4096.0 * static_cast<double>(t.words.size())) {
        fail("its index can leave the line");
      }
      return {t.values,
              state_error_[law_.states.size() + at(t.line)] / program_.lines[at(t.line)].scale};
    }
    const double first = std::floor(x.words.lo / 4096) + s.offset - t.low;
    const double end = std::floor(x.words.hi / 4096) + s.offset - t.low;
    Fact f;
    f.words = t.values;
    if (!t.wraps) {
      if (first < 0 || end >= static_cast<double>(t.words.size())) {
        fail("its index can leave the table");
        return {t.values, t.error};
      }
      if (s.op == EngineOp::lrp && end - first < static_cast<double>(t.words.size()) / 2) {
        f.words = {infinity, -infinity};
        for (auto i = static_cast<std::size_t>(first); i <= static_cast<std::size_t>(end); ++i) {
          const double v = engine_table_value(t.words[i]);
          f.words = hull(f.words, hull({v, v}, {v + engine_table_slope(t.words[i]),
                                                v + engine_table_slope(t.words[i])}));
        }
      }
    }
    f.error = t.error;
    if (s.op == EngineOp::lrp) {
      f.error += t.slope * x.error + 0.5;
      if (x.error > 0) f.error += t.jump * (1 + x.error / 4096);
    } else if (x.error > 0) {
      facts_.margin[at(step_)] = x.error;
      if (swap_ == step_) f.error += t.values.width();
    }
    return f;
  }

  /// What an operand can be where a comparison came out this way.
  Span given(const Operand& o, const Step& c, bool truth) {
    const auto known = [&](const Operand& p) {
      Span w = operand(p, 0).words;
      const Span x = operand(c.x, 0).words, y = operand(c.y, 0).words;
      if (p == c.x) w = both_of(w, truth ? Span{word_low, y.hi - 1} : Span{y.lo, word_high});
      if (p == c.y) w = both_of(w, truth ? Span{x.lo + 1, word_high} : Span{word_low, x.hi});
      return w;
    };
    Span w = known(o);
    if (o.from == From::step && w.lo <= w.hi) {
      const Step& s = program_.steps[at(o.index)];
      if (s.mode == 0 && (s.op == EngineOp::add || s.op == EngineOp::sub)) {
        const Span a = known(s.x), b = known(s.y);
        const Span r =
            s.op == EngineOp::add ? Span{a.lo + b.lo, a.hi + b.hi} : Span{a.lo - b.hi, a.hi - b.lo};
        w = both_of(w, r);
      }
    }
    return w;
  }

  Fact selected(const Step& s, const Fact& x, const Fact& y) {
    Fact f{hull(x.words, y.words), std::max(x.error, y.error)};
    if (flag_.lo > 0) f = x;
    if (flag_.hi <= 0) f = y;
    if (flag_.lo <= 0 && flag_.hi > 0 && sources_.size() == 1) {
      const Step& c = program_.steps[at(sources_[0])];
      if (c.mode == 0) f.words = hull(given(s.x, c, true), given(s.y, c, false));
      if (c.mode == 3) f.words = hull(given(s.x, c, false), given(s.y, c, true));
    }
    // The law may have gone the other way even where the words are sure.
    if (std::find(sources_.begin(), sources_.end(), swap_) != sources_.end()) {
      f.error = std::max(x.error, y.error) +
                std::max(std::fabs(x.words.hi - y.words.lo), std::fabs(y.words.hi - x.words.lo));
    }
    return f;
  }

  /// y with the sign turned where x is below 0.
  Fact flipped(const Fact& x, const Fact& y) {
    Fact f = y;
    if (x.words.hi < 0) {
      f.words = -y.words;
    } else if (x.words.lo < 0) {
      f.words = hull(y.words, -y.words);
    }
    if (x.error > 0 && x.words.lo <= x.error && x.words.hi >= -x.error) {
      facts_.margin[at(step_)] = x.error;
      if (swap_ == step_) f.error += 2 * y.words.size();
    }
    return f;
  }

  Fact compared(const Step& s, const Fact& x, const Fact& y) {
    const Span c = x.words.hi < y.words.lo    ? Span{1, 1}
                   : x.words.lo >= y.words.hi ? Span{0, 0}
                                              : Span{0, 1};
    switch (s.mode) {
      case 1:
        flag_ = most(flag_, c);
        break;
      case 2:
        flag_ = least(flag_, c);
        break;
      case 3:
        flag_ = {1 - c.hi, 1 - c.lo};
        break;
      default:
        flag_ = c;
    }
    if (s.mode == 0 || s.mode == 3) sources_.clear();
    sources_.push_back(step_);
    // Truth values of comparisons that were kept bring their own.
    if (s.y.from == From::step && program_.steps[at(s.y.index)].op == EngineOp::cmp) {
      sources_.push_back(s.y.index);
    }
    const double apart = std::max(y.words.lo - x.words.hi, x.words.lo - y.words.hi);
    if (apart <= x.error + y.error) facts_.margin[at(step_)] = x.error + y.error;
    return {flag_, 0};
  }

  Fact result(const Step& s) {
    const Fact x = operand(s.x, s.x_error), y = operand(s.y, s.y_error);
    const Fact acc = takes_acc(s) ? facts_.steps[at(step_ - 1)] : Fact{};
    switch (s.op) {
      case EngineOp::add: {
        Fact f;
        if (blend(s, &f)) return f;
        const Fact& other = s.mode >= 2 ? acc : y;
        f = {{x.words.lo + other.words.lo, x.words.hi + other.words.hi}, x.error + other.error};
        return (s.mode & 1) != 0 ? wrapped(f) : checked(f);
      }
      case EngineOp::sub: {
        const Fact& a = s.mode == 2 ? acc : x;
        const Fact& b = s.mode == 2 ? x : y;
        return checked({{a.words.lo - b.words.hi, a.words.hi - b.words.lo}, a.error + b.error});
      }
      case EngineOp::mul:
        return checked(multiplied(s, x, y, true));
      case EngineOp::mac: {
        const Fact m = multiplied(s, x, y, true);
        return checked(
            {{acc.words.lo + m.words.lo, acc.words.hi + m.words.hi}, acc.error + m.error});
      }
      case EngineOp::mlw:
        return wrapped(multiplied(s, x, y, false));
      case EngineOp::min: {
        const Fact f{least(x.words, y.words), std::max(x.error, y.error)};
        if (x.words.hi + x.error <= y.words.lo - y.error) return x;
        if (y.words.hi + y.error <= x.words.lo - x.error) return y;
        return f;
      }
      case EngineOp::max: {
        const Fact f{most(x.words, y.words), std::max(x.error, y.error)};
        if (x.words.hi + x.error <= y.words.lo - y.error) return y;
        if (y.words.hi + y.error <= x.words.lo - x.error) return x;
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

  static Fact wrapped(const Fact& f) {
    if (f.words.lo >= word_low && f.words.hi <= word_high) return f;
    return {{word_low, word_high}, f.error};
  }

  void narrow_by_law(const Step& s, Fact* f) const {
    if (s.node < 0 || s.turns) return;
    const Span law = spans_[at(s.node)] * (1 / s.scale);
    if (law.empty()) return;
    f->words = both_of(f->words,
                       {std::floor(law.lo - f->error - 1e-6), std::ceil(law.hi + f->error + 1e-6)});
  }

  void states() {
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

  void require(const Fact& f, double lower, double upper, double scale, int state) {
    if (f.words.lo >= lower && f.words.hi <= upper) return;
    const double end = f.words.lo < lower ? f.words.lo : f.words.hi;
    facts_.unproven.push_back(
        {-1, state, fmt::format("its next value can be {:.6g}", end * scale)});
  }

  const Law& law_;
  const Target& target_;
  const Program& program_;
  const Cell& cell_;
  const std::vector<double>& state_error_;
  int swap_;
  std::vector<Span> spans_;
  CellFacts facts_;
  int step_ = 0;
  Span flag_{0, 1};
  std::vector<int> sources_;
};

}  // namespace

CellFacts analyse(const Law& law, const Target& target, const Program& program, const Cell& cell,
                  const std::vector<double>& state_error, int swap,
                  const std::vector<Span>* spans) {
  return Analysis(law, target, program, cell, state_error, swap, spans).run();
}

}  // namespace feltgate::law
