// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The events of a law as FUDI, for Pure Data. Documentation: docs/devices/strings-and-drums.md
#include "sim/loop/loop.hpp"

#include <fmt/format.h>

namespace feltgate {

namespace {

/// The digits at the end of a name; may be empty.
std::string number_of(const std::string& name) {
  const auto last = name.find_last_not_of("0123456789");
  return last == std::string::npos ? "" : name.substr(last + 1);
}

}  // namespace

std::string event_lines(const std::vector<RunEvent>& events, double run_s) {
  std::string text;
  double before_s = 0;
  for (std::size_t i = 0; i < events.size();) {
    const RunEvent& first = events[i];
    const std::string number = number_of(first.name);
    text += fmt::format("{:.3f} {}", 1e3 * (first.at_s - before_s),
                        first.name.substr(0, first.name.size() - number.size()));
    if (!number.empty()) text += " " + number;
    before_s = first.at_s;
    for (std::size_t k = i; i < events.size(); ++i) {
      const RunEvent& e = events[i];
      const bool together =
          i == k || (e.at_s - first.at_s < run_s && !number.empty() && number_of(e.name) == number);
      if (!together) break;
      text += fmt::format(" {:.6g}", e.value);
    }
    text += ";\n";
  }
  return text;
}

}  // namespace feltgate
