// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Text tables: a line of column names, then rows with a time. Documentation: docs/traces.md
#pragma once

#include <deque>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "options.hpp"
#include "place.hpp"
#include "text.hpp"

namespace feltgate::traces {

/// Reads row by row. Commas, semicolons, tabs or blanks separate; empty lines, and lines that start
/// with # or ; before the names, are passed over, but for what they say of rate and channels.
class Table {
 public:
  /// One unit of time() is a picosecond: 53 days fit.
  static constexpr TimeBase kTimeBase{1, 1'000'000'000'000};

  /// Of the options: time_column, time_unit, sample_hz and warn. Throws TraceError when there are
  /// no names, or when a row of units follows them.
  explicit Table(const std::filesystem::path& path, const Options& options = {});

  const std::vector<std::string>& columns() const { return columns_; }
  /// Index of the column of this name, with or without regard to case and unit; else
  /// columns().size().
  std::size_t find(const std::string& name) const;
  /// Index of the column of time: the named one, or the first of the usual names. Its unit is the
  /// one of the options, or in its name (`[s]`, `(ms)`, `_us`, `microseconds`), else seconds.
  /// columns().size() when there is none and a rate is known: each row is a sample. Throws
  /// TraceError when there is neither.
  std::size_t use_time();
  /// Rate of the samples: of the options, else of a line before the names; 0: unknown.
  std::int64_t sample_hz() const { return sample_hz_; }

  /// The next row, its fields and time; false at the end. Throws TraceError when it is short or
  /// long, or when its time is no number or goes backwards.
  bool read();
  std::string_view field(std::size_t column) const { return fields_[column]; }
  /// Everything after the time, to see whether a row differs from the one before.
  std::string values() const;
  /// Picoseconds since the first row.
  std::int64_t time() const { return time_; }

  std::string where() const { return where_; }
  /// The mend of a message about a column that is not there: the nearest name, and what there is.
  std::string columns_there(const std::string& name) const;
  [[noreturn]] void fail(const std::string& what, const std::string& mend) const;

 private:
  struct Line {
    std::string text, where;
  };
  bool next_line();
  void read_ahead();
  void note(std::string_view comment);
  void choose_separator();
  std::vector<std::string> names_before(const std::vector<std::string>& comments) const;
  void refuse_units();
  void split();
  int128_t stamp();
  void look_at_stamps() const;

  ByteReader in_;
  std::deque<Line> ahead_;  // the first rows, read to see how the table is written
  std::string line_, where_;
  char separator_ = ',';
  std::vector<std::string> columns_;
  std::vector<std::string_view> fields_;
  std::string time_name_, time_unit_;
  std::function<void(const std::string&)> warn_;
  std::int64_t sample_hz_ = 0, noted_hz_ = 0;
  bool sigrok_ = false;                // libsigrok wrote it
  std::vector<std::string> channels_;  // that a line before the names tells
  std::size_t time_column_ = 0;
  int time_power_ = 12;
  std::int64_t period_ = 0;  // stamps between two samples of libsigrok; 0: stamps are times
  std::int64_t rows_ = 0;
  int128_t origin_ = 0;
  std::int64_t time_ = 0;
};

}  // namespace feltgate::traces
