// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Evaluates a law in long double, as docs/laws.md defines it.
#include <algorithm>
#include <cmath>

#include "law_tree.hpp"

namespace feltgate::judge {

namespace {
constexpr Real pi = 3.14159265358979323846264338327950288L;
}  // namespace

bool Evaluator::whole(const Node& n) const {
  const auto all = [&](std::size_t from) {
    return std::all_of(n->parts.begin() + static_cast<long>(from), n->parts.end(),
                       [&](const Node& p) { return whole(p); });
  };
  switch (n->kind) {
    case Kind::number:
      return n->value == std::floor(n->value);
    case Kind::counter:
      return true;
    case Kind::param:
      return law_.params[at(n->index)].whole;
    case Kind::state:
      return law_.states[at(n->index)].whole;
    case Kind::let:
      return whole(law_.lets[at(n->index)].value);
    case Kind::floor:
    case Kind::round:
      return true;
    case Kind::add:
    case Kind::subtract:
    case Kind::multiply:
    case Kind::negate:
    case Kind::minimum:
    case Kind::maximum:
    case Kind::clamp:
    case Kind::absolute:
    case Kind::modulo:
      return all(0);
    case Kind::choice:
      return all(1);
    default:
      return false;
  }
}

long Evaluator::decide(const Node& n, long taken, long other, Real distance, Real size, bool exact,
                       bool rounds) {
  auto found = known_.find(n.get());
  if (found == known_.end()) {
    const std::string c = canonical(law_, n);
    const auto number = numbers_.emplace(c, static_cast<long>(numbers_.size())).first->second;
    found = known_.emplace(n.get(), Known{number, c}).first;
  }
  const long key = 64 * found->second.number + counter_ + 1;
  const auto forced = forced_->find(key);
  if (forced != forced_->end()) return forced->second;
  if (seen_.insert(key).second) {
    decisions_.push_back({key, &found->second.canonical, taken, other, distance,
                          1e-15L * (1 + size), exact, rounds});
  }
  return taken;
}

/// Evaluates a < b; `n` is the comparison as written in the law.
bool Evaluator::less(const Node& n, const Node& a, const Node& b) {
  Real x = of(a), y = b ? of(b) : 0;
  const bool whole_a = whole(a), whole_b = !b || whole(b);
  const bool exact =
      (whole_a && (whole_b || b->kind == Kind::number)) || (whole_b && a->kind == Kind::number);
  // A whole value is rounded to a whole number, because its word's step may not be exact.
  if (whole_a) x = std::nearbyint(x);
  if (whole_b) y = std::nearbyint(y);
  const bool is = x < y;
  return decide(n, is ? 1 : 0, is ? 0 : 1, std::fabs(x - y), std::fabs(x) + std::fabs(y), exact) !=
         0;
}

bool Evaluator::truth(const Node& n) {
  const auto& p = n->parts;
  switch (n->kind) {
    case Kind::less:
      return less(n, p[0], p[1]);
    case Kind::more:
      return less(n, p[1], p[0]);
    case Kind::less_equal:
      return !less(n, p[1], p[0]);
    case Kind::more_equal:
      return !less(n, p[0], p[1]);
    case Kind::equal:
    case Kind::differs: {
      const bool same = std::nearbyint(of(p[0])) == std::nearbyint(of(p[1]));
      const bool is = same == (n->kind == Kind::equal);
      return decide(n, is ? 1 : 0, is ? 0 : 1, 0, 0, true) != 0;
    }
    case Kind::state:
      return before_->states[at(n->index)] != 0;
    // Evaluates both sides, so that all comparisons are known.
    case Kind::both: {
      const bool a = truth(p[0]), b = truth(p[1]);
      return a && b;
    }
    case Kind::either: {
      const bool a = truth(p[0]), b = truth(p[1]);
      return a || b;
    }
    default:
      return !truth(p[0]);
  }
}

Real Evaluator::element(const Node& n) {
  const std::vector<double>& values = law_.arrays[at(n->index)].values;
  const long last = static_cast<long>(values.size()) - 1;
  const bool exact = whole(n->parts[0]);
  const Real index = of(n->parts[0]), near = std::nearbyint(index), x = exact ? near : index;
  const auto within = [&](Real i) { return std::clamp(static_cast<long>(i), 0L, last); };
  const long taken = within(std::floor(x)), other = within(x >= near ? near - 1 : near);
  if (taken == other) return values[at(taken)];
  const long index_of = decide(n, taken, other, std::fabs(x - near), std::fabs(x), exact, true);
  return values[at(std::clamp(index_of, 0L, last))];
}

/// Returns x rounded down, and records this as a decision.
Real Evaluator::floored(const Node& n, Real x) {
  const bool exact = whole(n->parts[0]) && (n->parts.size() < 2 || whole(n->parts[1]));
  const Real near = std::nearbyint(x);
  const auto down = static_cast<long>(std::floor(x));
  const auto other = static_cast<long>(x >= near ? near - 1 : near);
  return static_cast<Real>(decide(n, down, other, std::fabs(x - near), std::fabs(x), exact, true));
}

Real Evaluator::table(const Table& t, Real x) {
  const Real period = static_cast<Real>(t.upper) - t.lower;
  if (t.periodic) x -= period * std::floor((x - t.lower) / period);
  const Real inside = std::clamp(x, static_cast<Real>(t.lower), static_cast<Real>(t.upper));
  if (t.body) {
    variable_ = inside;
    return of(t.body);
  }
  const auto segments = static_cast<Real>(t.points.size() - 1);
  const Real place = (inside - t.lower) / period * segments;
  const Real first = std::min(std::floor(place), segments - 1);
  const Real from = t.points[at(static_cast<long>(first))],
             to = t.points[at(static_cast<long>(first) + 1)];
  return from + (to - from) * (place - first);
}

Real Evaluator::of(const Node& n) {
  const auto arg = [&](std::size_t i) { return of(n->parts[i]); };
  switch (n->kind) {
    case Kind::number:
      return n->value;
    case Kind::param:
      return before_->params[at(n->index)];
    case Kind::input:
      return before_->inputs[at(n->index)];
    case Kind::state: {
      const State& s = law_.states[at(n->index)];
      return s.follows ? filtered(s, before_->states[at(n->index)]) : before_->states[at(n->index)];
    }
    case Kind::line: {
      std::size_t i = 0;
      while (law_.lines[i].name != n->text) ++i;
      return before_->lines[i][at(n->index) - 1];
    }
    case Kind::let:
      return of(law_.lets[at(n->index)].value);
    case Kind::counter:
      return n->text == "x" ? variable_ : static_cast<Real>(counter_);
    case Kind::add:
      return arg(0) + arg(1);
    case Kind::subtract:
      return arg(0) - arg(1);
    case Kind::multiply:
      return arg(0) * arg(1);
    case Kind::divide:
      return arg(0) / arg(1);
    case Kind::power:
      return std::pow(arg(0), static_cast<Real>(n->index));
    case Kind::negate:
      return -arg(0);
    case Kind::minimum:
      return std::min(arg(0), arg(1));
    case Kind::maximum:
      return std::max(arg(0), arg(1));
    case Kind::clamp: {
      const Real x = arg(0), lower = arg(1), upper = arg(2);
      return x < lower ? lower : x > upper ? upper : x;
    }
    case Kind::absolute:
      return std::fabs(arg(0));
    case Kind::sine:
      return std::sin(arg(0));
    case Kind::cosine:
      return std::cos(arg(0));
    case Kind::root:
      return std::sqrt(arg(0));
    case Kind::exponential:
      return std::exp(arg(0));
    case Kind::logarithm:
      return std::log(arg(0));
    case Kind::table:
      return table(law_.tables[at(n->index)], arg(0));
    case Kind::element:
      return element(n);
    case Kind::floor:
      return floored(n, arg(0));
    case Kind::round:
      return floored(n, arg(0) + 0.5L);
    case Kind::modulo: {
      const Real x = arg(0), period = arg(1);
      return std::clamp(x - period * floored(n, x / period), Real{0}, period);
    }
    case Kind::noise:
      return 2 * before_->states[at(n->index)] - 1;
    case Kind::angle: {
      const Real x = arg(1), c = x / n->value;
      const Real y = std::fabs(arg(0));
      const Real upper =
          std::fabs(x) + y < n->value ? std::atan2(1 - std::fabs(c), c) : std::atan2(y, x);
      return less(n, n->parts[0], {}) ? -upper : upper;
    }
    case Kind::sign:
      return less(n, n->parts[0], {}) ? -1 : 1;
    case Kind::choice: {
      const bool is = truth(n->parts[0]);
      const Real a = arg(1), b = arg(2);
      return is ? a : b;
    }
    case Kind::sum: {
      Real sum = 0;
      for (counter_ = static_cast<int>(n->value); counter_ <= n->index; ++counter_) sum += arg(0);
      counter_ = -1;
      return sum;
    }
    default:
      return truth(n) ? 1 : 0;
  }
}

/// A lowpass is of this run already; its step response is exact.
Real Evaluator::filtered(const State& s, Real y) {
  const Real share = 1 - std::exp(-2 * pi * of(s.frequency) / before_->rate_hz);
  return y + share * (of(s.follows) - y);
}

Outcome Evaluator::run(const Before& before, const std::map<long, long>& forced) {
  before_ = &before;
  forced_ = &forced;
  decisions_.clear();
  seen_.clear();
  Outcome o;
  for (const Node& t : law_.torques) o.torques.push_back(of(t));
  for (const Event& e : law_.events) {
    o.events.push_back(of(e.value));
    o.holds.push_back(truth(e.condition) ? 1 : 0);
  }
  for (std::size_t k = 0; k < law_.states.size(); ++k) {
    const State& s = law_.states[k];
    Real next = 0;
    if (s.follows) {
      next = filtered(s, before.states[k]);
    } else if (s.next) {
      const Node& rounded = rounded_next_[k];
      next = s.truth ? (truth(s.next) ? 1 : 0) : of(rounded ? rounded : s.next);
    }
    const Real width = static_cast<Real>(s.upper) - s.lower;
    if (s.phase) next -= width * std::floor((next - s.lower) / width);
    o.states.push_back(next);
  }
  for (const Line& l : law_.lines) o.written.push_back(of(l.written));
  o.decisions = decisions_;
  return o;
}

}  // namespace feltgate::judge
