// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Describes a compiled law as a page of text. Documentation: docs/laws.md
#pragma once

#include <string>

#include "law/compile.hpp"
#include "law/measure.hpp"

namespace feltgate::law {

/// The report: parameters with their words, rate, bound, measured error, strips, tables.
std::string report(const Compiled& compiled, const Measured& measured);

/// The listing: every instruction with its operands, format, range and error.
std::string listing(const Compiled& compiled);

/// An operand as the listing names it: "position", "contact", "#12", "t3".
std::string name_of(const Compiled& compiled, const Operand& operand);

}  // namespace feltgate::law
