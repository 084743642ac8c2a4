// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The range of a value of the law that conditions decide: what is compared is narrowed on each
// side. Documentation: docs/laws.md
#pragma once

#include "law/ranges.hpp"

namespace feltgate::law {

/// The range of node `id` over `cell`. Where it is a choice (or a choice of choices), each side is
/// looked at where its condition can hold: `if n < 9 then n + 1 else 0` goes to 9 for a whole n.
Span reach(const Law& law, RangesOf& ranges, NodeId id, const Cell& cell);

}  // namespace feltgate::law
