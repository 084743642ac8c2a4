// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Recorded inputs as text. Documentation: docs/page.md
#include "apps/page/recorded_inputs.hpp"

#include <fmt/format.h>

#include <sstream>
#include <stdexcept>

namespace feltgate::page {

namespace {

int levels(EncoderPins p) { return (p.a ? 1 : 0) | (p.b ? 2 : 0) | (p.z ? 4 : 0); }
EncoderPins pins_of(int levels) {
  return {(levels & 1) != 0, (levels & 2) != 0, (levels & 4) != 0};
}

}  // namespace

std::string text_of(const RunInputs& inputs) {
  std::string out = fmt::format("c {} {}\n", inputs.clocks, levels(inputs.pins));
  for (const HostWrite& w : inputs.writes) {
    out += fmt::format("w {} {} {}\n", w.clock, w.address, w.data);
  }
  Clock before = 0;
  for (const EncoderEvent& e : inputs.edges) {
    out += fmt::format("{} {}\n", e.clock - before, levels(e.pins));
    before = e.clock;
  }
  return out;
}

RunInputs inputs_from_text(const std::string& text) {
  RunInputs inputs;
  std::istringstream lines(text);
  std::string line;
  Clock now = 0;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    bool read = false;
    if (line[0] == 'c') {
      char c = 0;
      int first = 0;
      read = static_cast<bool>(words >> c >> inputs.clocks >> first);
      inputs.pins = pins_of(first);
    } else if (line[0] == 'w') {
      char c = 0;
      HostWrite w;
      read = static_cast<bool>(words >> c >> w.clock >> w.address >> w.data);
      inputs.writes.push_back(w);
    } else {
      Clock delta = 0;
      int next = 0;
      read = static_cast<bool>(words >> delta >> next) && delta >= 0;
      now += delta;
      inputs.edges.push_back({now, pins_of(next)});
    }
    if (!read) {
      throw std::invalid_argument(
          fmt::format("line {} of the recorded inputs cannot be read: \"{}\"", number, line));
    }
  }
  return inputs;
}

std::string hex(std::uint64_t value) { return fmt::format("{:016x}", value); }

}  // namespace feltgate::page
