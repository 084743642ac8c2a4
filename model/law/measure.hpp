// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The image run by the interpreter beside the law in double: how far apart they are. Documentation:
// docs/law-compiler.md
#pragma once

#include <cstdint>
#include <vector>

#include "law/compile.hpp"

namespace feltgate::law {

struct Measured {
  std::vector<double> output;  ///< largest difference, Nm, as Law::outputs
  std::int64_t runs = 0;
  std::int64_t in_strips = 0;  ///< runs that are in none of `output`: a comparison was too close
  bool all_inputs = false;     ///< every value of the only input, with the parameters' defaults
};

/// Random inputs and parameters, corners among them. States and lines of the law are set to what
/// the words say before each run, unless `free`: then both run on by themselves for 1000 runs at a
/// time.
Measured measure(const Compiled& compiled, std::uint64_t seed, std::int64_t runs,
                 bool free_running = false);

/// All positions, where the law has no state and no other input; else nothing.
Measured measure_all(const Compiled& compiled);

}  // namespace feltgate::law
