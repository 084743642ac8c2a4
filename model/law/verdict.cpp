// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/laws.md
#include "law/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "law/derive.hpp"
#include "law/diagnostics.hpp"
#include "law/evaluate.hpp"
#include "law/mends.hpp"
#include "law/units.hpp"

namespace feltgate::law {

namespace {

constexpr double kIdle = 0.99;       ///< share of its range from which on a bound says nothing
constexpr double kTold = 0.05;       ///< share of excluded runs above which it is reported
constexpr double kTooMany = 0.3;     ///< share of excluded runs above which the bound is useless
constexpr double kMostOfSide = 0.5;  ///< the same, of the runs on a comparison's rarer side
constexpr double kWrong = 0.1;  ///< share of what a law gave above which a measured error fails
constexpr double kKept = 0.01;  ///< reported relative error at the small end of a parameter's range
constexpr double kSlow = 0.01;  ///< reported error of a run beside the largest move of a state
constexpr int kGivenRuns = 1000;    ///< runs to each side of 0 that show what a law gives
constexpr double kLargeSeen = 0.1;  ///< reported bound beside what random runs gave
constexpr double kIdleTimes =
    100;                        ///< a bound so many times above the largest measured error is idle
constexpr double kAsSet = 0.1;  ///< reported relative error of the file's value, which is listed

/// A number of the law that its words hardly keep, because what it stands beside needs a large
/// step; empty when there is none. Such a number is often the cause of a large error.
std::string lost_number(const Program& program) {
  for (const Step& s : program.steps) {
    const bool beside = s.op == EngineOp::min || s.op == EngineOp::max || s.op == EngineOp::sel ||
                        s.op == EngineOp::add || s.op == EngineOp::sub;
    for (const Operand& o : {s.x, s.y}) {
      if (!beside || o.from != From::constant) continue;
      const double word = program.constants[at(o.index)];
      if (std::fabs(o.exact - word) <= kAsSet * std::fabs(o.exact)) continue;
      return fmt::format(
          "the number {:.6g} of line {} became {:.6g} there: {:.0f} word{} of step {:.3g}",
          o.exact * s.scale, s.place.line, word * s.scale + 0.0, word, word == 1 ? "" : "s",
          s.scale);
    }
  }
  return {};
}

/// The mend for large errors: limit what needs a large step, or the argument of the table with the
/// worst error for its size.
std::string mend(const Program& program, const Bound& b) {
  if (const std::string lost = lost_number(program); !lost.empty()) {
    return lost +
           ". Limit what stands beside it before it grows: min(x, 3)^2 in place of min(x^2, 9)";
  }
  double worst = 1e-3;
  std::string words = "limit values with clamp, or narrow the ranges of parameters";
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    const Step& s = program.steps[i];
    if (s.op != EngineOp::lrp || program.tables[at(s.table)].wraps) continue;
    const double share = b.errors[i] / std::max(b.words[i].size(), 1.0);
    if (share <= worst) continue;
    worst = share;
    words = fmt::format(
        "narrow what goes into {} in line {}, with clamp or by the ranges of "
        "parameters",
        program.tables[at(s.table)].what, s.place.line);
  }
  return words;
}

constexpr const char* kFiner =
    "Give what is compared finer formats (clamp what it is made of, or narrow its ranges), or "
    "compare what is exact";

/// Reports the comparison that comes out otherwise in the most runs, relative to its rarer side by
/// the law. A law that acts near 0 only does so in few of all positions.
void sides(const Measured& m, Verdict* v) {
  const auto share = [](const Sides& s) {
    const auto rare = static_cast<double>(std::min(s.holds, s.fails));
    return s.outside == 0 ? 0 : rare > 0 ? static_cast<double>(s.outside) / rare : infinity;
  };
  const auto tell = [&](double above, double most, std::vector<std::string>* list) {
    std::vector<const Sides*> told;
    for (const Sides& s : m.sides) {
      if (share(s) > above && share(s) <= most) told.push_back(&s);
    }
    if (told.empty()) return;
    const Sides& worst =
        **std::max_element(told.begin(), told.end(),
                           [&](const Sides* a, const Sides* b) { return share(*a) < share(*b); });
    const std::int64_t rare = std::min(worst.holds, worst.fails);
    list->push_back(fmt::format(
        "line {}, column {}: by the law this comparison is {} in {} of {} runs; in {}{} it came "
        "out otherwise, within its strip, with a result outside of the bound{}. {}",
        worst.place.line, worst.place.column, rare == worst.holds ? "true" : "false", rare, m.runs,
        worst.outside, rare > 0 ? fmt::format(" ({:.4g} %)", 100 * share(worst)) : "",
        told.size() > 1 ? fmt::format("; so do {} more comparisons", told.size() - 1) : "",
        kFiner));
  };
  tell(kMostOfSide, infinity, &v->failures);
  tell(kTold, kMostOfSide, &v->warnings);
}

void runs_left_out(const Measured& m, Verdict* v) {
  const auto tell = [&](std::int64_t runs, const char* what) {
    const double share =
        static_cast<double>(runs) / static_cast<double>(std::max<std::int64_t>(m.runs, 1));
    if (share <= kTold) return;
    auto& list = share > kTooMany ? v->failures : v->warnings;
    list.push_back(fmt::format("{:.3g} % of the runs ({} of {}) {}. {}", 100 * share, runs, m.runs,
                               what, kFiner));
  };
  tell(m.in_strips,
       "are left out: a comparison came out otherwise than the law's, within its strip; the bound "
       "is for the others");
  tell(m.kept_otherwise,
       "leave a state, a line or an event that is not the law's: a comparison came out otherwise, "
       "within its strip");
}

/// Reports free runs that leave the law, counted by their beginnings: one comparison within its
/// strip may change all that follows it.
void free_runs(const FreeRuns& free, Verdict* v) {
  const double share = static_cast<double>(free.left) / std::max(1, free.acting);
  if (share <= kTold) return;
  auto& list = share > kTooMany ? v->failures : v->warnings;
  list.push_back(fmt::format(
      "in {} of {} starts the words leave the law, in free runs from the file's first values: they "
      "err by more than the bound and {:.0f} % of what the law gives in more than {:.0f} % of the "
      "runs. {}",
      free.left, free.acting, 100 * kLargeError, 100 * kLargeRuns, kFiner));
}

/// What a word keeps of its values.
struct Kept {
  std::string name, unit;
  std::string of;  ///< whose the set value is
  double to_si = 1, step = 1;
  double set = 0, word = 0;  ///< the set value, and that of its word
  Span range;
  bool set_by_host = false;  ///< a parameter, no word that the host computes
  bool one_word = false;     ///< the word has one value
  double noise = 0;          ///< of the set value, by the rounding of doubles
  double share = kKept;      ///< reported relative error at the small end of the range
  std::string mend;          ///< of the set value
  std::string range_mend;
};

/// Reports values that a word represents badly: the set value, and the small end of a range.
void kept_badly(const Kept& k, Verdict* v) {
  const auto si = [&](double value) { return fmt::format("{:.3g}", value / k.to_si + 0.0); };
  // Small values of a range below 0 are negative.
  const auto small = [&](double value) { return si(k.range.hi < 0 ? -value : value); };
  const auto nearest = [&](double value) { return std::nearbyint(value / k.step); };
  const std::string unit = with_blank(k.unit), step = "; its step is " + si(k.step) + ": ";
  const double off = std::fabs(k.word - k.set);
  // Setting a parameter whose word has one value does nothing.
  const bool one =
      (k.one_word || nearest(k.range.lo) == nearest(k.range.hi)) && k.range.width() > k.noise;
  if (!(one && k.set_by_host) && off > kAsSet * std::fabs(k.set) && off > k.noise) {
    v->warnings.push_back(fmt::format("{}: {:.6g}{}{} becomes {:.6g}", k.name, k.set / k.to_si,
                                      unit, k.of, k.word / k.to_si + 0.0) +
                          step + k.mend);
  } else if (one) {
    (k.set_by_host ? v->failures : v->warnings)
        .push_back(fmt::format("{}: every value of {} .. {}{} becomes {}", k.name, si(k.range.lo),
                               si(k.range.hi), unit, si(k.word)) +
                   step + k.mend);
  }
  const double least = std::min(std::fabs(k.range.lo), std::fabs(k.range.hi));
  if ((k.range.lo <= 0 && k.range.hi >= 0) || k.step / 2 <= k.share * least) return;
  v->warnings.push_back(
      fmt::format("{}: of {} .. {}{} only values from {} on are kept to {:.0f} %", k.name,
                  si(k.range.lo), si(k.range.hi), unit, small(k.step / 2 / k.share),
                  100 * k.share) +
      (least < k.step / 2
           ? fmt::format(", and those nearer to 0 than {} become 0", small(k.step / 2))
           : "") +
      step + k.range_mend);
}

void parameters(const Compiled& c, Verdict* v) {
  for (const ImageWord& w : c.image.words) {
    if (!w.formula.empty()) continue;
    for (const Parameter& p : c.law.parameters) {
      if (p.name != w.name) continue;
      Kept k;
      k.name = w.name;
      k.unit = w.unit;
      k.to_si = w.to_si;
      k.step = std::fabs(w.scale);
      k.set = p.initial;
      k.word = w.initial * w.scale;
      k.range = {p.range.lower, p.range.upper};
      k.of = " of the file";
      k.mend = finer(c.law, c.target, p, k.step);
      k.range_mend = "narrow its range, or begin it there";
      k.set_by_host = true;
      k.one_word = w.lower == w.upper;
      // A whole parameter has a word for each of its values.
      if (p.whole) k.share = infinity;
      kept_badly(k, v);
    }
  }
}

/// Reports the same of the words that the host computes from the other words.
void computed(const Compiled& c, Verdict* v) {
  std::map<std::string, double> values;
  for (const ImageWord& w : c.image.words) {
    if (w.formula.empty()) values[w.name] = w.initial * w.scale;
  }
  const std::vector<Span> spans = ranges(c.law, whole_cell(c.law, c.target));
  for (std::size_t i = 0; i < c.program.words.size(); ++i) {
    const ImageWord& w = c.image.words[i];
    if (w.formula.empty()) continue;
    const std::vector<NodeId>& nodes = c.program.words[i].nodes;
    const Node& first = c.law.nodes[at(nodes.front())];
    Kept k;
    k.range = {1, 1};
    for (const NodeId n : nodes) {
      k.name += (k.name.empty() ? "" : " * ") + formula(c.law, n);
      k.range = k.range * spans[at(n)];
    }
    const Operand word{From::word, static_cast<int>(i)};
    for (const Step& step : c.program.steps) {
      if (!(step.x == word) && !(step.y == word)) continue;
      k.name = fmt::format("line {}: {}, which the host computes", step.place.line, k.name);
      break;
    }
    if (nodes.size() == 1 && !(first.unit == kNumber)) k.unit = text_of(first.unit);
    k.step = std::fabs(w.scale);
    k.set = evaluate_formula(w.formula, [&](const std::string& name) { return values.at(name); });
    k.word = w.initial * w.scale;
    k.noise = 1e-15 * k.range.size();
    k.share = kAsSet;
    k.mend = std::string(full(k.range.size(), k.step) ? "narrow the ranges, or " : "") +
             fmt::format("give what it is made of values that make it {:.3g} or more in size",
                         5 * k.step);
    k.range_mend = "narrow the ranges of what it is made of";
    kept_badly(k, v);
  }
}

/// The error that a run adds to a state beside the state's range.
double drift_share(const Law& law, const Bound& b, std::size_t state) {
  const Range& r = law.states[state].range;
  return r.upper > r.lower ? b.drift[state] / (r.upper - r.lower) : 0;
}

/// Reports states to which a run adds a large error: the words may do something else than the law,
/// and no bound shows that.
void states(const Compiled& c, const Measured& m, Verdict* v) {
  if (c.bound.states_bounded) return;
  for (std::size_t k = 0; k < c.bound.drift.size(); ++k) {
    const State& s = c.law.states[k];
    const double share = drift_share(c.law, c.bound, k);
    const std::string adds =
        fmt::format("a run adds an error of up to {:.3g} to", c.bound.drift[k]);
    if (share > kLargeShare) {
      v->failures.push_back(fmt::format(
          "state {}: {} it, {:.3g} % of its range, {:.6g} .. {:.6g}: what it does is no longer the "
          "law's; {}",
          s.name, adds, 100 * share, s.range.lower, s.range.upper, mend(c.program, c.bound)));
      continue;
    }
    // In the words a state that a run hardly moves may move at another speed, or stand still.
    if (k >= m.move.size() || !(c.bound.drift[k] > kSlow * m.move[k]) || !(m.move[k] > 0)) continue;
    v->warnings.push_back(fmt::format(
        "state {}: a run moved it by {:.3g} at most (measured), and {} that (its step is {:.3g}), "
        "so that it may move at another speed or stand still; give the law a lower rate, or the "
        "state a narrower range",
        s.name, m.move[k], adds, c.program.states[k].scale));
  }
}

/// Whether runs with random inputs give all that the law can give. Those of several inputs seldom
/// meet where a texture or a contact is; a mailbox has the file's value alone in some of them.
bool runs_reach_all(const Law& law) {
  const auto& all = law.parameters;
  return law.inputs.size() == 1 && law.states.empty() && law.lines.empty() &&
         std::none_of(all.begin(), all.end(), [](const Parameter& p) { return p.mailbox; });
}

/// A bound beside the values of its output.
struct Size {
  double bound;
  Span range;
  std::string of, mend;
};

double share_of(const Size& s) { return s.bound / s.range.width(); }

/// Reports a bound that is a large part of its output's range, and one as large as this range.
/// Returns whether it did.
bool beside_its_output(const std::string& name, const Size& s, double lsb, Verdict* v) {
  const double share = share_of(s);
  if (s.bound <= lsb || share <= kLargeShare) return false;
  const bool idle = share >= kIdle && s.bound > 2 * lsb;
  (idle ? v->failures : v->warnings)
      .push_back(fmt::format(
          "{}: the bound, {:.3g} Nm, is {:.3g} % of {}, {:.3g} .. {:.3g} Nm{}; {}", name, s.bound,
          100 * share, s.of, s.range.lo, s.range.hi, idle ? ": it says nothing" : "", s.mend));
  return true;
}

/// Reports an output whose words have one value where the law gives many.
void dead(const Compiled& c, std::size_t output, const std::string& name, const Span& given,
          double lsb, Verdict* v) {
  for (std::size_t i = 0; i < c.program.steps.size(); ++i) {
    const Span& words = c.bound.words[i];
    const bool one =
        c.program.steps[i].output == c.law.outputs[output].axis && words.lo == words.hi;
    if (!one || given.width() <= 2 * lsb) continue;
    v->failures.push_back(fmt::format(
        "{}: the words always give {:.3g} Nm, where the law gives {:.3g} .. {:.3g} Nm; {}", name,
        words.lo * lsb + 0.0, given.lo, given.hi, mend(c.program, c.bound)));
  }
}

/// Fails a measured error that is a large part of what the law gave.
void measured_wrong(const std::string& name, double off, const Span& gave, double lsb,
                    const std::string& mend, Verdict* v) {
  // A law that always gave the same is measured by its size.
  const double most = gave.width() > 0 ? gave.width() : gave.size();
  if (!(off > lsb && off > kWrong * most)) return;
  v->failures.push_back(fmt::format(
      "{}: {:.3g} Nm from the law was measured, and the law gave {:.3g} .. {:.3g} Nm in these runs"
      "{}; {}",
      name, off, gave.lo, gave.hi,
      most > 0 ? fmt::format(": an error of {:.3g} %", 100 * off / most) : "", mend));
}

}  // namespace

std::string name_of(const Output& output, const Law& law) {
  return law.outputs.size() == 1 && output.axis == 0
             ? output.name
             : fmt::format("{}[{}]", output.name, output.axis);
}

std::vector<Span> output_ranges(const Law& law, const Target& target) {
  const std::vector<Span> spans = ranges(law, with_sums(law, whole_cell(law, target)));
  const double end = std::ldexp(1.0, target.torque.integer);
  std::vector<Span> list;
  for (const Output& o : law.outputs) {
    const Span s = spans[at(o.value)], limited = both_of(s, {-end, end});
    list.push_back(limited.empty() ? s : limited);
  }
  return list;
}

std::vector<Span> given_ranges(const Law& law, const Target& target) {
  std::vector<Span> list = output_ranges(law, target);
  if (!runs_reach_all(law)) return list;
  std::vector<Span> given(list.size(), {infinity, -infinity});
  const Span x = whole_cell(law, target).inputs[0];
  Evaluation<double> evaluation(law);
  for (int i = -kGivenRuns; i <= kGivenRuns; ++i) {
    const double share = std::pow(1.0 * i / kGivenRuns, 3);  // most of them near 0
    evaluation.run({x.size() * share});
    for (std::size_t o = 0; o < given.size(); ++o) {
      const double torque = evaluation.outputs()[o];
      given[o] = hull(given[o], {torque, torque});
    }
  }
  for (std::size_t o = 0; o < list.size(); ++o) {
    const Span s = both_of(list[o], given[o]);
    if (s.width() > 0) list[o] = s;
  }
  return list;
}

double largest_share(const std::vector<Span>& spans, const Target& target, const Bound& b) {
  const double lsb = std::ldexp(1.0, -target.torque.fraction);
  double share = 0;
  for (std::size_t o = 0; o < spans.size(); ++o) {
    if (b.output[o] > 2 * lsb) share = std::max(share, b.output[o] / spans[o].width());
  }
  return share;
}

double largest_drift(const Law& law, const Bound& b) {
  double most = 0;
  for (std::size_t k = 0; k < b.drift.size(); ++k) most = std::max(most, drift_share(law, b, k));
  return most;
}

void refuse_idle_bounds(const Law& law, const Target& target, const Program& program,
                        const Bound& b) {
  const std::vector<Span> spans = output_ranges(law, target);
  for (std::size_t o = 0; o < spans.size(); ++o) {
    // One LSB is never refused, and the ranges of law and words are rounded outward to one LSB.
    const double lsb = std::ldexp(1.0, -target.torque.fraction);
    if (b.output[o] <= 2 * lsb || b.output[o] < kIdle * spans[o].width()) continue;
    throw Refused(
        law.outputs[o].place,
        fmt::format("the proven bound of {}, {:.3g} Nm, is as large as its range, {:.3g} .. {:.3g} "
                    "Nm: it says nothing",
                    name_of(law.outputs[o], law), b.output[o], spans[o].lo, spans[o].hi),
        mend(program, b));
  }
}

std::vector<bool> useful_bounds(const Compiled& c, const Measured& m) {
  std::vector<bool> useful(c.law.outputs.size(), true);
  for (std::size_t o = 0; o < useful.size(); ++o) {
    if (o >= m.output.size() || o >= m.reached.size() || !(m.reached[o].width() > 0)) continue;
    const double bound = m.all_inputs ? c.bound.as_set[o] : c.bound.output[o];
    const double lsb = std::ldexp(1.0, -c.target.torque.fraction);
    const double free = o < m.free.most.size() ? m.free.most[o] : 0;
    useful[o] = !(bound > 2 * lsb && bound > kIdleTimes * std::max(m.output[o], free) &&
                  bound > kLargeShare * m.reached[o].width());
  }
  return useful;
}

Verdict verdict(const Compiled& c, const Measured& m) {
  Verdict v;
  sides(m, &v);
  runs_left_out(m, &v);
  free_runs(m.free, &v);
  const std::vector<Span> spans = output_ranges(c.law, c.target);
  const double lsb = std::ldexp(1.0, -c.target.torque.fraction);
  const std::vector<bool> useful = useful_bounds(c, m);
  for (std::size_t o = 0; o < c.law.outputs.size(); ++o) {
    const std::string name = name_of(c.law.outputs[o], c.law);
    const double bound = m.all_inputs ? c.bound.as_set[o] : c.bound.output[o];
    if (o < m.output.size() && !(m.output[o] <= bound * (1 + 1e-9) + 1e-9)) {
      v.failures.push_back(
          fmt::format("{}: {:.3g} Nm from the law was measured, the bound is {:.3g}: an error of "
                      "the compiler, not of the law; please report it",
                      name, m.output[o], bound));
    }
    const std::string narrower = mend(c.program, c.bound);
    if (!useful[o]) {
      v.warnings.push_back(
          fmt::format("{}: no useful bound: {:.3g} Nm, where {:.3g} Nm is the largest error "
                      "measured and the law gave {:.3g} .. {:.3g} Nm; {}",
                      name, bound, m.output[o], m.reached[o].lo, m.reached[o].hi, narrower));
    }
    dead(c, o, name, o < m.reached.size() ? m.reached[o] : spans[o], lsb, &v);
    const Size by_range{c.bound.output[o], spans[o], "its range", narrower};
    const std::size_t failed = v.failures.size();
    if (o >= m.reached.size() || !(m.reached[o].width() > 0)) {
      beside_its_output(name, by_range, lsb, &v);
    } else if (runs_reach_all(c.law)) {
      const Size seen{bound, m.reached[o], "what the law gave in the measured runs", narrower};
      if (!beside_its_output(name, seen, lsb, &v)) beside_its_output(name, by_range, lsb, &v);
    } else if (useful[o] && share_of(by_range) < kIdle && bound > 2 * lsb &&
               bound > kLargeSeen * m.reached[o].width()) {
      // A range by intervals may be far wider than what a law of several inputs gives.
      v.warnings.push_back(fmt::format(
          "{}: the bound, {:.3g} Nm, is {:.3g} % of what the law gave in the runs with random "
          "inputs, {:.3g} .. {:.3g} Nm (its range, by intervals, is {:.3g} .. {:.3g} Nm); {}",
          name, bound, 100 * bound / m.reached[o].width(), m.reached[o].lo, m.reached[o].hi,
          spans[o].lo, spans[o].hi, narrower));
    } else if (useful[o]) {
      beside_its_output(name, by_range, lsb, &v);
    }
    if (o < m.output.size() && o < m.reached.size() && v.failures.size() == failed) {
      measured_wrong(name, m.output[o], m.reached[o], lsb, narrower, &v);
    }
  }
  for (const Unused& u : c.law.unused) {
    v.warnings.push_back(
        fmt::format("line {}, column {}: \"{}\" is never used; use it, or take it out",
                    u.place.line, u.place.column, u.name));
  }
  states(c, m, &v);
  parameters(c, &v);
  computed(c, &v);
  return v;
}

std::string text(const Verdict& v) {
  std::string s;
  for (const std::string& f : v.failures) s += "failed: " + f + "\n";
  for (const std::string& w : v.warnings) s += "warning: " + w + "\n";
  return s;
}

}  // namespace feltgate::law
