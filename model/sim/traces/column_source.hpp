// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Plain columns: a time and a position in counts, or in another unit with a scale. Several counts
// between two rows are spread evenly over the interval. Documentation: docs/traces.md
#pragma once

#include <filesystem>

#include "feltgate/encoder_source.hpp"
#include "options.hpp"
#include "table.hpp"

namespace feltgate::traces {

/// Columns that are taken for the position when none is named.
bool has_count_column(const Table& table);

/// d counts between two rows take one slot each of d equal ones; an edge falls at the end of its
/// slot, or with jitter at a seeded uniform clock of it, so that at the time of a row the position
/// is always the row's. A value off the grid of counts is rounded to the nearest (half away from
/// 0).
class ColumnSource final : public EncoderSource {
 public:
  ColumnSource(const std::filesystem::path& path, const Options& options);

  EncoderPins initial() const override { return initial_; }
  std::optional<EncoderEvent> next() override;
  Clock length() const override { return row_clock_ + 1; }

 private:
  double read_value();
  std::int64_t count_of(double value);
  void take(double value);
  std::optional<double> period_in(double step) const;
  bool is_leap(double step) const;
  void warn_of_jump(double value, std::optional<double> period);
  bool advance();

  Table table_;
  ClockMap map_;
  bool jitter_;
  SplitMix64 random_;
  double scale_;
  std::optional<double> wrap_;   // 0: not yet known
  std::vector<double> periods_;  // after which such a column may begin again, in its units
  double turn_;                  // of the encoder in the column's units; 0: unknown
  std::function<void(const std::string&)> warn_;
  std::size_t column_ = 0;
  double value_ = 0;      // of the row read last
  double step_ = 0;       // from the row before it, without wraps
  bool stepped_ = false;  // there was one
  double largest_ = 0;    // of all steps
  double turns_ = 0;      // wraps so far
  EncoderPins initial_;
  std::int64_t count_ = 0;  // of the row read last
  std::int64_t steps_ = 0;  // edges of the present interval, and how many of them are given
  std::int64_t given_ = 0;
  bool up_ = true;
  unsigned phase_ = 0;
  Clock from_ = 0;
  Clock row_clock_ = 0;
};

}  // namespace feltgate::traces
