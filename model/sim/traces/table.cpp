// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Text tables: names, rows and times. Documentation: docs/traces.md
#include "sim/traces/table.hpp"

#include <fmt/format.h>

#include "feltgate/nearest.hpp"
#include "sim/traces/error.hpp"

namespace feltgate::traces {
namespace {

/// A column's name in small letters without its unit, and the power of ten of the unit in ps.
struct Heading {
  std::string name;
  int power = 12;
};

Heading heading(const std::string& column) {
  static constexpr struct {
    const char* unit;
    int power;
  } kUnits[] = {{"s", 12}, {"ms", 9}, {"us", 6}, {"ns", 3}};
  const std::string low = lower(column);
  for (const auto& [unit, power] : kUnits) {
    for (const std::string& end :
         {std::string("[") + unit + "]", std::string("(") + unit + ")", std::string("_") + unit}) {
      if (low.size() > end.size() && low.compare(low.size() - end.size(), end.size(), end) == 0) {
        return {std::string(trim(low.substr(0, low.size() - end.size()))), power};
      }
    }
  }
  return {low, 12};
}

}  // namespace

Table::Table(const std::filesystem::path& path) : in_(path) {
  do {
    if (!next_line()) fail("the table has no line of column names", "give a first line of names");
  } while (line_.front() == '#' || line_.front() == ';');
  if (line_.compare(0, 3, "\xEF\xBB\xBF") == 0) line_.erase(0, 3);
  for (const char separator : {';', '\t', ','}) {
    if (line_.find(separator) != std::string::npos) separator_ = separator;
  }
  split();
  bool numbers = true;
  for (const std::string_view field : fields_) {
    columns_.emplace_back(field);
    numbers = numbers && parse_real(field).has_value();
  }
  if (numbers) fail("the first line holds numbers", "put the column names before them");
}

bool Table::next_line() {
  do {
    if (!in_.line(line_)) return false;
  } while (trim(line_).empty());
  return true;
}

void Table::split() {
  fields_.clear();
  std::string_view rest = line_;
  for (;;) {
    const std::size_t at = rest.find(separator_);
    std::string_view field = trim(rest.substr(0, at));
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
      field = trim(field.substr(1, field.size() - 2));
    }
    fields_.push_back(field);
    if (at == std::string_view::npos) break;
    rest = rest.substr(at + 1);
  }
  // A separator at the end of the line starts no field.
  if (fields_.size() > 1 && fields_.back().empty()) fields_.pop_back();
}

std::size_t Table::find(const std::string& name) const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i] == name) return i;
  }
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (lower(columns_[i]) == lower(name) || heading(columns_[i]).name == lower(name)) return i;
  }
  return columns_.size();
}

std::size_t Table::use_time(const std::string& name) {
  time_column_ = columns_.size();
  if (!name.empty()) {
    time_column_ = find(name);
  } else {
    for (const char* usual : {"time", "t", "timestamp"}) {
      if (time_column_ == columns_.size()) time_column_ = find(usual);
    }
  }
  if (time_column_ == columns_.size()) {
    fail(name.empty() ? "no column of time" : "no column " + shown(name), columns_there(name));
  }
  time_power_ = heading(columns_[time_column_]).power;
  return time_column_;
}

bool Table::read() {
  if (!next_line()) return false;
  split();
  if (fields_.size() != columns_.size()) {
    fail(fmt::format("the row has {} of {} fields", fields_.size(), columns_.size()),
         "the file is truncated or damaged; fetch it again");
  }
  read_time();
  return true;
}

void Table::read_time() {
  constexpr int128_t kMost = int128_t{1} << 62U;
  const std::string_view text = fields_[time_column_];
  const std::optional<int128_t> t = parse_decimal(text, time_power_);
  if (!t) fail("time " + shown(text) + " is not a finite number", "give a number");
  if (!any_) origin_ = *t;
  any_ = true;
  const int128_t since = *t - origin_;
  if (since > kMost) fail("time " + shown(text) + " is over 53 days in", "cut the recording");
  if (since < time_) {
    fail("time goes backwards to " + shown(text), "sort the recording or cut it");
  }
  time_ = static_cast<std::int64_t>(since);
}

std::string Table::values() const {
  std::string text;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (i != time_column_) text.append(fields_[i]).append(1, separator_);
  }
  return text;
}

void Table::fail(const std::string& what, const std::string& mend) const { in_.fail(what, mend); }

std::string Table::columns_there(const std::string& name) const {
  return fmt::format("{}name it; there are: {}", config::did_you_mean(name, columns_),
                     list_names(columns_));
}

}  // namespace feltgate::traces
