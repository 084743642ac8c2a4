// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes the Gappa lemmas that need more than arithmetic on words: tables, low-passes, states, the
// law's own ranges. Documentation: docs/laws.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "feltgate/largest.hpp"
#include "law/gappa_cutter.hpp"

namespace feltgate::law {

namespace gappa {

bool Cutter::index() {
  const Step& s = steps_[at(n_)];
  const TableUse& t = c_.program.tables[at(s.table)];
  begin();
  const Term x = operand(n_, false);
  if (t.wraps) return false;
  const double first = t.line >= 0 ? 0 : 4096.0 * (t.low - s.offset);
  want(fmt::format("{} {}", x.word,
                   within(Span{first, first + 4096.0 * static_cast<double>(t.words.size()) - 1})));
  return true;
}

void Cutter::table() {
  const Step& s = steps_[at(n_)];
  const TableUse& t = c_.program.tables[at(s.table)];
  (void)index();
  if (s.op == EngineOp::tab) {
    // The result is a word of the memory: one of a delay line, within its range and error, or a
    // rounded one of an array.
    if (goals_.empty()) want("0 in [0,0]");
    return finish("");
  }
  const TableProof& proof = tables_[at(n_)];
  const Span x = why(n_).x.words;
  const double e = why(n_).x.error, last = static_cast<double>(t.words.size()) - 1;
  const auto segment = [&](double word) {
    return t.wraps ? 0.0 : std::clamp(std::floor(word / 4096) + s.offset - t.low, 0.0, last);
  };
  const double to = t.wraps ? last : segment(x.hi);
  const double reach = t.wraps ? last : std::ceil(e / 4096);
  const auto beside = [&](const std::vector<double>& of, double i) {
    double most = 0;
    for (double k = std::max(0.0, i - reach); k <= std::min(last, i + reach); ++k) {
      most = larger(most, of[static_cast<std::size_t>(k)]);
    }
    return most;
  };
  const double first = segment(x.lo);
  double apart = 0;
  Span values{infinity, -infinity};
  for (double i = first; i <= to; ++i) {
    // |line(x) - f(X)| <= |line(x) - f(x)| + |f'| |x - X|, with x a word in segment i; f' also
    // covers the neighbouring segments.
    const double moved = e > 0 ? up(beside(proof.gradient, i) * e) : 0;
    apart = larger(apart, up(proof.error[static_cast<std::size_t>(i)] + moved));
    const std::uint64_t line = t.words[static_cast<std::size_t>(i)];
    const double begin = 4096.0 * (i + t.low - s.offset);
    const double from = t.wraps ? 0 : std::max(0.0, x.lo - begin);
    const double end = t.wraps ? 4095 : std::min(4095.0, x.hi - begin);
    for (const double f : {from, end}) {
      const double there = engine_table_value(line) + engine_table_slope(line) * f / 4096;
      values = hull(values, {there, there});
    }
  }
  if (e > 0) {
    // Also <= |line(x) - line(X)| + |line(X) - f(X)|, with X in segment i: a line may rise less
    // than its function. Lines may jump at seams.
    double too = 0;
    const double low = std::max(0.0, first - reach), high = std::min(last, to + reach);
    for (double i = low; i <= high; ++i) {
      too = larger(too,
                   up(proof.between[static_cast<std::size_t>(i)] + up(beside(proof.rise, i) * e)));
    }
    apart = std::min(apart, up(too + up(t.jump_over(low, high) * (1 + std::floor(e / 4096)))));
  }
  definitions_ += fmt::format("t{0} = near(m);\n", n_);
  give(fmt::format("m {} /\\ m - T{} {}", within(values), n_, within(apart)));
  require(fmt::format("t{}", n_), fmt::format("T{}", n_));
  finish("");
}

void Cutter::between() {
  const Step& m = steps_[at(n_ - 1)];
  const int d = m.x.index;
  const bool chained = steps_[at(d)].mode == 2 && steps_[at(d)].x == steps_[at(n_)].x;
  for (int below = 0; below < 2; ++below) {
    begin();
    const Term y = operand(n_, false), a = operand(n_ - 1, true);
    const Term x = chained ? result_of(d - 1) : operand(d, false);
    definitions_ += fmt::format(
        "d = {0} - {1};\nD = {2} - {3};\nk = {4} * 1b-{6};\nK = {5} * 1b-{6};\np = k * d;\n"
        "r = near(p);\nt{7} = {1} + r;\nT{7} = {3} + K * D;\n",
        x.word, y.word, x.law, y.law, a.word, a.law, engine_shift(m.mode), n_);
    const std::string t = fmt::format("t{}", n_), law = fmt::format("T{}", n_);
    give(below == 0 ? "d >= 0" : "d <= 0");
    hint(t + " - " + law,
         fmt::format("(r - p) + (1 - k) * ({0} - {1}) + k * ({2} - {3}) + (k - K) * D", y.word,
                     y.law, x.word, x.law));
    hint("D", fmt::format("d - ({} - {}) + ({} - {})", x.word, x.law, y.word, y.law));
    hint(t, x.word + " - (d - r)");
    hint("d - r", "(1 - k) * d - (r - p)");
    require(t, law);
    finish(below == 0 ? ".up" : ".down");
  }
}

void Cutter::states() {
  for (std::size_t i = 0; i < c_.program.states.size(); ++i) {
    const StateUse& use = c_.program.states[i];
    if (use.next.from != From::step) continue;
    n_ = use.next.index;
    begin();
    const Term next = sink_[at(n_)] != 0 ? result_of(n_) : Term{};
    if (next.word.empty()) continue;
    want(fmt::format("{} in [{},{}]", next.word, use.lower, use.upper));
    if (next.word != next.law) {
      // For a state with unbounded error, the bound is the error that this run adds.
      const auto& errors = c_.bound.states_bounded ? c_.bound.state : c_.bound.drift;
      const double e = i < c_.law.states.size() ? errors[i] / std::fabs(use.scale) : 0;
      want(fmt::format("{} - {} {}", next.word, next.law, within(up(e))));
    }
    finish(fmt::format(".state{}", i));
  }
}

/// Proves the range of a node y + a (x - y) with a in 0 .. 1, in the cases x above y and x below y;
/// false if the node has another form.
bool Cutter::law_between(NodeId id) {
  const auto node = [this](NodeId i) -> const Node& { return c_.law.nodes[at(i)]; };
  const auto span = [this](NodeId i) { return spans_[at(i)]; };
  for (int i = 0; i < 4; ++i) {
    const NodeId y = node(id).arguments[at(i % 2)], sum = node(id).arguments[at(1 - i % 2)];
    if (node(sum).op != Op::multiply) continue;
    const NodeId a = node(sum).arguments[at(i / 2)], d = node(sum).arguments[at(1 - i / 2)];
    if (node(d).op != Op::subtract || node(d).arguments[1] != y) continue;
    if (span(a).lo < 0 || span(a).hi > 1) continue;
    const NodeId x = node(d).arguments[0];
    for (const bool above : {true, false}) {
      begin();
      definitions_ = fmt::format("d = N{} - N{};\np = N{} * d;\nr = N{} + p;\n", x, y, a, y);
      for (const NodeId n : {x, y, a}) give(fmt::format("N{} {}", n, within(span(n))));
      give("p " + within(span(sum)));
      give(above ? "d >= 0" : "d <= 0");
      hint("r", fmt::format("N{} - (1 - N{}) * d", x, a));
      want("r " + within(span(id)));
      finish(fmt::format(".law{}{}", id, above ? "up" : "down"));
    }
    for (const NodeId n : {x, y, a, sum}) wanted_.insert(n);
    return true;
  }
  return false;
}

void Cutter::law_ranges() {
  n_ = -1;
  Cell free = c_.bound.parts[at(cell_)];
  free.sums.clear();
  const std::vector<Span> without = ranges(c_.law, free);
  while (!wanted_.empty()) {
    const NodeId id = *wanted_.rbegin();
    wanted_.erase(id);
    // What the cell's sums narrow is a condition of the cell.
    if (!without[at(id)].within(spans_[at(id)])) continue;
    const Node& n = c_.law.nodes[at(id)];
    const bool two = n.arguments.size() == 2;
    std::string value;
    begin();
    const auto argument = [&](std::size_t i) {
      const NodeId a = n.arguments[i];
      const Span s = spans_[at(a)];
      const std::string x = fmt::format("N{}", a);
      if (known_.insert(x).second && s.size() < infinity) give(x + " " + within(s));
      return x;
    };
    std::vector<std::string> branches{""};
    switch (n.op) {
      case Op::add:
        if (law_between(id)) continue;
        value = argument(0) + " + " + argument(1);
        break;
      case Op::subtract:
        value = argument(0) + " - " + argument(1);
        break;
      case Op::multiply:
        value = argument(0) + " * " + argument(1);
        // The range of x / r with r >= |x| is given.
        if (n.arguments[0] != n.arguments[1] &&
            !(spans_[at(n.arguments[0])] * spans_[at(n.arguments[1])]).within(spans_[at(id)])) {
          continue;
        }
        break;
      case Op::negate:
        value = "-" + argument(0);
        break;
      case Op::absolute:
        value = "|" + argument(0) + "|";
        break;
      case Op::reciprocal:
        value = "1 / " + argument(0);
        break;
      case Op::minimum:
      case Op::maximum:
        branches = {argument(0) + " - " + argument(1), argument(1) + " - " + argument(0)};
        break;
      default:
        continue;
    }
    for (const NodeId a : n.arguments) wanted_.insert(a);
    const std::string facts = given_;
    for (std::size_t i = 0; i < branches.size(); ++i) {
      begin();
      given_ = facts;
      if (two && value.empty()) {
        // The operand that min (max) takes is not above (below) the other one.
        const std::string a = argument(i), b = argument(1 - i);
        const bool least = n.op == Op::minimum;
        give(branches[least ? 1 - i : i] + " >= 0");
        hint(a, b + (least ? " - (" : " + (") + branches[least ? 1 - i : i] + ")");
        want(a + " " + within(spans_[at(id)]));
      } else {
        want(value + " " + within(spans_[at(id)]));
      }
      finish(fmt::format(".law{}{}", id, branches.size() > 1 ? (i == 0 ? "x" : "y") : ""));
    }
  }
}

}  // namespace gappa

}  // namespace feltgate::law
