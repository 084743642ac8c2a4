// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Text tables: a line of column names, then rows with a time. Documentation: docs/traces.md
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "place.hpp"
#include "text.hpp"

namespace feltgate::traces {

/// Reads row by row. Commas, semicolons or tabs separate; lines that start with # or ; before the
/// names, and empty lines, are skipped; quotes round a field are dropped.
class Table {
 public:
  /// One unit of time() is a picosecond: 53 days fit.
  static constexpr TimeBase kTimeBase{1, 1'000'000'000'000};

  explicit Table(const std::filesystem::path& path);

  const std::vector<std::string>& columns() const { return columns_; }
  /// Index of the column of this name, with or without regard to case and unit; else
  /// columns().size().
  std::size_t find(const std::string& name) const;
  /// Index of the column of time: the named one, or the first of the usual names. A unit in its
  /// name counts (`[s]`, `(ms)`, `_us`, `_ns`), else seconds. Throws TraceError when there is none.
  std::size_t use_time(const std::string& name);

  /// The next row, its fields and time; false at the end. Throws TraceError when it is short or
  /// long, or when its time is no number or goes backwards.
  bool read();
  std::string_view field(std::size_t column) const { return fields_[column]; }
  /// Everything after the time, to see whether a row differs from the one before.
  std::string values() const;
  /// Picoseconds since the first row.
  std::int64_t time() const { return time_; }

  std::string where() const { return in_.where(); }
  /// The mend of a message about a column that is not there: the nearest name, and what there is.
  std::string columns_there(const std::string& name) const;
  [[noreturn]] void fail(const std::string& what, const std::string& mend) const;

 private:
  bool next_line();
  void split();
  void read_time();

  ByteReader in_;
  std::string line_;
  char separator_ = ',';
  std::vector<std::string> columns_;
  std::vector<std::string_view> fields_;
  std::size_t time_column_ = 0;
  int time_power_ = 12;
  bool any_ = false;
  int128_t origin_ = 0;
  std::int64_t time_ = 0;
};

}  // namespace feltgate::traces
