// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The range of a formula over parameters, by intervals. Documentation: docs/laws.md
#pragma once

#include <string>
#include <vector>

#include "law/law.hpp"

namespace feltgate::law {

/// A formula that has no value somewhere in its parameters' ranges.
struct NoRange {
  std::string what, mend;
};

/// The range of `node`, which may only hold constants and parameters; `ranges` holds those of its
/// arguments, by node. Each end is moved one double outward; constants and parameters are exact.
/// Errors: NoRange where a divisor can be 0, a root's argument below 0, or a value beyond 1e300.
Range host_range(const Law& law, const Node& node, const std::vector<Range>& ranges);

}  // namespace feltgate::law
