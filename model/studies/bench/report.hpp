// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The benchmark's result as JSON (schema feltgate-bench/1) and as text. Documentation:
// docs/speed-for-accuracy.md
#pragma once

#include <string>

#include "studies/bench/measure.hpp"

namespace feltgate::bench {

/// Where and when the figures were measured.
struct Circumstances {
  std::string version, machine, compiler, date;
};
/// The circumstances of this program, now.
Circumstances circumstances();

std::string json(const Result& result, const std::vector<Work>& works, const Circumstances& c);
std::string text(const Result& result, const std::vector<Work>& works, const Circumstances& c);

}  // namespace feltgate::bench
