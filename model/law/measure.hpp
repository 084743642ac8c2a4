// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Measures the error of an image: the interpreter runs the image beside the law in double.
// Documentation: docs/laws.md
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "law/compile.hpp"

namespace feltgate::law {

/// A comparison with a strip: in how many runs it is true and false by the law, and in how many the
/// words decide otherwise and their results are outside of their bounds.
struct Sides {
  Place place;
  std::int64_t holds = 0, fails = 0, outside = 0;
};

/// Of what the law gives, and above the bound or as much again: a large error.
constexpr double kLargeError = 0.05;
constexpr double kLargeRuns = 0.05;

/// The words beside the law as its text says it: both begin with the first values of the file and
/// go on by themselves.
struct FreeRuns {
  std::int64_t runs = 0;
  std::vector<double> most;  ///< largest error, Nm, as Law::outputs
  int starts = 0;            ///< from the beginning, with other inputs and parameters
  int acting = 0;            ///< of these, those in which a torque of law or words moved
  int left = 0;  ///< of these, those in which more than kLargeRuns of the runs had large errors
  std::string unknown;  ///< why there are none
};

struct Measured {
  std::vector<double> output;  ///< largest difference, Nm, as Law::outputs
  std::vector<Span> reached;   ///< the law's least and largest output, Nm, as Law::outputs
  std::int64_t runs = 0;
  std::int64_t in_strips = 0;       ///< runs excluded from `output`: a comparison was in its strip
  std::int64_t kept_otherwise = 0;  ///< further runs in a strip that shows in no output of the run
  std::vector<Sides> sides;         ///< of each comparison with a strip
  std::vector<double> move;  ///< SI: largest change of a state in a run of the law, as Law::states
  bool all_inputs = false;   ///< ran every value of the only input, with default parameters
  FreeRuns free;
};

/// Measures with random inputs and parameters, corners included. Before each run the law's states
/// and lines are set to the values of the words. With `free_running`, law and words instead run
/// independently for 1000 runs at a time.
Measured measure(const Compiled& compiled, std::uint64_t seed, std::int64_t runs,
                 bool free_running = false);

/// Measures all positions, if the law has no state and no other input; otherwise measures nothing.
Measured measure_all(const Compiled& compiled);

/// Runs words and law freely, with random and with smooth inputs, each time from the beginning. The
/// law is run from its text (source_law.hpp): what reader and compiler make of it does not matter.
FreeRuns measure_free(const Compiled& compiled, std::uint64_t seed, std::int64_t runs);

}  // namespace feltgate::law
