// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Computes the bounds: splits cells, bounds the errors of states, finds the strips. Documentation:
// docs/laws.md
#include "law/bound.hpp"

#include <algorithm>
#include <cmath>

#include "feltgate/largest.hpp"

namespace feltgate::law {

namespace {

constexpr double kLargeDrift = 0.002;  ///< of a state's range; from here on cells are halved for it

double worst(const CellFacts& f) {
  if (!f.reachable) return 0;
  double w = 0;
  for (const double e : f.output_error) w = larger(w, e);
  return w + 1e6 * static_cast<double>(f.unproven.size());
}

struct Leaf {
  Cell cell;
  CellFacts facts;
};

/// All spans of a cell in one list.
std::vector<Span*> sides(Cell& c) {
  std::vector<Span*> all;
  for (auto* part : {&c.inputs, &c.states, &c.parameters}) {
    for (Span& s : *part) all.push_back(&s);
  }
  for (auto& [id, s] : c.sums) all.push_back(&s);
  return all;
}

class Bounds {
 public:
  Bounds(const Law& law, const Target& target, const Program& program, const Cell& cell,
         const std::vector<Span>* spans)
      : law_(law),
        target_(target),
        program_(program),
        errors_(law.states.size() + law.lines.size(), 0),
        cell_(cell),
        ranges_(law),
        whole_(spans != nullptr ? *spans : ranges(law, cell)) {}

  /// Computes the bound. `one_run`: for one run from the current states.
  Bound run(int splits, bool one_run, bool with_strips) {
    Cell whole = cell_;
    limits_ = splits > 0;
    if (limits_) whole = with_sums(law_, whole);
    bounded_ = !one_run;
    if (bounded_) settle(whole);
    leaves_.push_back({whole, whole_facts(whole)});
    const bool whole_reachable = leaves_.front().facts.reachable;
    for (int i = 0; i < splits && split(whole); ++i) {
    }
    // What a run adds to a state counts as the outputs do.
    by_drift_ = !bounded_;
    stalled_ = 0;
    for (int i = 0; i < splits && largest_drift() > kLargeDrift && split(whole); ++i) {
    }
    Bound b;
    b.states_bounded = bounded_;
    b.state = errors_;
    if (!bounded_) b.drift.assign(law_.states.size(), 0);
    b.output.assign(law_.outputs.size(), 0);
    b.words.assign(program_.steps.size(), Span{1, 0});
    b.errors.assign(program_.steps.size(), 0);
    b.margins.assign(program_.steps.size(), 0);
    b.cells = static_cast<int>(leaves_.size());
    std::size_t largest = 0;
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
      if (worst(leaves_[i].facts) > worst(leaves_[largest].facts)) largest = i;
      b.parts.push_back(leaves_[i].cell);
    }
    std::swap(b.parts.front(), b.parts[largest]);
    for (const Leaf& l : leaves_) {
      if (!l.facts.reachable) continue;
      for (std::size_t o = 0; o < b.output.size(); ++o) {
        b.output[o] = larger(b.output[o], l.facts.output_error[o]);
      }
      for (std::size_t s = 0; s < b.words.size(); ++s) {
        b.words[s] = hull(b.words[s], l.facts.steps[s].words);
        b.errors[s] = larger(b.errors[s], l.facts.steps[s].error);
        b.margins[s] = larger(b.margins[s], l.facts.margin[s]);
      }
      for (std::size_t k = 0; k < b.drift.size(); ++k) {
        b.drift[k] = larger(b.drift[k], l.facts.state_error[k]);
      }
      if (b.unproven.empty()) b.unproven = l.facts.unproven;
    }
    // If the formats hold no value at all, nothing is proven.
    b.reachable = whole_reachable;
    if (!whole_reachable) b.unproven.push_back({0, -1, "its formats hold no value"});
    if (!bounded_) drifting(&b);
    if (with_strips) strips(whole, &b);
    return b;
  }

 private:
  CellFacts facts(const Cell& c) {
    return limited(analyse(law_, target_, program_, c, errors_, -1, &ranges_.over(c)));
  }

  CellFacts whole_facts(const Cell& c) const {
    return limited(analyse(law_, target_, program_, c, errors_, -1, &whole_));
  }

  /// Limits the output errors by the ranges of law and words. The search for formats does not use
  /// this limit, because a limited error does not show improvements.
  CellFacts limited(CellFacts f) const {
    for (std::size_t o = 0; limits_ && f.reachable && o < f.output_error.size(); ++o) {
      f.output_error[o] = std::min(f.output_error[o], f.output_apart[o]);
    }
    return f;
  }

  /// Finds state errors that a run does not increase; clears them if they grow without limit.
  void settle(const Cell& whole) {
    if (errors_.empty()) return;
    std::vector<double> start = errors_;
    for (std::size_t k = 0; k < law_.states.size(); ++k) {
      const StateUse& use = program_.states[k];
      start[k] = std::fabs(use.initial * use.scale - law_.states[k].initial);
      if (start[k] < 1e-12 * std::fabs(law_.states[k].initial)) start[k] = 0;
    }
    errors_ = start;
    std::vector<double> before = errors_;
    for (int i = 0; i < 40; ++i) {
      const CellFacts f = whole_facts(whole);
      if (!f.reachable) return;
      bool more = false;
      std::vector<double> next = errors_;
      for (std::size_t k = 0; k < errors_.size(); ++k) {
        const double to = f.state_error[k];
        if (to <= errors_[k]) continue;
        more = true;
        next[k] = to;
        // If the increments shrink by a constant factor, the geometric series gives their sum.
        const double step = to - errors_[k], last_step = errors_[k] - before[k];
        if (i >= 2 && last_step > 0 && step < last_step) {
          next[k] = errors_[k] + step / (1 - step / last_step) * 1.001;
        }
      }
      if (!more) return;
      before = errors_;
      errors_ = next;
      for (const double e : errors_) {
        if (!(e < 1e9)) i = 40;
      }
    }
    bounded_ = false;
    std::fill(errors_.begin(), errors_.end(), 0.0);
  }

  /// The error that a run adds to the state with the largest one beside its range.
  double drift(const CellFacts& f) const {
    double most = 0;
    for (std::size_t k = 0; f.reachable && k < law_.states.size(); ++k) {
      const Range& r = law_.states[k].range;
      if (r.upper > r.lower) most = larger(most, f.state_error[k] / (r.upper - r.lower));
    }
    return most;
  }
  double largest_drift() const {
    double most = 0;
    for (const Leaf& l : leaves_) most = larger(most, drift(l.facts));
    return by_drift_ ? most : 0;
  }
  double badness(const CellFacts& f) const { return by_drift_ ? drift(f) : worst(f); }

  /// Halves the worst cell along the side that reduces the bound most; false if no side does.
  bool split(Cell& whole) {
    std::size_t pick = 0;
    for (std::size_t i = 1; i < leaves_.size(); ++i) {
      if (badness(leaves_[i].facts) > badness(leaves_[pick].facts)) pick = i;
    }
    const double now = badness(leaves_[pick].facts);
    if (now <= 0 || stalled_ > 150) return false;
    const std::size_t count = sides(leaves_[pick].cell).size();
    double best = infinity;
    Leaf low, high;
    bool found = false;
    for (std::size_t s = 0; s < count; ++s) {
      Leaf a{leaves_[pick].cell, {}}, b{leaves_[pick].cell, {}};
      Span* first = sides(a.cell)[s];
      Span* second = sides(b.cell)[s];
      if (!(first->width() > 0)) continue;
      // A sum of squares is halved by its size.
      const bool by_size = s >= count - whole.sums.size() && first->lo > 0;
      const double middle = by_size ? std::sqrt(first->lo * first->hi) : first->middle();
      first->hi = middle;
      second->lo = middle;
      const double share = (middle - first->lo) / sides(whole)[s]->width();
      ranges_.narrow_by_sums(&a.cell);
      a.facts = facts(a.cell);
      // The score is at least this: the other half cannot make this side the best one.
      if (found && badness(a.facts) - 1e-9 * share >= best) continue;
      ranges_.narrow_by_sums(&b.cell);
      b.facts = facts(b.cell);
      const double score = std::max(badness(a.facts), badness(b.facts)) +
                           1e-3 * std::min(badness(a.facts), badness(b.facts)) - 1e-9 * share;
      // While no side reduces the bound, the side with the largest relative width is halved.
      if (!found || score < best) {
        best = score;
        low = std::move(a);
        high = std::move(b);
        found = true;
      }
    }
    if (!found) return false;
    stalled_ = best < now * 0.98 ? 0 : stalled_ + 1;
    leaves_[pick] = std::move(low);
    leaves_.push_back(std::move(high));
    return true;
  }

  /// For states whose error is not bounded, words in range do not imply a law in range: the law's
  /// own state must be proven to stay in its range.
  void drifting(Bound* b) {
    for (std::size_t k = 0; k < law_.states.size(); ++k) {
      const State& s = law_.states[k];
      if (s.phase || b->unproven.size() > 0) continue;
      Span next{1, 0};
      for (const Leaf& l : leaves_) {
        if (l.facts.reachable) next = hull(next, reach(law_, ranges_, s.next, l.cell));
      }
      const double slack = 1e-9 * (s.range.upper - s.range.lower);
      if (next.lo < s.range.lower - slack || next.hi > s.range.upper + slack) {
        const double end = next.lo < s.range.lower - slack ? next.lo : next.hi;
        b->unproven.push_back(
            {-1, static_cast<int>(k), beyond_text(end, s.range.lower, s.range.upper)});
      }
    }
  }

  /// Whether the comparison can have both results, and law and words always decide alike.
  bool sharp(const Step& s, const Reason& why) const {
    if (s.condition < 0) return false;
    if (s.op == EngineOp::cmp) return why.decided.lo != why.decided.hi;
    return s.op == EngineOp::abs && !(s.x == s.y) && why.x.words.lo < 0 && why.x.words.hi >= 0;
  }

  /// The largest error of each output over the parts of the cell, if this step is wrong, and each
  /// whose margin there is above that in `margins`.
  std::vector<double> over_parts(int step, const std::vector<double>& margins) {
    std::vector<double> error(law_.outputs.size(), 0);
    for (const Leaf& l : leaves_) {
      if (!l.facts.reachable) continue;
      const CellFacts f = limited(analyse(law_, target_, program_, l.cell, errors_, step,
                                          &ranges_.over(l.cell), false, &margins));
      for (std::size_t o = 0; f.reachable && o < error.size(); ++o) {
        error[o] = larger(error[o], f.output_error[o]);
      }
    }
    return error;
  }

  void strips(const Cell& whole, Bound* b) {
    const CellFacts base = analyse(law_, target_, program_, whole, errors_, -1, &whole_, true);
    if (!base.reachable) return;
    std::vector<Strip> harmless;
    // The values of states, lines and events are wrong as well.
    const bool kept = !law_.states.empty() || !law_.lines.empty() || !law_.events.empty();
    for (std::size_t i = 0; i < program_.steps.size(); ++i) {
      if (base.margin[i] <= 0) {
        if (sharp(program_.steps[i], base.reasons[i])) {
          b->sharp.push_back(program_.steps[i].place);
        }
        continue;
      }
      const CellFacts swapped = analyse(law_, target_, program_, whole, errors_,
                                        static_cast<int>(i), &whole_, false, &base.margin);
      const CellFacts most = limited(swapped);
      Strip s;
      s.condition = program_.steps[i].condition;
      s.step = static_cast<int>(i);
      s.floors = program_.steps[i].floors;
      s.place = program_.steps[i].place;
      const double own = program_.steps[i].margin_scale;
      s.width = base.margin[i] * (own != 0 ? own : program_.steps[i].scale);
      if (s.condition >= 0 && law_.nodes[at(s.condition)].op == Op::less) {
        s.unit = law_.nodes[at(law_.nodes[at(s.condition)].arguments[0])].unit;
      }
      bool any = false;
      std::vector<double> parts;
      for (std::size_t o = 0; o < base.output_error.size(); ++o) {
        // The significance test uses the unlimited outputs; the jump is the excess over the bound.
        const bool raised = !(swapped.output_error[o] <= base.output_error[o]);
        // An error of the whole cell that the swap does not raise may hide that of its parts.
        const bool within = most.reachable && most.output_error[o] <= b->output[o];
        const bool hides = !raised && !within;
        if (hides && parts.empty()) parts = over_parts(s.step, base.margin);
        const double error = hides ? parts[o] : most.output_error[o];
        const double excess = larger(0.0, error - b->output[o]);
        s.jump.push_back(excess <= 1e-9 * error ? 0 : excess);  // the rounding of doubles
        any = any || raised || !(s.jump.back() <= 0);
      }
      for (std::size_t k = 0; k < base.state_error.size(); ++k) {
        s.next.push_back(larger(0.0, swapped.state_error[k] - base.state_error[k]));
      }
      (any || kept ? b->strips : harmless).push_back(s);
    }
    if (harmless.empty()) return;
    // One by one they do not matter; they must not do so together either.
    std::vector<double> margins = base.margin;
    for (const Strip& s : harmless) margins[at(s.step)] = -1;
    const std::vector<double> together = over_parts(harmless.front().step, margins);
    for (std::size_t o = 0; o < together.size(); ++o) {
      if (together[o] <= b->output[o] * (1 + 1e-9)) continue;
      b->strips.insert(b->strips.end(), harmless.begin(), harmless.end());
      return;
    }
  }

  const Law& law_;
  const Target& target_;
  const Program& program_;
  std::vector<double> errors_;
  const Cell cell_;
  RangesOf ranges_;
  std::vector<Span> whole_;
  std::vector<Leaf> leaves_;
  bool bounded_ = true, limits_ = false, by_drift_ = false;
  int stalled_ = 0;
};

}  // namespace

Bound bound(const Law& law, const Target& target, const Program& program, int splits,
            const std::vector<Span>* whole) {
  return Bounds(law, target, program, whole_cell(law, target), whole)
      .run(splits, false, splits > 0);
}

std::vector<double> bound_as_set(const Law& law, const Target& target, const Program& program,
                                 const Cell& cell, const Bound& all, int splits) {
  const Bound set =
      Bounds(law, target, program, cell, nullptr).run(splits, !all.states_bounded, false);
  std::vector<double> least = all.output;
  if (set.states_bounded != all.states_bounded || !set.unproven.empty()) return least;
  for (std::size_t o = 0; o < least.size(); ++o) least[o] = std::min(least[o], set.output[o]);
  return least;
}

namespace {

constexpr std::size_t kMostCells = 16;  ///< of one side of a condition
constexpr int kMostSides = 1000;        ///< looked at for a value

class Reach {
 public:
  Reach(const Law& law, RangesOf& ranges) : law_(law), ranges_(ranges) {}

  Span of(NodeId id, const Cell& cell) {
    const Node& n = law_.nodes[at(id)];
    if (n.op != Op::select || ++sides_ > kMostSides) return ranges_.over(cell)[at(id)];
    Span all{1, 0};
    for (const bool truth : {true, false}) {
      for (const Cell& part : where(n.arguments[0], truth, cell)) {
        all = hull(all, of(n.arguments[truth ? 1 : 2], part));
      }
    }
    return all;
  }

 private:
  /// Cells that together hold every value of `cell` with which the condition is `truth`.
  std::vector<Cell> where(NodeId condition, bool truth, const Cell& cell) {
    const Node& n = law_.nodes[at(condition)];
    if (n.op == Op::opposite) return where(n.arguments[0], !truth, cell);
    if (n.op == Op::less) return compared(n, truth, cell);
    if (n.op != Op::both && n.op != Op::either) return {cell};
    std::vector<Cell> all;
    if ((n.op == Op::both) == truth) {  // both sides say something
      for (const Cell& first : where(n.arguments[0], truth, cell)) {
        for (Cell& second : where(n.arguments[1], truth, first)) all.push_back(std::move(second));
      }
    } else {
      all = where(n.arguments[0], truth, cell);
      for (Cell& other : where(n.arguments[1], truth, cell)) all.push_back(std::move(other));
    }
    if (all.size() > kMostCells) return {cell};
    return all;
  }

  std::vector<Cell> compared(const Node& n, bool truth, Cell cell) {
    const NodeId x = n.arguments[0], y = n.arguments[1];
    const Span a = ranges_.over(cell)[at(x)], b = ranges_.over(cell)[at(y)];
    // Whole numbers that are not the same are one apart.
    const double apart = truth && law_.nodes[at(x)].whole && law_.nodes[at(y)].whole ? 1 : 0;
    const bool possible =
        truth ? narrow(x, {-infinity, b.hi - apart}, &cell) &&
                    narrow(y, {a.lo + apart, infinity}, &cell)
              : narrow(x, {b.lo, infinity}, &cell) && narrow(y, {-infinity, a.hi}, &cell);
    if (!possible) return {};
    return {cell};
  }

  /// Narrows what the node reads to `to`; false if nothing is left.
  bool narrow(NodeId id, const Span& to, Cell* cell) const {
    const Node& n = law_.nodes[at(id)];
    if (n.op == Op::constant) return n.value >= to.lo && n.value <= to.hi;
    Span* const own = n.op == Op::state                   ? &cell->states[at(n.index)]
                      : n.op == Op::parameter             ? &cell->parameters[at(n.index)]
                      : n.op == Op::input && n.index >= 0 ? &cell->inputs[at(n.index)]
                                                          : nullptr;
    if (own == nullptr) return true;
    *own = both_of(*own, to);
    return !own->empty();
  }

  const Law& law_;
  RangesOf& ranges_;
  int sides_ = 0;
};

}  // namespace

Span reach(const Law& law, RangesOf& ranges, NodeId id, const Cell& cell) {
  return Reach(law, ranges).of(id, cell);
}

}  // namespace feltgate::law
