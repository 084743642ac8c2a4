// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/laws.md
#include "law/number_list.hpp"

#include <fmt/format.h>

namespace feltgate::law {

std::string number_list(const std::string& begin, const std::vector<double>& values,
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
