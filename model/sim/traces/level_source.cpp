// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A capture of logic levels as encoder pins. Documentation: docs/traces.md
#include "sim/traces/level_source.hpp"

#include <fmt/format.h>

#include <utility>

#include "sim/traces/error.hpp"
#include "sim/traces/phase.hpp"

namespace feltgate::traces {
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
