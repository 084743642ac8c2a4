// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// JSON as text; and columns of a report, each described once: JSON, the table for readers and CSV
// follow from the description. Documentation: docs/json.md
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace feltgate::files {

using Json = nlohmann::ordered_json;

/// The JSON, pretty-printed, with a final newline. In a text that is not UTF-8, such as a file name
/// in Latin-1, U+FFFD replaces each invalid byte.
inline std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// A figure of a row.
template <class Row>
struct Column {
  std::string key;                        ///< in JSON; "a/b": b in the object a; empty: not there
  std::function<Json(const Row&)> value;  ///< a member or a function; `absent`: left out
  /// Over the table's column, lines apart by "\n", after "<" flush left; empty: not in the table.
  std::string title = {};
  std::string format = "{}";  ///< of a number in the table
  double factor = 1;          ///< from the unit in JSON to that of the title
};
template <class Row>
using Columns = std::vector<Column<Row>>;

inline const Json absent = Json::value_t::discarded;
inline Json when(bool there, const Json& value) { return there ? value : absent; }

/// An array is its length; null and what is not finite are "-".
inline std::string cell(const Json& value, const std::string& format = "{}", double factor = 1) {
  if (value.is_discarded()) return "";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_array()) return fmt::format("{}", value.size());
  if (value.is_number_integer() && format == "{}") return value.dump();
  if (!value.is_number() || !std::isfinite(value.get<double>())) return "-";
  return fmt::format(fmt::runtime(format), factor * value.get<double>());
}

template <class Row>
Json object_of(const Columns<Row>& columns, const Row& row) {
  Json object = Json::object();
  for (const Column<Row>& c : columns) {
    const Json value = c.key.empty() ? absent : c.value(row);
    if (!value.is_discarded()) object[Json::json_pointer("/" + c.key)] = value;
  }
  return object;
}

template <class Row>
Json array_of(const Columns<Row>& columns, const std::vector<Row>& rows) {
  Json all = Json::array();
  for (const Row& row : rows) all.push_back(object_of(columns, row));
  return all;
}

using Cells = std::vector<std::string>;

/// Lines of cells, two blanks apart, each column as wide as its widest cell and flush right unless
/// `left` says otherwise.
inline std::string aligned(const std::vector<Cells>& lines, std::vector<bool> left = {true}) {
  std::vector<std::size_t> widths(lines[0].size());
  left.resize(widths.size());
  for (const Cells& line : lines) {
    for (std::size_t c = 0; c < line.size(); ++c) widths[c] = std::max(widths[c], line[c].size());
  }
  std::string text;
  for (const Cells& line : lines) {
    for (std::size_t c = 0; c < line.size(); ++c) {
      text += fmt::format(left[c] ? "{:<{}}  " : "{:>{}}  ", line[c], widths[c]);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += "\n";
  }
  return text;
}

/// The columns that have a title.
template <class Row>
std::string table(const Columns<Row>& columns, const std::vector<Row>& rows) {
  std::vector<Cells> lines(2 + rows.size());
  std::vector<bool> left;
  for (const Column<Row>& c : columns) {
    if (c.title.empty()) continue;
    left.push_back(c.title[0] == '<');
    const std::string title = c.title.substr(left.back() ? 1 : 0);
    const auto end = title.find('\n');
    lines[0].push_back(end == std::string::npos ? "" : title.substr(0, end));
    lines[1].push_back(title.substr(end + 1));
    for (std::size_t n = 0; n < rows.size(); ++n) {
      lines[2 + n].push_back(cell(c.value(rows[n]), c.format, c.factor));
    }
  }
  const std::string text = aligned(lines, left);
  return text[0] == '\n' ? text.substr(1) : text;  // no title has two lines
}

/// The columns that have a title as lines of a Markdown table, whose head is the first.
template <class Row>
std::string markdown(const Columns<Row>& columns, const std::vector<Row>& rows) {
  std::string text;
  for (const Column<Row>& c : columns) {
    if (c.title.empty()) continue;
    std::string rule = text.empty() ? "|---|" : "";
    text += "| " + c.title + " |";
    for (const Row& row : rows) {
      text += " " + cell(c.value(row), c.format, c.factor) + " |";
      if (!rule.empty()) rule += "---|";
    }
    text += "\n" + (rule.empty() ? "" : rule + "\n");
  }
  return text;
}

}  // namespace feltgate::files
