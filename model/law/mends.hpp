// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Mends that were tried before they are told; where none helps, the reason. Documentation:
// docs/laws.md
#pragma once

#include <string>

#include "law/law.hpp"
#include "law/ranges.hpp"
#include "law/target.hpp"

namespace feltgate::law {

/// The refusal of a state, or of a line if `is_line`, that can leave its range; `how` says with
/// which value. The mend names a larger range only where one holds all its next values; elsewhere
/// the reason says that none does.
Refused leaves_its_range(const Law& law, const Target& target, int index, bool is_line,
                         const std::string& how);

/// Whether the range of a word, whose largest magnitude is `size`, may decide its step.
inline bool full(double size, double step) { return size / step >= 0x1p10; }

/// The mend for a parameter of which a word with this step keeps too little. A narrower range helps
/// only where the word has many steps; a larger value helps where its own step is not larger too.
std::string finer(const Law& law, const Target& target, const Parameter& p, double step);

}  // namespace feltgate::law
