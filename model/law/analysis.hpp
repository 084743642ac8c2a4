// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Computes the range and the error of each step of a program over a cell, in program order.
// Documentation: docs/laws.md
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "law/bound.hpp"

namespace feltgate::law::analysis {

constexpr double word_low = -2147483648.0, word_high = 2147483647.0;

/// Raises `e` slightly to cover the rounding of a sum of products: errors are upper bounds.
inline double raised(double e) { return e * (1 + 0x1p-50); }

inline double raised_sum(double a, double b) {
  const double s = a + b;
  return s - a == b && s - b == a ? s : raised(s);
}

inline double power(int mode) { return std::exp2(EngineMap::shifts[mode]); }

class Analysis {
 public:
  Analysis(const Law& law, const Target& target, const Program& program, const Cell& cell,
           const std::vector<double>& state_error, int swap, const std::vector<Span>* spans,
           bool explain, const std::vector<double>* margins)
      : law_(law),
        target_(target),
        program_(program),
        cell_(cell),
        state_error_(state_error),
        swap_(swap),
        explain_(explain),
        margins_(margins),
        own_spans_(spans != nullptr ? std::vector<Span>() : ranges(law, cell)),
        spans_(spans != nullptr ? *spans : own_spans_) {}
  CellFacts run();

 private:
  void fail(const std::string& reason) { facts_.unproven.push_back({step_, -1, reason}); }

  /// Notes the margin of the current step, in words: within it, law and words may decide
  /// differently.
  void margin(double words);
  /// Whether this analysis assumes that law and words decide differently at `step`.
  bool wrong(int step) const { return swap_ >= 0 && wrong_[at(step)] != 0; }
  Fact operand(const Operand& o, double extra);
  Fact checked(const Fact& f);
  Fact multiplied(const Step& s, const Fact& x, const Fact& y, bool rounds);
  /// Handles y + a * (x - y) with a in 0 .. 1: the result lies between x and y, and the errors of x
  /// and y do not add.
  bool blend(const Step& s, Fact* f);
  Fact table_result(const Step& s, const Fact& x);
  /// The values that an operand can have when comparison `c` has the result `truth`.
  Span given(const Operand& o, const Step& c, bool truth);
  Span given(const Operand& o, bool truth);
  /// The fact of a selection that surely takes operand number `which`.
  Fact only(const Fact& f, int which);
  Fact selected(const Step& s, const Fact& x, const Fact& y);
  /// y, negated where x is below 0.
  Fact flipped(const Fact& x, const Fact& y);
  Fact compared(const Step& s, const Fact& x, const Fact& y);
  Fact result(const Step& s);
  static Fact wrapped(const Fact& f);
  void narrow_by_law(const Step& s, Fact* f);
  void states();
  void require(const Fact& f, double lower, double upper, double scale, int state);
  const Law& law_;
  const Target& target_;
  const Program& program_;
  const Cell& cell_;
  const std::vector<double>& state_error_;
  int swap_;
  bool explain_;
  const std::vector<double>* margins_;
  Reason why_;                         ///< of the current step
  const std::vector<Span> own_spans_;  ///< empty if the caller gave them
  const std::vector<Span>& spans_;
  CellFacts facts_;
  int step_ = 0;
  Span flag_{0, 1};
  std::vector<char> wrong_;
  std::vector<int> sources_;              ///< comparisons that the flag depends on
  std::map<int, std::vector<int>> kept_;  ///< sources of each comparison's result, by step
};

}  // namespace feltgate::law::analysis
