// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Rows of a run as a CSV file. Documentation: docs/json.md
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "loop/columns.hpp"

namespace feltgate {

/// Rows that a file has at most, unless the user says which ticks are wanted.
constexpr std::int64_t most_rows = 100'000;

/// The smallest of 1, 2, 5, 10, 20, ... that leaves at most most_rows of so many ticks.
int sane_every(std::int64_t ticks);

/// Header and rows, one value per column.
class CsvWriter {
 public:
  CsvWriter(std::FILE* to, std::vector<Column> columns);
  void add(const Row& row);
  /// How large the file will be, one line for the user; `every` of `ticks` ticks has a row.
  std::string forecast(std::int64_t ticks, int every) const;

 private:
  std::FILE* to_;
  std::vector<Column> columns_;
};

}  // namespace feltgate
