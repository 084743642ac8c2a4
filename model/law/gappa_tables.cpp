// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Evaluates tables against their functions, word by word. Documentation: docs/laws.md
#include <algorithm>
#include <cmath>

#include "feltgate/largest.hpp"
#include "law/gappa.hpp"

namespace feltgate::law {

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
