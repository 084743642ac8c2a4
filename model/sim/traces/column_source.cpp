// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Plain columns of time and position as encoder edges. Documentation: docs/traces.md
#include "sim/traces/column_source.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sim/traces/error.hpp"
#include "sim/traces/phase.hpp"

namespace feltgate::traces {
namespace {

constexpr const char* kUsual[] = {"count", "counts", "position"};

std::size_t count_column(const Table& table, const std::string& name) {
  std::size_t column = table.columns().size();
  if (!name.empty()) {
    column = table.find(name);
  } else {
    for (const char* usual : kUsual) {
      if (column == table.columns().size()) column = table.find(usual);
    }
  }
  if (column == table.columns().size()) {
    table.fail(name.empty() ? "no column of counts" : "no column " + shown(name),
               table.columns_there(name));
  }
  return column;
}

// An angle without a scale would round to no motion at all.
bool looks_like_angle(const std::string& column) {
  const std::string low = lower(column);
  return low.find("theta") != std::string::npos || low.find("angle") != std::string::npos ||
         low.find("rad") != std::string::npos || low.find("deg") != std::string::npos;
}

}  // namespace

bool has_count_column(const Table& table) {
  for (const char* usual : kUsual) {
    if (table.find(usual) != table.columns().size()) return true;
  }
  return false;
}

ColumnSource::ColumnSource(const std::filesystem::path& path, const Options& options)
    : table_(path),
      map_(Table::kTimeBase, options.clock_hz),
      jitter_(options.jitter),
      random_(options.seed),
      scale_(options.scale.value_or(1.0)) {
  table_.use_time(options.time_column);
  column_ = count_column(table_, options.count_column);
  if (!options.scale && looks_like_angle(table_.columns()[column_])) {
    table_.fail("column " + shown(table_.columns()[column_]) + " looks like an angle",
                "give the scale in counts per unit, such as 2048/2pi");
  }
  if (!table_.read()) table_.fail("the table has no rows", "record something");
  count_ = read_count();
  phase_ = static_cast<unsigned>(count_ & 3);
  initial_ = pins_at(phase_);
}

std::int64_t ColumnSource::read_count() {
  constexpr double kMost = 9007199254740992.0;  // 2^53: doubles hold every integer up to here
  const std::string_view text = table_.field(column_);
  const std::optional<double> value = parse_real(text);
  if (!value) table_.fail("position " + shown(text) + " is not a finite number", "give a number");
  const double count = *value * scale_;
  if (!(std::fabs(count) < kMost)) {
    table_.fail("position " + shown(text) + " is over 2^53 counts", "check the scale");
  }
  return static_cast<std::int64_t>(std::llround(count));
}

bool ColumnSource::advance() {
  if (!table_.read()) return false;
  const std::int64_t count = read_count();
  const std::optional<Clock> clock = map_.at(table_.time());
  if (!clock) table_.fail("the recording is over 2^62 clocks long", "cut the recording");
  up_ = count > count_;
  steps_ = up_ ? count - count_ : count_ - count;
  if (steps_ > *clock - row_clock_) {
    table_.fail(fmt::format("{} counts in {} clocks: more than one state per clock", steps_,
                            *clock - row_clock_),
                "check scale and time unit, or raise the clock");
  }
  count_ = count;
  given_ = 0;
  from_ = row_clock_;
  row_clock_ = *clock;
  return true;
}

std::optional<EncoderEvent> ColumnSource::next() {
  while (given_ == steps_) {
    if (!advance()) return std::nullopt;
  }
  const auto slot_end = [&](std::int64_t slots) {
    const int128_t span = row_clock_ - from_;
    return from_ + static_cast<Clock>(span * slots / steps_);
  };
  const Clock before = slot_end(given_);
  Clock clock = slot_end(++given_);
  if (jitter_) clock = before + 1 + random_.below(clock - before);
  phase_ += up_ ? 1U : 3U;
  return EncoderEvent{clock, pins_at(phase_)};
}

}  // namespace feltgate::traces
