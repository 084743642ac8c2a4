// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What a compiled law is, as a page of text. Documentation: docs/law-compiler.md
#pragma once

#include <string>

#include "law/compile.hpp"
#include "law/measure.hpp"

namespace feltgate::law {

/// Parameters with their words, rate, bound, measured error, strips, tables.
std::string report(const Compiled& compiled, const Measured& measured);

/// Every instruction with what it reads, its format, its range and its error.
std::string listing(const Compiled& compiled);

/// An operand as the listing names it: "position", "contact", "#12", "t3".
std::string name_of(const Compiled& compiled, const Operand& operand);

}  // namespace feltgate::law
