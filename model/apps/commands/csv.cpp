// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes rows as CSV. Documentation: docs/json.md
#include "apps/commands/csv.hpp"

#include <fmt/format.h>

#include <iterator>

namespace feltgate {

namespace {

// Mean size of a value with its comma during motion; values at rest and round numbers are shorter.
constexpr double bytes_per_value = 15;

}  // namespace

int sane_every(std::int64_t ticks) {
  for (int decade = 1; decade < 1'000'000'000; decade *= 10) {
    for (const int every : {decade, 2 * decade, 5 * decade}) {
      if ((ticks + every - 1) / every <= most_rows) return every;
    }
  }
  return 1'000'000'000;
}

CsvWriter::CsvWriter(std::FILE* to, std::vector<Column> columns)
    : to_(to), columns_(std::move(columns)) {
  std::string header;
  for (const Column& c : columns_) header += (header.empty() ? "" : ",") + c.name;
  header += '\n';
  std::fwrite(header.data(), 1, header.size(), to_);
}

void CsvWriter::add(const Row& row) {
  fmt::memory_buffer line;
  const auto end = std::back_inserter(line);
  for (const Column& c : columns_) {
    if (line.size() > 0) line.push_back(',');
    const double value = c.value(row);
    if (c.digits > 0) {
      fmt::format_to(end, "{:.{}g}", value, c.digits);
    } else {
      fmt::format_to(end, "{}", value);
    }
  }
  line.push_back('\n');
  std::fwrite(line.data(), 1, line.size(), to_);
}

std::string CsvWriter::forecast(std::int64_t ticks, int every) const {
  const std::int64_t rows = (ticks + every - 1) / every;
  const double mb =
      1e-6 * bytes_per_value * static_cast<double>(rows) * static_cast<double>(columns_.size());
  return fmt::format("CSV: {} rows of {} columns, up to about {:.2g} MB{}", rows, columns_.size(),
                     mb,
                     every == 1 ? "" : fmt::format(" (--every {}; --every 1: all ticks)", every));
}

}  // namespace feltgate
