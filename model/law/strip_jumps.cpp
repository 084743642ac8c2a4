// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/laws.md
#include "law/allocate.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "feltgate/largest.hpp"

namespace feltgate::law {

namespace {

constexpr std::size_t kMostSteps = 60'000;  ///< analysed for all strips over a cell
constexpr int kMostOfStrip = 1000;
constexpr int kStalled =
    30;  ///< halvings in which no jump became smaller, after which a strip ends
constexpr double kWide = 16;  ///< ratio of the ends of a range above 0 that is halved by size

using Jumps = std::vector<double>;

double largest(const Jumps& jumps) {
  double most = 0;
  for (const double j : jumps) most = larger(most, j);
  return most;
}

class Tightening {
 public:
  Tightening(const Law& law, const Target& target, const Program& program, const Bound& b)
      : law_(law), target_(target), program_(program), bound_(b), ranges_(law) {}

  /// Sets the cell, and the bounds of the outputs in it.
  void over(const Cell& cell, const std::vector<double>& outputs) {
    cell_ = cell;
    analyses_ = 0;
    outputs_ = outputs;
    margins_ = analyse(law_, target_, program_, cell, bound_.state, -1, &ranges_.over(cell)).margin;
  }

  /// How far outputs may be beyond their bounds if the comparison of strip `s` is wrong.
  Jumps jumps(const Strip& s) {
    const int step = s.step;
    find_deciding(s.floors >= 0 ? s.floors : s.condition);
    std::vector<Part> parts{{cell_, in(cell_, step)}};
    int stalled = 0;
    double least = largest(parts[0].jumps);
    const int end = std::min(most_, analyses_ + kMostOfStrip);
    while (stalled < kStalled && analyses_ < end) {
      const auto worst = std::max_element(
          parts.begin(), parts.end(),
          [](const Part& a, const Part& b) { return largest(a.jumps) < largest(b.jumps); });
      const double now = largest(worst->jumps);
      stalled = now < 0.98 * least ? 0 : stalled + 1;
      least = std::min(least, now);
      Part low, high;
      if (!(now > 0) || !halve(*worst, step, &low, &high)) break;
      *worst = std::move(low);
      parts.push_back(std::move(high));
    }
    Jumps all(outputs_.size(), 0);
    for (const Part& p : parts) {
      for (std::size_t o = 0; o < all.size(); ++o) all[o] = larger(all[o], p.jumps[o]);
    }
    for (std::size_t o = 0; o < all.size(); ++o) all[o] = std::min(all[o], s.jump[o]);
    return all;
  }

 private:
  struct Part {
    Cell cell;
    Jumps jumps;
  };

  Jumps in(const Cell& cell, int step) {
    ++analyses_;
    const CellFacts f = analyse(law_, target_, program_, cell, bound_.state, step,
                                &ranges_.over(cell), false, &margins_);
    Jumps jumps;
    for (std::size_t o = 0; o < outputs_.size(); ++o) {
      // Where no value is, or where the comparison is certain, no output is beyond its bound.
      const double error = f.reachable ? std::min(f.output_error[o], f.output_apart[o]) : 0;
      const double excess = f.reachable && f.margin[at(step)] > 0 ? error - outputs_[o] : 0;
      jumps.push_back(excess <= 1e-9 * error ? 0 : excess);
    }
    return jumps;
  }

  /// Finds the inputs, states and parameters on which the node depends: cells are halved by these.
  void find_deciding(NodeId id) {
    std::vector<char> below(law_.nodes.size(), 0);
    deciding_.clear();
    if (id >= 0) below[at(id)] = 1;
    for (NodeId i = id; i >= 0; --i) {
      if (below[at(i)] == 0) continue;
      const Node& n = law_.nodes[at(i)];
      for (const NodeId a : n.arguments) below[at(a)] = 1;
      if (n.op == Op::parameter && law_.parameters[at(n.index)].derived >= 0) {
        below[at(law_.parameters[at(n.index)].derived)] = 1;
      }
      std::vector<Span> Cell::*list = n.op == Op::input       ? &Cell::inputs
                                      : n.op == Op::state     ? &Cell::states
                                      : n.op == Op::parameter ? &Cell::parameters
                                                              : nullptr;
      if (list != nullptr && n.index >= 0) deciding_.emplace_back(list, n.index);
    }
  }

  /// Halves a part along the side that lowers its jumps most.
  bool halve(const Part& part, int step, Part* low, Part* high) {
    bool found = false;
    double best = 0;
    for (const auto& [list, index] : deciding_) {
      Part a{part.cell, {}}, b{part.cell, {}};
      Span *const first = &(a.cell.*list)[at(index)], *const second = &(b.cell.*list)[at(index)];
      if (!(first->width() > 0)) continue;
      const bool by_size = first->lo > 0 && first->hi > kWide * first->lo;
      const double middle = by_size ? std::sqrt(first->lo * first->hi) : first->middle();
      first->hi = second->lo = middle;
      a.jumps = in(a.cell, step);
      b.jumps = in(b.cell, step);
      const double x = largest(a.jumps), y = largest(b.jumps);
      // While no side lowers them, the widest is halved.
      const double score = std::max(x, y) + 1e-3 * std::min(x, y) -
                           1e-9 * first->width() / (cell_.*list)[at(index)].width();
      if (found && score >= best) continue;
      found = true;
      best = score;
      *low = std::move(a);
      *high = std::move(b);
    }
    return found;
  }

  const Law& law_;
  const Target& target_;
  const Program& program_;
  const Bound& bound_;
  RangesOf ranges_;
  Cell cell_;
  std::vector<double> outputs_, margins_;
  std::vector<std::pair<std::vector<Span> Cell::*, int>> deciding_;
  const int most_ = static_cast<int>(kMostSteps / std::max<std::size_t>(program_.steps.size(), 1));
  int analyses_ = 0;
};

}  // namespace

void tighten_jumps(const Law& law, const Target& target, const Program& program, const Cell& as_set,
                   Bound* b) {
  std::vector<std::size_t> order(b->strips.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) {
    return largest(b->strips[i].jump) > largest(b->strips[k].jump);
  });
  Tightening work(law, target, program, *b);
  work.over(as_set, b->as_set);
  for (const std::size_t i : order) b->strips[i].jump_as_set = work.jumps(b->strips[i]);
  work.over(whole_cell(law, target), b->output);
  for (const std::size_t i : order) b->strips[i].jump = work.jumps(b->strips[i]);
}

}  // namespace feltgate::law
