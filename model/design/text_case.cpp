// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Makes names and heads of the generated files. Documentation: docs/designs.md
#include "design/text_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace feltgate::design {

std::string upper(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return name;
}

std::string camel(const std::string& name) {
  std::string out;
  bool start = true;
  for (char c : name) {
    if (c == '_' || c == '-') {
      start = true;
    } else {
      out += start ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
      start = false;
    }
  }
  return out;
}

std::string real_literal(double v) {
  std::string s = fmt::format("{:.17g}", v);
  if (s.find_first_of(".en") == std::string::npos) s += ".0";
  return s;
}

std::string generated_banner(const std::string& sources, const std::string& what) {
  return "// SPDX-License-Identifier: Apache-2.0\n"
         "// SPDX-FileCopyrightText: 2026 the feltgate authors\n//\n// Generated from " +
         sources + " by\n// `feltgate generate`: do not edit." + (what.empty() ? "" : " ") + what +
         "\n";
}

}  // namespace feltgate::design
