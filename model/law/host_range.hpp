// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Computes the range of a formula of parameters by interval arithmetic. Documentation: docs/laws.md
#pragma once

#include <string>
#include <vector>

#include "law/law.hpp"

namespace feltgate::law {

/// Thrown when a formula has no value somewhere in the ranges of its parameters.
struct NoRange {
  std::string what, mend;
};

/// The range of `node`, which may depend only on constants and parameters; `ranges` holds the
/// ranges of its arguments, by node. Each end is rounded outward by one double; constants and
/// parameters are exact. Throws NoRange when a divisor can be 0, a root's argument can be below 0,
/// or a value can exceed 1e300.
Range host_range(const Law& law, const Node& node, const std::vector<Range>& ranges);

}  // namespace feltgate::law
