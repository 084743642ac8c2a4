// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Plain columns of time and position as encoder edges. Documentation: docs/traces.md
#include "sim/traces/column_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/traces/error.hpp"
#include "sim/traces/options.hpp"

namespace feltgate::traces {
namespace {

constexpr double kTurnRad = 6.28318530717958647692;

constexpr const char* kUsual[] = {"count", "counts",  "position", "pos",
                                  "ticks", "encoder", "angle",    "theta"};

/// The column of this name, with or without a unit of angle behind it.
std::size_t find_usual(const Table& table, const std::string& usual) {
  std::size_t column = table.find(usual);
  for (const char* unit : {"_deg", "_rad", "_counts", " [deg]", " (deg)", "[deg]", "(deg)",
                           " [rad]", " (rad)", "[rad]", "(rad)"}) {
    if (column == table.columns().size()) column = table.find(usual + unit);
  }
  return column;
}

std::size_t count_column(const Table& table, const std::string& name) {
  std::size_t column = table.columns().size();
  if (!name.empty()) {
    column = table.find(name);
  } else {
    for (const char* usual : kUsual) {
      if (column == table.columns().size()) column = find_usual(table, usual);
    }
  }
  if (column == table.columns().size()) {
    table.fail(name.empty() ? "no column of counts" : "no column " + shown(name),
               table.columns_there(name));
  }
  return column;
}

/// What a column's name says of its unit.
enum class Unit { unknown, angle, degrees, radians };

Unit unit_of(const std::string& column) {
  const std::string low = lower(column);
  const auto has = [&](const char* word) { return low.find(word) != std::string::npos; };
  if (has("deg")) return Unit::degrees;
  if (has("rad")) return Unit::radians;
  return has("theta") || has("angle") ? Unit::angle : Unit::unknown;
}

/// The periods after which a column may begin again: a turn of an angle, or the range of a counter
/// of 16 or 32 bits. Where only the scale can tell the unit of an angle, the turn is the one of a
/// whole number of counts.
std::vector<double> periods_of(Unit unit, std::optional<double> scale) {
  if (unit == Unit::degrees) return {360.0};
  if (unit == Unit::radians) return {kTurnRad};
  std::vector<double> periods;
  const auto whole = [](double v) { return std::fabs(v - std::round(v)) < 1e-6; };
  for (const double turn : {360.0, kTurnRad}) {
    if (scale && !whole(*scale) && whole(turn * *scale)) periods.push_back(turn);
  }
  if (periods.empty()) periods = {65536.0, 4294967296.0};
  return periods;
}

}  // namespace

bool has_count_column(const Table& table) {
  for (const char* usual : kUsual) {
    if (find_usual(table, usual) != table.columns().size()) return true;
  }
  return false;
}

ColumnSource::ColumnSource(const std::filesystem::path& path, const Options& options)
    : table_(path, options),
      map_(Table::kTimeBase, options.clock_hz),
      jitter_(options.jitter),
      random_(options.seed),
      scale_(options.scale.value_or(1.0)),
      wrap_(options.wrap),
      turn_(options.turn_counts / std::fabs(scale_)),
      warn_(options.warn) {
  table_.use_time();
  column_ = count_column(table_, options.count_column);
  const std::string& name = table_.columns()[column_];
  const Unit unit = unit_of(name);
  // An angle without a scale would round to no motion at all.
  if (!options.scale && unit != Unit::unknown) {
    table_.fail("column " + shown(name) + " looks like an angle",
                std::string("give the scale in counts per unit, such as ") +
                    (unit == Unit::degrees ? "4096/360" : "2048/2pi"));
  }
  periods_ = periods_of(unit, options.scale);
  if (!table_.read()) table_.fail("the table has no rows", "record something");
  value_ = read_value();
  count_ = count_of(value_);
  phase_ = static_cast<unsigned>(count_ & 3);
  initial_ = pins_at(phase_);
}

double ColumnSource::read_value() {
  const std::string_view text = table_.field(column_);
  if (text.empty()) {
    table_.fail("no value of " + shown(table_.columns()[column_]),
                "fill the cell, or remove the row");
  }
  const std::optional<double> value = parse_real(text);
  if (!value) table_.fail("position " + shown(text) + " is not a finite number", "give a number");
  return *value;
}

std::int64_t ColumnSource::count_of(double value) {
  constexpr double kMost = 9007199254740992.0;  // 2^53: doubles hold every integer up to here
  if (wrap_ && *wrap_ > 0) value += turns_ * *wrap_;
  const double count = value * scale_;
  if (!(std::fabs(count) < kMost)) {
    table_.fail("position " + shown(table_.field(column_)) + " is over 2^53 counts",
                "check the scale");
  }
  return static_cast<std::int64_t>(std::llround(count));
}

/// The period that makes this step one like the step before, and much more so than it is without;
/// nothing where there is none. Without a step before, the step is to be nearly the period.
std::optional<double> ColumnSource::period_in(double step) const {
  const auto fits = [&](double period) {
    const double shorter = step - std::copysign(period, step);
    if (!stepped_) return std::fabs(shorter) <= period / 8;
    const double change = std::fabs(shorter - step_);
    return change <= 2 * std::fabs(step_) + period / 512 && 2 * change < std::fabs(step - step_);
  };
  for (const double period : periods_) {
    if (fits(period)) return period;
  }
  if (turn_ > 0 && fits(turn_)) return turn_;
  return std::nullopt;
}

/// Takes the next value. A step of more than half a wrap becomes the shorter way round.
void ColumnSource::take(double value) {
  double step = value - value_;
  const auto shorten = [&] {
    const double wraps = std::round(step / *wrap_);
    turns_ -= wraps;
    step -= wraps * *wrap_;
  };
  if (wrap_ && *wrap_ > 0) shorten();
  const std::optional<double> period = period_in(step);
  const bool known = period && std::count(periods_.begin(), periods_.end(), *period) > 0;
  if (known && wrap_ && *wrap_ == 0) {
    wrap_ = period;
    shorten();
  } else if (period || is_leap(step)) {
    warn_of_jump(value, period);
  }
  value_ = value;
  step_ = step;
  stepped_ = true;
  largest_ = std::max(largest_, std::fabs(step));
}

/// Whether a step of about a turn or more stands out from all before it.
bool ColumnSource::is_leap(double step) const {
  const double turn = turn_ > 0 ? turn_ : periods_.front();
  return stepped_ && std::fabs(step) > 0.75 * turn && std::fabs(step) > 8 * largest_;
}

void ColumnSource::warn_of_jump(double value, std::optional<double> period) {
  if (!warn_) return;
  const std::string jump =
      fmt::format("{}: {} goes from {:.6g} to {:.6g} in one row", table_.where(),
                  shown(table_.columns()[column_]), value_, value);
  if (!period) {
    warn_(jump + "; if it begins again after some number, give this: --wrap NUMBER");
  } else {
    const bool counter = *period == 65536.0 || *period == 4294967296.0;
    const std::string number = *period == kTurnRad ? "2pi" : fmt::format("{:.10g}", *period);
    warn_(fmt::format("{}, about {}; if it begins again after {}, give --wrap {}", jump,
                      !counter             ? "a turn"
                      : *period == 65536.0 ? "2^16"
                                           : "2^32",
                      number, number));
  }
  warn_ = nullptr;
}

bool ColumnSource::advance() {
  if (!table_.read()) return false;
  take(read_value());
  const std::int64_t count = count_of(value_);
  const std::optional<Clock> clock = map_.at(table_.time());
  if (!clock) table_.fail("the recording is over 2^62 clocks long", "cut the recording");
  up_ = count > count_;
  steps_ = up_ ? count - count_ : count_ - count;
  if (steps_ > *clock - row_clock_) {
    table_.fail(fmt::format("{} counts in {} clocks: more than one state per clock", steps_,
                            *clock - row_clock_),
                "check scale, wrap and time unit, or raise the clock");
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
