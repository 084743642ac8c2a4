// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The inputs of the core in a run, with the counts that an absolute encoder shows; writes them as a
// text for a page, and reads it. Documentation: docs/page.md
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "sim/loop/loop.hpp"

namespace feltgate::page {

/// From this clock on an absolute encoder shows this count, of all turns.
struct ShownCount {
  Clock clock = 0;
  std::int64_t count = 0;
};

struct Recording : RunInputs {
  Recording() = default;
  Recording(RunInputs inputs) : RunInputs(std::move(inputs)) {}  // NOLINT: without counts
  std::vector<ShownCount> counts;
};

/// Notes when the count of an absolute encoder changes; give it every step of the plant.
class CountRecorder {
 public:
  CountRecorder(int bits, Recording* recording) : bits_(bits), recording_(recording) {}
  /// The shaft has turned evenly to this angle in the next `clocks`.
  void turned(double to_rad, Clock clocks);

 private:
  int bits_;
  Recording* recording_;
  Clock now_ = 0;
  double at_rad_ = 0;
};

/// The text: a line "c CLOCKS LEVELS" with the levels at reset (1 A, 2 B, 4 Z), then a line
/// "w CLOCK ADDRESS DATA" per register write, and a line "e DELTA LEVELS" per pin change, DELTA
/// clocks after the previous change, or "a DELTA COUNTS" per change of the shown count, by so many.
std::string text_of(const Recording& inputs);
/// Reads such a text. Throws std::invalid_argument with the line.
Recording inputs_from_text(const std::string& text);

/// `value` as 16 hexadecimal digits.
std::string hex(std::uint64_t value);

}  // namespace feltgate::page
