// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/laws.md
#include "law/source_law.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace feltgate::law {

namespace {

using Real = SourceLaw::Real;
using Kind = Statement::Kind;

constexpr Real kTurn = 6.28318530717958647692528676655900577L;
constexpr Real kRounding = 1e-13L;  ///< relative; numbers nearer to each other count as equal

bool same(Real a, Real b) { return std::fabs(a - b) <= kRounding * (std::fabs(a) + std::fabs(b)); }
bool less(Real a, Real b) { return a < b && !same(a, b); }
Real truth(bool b) { return b ? 1 : 0; }

Real rounded_down(Real x) {
  const Real near = std::nearbyint(x);
  return std::fabs(x - near) <= kRounding * std::max<Real>(1, std::fabs(x)) ? near : std::floor(x);
}

std::size_t index_in(Real x, Real least, std::size_t count) {
  const Real most = least + static_cast<Real>(count) - 1;
  return static_cast<std::size_t>(std::clamp(rounded_down(x), least, most) - least);
}

/// Whether it is the first part of a < b < c.
bool compares(const Expression& e) {
  return e.kind == Expression::Kind::binary && !e.brackets &&
         e.name.find_first_of("<>=") != std::string::npos;
}

[[noreturn]] void unknown(const std::string& what) {
  throw std::invalid_argument("the run from the source does not know \"" + what + "\"");
}

}  // namespace

SourceLaw::SourceLaw(const std::string& text, double rate_hz, std::function<double(Place)> nearest)
    : places_(text), step_time_(1 / static_cast<Real>(rate_hz)), nearest_(std::move(nearest)) {
  Diagnostics diagnostics;
  for (Slot& s : inputs_) s = number(0);
  for (const Statement& s : parse_statements(text, diagnostics)) statement(s);
}

SourceLaw::Slot SourceLaw::number(Real value) {
  values_.push_back(value);
  return values_.size() - 1;
}

/// Adds a step to each run. Its value as the law begins is known at once, as that of constants.
SourceLaw::Slot SourceLaw::step(std::function<Real()> value) {
  const Slot to = number(value());
  building_->push_back({to, std::move(value)});
  return to;
}

const SourceLaw::Symbol* SourceLaw::find(const std::string& name) const {
  for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope) {
    const auto found = scope->find(name);
    if (found != scope->end()) return &found->second;
  }
  return nullptr;
}

SourceLaw::Slot SourceLaw::keep(Real first) {
  Kept k;
  k.slot = k.next = number(first);
  k.first = first;
  kept_.push_back(k);
  return k.slot;
}

void SourceLaw::statement(const Statement& s) {
  switch (s.kind) {
    case Kind::param:
    case Kind::mailbox:
      parameters_[s.name].first = constant(s.value);
      parameters_[s.name].slot = number(parameters_[s.name].first);
      return define(s.name, {s.kind, parameters_[s.name].slot});
    case Kind::let:
    case Kind::var:
      return define(s.name, {s.kind, expression(s.value)});
    case Kind::set: {
      const Slot to = expression(s.value);
      for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope) {
        if (scope->count(s.name) == 0) continue;
        (*scope)[s.name].index = to;
        return;
      }
      return;
    }
    case Kind::state:
    case Kind::phase:
    case Kind::boolean: {
      const Slot slot = keep(constant(s.value));
      states_[s.name] = kept_.size() - 1;
      Kept& k = kept_.back();
      k.whole = s.whole;
      k.phase = s.kind == Kind::phase;
      if (k.phase) {
        const Real lower = constant(s.lower), upper = constant(s.upper);
        kept_.back().lower = lower;
        kept_.back().upper = upper;
      }
      return define(s.name, {s.kind, slot});
    }
    case Kind::next: {
      const Slot to = expression(s.value);
      const Symbol* const symbol = find(s.name);
      (symbol->kind == Kind::line ? lines_[symbol->index].next : kept_[states_[s.name]].next) = to;
      return;
    }
    case Kind::line:
      lines_.push_back({std::vector<Real>(static_cast<std::size_t>(constant(s.index)), 0), 0, 0});
      return define(s.name, {s.kind, lines_.size() - 1});
    case Kind::array:
      arrays_.push_back(numbers(s));
      return define(s.name, {s.kind, arrays_.size() - 1});
    case Kind::table:
      return table(s);
    case Kind::loop:
      return loop(s);
    case Kind::out:
      torques_[s.index ? static_cast<int>(constant(s.index)) : 0] = expression(s.value);
      return;
    case Kind::event:
      if (s.value) expression(s.value);
      events_.push_back({expression(s.condition), false, false});
      return;
    case Kind::rate:
    case Kind::require:
      return;
  }
  unknown(s.name);
}

void SourceLaw::loop(const Statement& s) {
  const Real last = constant(s.upper);
  for (Real i = constant(s.lower); i <= last; ++i) {
    scopes_.emplace_back();
    define(s.variable, {Kind::let, number(i)});
    for (const Statement& inner : s.body) statement(inner);
    scopes_.pop_back();
  }
}

std::vector<Real> SourceLaw::numbers(const Statement& s) {
  std::vector<Real> all;
  for (const ExpressionPtr& e : s.elements) {
    all.push_back(constant(e) * static_cast<Real>(s.unit.to_si));
  }
  return all;
}

void SourceLaw::table(const Statement& s) {
  Table t;
  t.lower = constant(s.lower);
  t.upper = constant(s.upper);
  t.periodic = s.periodic;
  t.points = numbers(s);
  if (s.value) {
    t.variable = number(t.lower);
    scopes_.emplace_back();
    define(s.variable, {Kind::let, t.variable});
    building_ = &t.steps;
    t.value = expression(s.value);
    building_ = &steps_;
    scopes_.pop_back();
  }
  tables_.push_back(std::move(t));
  define(s.name, {s.kind, tables_.size() - 1});
}

Real SourceLaw::looked_up(Table& t, Real x) {
  const Real width = t.upper - t.lower;
  if (t.periodic) x -= width * std::floor((x - t.lower) / width);
  x = std::clamp(x, t.lower, t.upper);
  if (t.points.empty()) {
    values_[t.variable] = x;
    for (const Step& s : t.steps) values_[s.to] = s.value();
    return values_[t.value];
  }
  const Real place = (x - t.lower) / width * static_cast<Real>(t.points.size() - 1);
  const std::size_t first = index_in(place, 0, t.points.size() - 1);
  const Real share = place - static_cast<Real>(first);
  return t.points[first] + (t.points[first + 1] - t.points[first]) * share;
}

SourceLaw::Slot SourceLaw::expression(const ExpressionPtr& e) {
  switch (e->kind) {
    case Expression::Kind::number:
      return number(static_cast<Real>(e->value) * static_cast<Real>(e->unit.to_si));
    case Expression::Kind::name:
      return name(*e);
    case Expression::Kind::call:
      return call(*e);
    case Expression::Kind::index:
      return indexed(*e);
    case Expression::Kind::unary: {
      const Slot a = expression(e->arguments[0]);
      if (e->name == "not") return step([this, a] { return truth(values_[a] == 0); });
      return step([this, a] { return -values_[a]; });
    }
    case Expression::Kind::binary:
      return binary(*e);
    case Expression::Kind::power: {
      const Slot a = expression(e->arguments[0]);
      const int power = static_cast<int>(e->value);
      return step([this, a, power] { return std::pow(values_[a], power); });
    }
    case Expression::Kind::choice: {
      // Both are computed: a filter in either of them goes on.
      const Slot c = expression(e->arguments[0]);
      const Slot a = expression(e->arguments[1]), b = expression(e->arguments[2]);
      return step([this, c, a, b] { return values_[values_[c] != 0 ? a : b]; });
    }
    case Expression::Kind::reduce:
      return reduce(*e);
  }
  unknown(e->name);
}

SourceLaw::Slot SourceLaw::input(const std::string& name, int axis) {
  const std::size_t first = 3 * static_cast<std::size_t>(axis);
  if (name == "position") return inputs_[first];
  if (name == "velocity") return inputs_[first + 1];
  if (name == "tau_hat") return inputs_[first + 2];
  unknown(name);
}

SourceLaw::Slot SourceLaw::name(const Expression& e) {
  if (const Symbol* const symbol = find(e.name)) return symbol->index;
  if (e.name == "pi") return number(kTurn / 2);
  if (e.name == "dt") return number(step_time_);
  if (e.name == "time") return since_start();
  if (e.name == "true" || e.name == "false") return number(truth(e.name == "true"));
  return input(e.name, 0);
}

SourceLaw::Slot SourceLaw::indexed(const Expression& e) {
  const Slot i = expression(e.arguments[0]);
  const Symbol* const symbol = find(e.name);
  if (symbol == nullptr) return input(e.name, static_cast<int>(values_[i]));
  const std::size_t of = symbol->index;
  if (symbol->kind == Kind::array) {
    return step([this, i, of] { return arrays_[of][index_in(values_[i], 0, arrays_[of].size())]; });
  }
  return step([this, i, of] {
    const Line& line = lines_[of];
    const std::size_t length = line.ring.size();
    return line.ring[(line.at + length - 1 - index_in(values_[i], 1, length)) % length];
  });
}

SourceLaw::Slot SourceLaw::binary(const Expression& e) {
  const Expression& left = *e.arguments[0];
  const bool chained = e.name.find_first_of("<>=") != std::string::npos && compares(left);
  if (!chained) {
    const Slot a = expression(e.arguments[0]);
    return binary_step(e.name, a, expression(e.arguments[1]));
  }
  // a < b < c: both comparisons.
  const Slot before = expression(e.arguments[0]);
  const Slot b = expression(left.arguments[1]);
  return binary_step("and", before, binary_step(e.name, b, expression(e.arguments[1])));
}

SourceLaw::Slot SourceLaw::binary_step(const std::string& sign, Slot a, Slot b) {
  using Operation = Real (*)(Real, Real);
  static const std::map<std::string, Operation> operations{
      {"+", [](Real x, Real y) { return x + y; }},
      {"-", [](Real x, Real y) { return x - y; }},
      {"*", [](Real x, Real y) { return x * y; }},
      {"/", [](Real x, Real y) { return x / y; }},
      {"<", [](Real x, Real y) { return truth(less(x, y)); }},
      {">", [](Real x, Real y) { return truth(less(y, x)); }},
      {"<=", [](Real x, Real y) { return truth(!less(y, x)); }},
      {">=", [](Real x, Real y) { return truth(!less(x, y)); }},
      {"==", [](Real x, Real y) { return truth(same(x, y)); }},
      {"!=", [](Real x, Real y) { return truth(!same(x, y)); }},
      {"and", [](Real x, Real y) { return truth(x != 0 && y != 0); }},
      {"or", [](Real x, Real y) { return truth(x != 0 || y != 0); }},
      {"min", [](Real x, Real y) { return y < x ? y : x; }},
      {"max", [](Real x, Real y) { return x < y ? y : x; }}};
  const auto found = operations.find(sign);
  if (found == operations.end()) unknown(sign);
  return step([this, a, b, of = found->second] { return of(values_[a], values_[b]); });
}

SourceLaw::Slot SourceLaw::reduce(const Expression& e) {
  const Real first = constant(e.arguments[0]), last = constant(e.arguments[1]);
  Slot all = 0;
  for (Real i = first; i <= last; ++i) {
    scopes_.emplace_back();
    define(e.variable, {Kind::let, number(i)});
    const Slot one = expression(e.arguments[2]);
    scopes_.pop_back();
    all = i == first ? one : binary_step(e.name == "sum" ? "+" : e.name, all, one);
  }
  return all;
}

SourceLaw::Slot SourceLaw::call(const Expression& e) {
  if (const Symbol* const symbol = find(e.name)) {
    const Slot x = expression(e.arguments[0]);
    return step([this, x, t = symbol->index] { return looked_up(tables_[t], values_[x]); });
  }
  std::vector<Slot> at;
  for (const ExpressionPtr& a : e.arguments) at.push_back(expression(a));
  const Slot x = at[0];
  if (e.name == "min" || e.name == "max") {
    Slot all = x;
    for (std::size_t i = 1; i < at.size(); ++i) all = binary_step(e.name, all, at[i]);
    return all;
  }
  if (e.name == "noise") return noise(static_cast<int>(values_[x]));
  if (e.name == "lowpass") return lowpass(x, at[1]);
  if (e.name == "clamp") return binary_step("min", binary_step("max", x, at[1]), at[2]);
  if (e.name == "mod") {
    return step([this, x, m = at[1]] {
      const Real rest = values_[x] - values_[m] * rounded_down(values_[x] / values_[m]);
      return std::clamp<Real>(rest, 0, values_[m]);
    });
  }
  if (e.name == "atan2") {
    // Nearer to 0 than this, |x| + |y| is taken as this.
    const Real least = nearest_(places_.of(e.offset));
    return step([this, y_slot = x, x_slot = at[1], least] {
      const Real along = values_[x_slot], y = values_[y_slot],
                 sum = std::fabs(along) + std::fabs(y);
      const Real c = along / least;
      const Real upper = sum == 0      ? kTurn / 4
                         : sum < least ? std::atan2(1 - std::fabs(c), c)
                                       : std::atan2(std::fabs(y), along);
      return y < 0 ? -upper : upper;
    });
  }
  using Function = Real (*)(Real);
  static const std::map<std::string, Function> functions{
      {"abs", [](Real a) { return std::fabs(a); }},
      {"sgn", [](Real a) -> Real { return a < 0 ? -1 : 1; }},
      {"sin", [](Real a) { return std::sin(a); }},
      {"cos", [](Real a) { return std::cos(a); }},
      {"sqrt", [](Real a) { return std::sqrt(a); }},
      {"exp", [](Real a) { return std::exp(a); }},
      {"log", [](Real a) { return std::log(a); }},
      {"floor", rounded_down},
      {"round", [](Real a) { return rounded_down(a + 0.5L); }}};
  const auto found = functions.find(e.name);
  if (found == functions.end()) unknown(e.name);
  return step([this, x, of = found->second] { return of(values_[x]); });
}

/// The runs so far, up to the last one that is counted, times the time between two.
SourceLaw::Slot SourceLaw::since_start() {
  const Slot runs = keep(0);
  const std::size_t counter = kept_.size() - 1;
  kept_[counter].next =
      step([this, runs] { return std::min<Real>(values_[runs] + 1, 2'000'000'000); });
  return step([this, runs] { return values_[runs] * step_time_; });
}

/// A first-order low-pass, with the value of this run. Its step response is exact.
SourceLaw::Slot SourceLaw::lowpass(Slot x, Slot frequency) {
  const Slot y = keep(0);
  const std::size_t filter = kept_.size() - 1;
  kept_[filter].next = step([this, x, y, frequency] {
    const Real share = 1 - std::exp(-kTurn * values_[frequency] * step_time_);
    return values_[y] + share * (values_[x] - values_[y]);
  });
  return kept_[filter].next;
}

/// Two phases over 0 .. 1 in parts of 2^-20: one grows by a constant, the other by the first one.
SourceLaw::Slot SourceLaw::noise(int seed) {
  const auto part = [](double x) { return std::floor((x - std::floor(x)) * 0x1p20) * 0x1p-20; };
  const double irrational = part(0.6180339887498949 + seed * 0.0137719);
  const Slot odd = number(std::floor(irrational * 0x1p19) * 0x1p-19 + 0x1p-20);
  Slot by = odd;
  for (const double of_golden : {0.7548776662466927, 0.5698402909980532}) {
    const Slot now = keep(part((seed + 1) * of_golden));
    Kept& k = kept_.back();
    k.phase = true;
    k.upper = 1;
    const std::size_t kept = kept_.size() - 1;
    kept_[kept].next = binary_step("+", now, by);
    by = now;
  }
  return step([this, by] { return 2 * values_[by] - 1; });
}

void SourceLaw::reset() {
  for (const Kept& k : kept_) values_[k.slot] = k.first;
  for (Line& l : lines_) std::fill(l.ring.begin(), l.ring.end(), Real{0});
  for (Event& e : events_) e.held = e.happened = false;
}

void SourceLaw::run(const Inputs& inputs) {
  for (std::size_t i = 0; i < inputs.size(); ++i) values_[inputs_[i]] = inputs[i];
  for (const Step& s : steps_) values_[s.to] = s.value();
  for (Event& e : events_) {
    const bool holds = values_[e.condition] != 0;
    e.happened = holds && !e.held;
    e.held = holds;
  }
  std::vector<Real> next;
  for (const Kept& k : kept_) {
    Real to = values_[k.next];
    if (k.whole) to = rounded_down(to);
    if (k.phase) to -= (k.upper - k.lower) * rounded_down((to - k.lower) / (k.upper - k.lower));
    next.push_back(to);
  }
  for (std::size_t i = 0; i < next.size(); ++i) values_[kept_[i].slot] = next[i];
  for (Line& l : lines_) {
    l.ring[l.at] = values_[l.next];
    l.at = (l.at + 1) % l.ring.size();
  }
}

Real SourceLaw::torque(int axis) const {
  const auto found = torques_.find(axis);
  return found == torques_.end() ? 0 : values_[found->second];
}

}  // namespace feltgate::law
