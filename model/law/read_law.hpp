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

/// The law in a file; its name is the file's without folder and ".law". `rate_hz` > 0: the rate in
/// Hz at which it runs, instead of what the file says; dt and filters follow. Errors: LawError with
/// everything that is wrong, also when the file cannot be read.
Law read_law(const std::string& path, double rate_hz = 0);

/// The same of a text; errors call it `path`.
Law read_law_text(std::string_view text, const std::string& path, double rate_hz = 0);

}  // namespace feltgate::law
