// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Analysis of table reads, low-pass filters, comparisons and selections. Documentation:
// docs/laws.md
#include <algorithm>
#include <cmath>

#include "feltgate/largest.hpp"
#include "law/analysis.hpp"

namespace feltgate::law {

bool joined_alike(const Program& program, const std::vector<int>& comparisons) {
  return !comparisons.empty() && std::all_of(comparisons.begin(), comparisons.end(), [&](int i) {
    const Step& c = program.steps[at(i)];
    const bool stored = c.y.from == From::step && program.steps[at(c.y.index)].op == EngineOp::cmp;
    const bool first = i == comparisons.front();
    const bool begins = c.mode == 0 || c.mode == 3;
    return !stored && first == begins &&
           (first || c.mode == program.steps[at(comparisons.back())].mode);
  });
}

bool hold_together(const Program& program, const std::vector<int>& comparisons, bool truth) {
  return comparisons.size() == 1 || (program.steps[at(comparisons.back())].mode == 2) == truth;
}

namespace analysis {

bool Analysis::blend(const Step& s, Fact* f) {
  if (s.op != EngineOp::add || s.mode != 2 || step_ == 0) return false;
  const Step& m = program_.steps[at(step_ - 1)];
  if (m.op != EngineOp::mul || m.x.from != From::step) return false;
  const Step& d = program_.steps[at(m.x.index)];
  if (d.op != EngineOp::sub || std::fabs(d.scale / s.scale - 1) > 1e-12) return false;
  // x - y of two words, or of the previous result and a word.
  const bool chained = d.mode == 2 && d.x == s.x;
  if (!chained && !(d.mode == 0 && d.y == s.x)) return false;
  const Fact a = operand(m.y, m.y_error), y = operand(s.x, s.x_error),
             x = chained ? facts_.steps[at(m.x.index - 1)] : operand(d.x, d.x_error),
             difference = operand(m.x, 0);
  const double p = power(m.mode);
  if (a.words.lo < 0 || a.words.hi > p) return false;
  const auto error = [&](double share) { return (1 - share) * y.error + share * x.error; };
  f->words = hull(x.words, y.words);
  f->error = larger(error(a.words.lo / p), error(a.words.hi / p)) +
             a.error * (difference.words.size() + difference.error) / p + 0.5;
  f->error = raised(f->error);
  return true;
}

Fact Analysis::table_result(const Step& s, const Fact& x) {
  const TableUse& t = program_.tables[at(s.table)];
  if (t.line >= 0) {
    if (x.words.lo < 0 || x.words.hi >= 4096.0 * static_cast<double>(t.words.size())) {
      fail("its index can leave the line");
    }
    const double error =
        state_error_[law_.states.size() + at(t.line)] / program_.lines[at(t.line)].scale;
    return {t.values, error + (x.error > 0 ? t.values.width() : 0)};
  }
  const double first = std::floor(x.words.lo / 4096) + s.offset - t.low;
  const double end = std::floor(x.words.hi / 4096) + s.offset - t.low;
  Fact f;
  f.words = t.values;
  f.error = t.error;
  const double last = static_cast<double>(t.words.size()) - 1;
  if (!t.wraps && (first < 0 || end > last)) {
    fail("its index can leave the table");
    // Where another decision is wrong, the law's index may leave it: both values are the table's.
    f.error += t.values.width();
    return f;
  }
  if (s.op == EngineOp::lrp) {
    const bool near = x.error < 4096, part = !t.wraps && end - first < last / 2;
    // The segments that words reach, plus one on each side for the law's argument.
    const double from = part ? std::max(0.0, first - 1) : 0;
    const double to = part ? std::min(last, end + 1) : last;
    if (!t.wraps) f.words = {infinity, -infinity};
    if (near && !t.wraps) f.error = 0;
    for (double i = from; !t.wraps && i <= to; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (near) f.error = larger(f.error, t.errors[k] + t.steep[k] * x.error);
      if (i < first || i > end) continue;
      const double v = engine_table_value(t.words[k]), rise = engine_table_slope(t.words[k]);
      if (i > first && i < end) {  // all of the segment
        f.words = hull(f.words, {std::min(v, v + rise), std::max(v, v + rise)});
        continue;
      }
      const auto line = [&, begin = 4096 * (i + t.low - s.offset)](double word) {
        const double y = v + rise * std::clamp((word - begin) / 4096, 0.0, 1.0);
        return Span{std::floor(y), std::ceil(y)};
      };
      f.words = hull(f.words, hull(line(x.words.lo), line(x.words.hi)));
    }
    if (!near || t.wraps) f.error += t.slope * x.error;
    // Law and words may be separated by one or more seams between segments.
    if (x.error > 0) f.error += near ? t.jump_over(from, to) : t.jump * (1 + x.error / 4096);
    f.error = raised(f.error + 0.5);
  } else if (x.error > 0) {
    margin(x.error);
    // The index is wrong by one where its error is less than one.
    if (wrong(step_)) f.error += x.error <= 4096 ? t.neighbours() : t.values.width();
  }
  return f;
}

Span Analysis::given(const Operand& o, const Step& c, bool truth) {
  const auto known = [&](const Operand& p) {
    Span w = operand(p, 0).words;
    const Span x = operand(c.x, 0).words, y = operand(c.y, 0).words;
    if (p == c.x) w = both_of(w, truth ? Span{word_low, y.hi - 1} : Span{y.lo, word_high});
    if (p == c.y) w = both_of(w, truth ? Span{x.lo + 1, word_high} : Span{word_low, x.hi});
    return w;
  };
  Span w = known(o);
  if (o.from == From::step && w.lo <= w.hi) {
    const Step& s = program_.steps[at(o.index)];
    if (s.mode == 0 && (s.op == EngineOp::add || s.op == EngineOp::sub)) {
      const Span a = known(s.x), b = known(s.y);
      const Span r =
          s.op == EngineOp::add ? Span{a.lo + b.lo, a.hi + b.hi} : Span{a.lo - b.hi, a.hi - b.lo};
      w = both_of(w, r);
    }
  }
  return w;
}

/// The values that an operand can have when the flag is `truth`.
Span Analysis::given(const Operand& o, bool truth) {
  const bool all = hold_together(program_, sources_, truth);
  Span w = all ? operand(o, 0).words : Span{1, 0};
  for (const int i : sources_) {
    const Step& c = program_.steps[at(i)];
    const Span here = given(o, c, (c.mode == 3) != truth);
    w = all ? both_of(w, here) : hull(w, here);
  }
  return w;
}

Fact Analysis::only(const Fact& f, int which) {
  why_.taken = which;
  return f;
}

Fact Analysis::selected(const Step& s, const Fact& x, const Fact& y) {
  Fact f{hull(x.words, y.words), std::max(x.error, y.error)};
  if (flag_.lo > 0) f = only(x, 1);
  if (flag_.hi <= 0) f = only(y, 2);
  if (flag_.lo <= 0 && flag_.hi > 0 && joined_alike(program_, sources_)) {
    if (explain_) why_.sources = sources_;
    f.words = hull(given(s.x, true), given(s.y, false));
  }
  // The law may have decided differently even where the decision of the words is certain.
  if (std::any_of(sources_.begin(), sources_.end(), [this](int c) { return wrong(c); })) {
    f.error = larger(x.error, y.error) +
              std::max(std::fabs(x.words.hi - y.words.lo), std::fabs(y.words.hi - x.words.lo));
  }
  return f;
}

Fact Analysis::flipped(const Fact& x, const Fact& y) {
  Fact f = y;
  if (x.words.hi < 0) {
    f.words = -y.words;
  } else if (x.words.lo < 0) {
    f.words = hull(y.words, -y.words);
  }
  if (x.error > 0 && x.words.lo <= x.error && x.words.hi >= -x.error) {
    margin(x.error);
    if (wrong(step_)) f.error += 2 * y.words.size();
  }
  return f;
}

Fact Analysis::compared(const Step& s, const Fact& x, const Fact& y) {
  const Span c = x.words.hi < y.words.lo    ? Span{1, 1}
                 : x.words.lo >= y.words.hi ? Span{0, 0}
                                            : Span{0, 1};
  why_.decided = c;
  switch (s.mode) {
    case 1:
      flag_ = most(flag_, c);
      break;
    case 2:
      flag_ = least(flag_, c);
      break;
    case 3:
      flag_ = {1 - c.hi, 1 - c.lo};
      break;
    default:
      flag_ = c;
  }
  if (s.mode == 0 || s.mode == 3) sources_.clear();
  sources_.push_back(step_);
  // A stored truth value also depends on the sources of its comparison.
  if (s.y.from == From::step && program_.steps[at(s.y.index)].op == EngineOp::cmp) {
    const std::vector<int>& more = kept_[s.y.index];
    sources_.insert(sources_.end(), more.begin(), more.end());
  }
  kept_[step_] = sources_;
  const double apart = std::max(y.words.lo - x.words.hi, x.words.lo - y.words.hi);
  // The law compares with the exact number, which differs from its word.
  double beside = 0;
  for (const Operand& o : {s.x, s.y}) {
    if (o.from == From::constant) beside += std::fabs(program_.constants[at(o.index)] - o.exact);
  }
  if (apart <= x.error + y.error + beside) margin(x.error + y.error);
  return {flag_, 0};
}

}  // namespace analysis

}  // namespace feltgate::law
