// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Time of a recording to clock of the FPGA. Documentation: docs/traces.md
#include "sim/traces/place.hpp"

#include <algorithm>
#include <numeric>

#include "feltgate/fixed.hpp"

namespace feltgate::traces {

ClockMap::ClockMap(TimeBase base, std::int64_t clock_hz)
    : num_(base.num * clock_hz), den_(base.den) {
  const std::int64_t common = std::gcd(num_, den_);
  num_ /= common;
  den_ /= common;
}

std::optional<Clock> ClockMap::at(std::int64_t t) const {
  constexpr int128_t kMost = int128_t{1} << 62U;
  const int128_t twice = static_cast<int128_t>(t) * num_ * 2 + den_;
  const int128_t clock = twice / (static_cast<int128_t>(den_) * 2);
  if (clock > kMost) return std::nullopt;
  return static_cast<Clock>(clock);
}

std::optional<Clock> Placer::edge(std::int64_t begin, std::int64_t end) {
  const std::optional<Clock> first = map_.at(begin);
  const std::optional<Clock> after = map_.at(end);
  if (!first || !after) return std::nullopt;
  const Clock width = std::max<Clock>(*after - *first, 1);
  Clock clock = *first;
  if (jitter_ && width > 1) clock += random_.below(width);
  clock = std::max(clock, last_ + 1);
  if (clock >= *first + width + kMostLag) return std::nullopt;
  last_ = clock;
  return clock;
}

std::optional<Clock> Placer::length(std::int64_t units) const {
  const std::optional<Clock> clocks = map_.at(units);
  if (!clocks) return std::nullopt;
  return std::max(*clocks, last_ + 1);
}

}  // namespace feltgate::traces
