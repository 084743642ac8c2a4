// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Formats the numbers of an array or a table as the text of a law. Documentation: docs/laws.md
#pragma once

#include <string>
#include <vector>

namespace feltgate::law {

/// "begin [a, b, ...] unit", nine digits each, broken into lines of at most 100 columns.
std::string number_list(const std::string& begin, const std::vector<double>& values,
                        const std::string& unit);

}  // namespace feltgate::law
