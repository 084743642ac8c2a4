// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Judges a bound: the share of runs that it covers, its size relative to the output, and the
// parameter values that the words represent badly. Documentation: docs/laws.md
#pragma once

#include <string>
#include <vector>

#include "law/measure.hpp"

namespace feltgate::law {

/// The sentences at the begin of the compiler's report.
struct Verdict {
  std::vector<std::string> failures;  ///< measurements that contradict the proof
  std::vector<std::string> warnings;
};

Verdict verdict(const Compiled& c, const Measured& m);

/// Whether the bound of each output says something. It does not where it is more than 100 times the
/// largest error measured and more than 1 % of what the law gave.
std::vector<bool> useful_bounds(const Compiled& c, const Measured& m);

/// The lines of a verdict, each with its kind; empty when there is nothing to report.
std::string text(const Verdict& v);

/// A unit as it stands behind a number.
inline std::string with_blank(const std::string& unit) { return unit.empty() ? "" : " " + unit; }

/// "torque", or with its axis "torque[2]" where that is not the only one or not axis 0.
std::string name_of(const Output& output, const Law& law);

/// The ranges of the outputs by the law, Nm, in the order of Law::outputs: over all inputs,
/// parameters and states, cut to the torque's format, where the limiter ends at the latest.
std::vector<Span> output_ranges(const Law& law, const Target& target);

/// The same, narrower where a law of one input without states is seen to give less with the file's
/// parameters: x / sqrt(1 + x^2) lies in -1 .. 1. A sample, not a proof.
std::vector<Span> given_ranges(const Law& law, const Target& target);

/// The largest ratio of a bound to the range of its output, `spans`; 0 if no bound exceeds two LSB.
double largest_share(const std::vector<Span>& spans, const Target& target, const Bound& b);

/// The largest ratio of the error that a run adds to a state, whose error has no end, to the range
/// of that state.
double largest_drift(const Law& law, const Bound& b);

constexpr double kLargeShare = 0.01;  ///< from this share on: reported, and functions are split

/// Throws Refused when a bound is as large as the range of its output: such a bound is useless.
void refuse_idle_bounds(const Law& law, const Target& target, const Program& program,
                        const Bound& b);

}  // namespace feltgate::law
