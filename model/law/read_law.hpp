// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reads a law file. Documentation: docs/laws.md
#pragma once

#include <string>
#include <string_view>

#include "law/diagnostics.hpp"
#include "law/law.hpp"

namespace feltgate::law {

/// Reads the law in a file; the law's name is the file name without folder and ".law". `rate_hz` >
/// 0 replaces the rate in the file (Hz); dt and filters follow it. Throws LawError with all errors,
/// also when the file cannot be read.
Law read_law(const std::string& path, double rate_hz = 0);

/// The same for a text; errors name it `path`.
Law read_law_text(std::string_view text, const std::string& path, double rate_hz = 0);

}  // namespace feltgate::law
