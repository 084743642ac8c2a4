// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/laws.md
#include "law/ranges.hpp"

#include <algorithm>
#include <cmath>

#include "law/back_end.hpp"

namespace feltgate::law {

namespace {

bool same(const Span& a, const Span& b) { return a.lo == b.lo && a.hi == b.hi; }

}  // namespace

class RangesOf::Work {
 public:
  explicit Work(const Law& law)
      : law_(law), order_(needed(law)), spans_(law.nodes.size()), last_(law.nodes.size()) {}

  const std::vector<NodeId>& order() const { return order_; }

  const std::vector<Span>& over(const Cell& cell) {
    cell_ = &cell;
    std::fill(spans_.begin(), spans_.end(), Span{1, 0});
    for (const NodeId id : order_) spans_[at(id)] = span(id);
    if (cell.sums.empty()) return spans_;
    const std::vector<Span> limits = limits_by_sums(law_, cell, spans_);
    for (const NodeId id : order_) {
      // Without a common part no value is in the cell; the analysis finds that by the sum.
      const Span own = span(id), both = both_of(own, limits[at(id)]);
      spans_[at(id)] = both.empty() ? own : both;
    }
    return spans_;
  }

 private:
  const Node& node(NodeId id) const { return law_.nodes[at(id)]; }

  /// y + a * (x - y) with a in 0 .. 1 lies between x and y.
  bool between(const Node& sum, Span* result) const {
    for (int i = 0; i < 2; ++i) {
      const NodeId y = sum.arguments[at(i)];
      const Node& product = node(sum.arguments[at(1 - i)]);
      if (product.op != Op::multiply) continue;
      for (int k = 0; k < 2; ++k) {
        const Span a = spans_[at(product.arguments[at(k)])];
        const Node& d = node(product.arguments[at(1 - k)]);
        if (d.op == Op::subtract && d.arguments[1] == y && a.lo >= 0 && a.hi <= 1) {
          *result = hull(spans_[at(y)], spans_[at(d.arguments[0])]);
          return true;
        }
      }
    }
    return false;
  }

  Span lookup(const Node& n, const Span& a) const {
    const Table& t = law_.tables[at(n.index)];
    Span x = {t.domain.lower, t.domain.upper};
    if (!t.periodic) x = {std::clamp(a.lo, x.lo, x.hi), std::clamp(a.hi, x.lo, x.hi)};
    Span r{1, 0};
    constexpr int pieces = 24;
    for (int i = 0; i < pieces; ++i) {
      const Span part = {down(x.lo + x.width() * i / pieces),
                         up(x.lo + x.width() * (i + 1) / pieces)};
      r = hull(r, table_jet(law_, t, both_of(part, {t.domain.lower, t.domain.upper})).v);
    }
    return r;
  }

  Span element(const Node& n, const Span& a) const {
    const auto& values = law_.arrays[at(n.index)].values;
    const double last = static_cast<double>(values.size()) - 1;
    Span r{1, 0};
    const auto from = static_cast<std::size_t>(std::clamp(std::floor(a.lo), 0.0, last));
    const auto to = static_cast<std::size_t>(std::clamp(std::floor(a.hi), 0.0, last));
    for (std::size_t i = from; i <= to; ++i) r = hull(r, {values[i], values[i]});
    return r;
  }

  /// The range of a function, from its last two arguments if one of them comes again: most cells
  /// differ in what other nodes depend on.
  template <typename F>
  Span remembered(NodeId id, const Span& argument, F f) {
    Remembered& m = last_[at(id)];
    for (int i = 0; i < 2; ++i) {
      if (m.known[i] && same(m.argument[i], argument)) return m.result[i];
    }
    const int i = m.next;
    m.next = 1 - i;
    m.argument[i] = argument;
    m.result[i] = f();
    m.known[i] = true;
    return m.result[i];
  }

  Span span(NodeId id) {
    const Node& n = node(id);
    if (!is_function(n.op) && n.op != Op::lookup && n.op != Op::element) return computed(id);
    return remembered(id, spans_[at(n.arguments[0])], [&] { return computed(id); });
  }

  /// What the condition, if it is `truth`, leaves of the range `s` of a node that it compares.
  Span where(NodeId condition, bool truth, NodeId id, Span s) const {
    const Node& n = node(condition);
    if (n.op == Op::opposite) return where(n.arguments[0], !truth, id, s);
    if (n.op == Op::both || n.op == Op::either) {
      const Span first = where(n.arguments[0], truth, id, s);
      if ((n.op == Op::both) == truth) return where(n.arguments[1], truth, id, first);
      return hull(first, where(n.arguments[1], truth, id, s));
    }
    if (n.op != Op::less) return s;
    for (const int side : {0, 1}) {
      if (n.arguments[at(side)] != id) continue;
      const NodeId other = n.arguments[at(1 - side)];
      const double apart = truth && node(id).whole && node(other).whole ? 1 : 0;
      if ((side == 0) == truth) {
        s.hi = std::min(s.hi, spans_[at(other)].hi - apart);
      } else {
        s.lo = std::max(s.lo, spans_[at(other)].lo + apart);
      }
    }
    return s;
  }

  Span computed(NodeId id) {
    const Node& n = node(id);
    const auto arg = [&](int i) { return spans_[at(n.arguments[at(i)])]; };
    switch (n.op) {
      case Op::constant:
        return {n.value, n.value};
      case Op::parameter: {
        const Span own = cell_->parameters[at(n.index)];
        const NodeId derived = law_.parameters[at(n.index)].derived;
        return derived < 0 ? own : both_of(own, spans_[at(derived)]);
      }
      case Op::input:
        return n.index < 0 ? whole_line() : cell_->inputs[at(n.index)];  // < 0: a table's variable
      case Op::state:
        return cell_->states[at(n.index)];
      case Op::add: {
        Span r;
        const Span sum = arg(0) + arg(1);
        return between(n, &r) ? both_of(r, sum) : sum;
      }
      case Op::subtract: {
        if (n.arguments[0] == n.arguments[1]) return {0, 0};
        Span d = arg(0) - arg(1);
        for (const Requirement& r : law_.requirements) narrow_difference(n, r, &d.lo, &d.hi);
        return d;
      }
      case Op::multiply:
        return n.arguments[0] == n.arguments[1] ? square(arg(0))
                                                : product_range(law_, *cell_, spans_, n);
      case Op::negate:
        return -arg(0);
      case Op::absolute:
        return amount(arg(0));
      case Op::minimum:
        return least(arg(0), arg(1));
      case Op::maximum: {
        const Span r = most(arg(0), arg(1));
        const auto negated = [&](int i) {
          const Node& m = node(n.arguments[at(i)]);
          return m.op == Op::negate && m.arguments[0] == n.arguments[at(1 - i)];
        };
        return negated(0) || negated(1) ? both_of(r, {0, infinity}) : r;
      }
      case Op::less:
        return truth_of_less(arg(0), arg(1));
      case Op::both:
        return least(arg(0), arg(1));
      case Op::either:
        return most(arg(0), arg(1));
      case Op::opposite:
        return {1 - arg(0).hi, 1 - arg(0).lo};
      case Op::select: {
        if (arg(0).lo > 0) return arg(1);
        if (arg(0).hi <= 0) return arg(2);
        const Span r = hull(where(n.arguments[0], true, n.arguments[1], arg(1)),
                            where(n.arguments[0], false, n.arguments[2], arg(2)));
        return r.empty() ? hull(arg(1), arg(2)) : r;
      }
      case Op::sine:
      case Op::cosine:
      case Op::root:
      case Op::reciprocal:
      case Op::exponential:
      case Op::logarithm:
      case Op::arctangent:
        return function_of(n.op, arg(0));
      case Op::lookup:
        return lookup(n, arg(0));
      case Op::element:
        return element(n, arg(0));
      case Op::line_read:
        return hull({0, 0},
                    {law_.lines[at(n.index)].range.lower, law_.lines[at(n.index)].range.upper});
    }
    return whole_line();
  }

  struct Remembered {
    Span argument[2], result[2];
    bool known[2] = {false, false};
    int next = 0;
  };

  const Law& law_;
  const std::vector<NodeId> order_;
  const Cell* cell_ = nullptr;
  std::vector<Span> spans_;
  std::vector<Remembered> last_;
};

RangesOf::RangesOf(const Law& law) : law_(law) {}
RangesOf::~RangesOf() = default;

const std::vector<Span>& RangesOf::over(const Cell& cell) {
  if (!work_) work_ = std::make_unique<Work>(law_);
  return work_->over(cell);
}

void RangesOf::narrow_by_sums(Cell* cell) {
  if (cell->sums.empty()) return;
  const std::vector<Span>& spans = over(*cell);
  for (const NodeId id : work_->order()) {
    const Node& n = law_.nodes[at(id)];
    if (n.op == Op::input) cell->inputs[at(n.index)] = spans[at(id)];
    if (n.op == Op::state) cell->states[at(n.index)] = spans[at(id)];
  }
}

void narrow_difference(const Node& n, const Requirement& r, double* lower, double* upper) {
  if (n.op != Op::subtract) return;
  const NodeId x = n.arguments[0], y = n.arguments[1];
  if (x == r.larger && y == r.smaller) *lower = std::max(*lower, 0.0);
  if (x == r.smaller && y == r.larger) *upper = std::min(*upper, 0.0);
}

Cell whole_cell(const Law& law, const Target& target) {
  Cell cell;
  for (const Input& input : law.inputs) {
    switch (input.source) {
      case Source::position: {
        const double end = Target::position_counts * target.count_rad();
        cell.inputs.push_back({-end, end});
        break;
      }
      case Source::velocity: {
        const double end = std::ldexp(1.0, target.velocity.integer);
        cell.inputs.push_back({-end, end});
        break;
      }
      case Source::tau_hat: {
        const double end = std::ldexp(1.0, target.torque.integer);
        cell.inputs.push_back({-end, end});
        break;
      }
    }
  }
  for (const Parameter& p : law.parameters)
    cell.parameters.push_back({p.range.lower, p.range.upper});
  for (const State& s : law.states) cell.states.push_back({s.range.lower, s.range.upper});
  return cell;
}

std::vector<Span> ranges(const Law& law, const Cell& cell) { return RangesOf(law).over(cell); }

// Lowers selections that only change a sign to one ABS, in place of a comparison and a selection.

/// Whether the node has the form x < 0 ? -v : v.
bool BackEnd::flips(NodeId id) const {
  const Node& n = node(id);
  if (n.op != Op::select || is_fixed(n.arguments[1]) || is_fixed(n.arguments[2])) return false;
  const Node& c = node(n.arguments[0]);
  if (c.op != Op::less || is_fixed(c.arguments[0])) return false;
  const Node& zero = node(c.arguments[1]);
  if (zero.op != Op::constant || zero.value != 0) return false;
  if (node(n.arguments[1]).op == Op::negate &&
      node(n.arguments[1]).arguments[0] == n.arguments[2]) {
    return true;
  }
  Term a, b;
  gather(n.arguments[1], true, a);
  gather(n.arguments[2], true, b);
  return a.number == -b.number && a.fixed == b.fixed && a.factors == b.factors;
}

/// Whether the node has the form x < 0 ? -c : c with c of numbers and parameters; gives x and c.
bool BackEnd::turned(NodeId id, NodeId* by, Term* amount) const {
  const Node& n = node(id);
  if (n.op != Op::select || !is_fixed(n.arguments[1]) || !is_fixed(n.arguments[2])) return false;
  const Node& c = node(n.arguments[0]);
  if (c.op != Op::less || is_fixed(c.arguments[0])) return false;
  const Node& zero = node(c.arguments[1]);
  if (zero.op != Op::constant || zero.value != 0) return false;
  Term a, b;
  gather(n.arguments[1], true, a);
  gather(n.arguments[2], true, b);
  if (a.number != -b.number || a.fixed != b.fixed) return false;
  *by = c.arguments[0];
  *amount = b;
  return true;
}

/// A product with a sign among its factors: ABS transfers the sign from one word to another.
Value BackEnd::turned_sum(NodeId id, Term term, double hint) {
  NodeId by = -1, sign = -1;
  Term amount;
  for (auto f = term.factors.begin(); f != term.factors.end(); ++f) {
    if (!turned(*f, &by, &amount)) continue;
    sign = *f;
    term.factors.erase(f);
    break;
  }
  term.number *= amount.number;
  term.fixed.insert(term.fixed.end(), amount.fixed.begin(), amount.fixed.end());
  std::sort(term.fixed.begin(), term.fixed.end());
  const Value x = value(by);
  for (const NodeId f : term.factors) (void)value(f);
  const double scale = sum_scale(id, {term}, hint);
  Chain c;
  add_term(term, scale, id, c);
  const Value v = chain(c, scale, id);
  if (v.operand.from == From::step)
    program_.steps[static_cast<std::size_t>(v.operand.index)].node = -1;
  Step& s = emit(EngineOp::abs, 0, x.operand, v.operand, scale, id);
  s.node = id;
  s.condition = node(sign).arguments[0];
  s.margin_scale = x.scale;
  return {last(), scale, 0};
}

}  // namespace feltgate::law
