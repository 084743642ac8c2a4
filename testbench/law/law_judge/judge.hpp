// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Compares a law's words, run by the interpreter, with the law in long double: the strips that the
// compiler reports, the inputs of a run, the verdict.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "feltgate/random.hpp"
#include "law/compile.hpp"
#include "law_tree.hpp"

namespace feltgate::judge {

/// The strips that the compiler reports, sorted by the comparison on their line.
class Strips {
 public:
  Strips(const Printer& printer, const feltgate::law::Compiled& c) {
    for (const law::Strip& s : c.bound.strips) {
      if (s.condition < 0) continue;
      const int line = c.law.nodes[static_cast<std::size_t>(s.condition)].place.line;
      for (const auto& [comparison, lines] : printer.lines()) {
        if (lines.count(line) == 0) continue;
        double& width = widths_[comparison];
        width = std::max(width, s.width);
        std::vector<double>& jump = jumps_[comparison];
        jump.resize(s.jump.size());
        for (std::size_t k = 0; k < jump.size(); ++k) jump[k] += s.jump[k];
      }
    }
  }

  /// Returns the width to each side of the turning point; 0: no strip.
  double width(const Decision& d) const {
    const auto found = widths_.find(*d.canonical);
    return found == widths_.end() ? 0 : found->second;
  }
  /// Returns the other results of a decision that its strip allows, the nearest first: at most 8 to
  /// each side of a number rounded down.
  std::vector<long> other_results(const Decision& d) const {
    const Real reach = width(d) * (1 + 1e-9) + d.rounding;
    std::vector<long> found;
    if (d.exact) return found;
    const long way = d.other - d.taken;
    for (int k = 0; k < (d.rounds ? 8 : 1); ++k) {
      if (d.distance + k <= reach) found.push_back(d.other + k * way);
      if (d.rounds && 1 - d.distance + k <= reach) found.push_back(d.taken - (k + 1) * way);
    }
    return found;
  }
  /// Returns the largest error of an output in the strip, Nm. Valid only if the width is not 0.
  double jump(const Decision& d, std::size_t output) const {
    return jumps_.at(*d.canonical)[output];
  }

 private:
  std::map<std::string, double> widths_;
  std::map<std::string, std::vector<double>> jumps_;
};

/// Returns the index of this name in the compiler's list; -1: not there.
template <class List>
long index(const List& list, const std::string& name) {
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (list[k].name == name) return static_cast<long>(k);
  }
  return -1;
}

/// Returns whether a step reads the state. The words of a state that no step reads need not follow
/// the law; the values that should have read it are judged separately.
inline bool is_read(const feltgate::law::Program& program, long state) {
  const feltgate::law::Operand o{feltgate::law::From::state, static_cast<int>(state)};
  return std::any_of(program.steps.begin(), program.steps.end(),
                     [&](const feltgate::law::Step& s) { return s.x == o || s.y == o; });
}

/// Returns the error in a parameter's word, or an empty text. The word must be in the range, and
/// close to the value in the file.
inline std::string wrong_word(const Param& param, const feltgate::law::ImageWord& w,
                              std::int32_t word, bool initial) {
  const double step = std::fabs(w.scale), unit = static_cast<double>(param.to_si);
  const double value = word * w.scale, lower = param.lower * unit, upper = param.upper * unit;
  const double near = 1e-9 * (upper - lower);
  if (!(value >= lower - near && value <= upper + near)) return param.name + " is out of its range";
  if (param.whole && !(std::fabs(value - std::nearbyint(value)) <= 1e-9)) {
    return param.name + " is no whole number";
  }
  if (initial && !(std::fabs(value - param.initial * unit) <= step * (1 + 1e-9))) {
    return fmt::format("{} begins at {} in place of {}", param.name, value, param.initial * unit);
  }
  const double a = w.lower * w.scale, b = w.upper * w.scale;
  if (!(std::min(a, b) <= lower + step && std::max(a, b) >= upper - step)) {
    return param.name + " does not reach the ends of its range";
  }
  return "";
}

/// Where a state's bound is of one run from it as it stands: what its first word says, no number
/// where that is not what the file says.
inline Real first(const State& s, const feltgate::law::StateUse& use) {
  const Real word = use.initial * static_cast<Real>(use.scale);
  return std::fabs(word - s.initial) <= use.scale ? word : std::nanl("");
}

/// Words of the inputs of three axes.
using Inputs = std::array<std::int64_t, 9>;

/// Makes random inputs of any size, sometimes at the ends of their range.
inline void random_inputs(const feltgate::law::Target& target, SplitMix64& random, Inputs* words) {
  for (std::size_t i = 0; i < words->size(); ++i) {
    const Format f = i % 3 == 1 ? target.velocity : target.torque;
    const std::int64_t end =
        i % 3 == 0 ? 131072 : (std::int64_t{1} << (f.integer + f.fraction)) - 1;
    const std::int64_t spread = (end >> random.below(20)) + 1, corner = random.below(32);
    const std::int64_t any = random.below(2 * spread + 1) - spread;
    (*words)[i] = corner == 0 ? -end : corner == 1 ? end : std::clamp(any, -end, end);
  }
}

inline Real input_si(const feltgate::law::Target& target, std::size_t input, std::int64_t word) {
  const double scale = input % 3 == 0   ? target.count_rad()
                       : input % 3 == 1 ? std::ldexp(1.0, -target.velocity.fraction)
                                        : std::ldexp(1.0, -target.torque.fraction);
  return static_cast<Real>(word) * scale;
}

struct Verdict {
  std::string failure;  ///< empty: none
  std::int64_t runs = 0;
  std::int64_t turned =
      0;  ///< runs in which only a turned comparison within its declared strip explains the words
  std::string first_turned;                  ///< the first of these runs
  std::int64_t aimed = 0, aimed_turned = 0;  ///< the same for runs aimed at a comparison
  int unread_states = 0;  ///< states that no step reads; their words are not judged
  double worst = 0;  ///< largest error of a torque divided by its bound, without the turned runs
  int acting = 0;    ///< free runs in which a torque moved
  int left = 0;      ///< of these, those in which many runs were far from the law
};

/// Compares the words of `compiled` with `law`: torques, events, states and lines of every run.
/// Ends at the first failure.
Verdict judge(const Law& law, const Printer& printer, const feltgate::law::Compiled& compiled,
              std::uint64_t seed, int runs);

}  // namespace feltgate::judge
