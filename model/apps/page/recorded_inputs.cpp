// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Recorded inputs as text. Documentation: docs/page.md
#include "apps/page/recorded_inputs.hpp"

#include <fmt/format.h>

#include <sstream>
#include <stdexcept>

#include "sim/backends/absolute_sensor.hpp"

namespace feltgate::page {

namespace {

int levels(EncoderPins p) { return (p.a ? 1 : 0) | (p.b ? 2 : 0) | (p.z ? 4 : 0); }
EncoderPins pins_of(int levels) {
  return {(levels & 1) != 0, (levels & 2) != 0, (levels & 4) != 0};
}

}  // namespace

void CountRecorder::turned(double to_rad, Clock clocks) {
  const double slope = (to_rad - at_rad_) / static_cast<double>(clocks);
  const auto count = [&](Clock after) {
    return AbsoluteSensor::count_of(at_rad_ + slope * static_cast<double>(after), bits_);
  };
  auto& counts = recording_->counts;
  std::int64_t shown = counts.empty() ? 0 : counts.back().count;
  for (Clock from = 0; count(clocks - 1) != shown;) {
    Clock first = from, last = clocks - 1;  // the first clock that shows another count
    while (first < last) {
      const Clock middle = first + (last - first) / 2;
      if (count(middle) != shown) {
        last = middle;
      } else {
        first = middle + 1;
      }
    }
    shown = count(first);
    counts.push_back({now_ + first, shown});
    from = first;
  }
  now_ += clocks;
  at_rad_ = to_rad;
}

std::string text_of(const Recording& inputs) {
  std::string out = fmt::format("c {} {}\n", inputs.clocks, levels(inputs.pins));
  for (const HostWrite& w : inputs.writes) {
    out += fmt::format("w {} {} {}\n", w.clock, w.address, w.data);
  }
  Clock before = 0;
  for (const EncoderEvent& e : inputs.edges) {
    out += fmt::format("e {} {}\n", e.clock - before, levels(e.pins));
    before = e.clock;
  }
  ShownCount shown;
  for (const ShownCount& c : inputs.counts) {
    out += fmt::format("a {} {}\n", c.clock - shown.clock, c.count - shown.count);
    shown = c;
  }
  return out;
}

Recording inputs_from_text(const std::string& text) {
  Recording inputs;
  ShownCount shown;
  std::istringstream lines(text);
  std::string line;
  Clock now = 0;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    char kind = 0;
    std::int64_t first = -1, second = 0;
    std::uint32_t data = 0;
    words >> kind >> first >> second;
    if (kind == 'w') words >> data;
    if (!words || first < 0 || std::string("cwea").find(kind) == std::string::npos) {
      throw std::invalid_argument(
          fmt::format("line {} of the recorded inputs cannot be read: \"{}\"", number, line));
    }
    if (kind == 'c') {
      inputs.clocks = first;
      inputs.pins = pins_of(static_cast<int>(second));
    } else if (kind == 'w') {
      inputs.writes.push_back({first, static_cast<int>(second), data, 0});
    } else if (kind == 'e') {
      inputs.edges.push_back({now += first, pins_of(static_cast<int>(second))});
    } else {
      inputs.counts.push_back(shown = {shown.clock + first, shown.count + second});
    }
  }
  return inputs;
}

std::string hex(std::uint64_t value) { return fmt::format("{:016x}", value); }

}  // namespace feltgate::page
