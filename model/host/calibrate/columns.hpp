// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Tables of numbers in named columns, from a file or typed in. Documentation: docs/calibration.md
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace feltgate::host {

/// A table of numbers, separated by commas, semicolons, tabs or blanks; # begins a comment; an
/// empty field is NaN.
class ColumnTable {
 public:
  /// Reads a header line and rows. Errors: MeasurementError "file:line: what; mend".
  ColumnTable(std::istream& in, std::string name);
  /// The same from a file; "-" is the standard input.
  static ColumnTable of_file(const std::string& path);

  std::size_t rows() const { return lines_.size(); }
  const std::vector<std::string>& names() const { return names_; }
  const std::string& file() const { return file_; }
  int line(std::size_t row) const { return lines_[row]; }
  /// The first of these names that exists; upper and lower case are equal.
  std::optional<std::size_t> find(const std::vector<std::string>& names) const;
  /// The same; throws if none exists, with `what` as its meaning.
  std::size_t need(const std::vector<std::string>& names, const std::string& what) const;
  double at(std::size_t row, std::size_t column) const { return values_[row][column]; }
  /// Throws a MeasurementError with the line of a row.
  [[noreturn]] void fail(std::size_t row, const std::string& what, const std::string& mend) const;

 private:
  std::string file_;
  std::vector<std::string> names_;
  std::vector<std::vector<double>> values_;
  std::vector<int> lines_;
};

}  // namespace feltgate::host
