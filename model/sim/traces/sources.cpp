// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Columns of positions and tables of levels as encoder edges. Documentation: docs/traces.md
#include "sim/traces/sources.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "sim/traces/options.hpp"
#include "sim/traces/text.hpp"

namespace feltgate::traces {
namespace {

constexpr std::size_t kLevelRowsAhead = 64;

}  // namespace

LevelTable::LevelTable(const std::filesystem::path& path, const Options& options)
    : table_(path, options) {
  const std::size_t time = table_.use_time();
  for (std::size_t i = 0; i < table_.columns().size(); ++i) {
    if (i == time) continue;
    names_.push_back(table_.columns()[i]);
    columns_.push_back(i);
  }
}

std::optional<LevelTable::Row> LevelTable::read() {
  if (!table_.read()) return std::nullopt;
  Row row{table_.time(), 0};
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    const std::string_view text = table_.field(chosen_[i]);
    bool high = text == "1";
    if (text.empty()) {
      table_.fail("no level of " + shown(table_.columns()[chosen_[i]]),
                  "fill the cell, or remove the row");
    }
    if (!high && text != "0") {
      const std::optional<double> value = parse_real(text);
      high = value && *value == 1.0;
      if (!high && !(value && *value == 0.0)) {
        table_.fail("level " + shown(text) + " of " + shown(table_.columns()[chosen_[i]]) +
                        " is not 0 or 1",
                    "give levels, or name a count column");
      }
    }
    if (high) row.levels |= 1U << i;
  }
  return row;
}

// A row that repeats all values of the row before was written by a sampler, not by an edge.
void LevelTable::find_width() {
  std::string before;
  bool repeats = false;
  std::int64_t smallest = 0;
  while (ahead_.size() < kLevelRowsAhead) {
    const std::optional<Row> row = read();
    if (!row) break;
    const std::string values = table_.values();
    if (!ahead_.empty()) {
      const std::int64_t gap = row->time - ahead_.back().time;
      if (gap > 0 && (smallest == 0 || gap < smallest)) smallest = gap;
      repeats = repeats || values == before;
    }
    before = values;
    ahead_.push_back(*row);
  }
  if (table_.sample_hz() > 0) {
    width_ = Table::kTimeBase.den / table_.sample_hz();
  } else if (repeats) {
    width_ = smallest;
  }
}

std::uint32_t LevelTable::start(const std::vector<std::size_t>& chosen) {
  for (const std::size_t channel : chosen) chosen_.push_back(columns_.at(channel));
  find_width();
  if (ahead_.empty()) table_.fail("the table has no rows", "record something");
  levels_ = ahead_.front().levels;
  ahead_.pop_front();
  return levels_;
}

std::optional<Change> LevelTable::next() {
  for (;;) {
    std::optional<Row> row;
    if (ahead_.empty()) {
      row = read();
    } else {
      row = ahead_.front();
      ahead_.pop_front();
    }
    if (!row) return std::nullopt;
    if (row->levels == levels_) continue;
    levels_ = row->levels;
    return Change{row->time, row->time + width_, levels_};
  }
}

// A capture of logic levels as encoder pins.

namespace {

std::vector<std::string> wanted(const Capture& capture, const Options& options) {
  if (!options.step.empty() || !options.dir.empty()) {
    if (options.step.empty() || options.dir.empty() || !options.probes.empty()) {
      fail(capture.where(), "STEP and DIR go together, and not with probes",
           "give STEP and DIR, or the probes");
    }
    return {options.step, options.dir};
  }
  if (options.probes.empty()) return guess_probes(capture.channels(), capture.where());
  if (options.probes.size() != 2 && options.probes.size() != 3) {
    fail(capture.where(), fmt::format("the number of probes is {}", options.probes.size()),
         "give A,B or A,B,Z");
  }
  return options.probes;
}

std::uint32_t started(Capture& capture, const Options& options) {
  std::vector<std::size_t> chosen;
  for (const std::string& name : wanted(capture, options)) {
    chosen.push_back(find_channel(capture.channels(), name, capture.where()));
    for (std::size_t i = 0; i + 1 < chosen.size(); ++i) {
      if (chosen[i] == chosen.back()) {
        fail(capture.where(), "probe " + shown(name) + " is named twice", "give each signal once");
      }
    }
  }
  return capture.start(chosen);
}

EncoderPins pins_from(std::uint32_t levels) {
  return {(levels & 1U) != 0, (levels & 2U) != 0, (levels & 4U) != 0};
}

}  // namespace

LevelSource::LevelSource(std::unique_ptr<Capture> capture, const Options& options)
    : capture_(std::move(capture)),
      placer_(ClockMap(capture_->time_base(), options.clock_hz), options.jitter, options.seed),
      step_dir_(!options.step.empty() || !options.dir.empty()) {
  const std::uint32_t levels = started(*capture_, options);
  step_ = (levels & 1U) != 0;
  if (!step_dir_) initial_ = pins_from(levels);
}

std::optional<EncoderPins> LevelSource::pins_of(std::uint32_t levels) {
  if (!step_dir_) return pins_from(levels);
  const bool before = std::exchange(step_, (levels & 1U) != 0);
  if (before || !step_) return std::nullopt;
  phase_ += (levels & 2U) != 0 ? 1U : 3U;
  return pins_at(phase_);
}

Clock LevelSource::placed(std::optional<Clock> clock) const {
  if (clock) return *clock;
  fail(capture_->where(), "changes come faster than one per clock, or the recording is too long",
       "raise the clock or cut the recording");
}

std::optional<EncoderEvent> LevelSource::next() {
  while (const std::optional<Change> change = capture_->next()) {
    const std::optional<EncoderPins> pins = pins_of(change->levels);
    if (!pins) continue;
    return EncoderEvent{placed(placer_.edge(change->begin, change->end)), *pins};
  }
  length_ = placed(placer_.length(capture_->end()));
  return std::nullopt;
}

// Plain columns of time and position as encoder edges.

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
