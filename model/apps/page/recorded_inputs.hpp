// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The inputs of the core in a run: writes them as a text for a page, and reads it. Documentation:
// docs/page.md
#pragma once

#include <cstdint>
#include <string>

#include "sim/loop/loop.hpp"

namespace feltgate::page {

/// The text: a line "c CLOCKS LEVELS" with the levels at reset (1 A, 2 B, 4 Z), then a line
/// "w CLOCK ADDRESS DATA" per register write, and a line "e DELTA LEVELS" per pin change, DELTA
/// clocks after the previous change.
std::string text_of(const RunInputs& inputs);
/// Reads such a text. Throws std::invalid_argument.
RunInputs inputs_from_text(const std::string& text);

/// `value` as 16 hexadecimal digits.
std::string hex(std::uint64_t value);

}  // namespace feltgate::page
