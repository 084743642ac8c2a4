// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What reached the core in a run as a text that a page can carry. Documentation: docs/page.md
#pragma once

#include <cstdint>
#include <string>

#include "loop/loop.hpp"

namespace feltgate::page {

/// A line "c CLOCKS LEVELS" with the levels at reset (1 A, 2 B, 4 Z), then "w CLOCK ADDRESS DATA"
/// for every register write, and "DELTA LEVELS" for every pin change, DELTA clocks after the one
/// before.
std::string text_of(const RunInputs& inputs);
/// The other way. Errors: std::invalid_argument with the line.
RunInputs inputs_from_text(const std::string& text);

/// 16 hexadecimal digits.
std::string hex(std::uint64_t value);

}  // namespace feltgate::page
