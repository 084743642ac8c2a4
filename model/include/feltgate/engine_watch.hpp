// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Finds out which run of the engine produced the torque in force. Documentation:
// docs/blocks/engine.md
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace feltgate {

/// The runs of thread 0. Runs end in the order in which they begin; each gives one torque.
struct EngineWatch {
  bool begins = false;       ///< a run began with the samples of the last tick
  bool running = false;      ///< whether a run was active in the last clock
  std::int64_t changes = 0;  ///< parameter sets that have come into force, also equal ones
  std::int64_t changes_at_begin = 0;
  bool stale = false;               ///< a mailbox was too old at the last tick: no torque
  std::deque<std::uint32_t> begun;  ///< ticks of the runs that have not ended yet
  /// Tick of the samples of: the last run that has ended; the run whose torque the axes have taken.
  std::optional<std::uint32_t> ended, in_force;

  /// The axes take the torque.
  void take() { in_force = ended; }

  /// One clock of the engine, with its inputs and its outputs after the clock. `late`: in this
  /// clock a mailbox has become too old, which takes the torque away. `stops`: delay lines are
  /// being cleared, which takes it away too and ends the runs that are under way.
  void clock(bool ticks, std::uint32_t tick_count, bool runs, bool fresh, bool takes, bool late,
             bool stops = false) {
    if (ticks) {
      begins = false;
      stale = late;
    }
    changes += takes;
    if (runs && !running) begin(tick_count);
    running = runs;
    if (fresh) end();
    if (stops) begun.clear();
    if (late || stops) ended.reset();
  }
  void begin(std::uint32_t tick_count) {
    changes_at_begin = changes;
    begun.push_back(tick_count);
    begins = true;
  }
  void end() {
    if (begun.empty()) return;
    ended = begun.front();
    begun.pop_front();
  }
};

}  // namespace feltgate
