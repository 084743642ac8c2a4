// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cuts a program into segments and writes a Gappa lemma for each; proves the lemmas of a law again.
// Documentation: docs/laws.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "law/gappa_cutter.hpp"

namespace feltgate::law {

namespace gappa {

std::string number(double x) {
  if (std::fabs(x) < 1e15 && std::floor(x) == x) return fmt::format("{:.0f}", x + 0.0);
  return fmt::format("{:a}", x);
}
std::string within(const Span& s) { return fmt::format("in [{},{}]", number(s.lo), number(s.hi)); }
std::string within(double e) { return within(Span{-e, e}); }

/// Largest number of steps in the expression of one problem.
constexpr int most_steps = 8;

std::vector<GappaLemma> Cutter::run() {
  if (!facts_.reachable) return {};
  cut();
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    if (sink_[i] == 0) continue;
    n_ = static_cast<int>(i);
    step();
  }
  states();
  law_ranges();
  return std::move(lemmas_);
}

bool Cutter::plain(int i) const {
  const Step& s = steps_[at(i)];
  if (why(i).between || !why(i).law.empty() || s.whole) return false;
  return (s.op == EngineOp::add && (s.mode & 1) == 0) || s.op == EngineOp::sub ||
         s.op == EngineOp::mul || s.op == EngineOp::mac;
}

void Cutter::cut() {
  std::vector<int> uses(steps_.size(), 0), size(steps_.size(), 1);
  sink_.assign(steps_.size(), 1);
  std::vector<int> user(steps_.size(), -1);
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    for (const int a : arguments(static_cast<int>(i))) {
      ++uses[at(a)];
      user[at(a)] = static_cast<int>(i);
    }
  }
  for (const StateUse& s : c_.program.states) {
    if (s.next.from == From::step) uses[at(s.next.index)] += 2;
  }
  for (const LineUse& l : c_.program.lines) {
    if (l.written.from == From::step) uses[at(l.written.index)] += 2;
  }
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const int own = static_cast<int>(i);
    for (const int a : arguments(own)) size[i] += sink_[at(a)] != 0 ? 0 : size[at(a)];
    const bool on = uses[i] == 1 && plain(own) && plain_user(user[i], own) &&
                    size[i] < most_steps && steps_[i].output < 0;
    sink_[i] = on ? 0 : 1;
  }
}

bool Cutter::plain_user(int user, int i) const {
  const Step& s = steps_[at(user)];
  // A step with a rounded constant stands for another value than its words give.
  const bool itself = (s.x_error == 0 && s.y_error == 0) || takes_acc(s);
  return (plain(user) || (!why(user).law.empty() && !why(user).between &&
                          (s.op == EngineOp::mul || s.op == EngineOp::mac ||
                           s.op == EngineOp::sub || s.op == EngineOp::add))) &&
         (s.mode & (s.op == EngineOp::add ? 1 : 0)) == 0 && itself && i < user;
}

std::vector<int> Cutter::arguments(int i) const {
  const Step& s = steps_[at(i)];
  std::vector<int> a;
  if (s.x.from == From::step) a.push_back(s.x.index);
  if (s.y.from == From::step) a.push_back(s.y.index);
  if (takes_acc(s)) a.push_back(i - 1);
  return a;
}

void Cutter::begin() {
  given_.clear();
  definitions_.clear();
  goals_.clear();
  hints_.clear();
  defined_.clear();
  known_.clear();
}

void Cutter::finish(const std::string& branch) {
  GappaLemma l;
  l.name = fmt::format("{}.cell{}.step{}{}.g", c_.law.name, cell_, n_, branch);
  for (const auto& [step, term] : defined_) l.steps.push_back(step);
  if (defined_.count(n_) == 0 && n_ >= 0) l.steps.push_back(n_);
  if (given_.empty()) give("0 in [0,0]");
  // By default Gappa ignores a new range that is less than 1 % narrower than the old one.
  l.text = fmt::format(
      "#@ -Echange-threshold=1e-6\n"
      "# Law {}: words of 32 bits in lower case, what they stand for in upper case.\n"
      "@near = fixed<-0,nu>;\n@down = fixed<-0,dn>;\n{}{{\n  {}\n  ->\n  {}\n}}\n{}",
      c_.law.name, definitions_, given_, goals_, hints_);
  lemmas_.push_back(std::move(l));
}

Term Cutter::leaf(const std::string& low, const std::string& high, const Fact& f) {
  const Term t = {low, f.error > 0 ? high : low};
  if (known_.insert(low).second) {
    give(fmt::format("{} {} /\\ @FIX({},0)", low, within(f.words), low));
    if (f.error > 0) give(fmt::format("{} - {} {}", low, high, within(f.error)));
  }
  return t;
}

Term Cutter::result_of(int i) {
  if (sink_[at(i)] != 0) {
    return leaf(fmt::format("t{}", i), fmt::format("T{}", i), fact(i));
  }
  return define(i);
}

Term Cutter::operand(int i, bool second) {
  const Step& s = steps_[at(i)];
  const Operand& o = second ? s.y : s.x;
  const Fact f = second ? why(i).y : why(i).x;
  const double extra = second ? s.y_error : s.x_error;
  switch (o.from) {
    case From::step: {
      Term t = result_of(o.index);
      return apart(t, i, second, extra);
    }
    case From::input:
      return leaf(fmt::format("i{}", o.index), "", f);
    case From::state:
      return leaf(fmt::format("s{}", o.index), fmt::format("S{}", o.index), f);
    case From::word:
      return leaf(fmt::format("w{}", o.index), fmt::format("W{}", o.index), f);
    case From::constant: {
      const std::string value = fmt::format("({})", c_.program.constants[at(o.index)]);
      return apart({value, value}, i, second, extra);
    }
    case From::none:
      break;
  }
  return {"0", "0"};
}

Term Cutter::apart(Term t, int i, bool second, double extra) {
  if (extra <= 0) return t;
  const std::string d = fmt::format("d{}{}", i, second ? "y" : "x");
  if (known_.insert(d).second) give(fmt::format("{} {}", d, within(extra)));
  t.law = fmt::format("({} + {})", t.law, d);
  return t;
}

Term Cutter::product(int i, const char* rounding) {
  const Step& s = steps_[at(i)];
  const Term x = operand(i, false), y = operand(i, true);
  const int shift = engine_shift(s.mode);
  if (s.y.from != From::constant) want(fmt::format("{} in [-131072,131071]", y.word));
  if (shift == 0) {
    return {fmt::format("{} * {}", x.word, y.word), fmt::format("{} * {}", x.law, y.law)};
  }
  return {fmt::format("{}({} * {} * 1b-{})", rounding, x.word, y.word, shift),
          fmt::format("{} * {} * 1b-{}", x.law, y.law, shift)};
}

Term Cutter::expression(int i) {
  const Step& s = steps_[at(i)];
  const auto joined = [](const Term& a, const char* op, const Term& b) {
    return Term{fmt::format("{} {} {}", a.word, op, b.word),
                fmt::format("{} {} {}", a.law, op, b.law)};
  };
  switch (s.op) {
    case EngineOp::add:
      return joined(s.mode >= 2 ? result_of(i - 1) : operand(i, false), "+",
                    operand(i, s.mode < 2));
    case EngineOp::sub:
      return s.mode == 2 ? joined(result_of(i - 1), "-", operand(i, false))
                         : joined(operand(i, false), "-", operand(i, true));
    case EngineOp::mul:
      return product(i, "near");
    case EngineOp::mac: {
      const Term acc = result_of(i - 1);
      return joined(acc, "+", product(i, "near"));
    }
    default:
      return product(i, "down");
  }
}

Term Cutter::define(int i) {
  if (defined_.count(i) == 0) {
    const Term e = expression(i);
    Term& t = defined_[i];
    t = {fmt::format("t{}", i), fmt::format("{}{}", e.word == e.law ? "t" : "T", i)};
    definitions_ += fmt::format("{} = {};\n", t.word, e.word);
    if (t.word != t.law) definitions_ += fmt::format("{} = {};\n", t.law, e.law);
    if (i != n_) want(fmt::format("{} in [-2147483648,2147483647]", t.word));
  }
  return defined_[i];
}

void Cutter::hint(const std::string& left, const std::string& right) {
  hints_ += left + " -> " + right + ";\n";
}

void Cutter::require(const std::string& word, const std::string& law) {
  if (!why(n_).law.empty()) {
    give(fmt::format("{} {}", law, within(why(n_).law)));
    wanted_.insert(steps_[at(n_)].node);
  }
  if (!wraps(fact(n_))) want(fmt::format("{} {}", word, within(fact(n_).words)));
  // The error of whole numbers only needs to be below the next whole number; values that are
  // rounded down are equal beyond the margin, so they need no error goal.
  const Step& s = steps_[at(n_)];
  const double e = s.whole ? down(fact(n_).error + 1) : fact(n_).error;
  if (word != law && s.floors < 0) want(fmt::format("{} - {} {}", word, law, within(e)));
  if (goals_.empty()) want("0 in [0,0]");
}

void Cutter::step() {
  const Step& s = steps_[at(n_)];
  switch (s.op) {
    case EngineOp::add:
    case EngineOp::sub:
    case EngineOp::mul:
    case EngineOp::mac:
    case EngineOp::mlw:
      if (why(n_).between) return between();
      begin();
      require(define(n_));
      return finish("");
    case EngineOp::min:
    case EngineOp::max:
      return extreme(s.op == EngineOp::min);
    case EngineOp::sel:
      return select();
    case EngineOp::cmp:
      return compare();
    case EngineOp::abs:
      return s.x == s.y ? amount() : sign();
    case EngineOp::lrp:
    case EngineOp::tab:
      return table();
    case EngineOp::tst:
      index();
      return finish("");
    default:
      return;
  }
}

}  // namespace gappa

Gappa::Gappa(const Compiled& compiled) : compiled_(compiled) {
  const auto& steps = compiled.program.steps;
  tables_.resize(steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i].op != EngineOp::lrp) continue;
    // All users of a turn's table share one proof.
    std::size_t same = 0;
    while (steps[same].table != steps[i].table) ++same;
    const bool whole = compiled.program.tables[at(steps[i].table)].wraps;
    tables_[i] = whole && same < i ? tables_[same] : table_proof(compiled, static_cast<int>(i));
  }
}

std::vector<GappaLemma> Gappa::lemmas(int cell) const {
  return gappa::Cutter(compiled_, compiled_.bound.parts[at(cell)], tables_, cell).run();
}

GappaCount prove_again(const Compiled& compiled, int cells,
                       const std::function<bool(const GappaLemma&)>& proves) {
  GappaCount count;
  count.steps = static_cast<int>(compiled.program.steps.size());
  count.all_cells = static_cast<int>(compiled.bound.parts.size());
  count.cells = cells <= 0 ? count.all_cells : std::min(cells, count.all_cells);
  const Gappa all(compiled);
  std::map<std::string, bool> known;
  std::vector<char> seen(compiled.program.steps.size(), 0), open(seen.size(), 0);
  for (int i = 0; i < count.cells; ++i) {
    const auto cell = static_cast<std::int64_t>(i) * count.all_cells / count.cells;
    for (const GappaLemma& l : all.lemmas(static_cast<int>(cell))) {
      const auto found = known.find(l.text);
      const bool good = found != known.end() ? found->second : proves(l);
      if (found == known.end()) {
        known.emplace(l.text, good);
        if (!good) count.open.push_back(l.name);
      }
      for (const int step : l.steps) (good ? seen : open)[at(step)] = 1;
    }
  }
  count.lemmas = static_cast<int>(known.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    // A branch around an event produces no word.
    if (compiled.program.steps[i].op == EngineOp::brf) continue;
    if (seen[i] == 0 || open[i] != 0) count.uncovered.push_back(static_cast<int>(i));
  }
  return count;
}

}  // namespace feltgate::law
