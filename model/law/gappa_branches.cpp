// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes the Gappa lemmas of steps with two cases: MIN and MAX, selections, comparisons, |x| and
// signs. Documentation: docs/laws.md
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "feltgate/largest.hpp"
#include "law/gappa.hpp"
#include "law/gappa_cutter.hpp"

namespace feltgate::law {

namespace gappa {

void Cutter::extreme(bool least) {
  // The operand that is taken is called a, the other one b.
  for (int side = 0; side < 2; ++side) {
    const int taken = why(n_).taken;
    if (taken != 0 && taken != side + 1) continue;
    for (int crossed = 0; crossed < (taken == 0 ? 2 : 1); ++crossed) {
      begin();
      const Term a = operand(n_, side == 1), b = operand(n_, side == 0);
      const Term &high = least ? b : a, &low = least ? a : b;
      const std::string gap = high.word + " - " + low.word, real = high.law + " - " + low.law;
      const bool differ = gap != real;
      if (taken != 0) {
        want(gap + " >= 0");
        if (differ) {
          want(real + " >= 0");
          hint(real, fmt::format("({}) - ({} - {}) + ({} - {})", gap, high.word, high.law, low.word,
                                 low.law));
        }
      } else {
        give(gap + " >= 0");
        if (a.word[0] != '(') hint(a.word, b.word + (least ? " - (" : " + (") + gap + ")");
      }
      if (crossed == 0) {
        require(a);
      } else if (differ) {
        // a - B = (a - A) + (A - B) = (b - B) + (a - b).
        give(real + " <= 0");
        const std::string far = a.word + " - " + b.law;
        hint(far, fmt::format("({} - {}) + ({} - {})", a.word, a.law, a.law, b.law));
        hint(far, fmt::format("({} - {}) + ({} - {})", b.word, b.law, a.word, b.word));
        if (least) hint(a.law + " - " + b.law, "0 - (" + real + ")");
        if (least) hint(a.word + " - " + b.word, "0 - (" + gap + ")");
        require(a.word, b.law);
      } else {
        continue;
      }
      finish(fmt::format(".{}{}", side == 1 ? "y" : "x", crossed != 0 ? "crossed" : ""));
    }
  }
}

void Cutter::select() {
  for (int side = 0; side < 2; ++side) {
    if (why(n_).taken != 0 && why(n_).taken != side + 1) continue;
    const std::vector<int>& sources = why(n_).sources;
    const char* const name = side == 0 ? ".x" : ".y";
    const auto known = [&](int c) {
      known_branch(c, (steps_[at(c)].mode == 3) != (side == 0), side == 1);
    };
    // A flag that says the result of one of several comparisons only: a problem for each.
    const bool each = sources.size() > 1 && !hold_together(c_.program, sources, side == 0);
    for (std::size_t i = 0; i < (each ? sources.size() : 1); ++i) {
      begin();
      const Term r = operand(n_, side == 1);
      for (std::size_t k = 0; !each && k < sources.size(); ++k) known(sources[k]);
      if (each) known(sources[i]);
      require(r);
      finish(each ? fmt::format("{}{}", name, i + 1) : name);
    }
  }
}

void Cutter::known_branch(int c, bool truth, bool second) {
  const Term x = operand(c, false), y = operand(c, true);
  const std::string low = truth ? x.word : y.word, high = truth ? y.word : x.word;
  give(fmt::format("{} - {} >= {}", high, low, truth ? 1 : 0));
  const std::string gap = "(" + high + " - " + low + ")";
  if (low[0] != '(') hint(low, high + " - " + gap);
  if (high[0] != '(') hint(high, low + " + " + gap);
  const Operand& o = second ? steps_[at(n_)].y : steps_[at(n_)].x;
  if (o.from != From::step) return;
  const Step& s = steps_[at(o.index)];
  if (s.mode != 0 || (s.op != EngineOp::add && s.op != EngineOp::sub)) return;
  const Term e = expression(o.index);
  const std::string t = fmt::format("t{}", o.index), same = t + " - (" + e.word + ")";
  give(same + " in [0,0]");
  hint(t, "(" + e.word + ") + (" + same + ")");
}

void Cutter::compare() {
  const double e = why(n_).x.error + why(n_).y.error;
  const Span decided = why(n_).decided;
  for (int side = 0; side < 2; ++side) {
    const auto sides = [&] {
      begin();
      const Term x = operand(n_, false), y = operand(n_, true);
      return side == 0 ? std::pair{y, x} : std::pair{x, y};
    };
    if (decided.lo == decided.hi && decided.lo == 1 - side) {
      const auto [high, low] = sides();
      want(fmt::format("{} - {} >= {}", high.word, low.word, 1 - side));
      finish(side == 0 ? ".surely" : ".surelynot");
    }
    // If the operands differ by more than both errors, law and words compare alike.
    const auto [high, low] = sides();
    const std::string gap = high.word + " - " + low.word, real = high.law + " - " + low.law;
    give(gap + " >= " + number(up(e)));
    want(real + " >= 0");
    if (gap != real) {
      hint(real, fmt::format("({}) - ({} - {}) + ({} - {})", gap, high.word, high.law, low.word,
                             low.law));
    }
    finish(side == 0 ? ".less" : ".not");
  }
}

void Cutter::amount() {
  const bool exact = why(n_).x.error == 0;
  for (int word = 0; word < 2; ++word) {
    for (int law = 0; law < 2; ++law) {
      if (exact && word != law) continue;
      begin();
      const Term x = operand(n_, false);
      give(x.word + (word == 0 ? " >= 0" : " <= 0"));
      if (!exact) give(x.law + (law == 0 ? " >= 0" : " <= 0"));
      const std::string w = (word == 0 ? "" : "-") + x.word, l = (law == 0 ? "" : "-") + x.law;
      const std::string gap = "(" + x.word + " - " + x.law + ")";
      if (word == law && word == 1 && !exact) hint(w + " - " + l, "0 - " + gap);
      if (word < law) {
        hint(w + " - " + l, gap + " + 2 * " + x.law);
        hint(w + " - " + l, "2 * " + x.word + " - " + gap);
      } else if (word > law) {
        hint(w + " - " + l, "0 - " + gap + " - 2 * " + x.law);
        hint(w + " - " + l, gap + " - 2 * " + x.word);
      }
      require(w, l);
      finish(fmt::format(".{}{}", word == 0 ? "plus" : "minus", word != law ? "crossed" : ""));
    }
  }
}

void Cutter::sign() {
  for (int minus = 0; minus < 2; ++minus) {
    begin();
    const Term x = operand(n_, false), y = operand(n_, true);
    if (why(n_).x.words.lo >= 0 && minus == 1) continue;
    if (why(n_).x.words.hi < 0 && minus == 0) continue;
    if (minus == 1) {
      const std::string w = "-" + y.word, l = "-" + y.law;
      if (w != l) hint(w + " - " + l, fmt::format("0 - ({} - {})", y.word, y.law));
      require(w, l);
    } else {
      require(y);
    }
    // Beyond the margin law and word have the same sign.
    const double e = why(n_).x.error;
    if (e > 0 && x.word != x.law) {
      give(fmt::format("{} {} {}", x.word, minus == 1 ? "<=" : ">=", number(minus == 1 ? -e : e)));
      want(fmt::format("{} {} 0", x.law, minus == 1 ? "<=" : ">="));
      hint(x.law, fmt::format("{0} - ({0} - {1})", x.word, x.law));
    }
    finish(minus == 1 ? ".minus" : ".plus");
  }
}

}  // namespace gappa

// Evaluates tables against their functions, word by word.

namespace {

/// SI value, or turns, of one LSB of the step's argument.
double argument_scale(const Compiled& c, const Step& s) {
  switch (s.x.from) {
    case From::step:
      return c.program.steps[at(s.x.index)].scale;
    case From::state:
      return c.program.states[at(s.x.index)].scale;
    case From::input:
      switch (c.law.inputs[at(s.x.index)].source) {
        case Source::position:
          return c.target.count_rad();
        case Source::velocity:
          return std::ldexp(1.0, -c.target.velocity.fraction);
        default:
          return std::ldexp(1.0, -c.target.torque.fraction);
      }
    default:
      return 1;
  }
}

}  // namespace

TableProof table_proof(const Compiled& c, int step) {
  const Step& s = c.program.steps[at(step)];
  const TableUse& t = c.program.tables[at(s.table)];
  const Node& n = c.law.nodes[at(s.node)];
  const Table* own = n.op == Op::lookup ? &c.law.tables[at(n.index)] : nullptr;
  const bool periodic = own != nullptr && own->periodic;
  const double word = t.wraps    ? std::ldexp(1.0, -21)
                      : periodic ? s.argument_scale
                                 : argument_scale(c, s);
  const auto function = [&](const Span& x) {
    const Jet j{x, {1, 1}, {0, 0}};
    switch (n.op) {
      case Op::sine:
      case Op::cosine:  // the table is the sine; the index is moved by a quarter
        return sine(Jet{x * Span{2 * pi, up(2 * pi)}, {2 * pi, 2 * pi}, {0, 0}});
      case Op::root:
        return root(j);
      case Op::reciprocal:
        return inverse(j);
      case Op::exponential:
        return exponential(j);
      case Op::logarithm:
        return logarithm(j);
      default:
        return table_jet(c.law, *own, x);
    }
  };
  // The range of the argument, in words of the table's own index.
  const double begin = 4096.0 * (t.low - s.offset),
               size = 4096.0 * static_cast<double>(t.words.size());
  const Span reach =
      s.x.from == From::step ? c.bound.words[at(s.x.index)] : Span{begin, begin + size - 1};
  const double low = t.wraps ? 0 : reach.lo + 4096.0 * s.offset;
  const double high = t.wraps ? 4096.0 * 512 - 1 : reach.hi + 4096.0 * s.offset;
  Span domain = {low * word, high * word};
  if (own != nullptr && !periodic) domain = {own->domain.lower, own->domain.upper};
  TableProof proof;
  for (std::size_t i = 0; i < t.words.size(); ++i) {
    const double value = engine_table_value(t.words[i]), slope = engine_table_slope(t.words[i]);
    const double first = 4096.0 * (t.low + static_cast<double>(i));
    double error = 0;
    for (double f = std::max(0.0, low - first); f < 4096 && first + f <= high; ++f) {
      const double x = std::clamp((first + f) * word, domain.lo, domain.hi);
      const Span exact = function({x, x}).v * (1 / s.scale);
      const double there = value + slope * f / 4096;  // exact in a double
      error = larger(error, larger(up(there - exact.lo), up(exact.hi - there)));
    }
    proof.error.push_back(error);
    const Span part = both_of({first * word, (first + 4096) * word}, domain);
    const double gradient = part.empty() ? 0 : function(part).d1.size() * word / s.scale;
    proof.gradient.push_back(up(up(gradient)));
    // Evaluates all words of the segment's part of the domain, including its end. The law's
    // argument need not be a word: between two words a curve leaves its chord by at most |f''| h^2
    // / 8.
    double everywhere = error;
    const double from = std::max(0.0, std::floor(domain.lo / word) - first);
    const double to = std::min(4096.0, std::ceil(domain.hi / word) - first);
    for (double f = from; f <= to; ++f) {
      const double x = std::clamp((first + f) * word, domain.lo, domain.hi);
      const Span exact = function({x, x}).v * (1 / s.scale);
      const double there = value + slope * f / 4096;
      everywhere = larger(everywhere, larger(up(there - exact.lo), up(exact.hi - there)));
    }
    const double bend = part.empty() ? 0 : function(part).d2.size() * word * word / 8 / s.scale;
    proof.between.push_back(up(everywhere + up(up(bend))));
    proof.rise.push_back(std::fabs(slope) / 4096);
  }
  return proof;
}

}  // namespace feltgate::law
