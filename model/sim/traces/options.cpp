// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// How to read a recording: the texts of the command line. Documentation: docs/traces.md
#include "sim/traces/options.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "feltgate/nearest.hpp"
#include "sim/traces/text.hpp"

namespace feltgate::traces {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::array<std::pair<FileFormat, const char*>, 7> kNames{
    {{FileFormat::detect, "detect"},
     {FileFormat::sigrok, "sigrok"},
     {FileFormat::vcd, "vcd"},
     {FileFormat::saleae, "saleae"},
     {FileFormat::levels, "levels"},
     {FileFormat::columns, "columns"},
     {FileFormat::vector, "vector"}}};

std::optional<double> factor(std::string_view text) {
  text = trim(text);
  double unit = 1.0;
  if (text.size() >= 2 && text.substr(text.size() - 2) == "pi") {
    unit = kPi;
    text.remove_suffix(2);
    if (text.empty()) return unit;
  }
  const std::optional<double> number = parse_real(text);
  if (!number) return std::nullopt;
  return *number * unit;
}

}  // namespace

std::vector<std::string> split_names(const std::string& text) {
  std::vector<std::string> names;
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    names.emplace_back(trim(rest.substr(0, comma)));
    rest = comma == std::string_view::npos ? std::string_view{} : rest.substr(comma + 1);
  }
  return names;
}

double parse_scale(const std::string& text) {
  const std::string_view all = text;
  const std::size_t slash = all.find('/');
  const std::optional<double> top = factor(all.substr(0, slash));
  const std::optional<double> bottom =
      slash == std::string_view::npos ? std::optional<double>(1.0) : factor(all.substr(slash + 1));
  const double scale = top && bottom ? *top / *bottom : 0.0;
  if (!std::isfinite(scale) || scale == 0.0) {
    fail("--scale", shown(text) + " is not a finite number other than 0",
         "give counts per unit, such as 325.95, 2048/2pi or 4096/360");
  }
  return scale;
}

double parse_wrap(const std::string& text) {
  if (text.empty()) return 0.0;
  const std::optional<double> wrap = factor(text);
  if (!wrap || !std::isfinite(*wrap) || *wrap <= 0) {
    fail("--wrap", shown(text) + " is not a finite number above 0",
         "give the units after which the column begins again, such as 360, 2pi or 65536");
  }
  return *wrap;
}

const char* name_of(FileFormat format) {
  for (const auto& [value, name] : kNames) {
    if (value == format) return name;
  }
  return "detect";
}

FileFormat parse_format(const std::string& name) {
  std::vector<std::string> known;
  for (const auto& [value, text] : kNames) {
    if (name == text) return value;
    known.emplace_back(text);
  }
  fail("--format", shown(name) + " is not a format",
       config::did_you_mean(name, known) + "give one of " + list_names(known));
}

}  // namespace feltgate::traces
