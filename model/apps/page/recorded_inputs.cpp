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
    out += fmt::format("e {} {}\n", e.clock - before, levels(e.pins));
    before = e.clock;
  }
  return out;
}

RunInputs inputs_from_text(const std::string& text) {
  RunInputs inputs;
  std::istringstream words(text);
  Clock now = 0;
  for (char kind = 0; words >> kind;) {
    std::int64_t first = -1, second = 0;
    std::uint32_t data = 0;
    words >> first >> second;
    if (kind == 'w') words >> data;
    if (!words || first < 0 || std::string("cwe").find(kind) == std::string::npos)
      throw std::invalid_argument("the recorded inputs cannot be read");
    if (kind == 'c') {
      inputs.clocks = first;
      inputs.pins = pins_of(static_cast<int>(second));
    } else if (kind == 'w') {
      inputs.writes.push_back({first, static_cast<int>(second), data, 0});
    } else {
      inputs.edges.push_back({now += first, pins_of(static_cast<int>(second))});
    }
  }
  return inputs;
}

std::string hex(std::uint64_t value) { return fmt::format("{:016x}", value); }

}  // namespace feltgate::page
