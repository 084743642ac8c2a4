// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Finds places where a table's formula is not a finite number. Documentation: docs/laws.md
#pragma once

#include "law/law.hpp"

namespace feltgate::law {

struct NoNumber {
  NodeId node = -1;  ///< the node without a value; -1: the formula is a number everywhere
  double x = 0;      ///< the argument at which it has no value, SI
};

/// Evaluates a table's formula at 4097 places over its domain, the ends included. A value that min,
/// max or a comparison would discard is also checked; a value that an `if` does not choose is not.
NoNumber no_number(const Law& law, const Table& table);

}  // namespace feltgate::law
