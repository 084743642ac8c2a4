// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes the rows of a run as a CSV file. Documentation: docs/json.md
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "sim/loop/columns.hpp"

namespace feltgate {

/// Default limit of the rows in a file; the user may choose the ticks instead.
constexpr std::int64_t most_rows = 100'000;

/// The smallest step of 1, 2, 5, 10, 20, ... that selects at most most_rows of `ticks` ticks.
int sane_every(std::int64_t ticks);

/// Header and rows, one value per column.
class CsvWriter {
 public:
  CsvWriter(std::FILE* to, std::vector<Column> columns);
  void add(const Row& row);
  /// The expected file size as one line for the user; every `every`-th of `ticks` ticks has a row.
  std::string forecast(std::int64_t ticks, int every) const;

 private:
  std::FILE* to_;
  std::vector<Column> columns_;
};

}  // namespace feltgate
