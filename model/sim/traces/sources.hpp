// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What an encoder did, from plain columns and from tables of levels: `time,A,B[,Z]` (a row per
// sample or per change) and Saleae Logic exports. Documentation: docs/traces.md
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <string>

#include "capture.hpp"
#include "feltgate/encoder_source.hpp"
#include "options.hpp"
#include "table.hpp"

namespace feltgate::traces {

/// Every column but the time is a channel; only the chosen ones must hold 0 or 1.
class LevelTable final : public Capture {
 public:
  LevelTable(const std::filesystem::path& path, const Options& options);

  const std::vector<std::string>& channels() const override { return names_; }
  TimeBase time_base() const override { return Table::kTimeBase; }
  std::uint32_t start(const std::vector<std::size_t>& chosen) override;
  std::optional<Change> next() override;
  std::int64_t end() const override { return table_.time() + width_; }
  std::string where() const override { return table_.where(); }

 private:
  struct Row {
    std::int64_t time = 0;
    std::uint32_t levels = 0;
  };
  std::optional<Row> read();
  void find_width();

  Table table_;
  std::vector<std::string> names_;
  std::vector<std::size_t> columns_;  // column of each channel
  std::vector<std::size_t> chosen_;
  std::deque<Row> ahead_;   // the first rows, read to see whether rows are samples or changes
  std::int64_t width_ = 0;  // of a sample, in ps; 0: rows are changes at exact times
  std::uint32_t levels_ = 0;
};

// A capture of logic levels as encoder pins: A, B and Z as they are, or STEP and DIR turned into
// quadrature.

/// With Options::step and dir a rising STEP is one count, up where DIR is high in the same sample;
/// the pins start low. Otherwise the probes are the pins.
class LevelSource final : public EncoderSource {
 public:
  LevelSource(std::unique_ptr<Capture> capture, const Options& options);

  EncoderPins initial() const override { return initial_; }
  std::optional<EncoderEvent> next() override;
  Clock length() const override { return length_; }

 private:
  std::optional<EncoderPins> pins_of(std::uint32_t levels);
  Clock placed(std::optional<Clock> clock) const;

  std::unique_ptr<Capture> capture_;
  Placer placer_;
  bool step_dir_;
  bool step_ = false;
  unsigned phase_ = 0;
  EncoderPins initial_;
  Clock length_ = 0;
};

// Plain columns: a time and a position in counts, or in another unit with a scale. Several counts
// between two rows are spread evenly over the interval.

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
