// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Tables of numbers in named columns. Documentation: docs/calibration.md
#include "host/calibrate/columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <limits>

#include "host/calibrate/regression.hpp"
#include "sim/traces/text.hpp"

namespace feltgate::host {

namespace {

std::vector<std::string> fields_of(const std::string& line, char separator) {
  std::vector<std::string> fields;
  std::string field;
  const auto end = [&] {
    std::string text(traces::trim(field));
    if (text.size() > 1 && text.front() == '"' && text.back() == '"') {
      text = text.substr(1, text.size() - 2);
    }
    if (separator != ' ' || !text.empty()) fields.push_back(text);
    field.clear();
  };
  for (const char c : line) {
    if (c == separator || (separator == ' ' && c == '\t')) {
      end();
    } else {
      field += c;
    }
  }
  end();
  return fields;
}

char separator_of(const std::string& line) {
  for (const char c : {',', ';', '\t'}) {
    if (line.find(c) != std::string::npos) return c;
  }
  return ' ';
}

}  // namespace

ColumnTable::ColumnTable(std::istream& in, std::string name) : file_(std::move(name)) {
  std::string line;
  char separator = ',';
  for (int number = 1; std::getline(in, line); ++number) {
    const std::size_t comment = line.find('#');
    const std::string text(traces::trim(std::string_view(line).substr(0, comment)));
    if (text.empty()) continue;
    const auto where = [&] { return fmt::format("{}:{}: ", file_, number); };
    if (names_.empty()) {
      separator = separator_of(text);
      names_ = fields_of(text, separator);
      for (std::string& n : names_) n = traces::lower(n);
      if (std::any_of(names_.begin(), names_.end(),
                      [](const std::string& n) { return traces::parse_real(n).has_value(); })) {
        throw MeasurementError(where() +
                               "numbers where the names of the columns should be; begin with a "
                               "line such as voltage_v,torque_nm");
      }
      continue;
    }
    const auto fields = fields_of(text, separator);
    if (fields.size() != names_.size()) {
      throw MeasurementError(fmt::format("{}{} fields under {} names; mend the row", where(),
                                         fields.size(), names_.size()));
    }
    std::vector<double> row;
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const auto value = traces::parse_real(fields[k]);
      if (!value && !fields[k].empty()) {
        throw MeasurementError(fmt::format("{}{} = \"{}\" is no number; write it as 1.25 or 1e-3",
                                           where(), names_[k], fields[k]));
      }
      row.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    values_.push_back(std::move(row));
    lines_.push_back(number);
  }
  if (names_.empty()) {
    throw MeasurementError(file_ + ":1: nothing in it; begin with the names of the columns");
  }
}

ColumnTable ColumnTable::of_file(const std::string& path) {
  if (path == "-") return {std::cin, "standard input"};
  std::ifstream in(path);
  if (!in) throw MeasurementError(path + ":0: cannot be read; check the path");
  return {in, path};
}

std::optional<std::size_t> ColumnTable::find(const std::vector<std::string>& names) const {
  for (const std::string& name : names) {
    const auto at = std::find(names_.begin(), names_.end(), name);
    if (at != names_.end()) return static_cast<std::size_t>(at - names_.begin());
  }
  return {};
}

std::size_t ColumnTable::need(const std::vector<std::string>& names,
                              const std::string& what) const {
  if (const auto column = find(names)) return *column;
  throw MeasurementError(fmt::format("{}:1: no column of {}; name it {} (there is {})", file_, what,
                                     fmt::join(names, " or "), fmt::join(names_, ", ")));
}

void ColumnTable::fail(std::size_t row, const std::string& what, const std::string& mend) const {
  throw MeasurementError(fmt::format("{}:{}: {}; {}", file_, lines_[row], what, mend));
}

}  // namespace feltgate::host
