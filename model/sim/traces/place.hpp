// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Maps the time of a recording to clocks of the FPGA: exact integer mapping and seeded jitter.
// Documentation: docs/traces.md
#pragma once

#include <cstdint>
#include <optional>

#include "feltgate/encoder_source.hpp"
#include "feltgate/random.hpp"

namespace feltgate::traces {

/// Seconds in one unit of a recording's time: num / den, each 1 to 10^15, num at most 100.
struct TimeBase {
  std::int64_t num = 1;
  std::int64_t den = 1;
};

/// Units of a recording to clocks, rounded to the nearest one (half up); it never drifts.
class ClockMap {
 public:
  /// clock_hz 1 to 1e12.
  ClockMap(TimeBase base, std::int64_t clock_hz);
  /// t from 0 to 2^62; nothing when the clock would pass 2^62.
  std::optional<Clock> at(std::int64_t t) const;

 private:
  std::int64_t num_;
  std::int64_t den_;
};

/// Puts edges on clocks, each strictly after the one before it.
class Placer {
 public:
  /// How far behind its sample an edge may be pushed by the edges before it.
  static constexpr Clock kMostLag = 16;

  Placer(ClockMap map, bool jitter, std::uint64_t seed)
      : map_(map), jitter_(jitter), random_(seed) {}

  /// Clock of an edge seen in the sample [begin, end) of the recording; nothing when it comes so
  /// fast after the others that more than one state per clock would be needed.
  std::optional<Clock> edge(std::int64_t begin, std::int64_t end);

  /// Length in clocks of a recording of that many units, at least one clock past the last edge.
  std::optional<Clock> length(std::int64_t units) const;

 private:
  ClockMap map_;
  bool jitter_;
  SplitMix64 random_;
  Clock last_ = 0;
};

}  // namespace feltgate::traces
