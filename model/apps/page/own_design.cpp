// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A user's design on a compiled core. Documentation: docs/page.md
#include "apps/page/own_design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "design/generate.hpp"

namespace feltgate::page {

namespace {

/// The lines of a design's header that a compiled core cannot change: all except its name, its
/// parameters' values, the start of the I2t sum and the checksums.
std::vector<std::string> fixed_lines(const design::Elaborated& e) {
  std::istringstream text(design::cpp_header(e));
  std::vector<std::string> lines;
  std::string line;
  bool values = false;
  while (std::getline(text, line)) {
    if (line.find("ParameterInfo parameters[]") != std::string::npos) values = true;
    const bool named = line.find("struct ") == 0 || line.find("///") != std::string::npos ||
                       line.find("* name =") != std::string::npos || line.find("//") == 0;
    if (!values && !named && line.find("i2t_start") == std::string::npos &&
        line.find("design_crc") == std::string::npos && line.find("file_sum") == std::string::npos)
      lines.push_back(line.substr(std::min(line.size(), line.find_first_not_of(' '))));
    if (values && line.find("};") != std::string::npos) values = false;
  }
  return lines;
}

std::string first_difference(const std::vector<std::string>& own,
                             const std::vector<std::string>& base) {
  for (std::size_t i = 0; i < std::min(own.size(), base.size()); ++i) {
    if (own[i] != base[i]) return fmt::format("\"{}\" instead of \"{}\"", own[i], base[i]);
  }
  return "other scenes";
}

}  // namespace

design::Elaborated elaborated(const std::string& text, const std::string& path,
                              const std::string& registers) {
  return design::elaborate(
      text.empty() ? design::read_design(path) : design::design_from_text(text, "own.toml"),
      design::read_registers(registers));
}

OwnDesign own_design(const std::string& text, const std::vector<std::string>& compiled,
                     const std::string& designs_folder, const std::string& registers) {
  const design::Elaborated own = elaborated(text, "", registers);
  const auto lines = fixed_lines(own);
  std::string differs;
  for (const std::string& name : compiled) {
    const auto base = fixed_lines(elaborated("", designs_folder + name + ".toml", registers));
    if (base != lines) {
      differs += fmt::format("; {}: {}", name, first_difference(lines, base));
      continue;
    }
    OwnDesign out;
    out.base = name;
    for (const design::Word& w : own.words) {
      out.values.emplace_back(w.parameter.name, w.quantised());
    }
    return out;
  }
  throw std::invalid_argument(
      "this design has formats or times of its own, for which this page has no core" + differs +
      "; make a page that has it: ./feltgate page --design FILE");
}

}  // namespace feltgate::page
