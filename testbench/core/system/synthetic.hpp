// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generates encoder motions by rules: seeded, small in memory, equal on every machine (the chirp to
// within one clock, because it uses the C library's sine). Documentation: docs/traces.md
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "feltgate/encoder_source.hpp"

namespace feltgate::traces {

/// A source driven by a function that says how long to wait and which way to turn.
class Synthetic final : public EncoderSource {
 public:
  struct Move {
    Clock wait = 1;  ///< clocks since the move before (the first: since clock 0), at least 1
    int turn = 0;    ///< +1 or -1 count; 2: both channels at once, which is illegal
  };
  using Rule = std::function<std::optional<Move>()>;

  /// Starts at A = B = 0; ends `rest` clocks (at least 1) after the last move.
  explicit Synthetic(Rule rule, Clock rest = 1) : rule_(std::move(rule)), rest_(rest) {}

  EncoderPins initial() const override { return {}; }
  std::optional<EncoderEvent> next() override;
  Clock length() const override { return clock_ + rest_; }

 private:
  Rule rule_;
  Clock rest_;
  Clock clock_ = 0;
  unsigned phase_ = 0;
};

namespace synthetic {

/// Throws std::invalid_argument for a motion that is not possible.
inline void demand(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

using Source = std::unique_ptr<EncoderSource>;

/// `counts` counts at an even rate (negative: downward), kept to 1e-6 counts per second and without
/// drift. Throws std::invalid_argument for 0, and for more than one count per clock.
Source constant_speed(double counts_per_s, std::int64_t counts, std::int64_t clock_hz = 50'000'000);

/// One count every `clocks_per_count` clocks, down to 1: the fastest there is. For a counter that
/// wraps, preset its position and run this over the border.
Source fast_run(std::int64_t counts, Clock clocks_per_count = 1, int direction = 1);

/// One count a second, upward.
Source one_count_per_second(std::int64_t counts, std::int64_t clock_hz = 50'000'000);

/// `rounds` times: `reach` counts up, `reach` down, one up, so that the turning points visit all
/// four phases in both directions. Ends `rounds` counts up.
Source reversals(std::int64_t rounds, std::int64_t reach, Clock clocks_per_count);

/// One edge to and fro, `edges` times; what a shaft at rest on an edge does.
Source dither(std::int64_t edges, Clock clocks_per_edge);

/// `bursts` moves of `counts` counts, alternately up and down, with a rest before each.
Source steps(std::int64_t bursts, std::int64_t counts, Clock clocks_per_count, Clock rest);

/// Position round(amplitude * sin(phase)) whose frequency rises evenly from f0 to f1, looked at
/// every `grid` clocks. Throws std::invalid_argument when that is too fast for the grid.
Source chirp(std::int64_t amplitude, double f0_hz, double f1_hz, double duration_s,
             std::int64_t clock_hz = 50'000'000, Clock grid = 50);

/// `counts` counts of even chance up and down, waits uniform from min_wait to max_wait.
Source random_walk(std::uint64_t seed, std::int64_t counts, Clock min_wait, Clock max_wait);

/// As random_walk; of a thousand moves about `per_thousand` change both channels at once.
Source illegal(std::uint64_t seed, std::int64_t moves, int per_thousand, Clock min_wait,
               Clock max_wait);

}  // namespace synthetic
}  // namespace feltgate::traces
