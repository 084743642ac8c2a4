// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Whether a bound says something: of how many runs, how large beside its output, and which values
// of parameters are kept. Documentation: docs/law-compiler.md
#pragma once

#include <string>
#include <vector>

#include "law/measure.hpp"

namespace feltgate::law {

/// Sentences that the answer begins with.
struct Verdict {
  std::vector<std::string> failures;  ///< what was measured is not what was proven
  std::vector<std::string> warnings;
};

Verdict verdict(const Compiled& c, const Measured& m);

/// The lines of a verdict, each with its kind; empty where there is nothing to tell.
std::string text(const Verdict& v);

/// What an output can be by its law, Nm, as Law::outputs: over all inputs, parameters and states,
/// within the torque's format, where the limiter ends at last.
std::vector<Span> output_ranges(const Law& law, const Target& target);

/// The largest bound beside the range of its output; 0 where none is above two last bits.
double largest_share(const Law& law, const Target& target, const Bound& b);

constexpr double kLargeShare = 0.01;  ///< from here on it is told, and functions go into pieces

/// Throws Refused where a bound is as large as the range of its output: it says nothing.
void refuse_idle_bounds(const Law& law, const Target& target, const Program& program,
                        const Bound& b);

}  // namespace feltgate::law
