// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// All inputs that decide what a simulated board does: how it was started, and each byte that it
// received, with its clock. Documentation: docs/host.md
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "feltgate/encoder_source.hpp"

namespace feltgate::board {

/// How a board was started.
struct Setup {
  std::string design = "lever", plant, hand = "free", scene = "free";  ///< plant: default_plant()
  bool arm = false;                                                    ///< the panel's switch
  std::int64_t baud = 1'000'000;
  double bad_line = 0;     ///< share of bytes that the line damages, in each direction
  std::uint64_t seed = 1;  ///< seed of the damage
};

/// Bytes that arrived at the same time.
struct Arrival {
  Clock clock = 0;
  std::vector<std::uint8_t> bytes;
};

/// Results: two runs with equal sums had the same ticks and sent the same bytes.
struct Outcome {
  Clock clocks = 0;
  std::int64_t ticks = 0;
  std::uint64_t tick_sum = 0;
  std::int64_t bytes = 0;
  std::uint64_t byte_sum = 0;
  bool operator==(const Outcome& o) const {
    return clocks == o.clocks && ticks == o.ticks && tick_sum == o.tick_sum && bytes == o.bytes &&
           byte_sum == o.byte_sum;
  }
};

/// A whole recording: start, received bytes, results.
struct Recording {
  Setup setup;
  std::vector<Arrival> arrivals;
  Outcome outcome;
};

/// Writes a recording while it runs. Without finish() the file has no outcome and is not accepted.
class RecordingWriter {
 public:
  RecordingWriter(std::FILE* to, const Setup& setup);
  void add(const Arrival& arrival);
  void finish(const Outcome& outcome);

 private:
  std::FILE* to_;
};

/// Errors: std::invalid_argument "file:line: what; mend".
Recording read_recording(const std::string& path);

}  // namespace feltgate::board
