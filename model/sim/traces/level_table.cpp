// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Tables of levels: rows that are samples, and rows that are changes. Documentation: docs/traces.md
#include "sim/traces/level_table.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "sim/traces/error.hpp"
#include "sim/traces/options.hpp"

namespace feltgate::traces {
namespace {

constexpr std::size_t kRowsAhead = 64;

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
  while (ahead_.size() < kRowsAhead) {
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

}  // namespace feltgate::traces
