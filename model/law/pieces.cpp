// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/laws.md
#include "law/allocate.hpp"

#include <algorithm>
#include <cmath>

#include "feltgate/engine_ops.hpp"
#include "law/derive.hpp"
#include "law/ranges.hpp"

namespace feltgate::law {

namespace {

double value(Op op, double x) {
  return op == Op::root         ? std::sqrt(x)
         : op == Op::reciprocal ? 1 / x
         : op == Op::logarithm  ? std::log(x)
                                : std::exp(x);
}

/// Distance of the function from its chord over a segment, sampled at a few places.
double bend(Op op, double from, double to) {
  const double a = value(op, from), b = value(op, to);
  double most = 0;
  for (int k = 1; k < 16; ++k) {
    const double share = k * k / 256.0;  // denser near both ends: sqrt curves most near one
    for (const double s : {share, 1 - share}) {
      most = std::max(most, std::fabs(value(op, from + (to - from) * s) - (a + (b - a) * s)));
    }
  }
  return most;
}

/// Widths of segments: that of the unsplit table, and the smallest one that is useful with the
/// argument's error.
struct Widths {
  double whole = 0, least = 0;
};

/// Ends of pieces of `segments` segments each. A segment is `width.whole` times a power of two
/// wide, and its error is at most `error`. Empty if more than `pieces` pieces would be needed.
std::vector<double> cuts_for(Op op, const Span& x, int pieces, int segments, const Widths& width,
                             double error) {
  std::vector<double> ends;
  double from = x.lo;
  while (static_cast<int>(ends.size()) < pieces) {
    double to = from;
    for (int k = 8; k > -28; --k) {
      // A table begins at a segment's border, at least an eighth of a segment before its range.
      const double h = std::ldexp(width.whole, k);
      const double end = std::min(x.hi, (std::floor(from / h - 0.125) + segments - 0.25) * h);
      if (h < width.least || !(end > from)) break;
      if (bend(op, from, std::min(from + h, end)) > error) continue;
      double good = from, bad = end;
      if (bend(op, std::max(end - h, from), end) <= error) good = end;
      for (int i = 0; i < 24 && good < end; ++i) {
        const double middle = (good + bad) / 2;
        (bend(op, std::max(middle - h, from), middle) <= error ? good : bad) = middle;
      }
      to = std::max(to, good);
    }
    if (to <= from) return {};
    ends.push_back(to);
    if (to >= x.hi) return ends;
    from = to;
  }
  return {};
}

/// Ends of the pieces, chosen so that their errors are as equal as possible.
std::vector<double> cuts(Op op, const Span& x, int pieces, int segments, const Widths& width) {
  const double whole = std::fabs(value(op, x.hi) - value(op, x.lo));
  double low = -40, high = 0;  // bits of the error in one piece
  std::vector<double> best{x.hi};
  for (int i = 0; i < 20 && whole > 0; ++i) {
    const double middle = (low + high) / 2;
    const std::vector<double> ends =
        cuts_for(op, x, pieces, segments, width, whole * std::exp2(middle));
    (ends.empty() ? low : high) = middle;
    if (!ends.empty()) best = ends;
  }
  return best;
}

/// The range of the argument for which the value lies in `keep`; values are positive except of log.
Span inverse_of(Op op, const Span& keep) {
  if (op == Op::logarithm) return exponential(keep);
  const auto inverse = [op](double y) {
    return op == Op::root ? y * y : op == Op::reciprocal ? 1 / y : std::log(y);
  };
  const bool falls = op == Op::reciprocal;
  const double low = keep.lo > 0 ? inverse(keep.lo) : falls ? infinity : -infinity;
  const double high = keep.hi < infinity ? inverse(keep.hi) : falls ? -infinity : infinity;
  return falls ? Span{high, low} : Span{low, high};
}

class Pieces {
 public:
  Pieces(const Law& law, const Target& target, const Program& whole, const Bound& b, int pieces)
      : law_(law),
        whole_(whole_cell(law, target)),
        spans_(ranges(law, whole_)),
        needed_(law.nodes.size(), 0),
        wide_(law.nodes.size(), 0),
        users_(law.nodes.size(), 0),
        widths_(law.nodes.size()),
        pieces_(pieces) {
    for (const Step& s : whole.steps) {
      if (s.op != EngineOp::lrp || s.node < 0) continue;
      const double error = s.x.from == From::step ? b.errors[at(s.x.index)] : 0;
      widths_[at(s.node)] = {4096 * s.argument_scale, 0.5 * error * s.argument_scale};
    }
    const std::vector<char> fixed = fixed_nodes(law);
    int count = 0;
    for (const NodeId id : needed(law)) {
      const Node& n = law.nodes[at(id)];
      needed_[at(id)] = 1;
      // A square uses its root once.
      for (std::size_t i = 0; i < n.arguments.size(); ++i) {
        if (i == 0 || n.arguments[i] != n.arguments[i - 1]) ++users_[at(n.arguments[i])];
      }
      if (!has_pieces(n.op) || fixed[at(id)] != 0) continue;
      const Span x = spans_[at(n.arguments[0])];
      if (!(x.width() > 0 && x.width() < infinity && widths_[at(id)].whole > 0) ||
          (n.op == Op::root && x.lo < 0) || (n.op == Op::logarithm && x.lo <= 0) ||
          (n.op == Op::reciprocal && x.lo <= 0 && x.hi >= 0)) {
        continue;
      }
      wide_[at(id)] = 1;
      ++count;
    }
    segments_ = std::max(8, EngineMap::table_words / (pieces * std::max(count, 1)) - 2);
  }

  bool narrowed() const { return narrowed_; }

  Law run() {
    made_ = law_;
    made_.nodes.clear();
    const std::vector<Span> matters = interest(law_, spans_);
    for (std::size_t i = 0; i < law_.nodes.size(); ++i) {
      const Node& n = law_.nodes[i];
      const auto id = static_cast<NodeId>(i);
      if (wide_[i] != 0) {
        const NodeId cut = cut_function(id, matters[i]);
        const Span& own = spans_[i];
        narrowed_ = narrowed_ || (cut >= 0 && (own.lo < matters[i].lo || own.hi > matters[i].hi));
        to_.push_back(cut >= 0 ? cut
                               : pieces(id, to_[at(n.arguments[0])], spans_[at(n.arguments[0])]));
      } else if ((n.op == Op::minimum || n.op == Op::maximum) && needed_[i] != 0) {
        to_.push_back(limited(id, {-infinity, infinity}));
      } else {
        to_.push_back(copied(n));
      }
    }
    for (auto& [id, range] : made_.known) id = to_[at(id)];
    const std::vector<Span> spans = ranges(law_, with_sums(law_, whole_));
    for (std::size_t i = 0; i < law_.nodes.size(); ++i) {
      const Node& n = law_.nodes[i];
      if (n.op != Op::multiply || needed_[i] == 0) continue;
      // The range of x / r with r >= |x| is not seen behind the pieces of 1 / r.
      const Span own = spans[i], all = spans[at(n.arguments[0])] * spans[at(n.arguments[1])];
      const bool narrow = n.arguments[0] != n.arguments[1] && !all.within(own);
      if (narrow) made_.known.push_back({to_[i], {own.lo, own.hi}});
    }
    const auto move = [this](NodeId& id) { id = id < 0 ? id : to_[at(id)]; };
    for (Parameter& p : made_.parameters) move(p.derived);
    each_root(made_, move);
    for (Requirement& r : made_.requirements) {
      move(r.smaller);
      move(r.larger);
    }
    return std::move(made_);
  }

 private:
  NodeId add(Node n) {
    made_.nodes.push_back(std::move(n));
    return static_cast<NodeId>(made_.nodes.size()) - 1;
  }

  NodeId make(Op op, const Node& like, const Unit& unit, std::vector<NodeId> arguments,
              double value = 0) {
    Node n;
    n.op = op;
    n.arguments = std::move(arguments);
    n.value = value;
    n.unit = unit;
    n.place = like.place;
    return add(std::move(n));
  }

  NodeId copied(Node n) {
    for (NodeId& a : n.arguments) a = to_[at(a)];
    return add(std::move(n));
  }

  /// Clamps `made`, which has the range `has`, to those ends of `keep` that it exceeds; unit and
  /// place are those of `like`.
  NodeId cut_off(NodeId made, const Node& like, const Span& has, const Span& keep) {
    if (has.hi > keep.hi) {
      made = make(Op::minimum, like, like.unit,
                  {made, make(Op::constant, like, like.unit, {}, keep.hi)});
    }
    if (has.lo < keep.lo) {
      made = make(Op::maximum, like, like.unit,
                  {made, make(Op::constant, like, like.unit, {}, keep.lo)});
    }
    return made;
  }

  /// A wide function, clamped to `keep` by its argument; -1 where that is not possible.
  NodeId cut_function(NodeId id, const Span& keep) {
    const Node& n = law_.nodes[at(id)];
    const NodeId argument = n.arguments[0];
    const bool positive = n.op != Op::reciprocal || spans_[at(argument)].lo > 0;
    const bool reached = keep.hi > 0 || n.op == Op::logarithm;
    if (!positive || !reached) return -1;
    const Span x = spans_[at(argument)];
    const Span left = inverse_of(n.op, keep), inside = both_of(x, left);
    if (!(inside.width() > 0)) return -1;
    const NodeId less = n.op == Op::root ? kept_below(argument, left.hi) : to_[at(argument)];
    return pieces(id, cut_off(less, law_.nodes[at(argument)], x, left), inside);
  }

  /// min(max(node, keep.lo), keep.hi), with the limits moved as far inward in the expression as
  /// possible, so that a function's table covers only the remaining range of its argument.
  NodeId limited(NodeId id, const Span& keep) {
    const Node& n = law_.nodes[at(id)];
    const auto constant = [&](int i) {
      return law_.nodes[at(n.arguments[at(i)])].op == Op::constant;
    };
    const bool alone = users_[at(id)] <= 1 || (keep.lo == -infinity && keep.hi == infinity);
    if (alone && n.arguments.size() == 2 && constant(0) != constant(1)) {
      const int c = constant(0) ? 0 : 1;
      const NodeId other = n.arguments[at(1 - c)];
      const double number = law_.nodes[at(n.arguments[at(c)])].value;
      if (n.op == Op::minimum && number >= keep.lo) {
        return limited(other, {keep.lo, std::min(keep.hi, number)});
      }
      if (n.op == Op::maximum && number <= keep.hi) {
        return limited(other, {std::max(keep.lo, number), keep.hi});
      }
      if (n.op == Op::multiply && number > 0) {
        const NodeId factor = to_[at(n.arguments[at(c)])];
        return make(Op::multiply, n, n.unit,
                    {factor, limited(other, {keep.lo / number, keep.hi / number})});
      }
      if (n.op == Op::subtract && c == 1) {
        const NodeId less = to_[at(n.arguments[1])];
        return make(Op::subtract, n, n.unit,
                    {limited(other, {keep.lo + number, keep.hi + number}), less});
      }
      if (n.op == Op::add) {
        const NodeId addend = to_[at(n.arguments[at(c)])];
        return make(Op::add, n, n.unit,
                    {limited(other, {keep.lo - number, keep.hi - number}), addend});
      }
    }
    if (alone && wide_[at(id)] != 0) {
      const NodeId cut = cut_function(id, keep);
      if (cut >= 0) return cut;
    }
    // The current node of run() has no copy yet.
    const bool has_copy = at(id) < to_.size();
    const bool squared = has_copy && spans_[at(id)].lo >= 0 && keep.hi < infinity;
    const NodeId made = squared ? kept_below(id, keep.hi) : has_copy ? to_[at(id)] : copied(n);
    return cut_off(made, n, spans_[at(id)], keep);
  }

  /// A value x' with min(x', most) = min(x, most), x >= 0: squares in a sum are limited before they
  /// are squared, where a word has twice as many bits. min(x + y, m) = min(min(x, m) + min(y, m),
  /// m).
  NodeId kept_below(NodeId id, double most) {
    const Node& n = law_.nodes[at(id)];
    const NodeId same = to_[at(id)];
    if (!(most > 0) || spans_[at(id)].hi <= most || users_[at(id)] > 1) return same;
    if (n.op == Op::add && spans_[at(n.arguments[0])].lo >= 0 &&
        spans_[at(n.arguments[1])].lo >= 0) {
      const NodeId a = kept_below(n.arguments[0], most), b = kept_below(n.arguments[1], most);
      return make(Op::add, n, n.unit, {a, b});
    }
    if (n.op != Op::multiply) return same;
    const NodeId x = n.arguments[0], y = n.arguments[1];
    const Node& factor = law_.nodes[at(x)];
    if (x == y) {
      const double end = std::sqrt(most) * (1 + 1e-12);  // above the root in spite of rounding
      const NodeId cut = limited(x, {-end, end});
      return make(Op::multiply, n, n.unit, {cut, cut});
    }
    if (factor.op != Op::constant || !(factor.value > 0) || spans_[at(y)].lo < 0) return same;
    return make(Op::multiply, n, n.unit,
                {to_[at(x)], kept_below(y, most / factor.value * (1 + 1e-12))});
  }

  NodeId pieces(NodeId id, NodeId argument, const Span& x) {
    const Node& n = law_.nodes[at(id)];
    const std::vector<double> ends = cuts(n.op, x, pieces_, segments_, widths_[at(id)]);
    const Unit unit = made_.nodes[at(argument)].unit;
    NodeId sum = -1, before = -1;
    double counted_twice = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      NodeId part = argument;
      if (before >= 0) part = make(Op::maximum, n, unit, {part, before});
      if (i + 1 < ends.size()) {
        counted_twice += value(n.op, ends[i]);
        before = make(Op::constant, n, unit, {}, ends[i]);
        part = make(Op::minimum, n, unit, {part, before});
      }
      const NodeId f = make(n.op, n, n.unit, {part});
      sum = sum < 0 ? f : make(Op::add, n, n.unit, {sum, f});
    }
    if (ends.size() < 2) return sum;
    const NodeId twice = make(Op::constant, n, n.unit, {}, -counted_twice);
    return make(Op::add, n, n.unit, {sum, twice});
  }

  const Law& law_;
  const Cell whole_;
  const std::vector<Span> spans_;
  std::vector<char> needed_;  ///< per node: it has a span; false if only in a table's formula
  std::vector<char> wide_;
  std::vector<int> users_;
  std::vector<Widths> widths_;
  std::vector<NodeId> to_;
  const int pieces_;
  int segments_ = 0;
  bool narrowed_ = false;
  Law made_;
};

}  // namespace

Law in_pieces(const Law& law, const Target& target, const Program& whole, const Bound& b,
              int pieces, bool* narrowed) {
  Pieces all(law, target, whole, b, pieces);
  Law made = all.run();
  if (narrowed != nullptr) *narrowed = all.narrowed();
  return made;
}

}  // namespace feltgate::law
