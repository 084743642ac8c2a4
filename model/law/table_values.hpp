// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Where a table's formula is a number. Documentation: docs/laws.md
#pragma once

#include "law/law.hpp"

namespace feltgate::law {

struct NoNumber {
  NodeId node = -1;  ///< what has no value; -1: the formula is a number everywhere
  double x = 0;      ///< at this one, SI
};

/// Looks at a table's formula at 4097 places over its domain, the ends among them. A value that
/// min, max or a comparison would drop counts; one that an `if` does not choose does not.
NoNumber no_number(const Law& law, const Table& table);

}  // namespace feltgate::law
