// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A board at the other end of a pseudo-terminal, in step with the clock on the wall; or fed from a
// recording. Documentation: docs/board.md
#pragma once

#include <functional>

#include "board/board.hpp"
#include "board/pseudo_terminal.hpp"

namespace feltgate::board {

/// How fast a board ran.
struct Pace {
  double simulated_s = 0, wall_s = 0;
  double busy_s = 0;    ///< of the processor's time, spent in the simulation
  double behind_s = 0;  ///< given up: simulated time that came too late by so much
  /// Simulated seconds per second without waiting.
  double factor() const { return busy_s > 0 ? simulated_s / busy_s : 0; }
  /// Whether it kept up, but for a hundredth.
  bool real_time() const { return behind_s <= 0.01 * simulated_s; }
};

struct ServeOptions {
  double for_s = 0;  ///< simulated; 0: until `go_on` says no
  bool paced = true;
  RecordingWriter* record = nullptr;
  std::function<bool()> go_on;
  std::function<void(const Pace&)> tell;  ///< about once in a second; may be empty
};

Pace serve(Board& board, PseudoTerminal& terminal, const ServeOptions& options);

/// The same bytes at the same clocks, as fast as it goes. `go_on` false ends it early.
Pace replay(Board& board, const Recording& recording, const std::function<bool()>& go_on,
            const std::function<void(double done)>& progress);

}  // namespace feltgate::board
