// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Formats the numbers of an array or a table as the text of a law. Documentation: docs/laws.md
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

namespace feltgate::law {

/// "begin [a, b, ...] unit", nine digits each, broken into lines of at most 100 columns.
inline std::string number_list(const std::string& begin, const std::vector<double>& values,
                               const std::string& unit) {
  std::string s, line = begin + " [";
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string number =
        fmt::format("{:.9g}{}", values[i], i + 1 < values.size() ? "," : "]");
    if (line.size() + number.size() + 1 > 98) {
      s += line + "\n";
      line = "   ";
    }
    line += (line.back() == '[' ? "" : " ") + number;
  }
  return s + line + (unit.empty() ? "" : " " + unit) + "\n";
}

}  // namespace feltgate::law
