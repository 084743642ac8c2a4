// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Which run of the engine the torque in force is of. Documentation: docs/blocks/engine.md
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace feltgate {

/// The runs of thread 0: each that begins gives a torque, one after the other.
struct EngineWatch {
  bool begins = false;       ///< a run began with the samples of the last tick
  bool running = false;      ///< as seen in the last clock
  std::int64_t changes = 0;  ///< sets of parameters that have come into force, also equal ones
  std::int64_t changes_at_begin = 0;
  bool stale = false;  ///< a mailbox was too old when the last tick measured: no torque
  std::deque<std::uint32_t> begun;  ///< ticks of the runs that have yet to end
  /// Tick of the samples of the last run that has ended, of that a clock ago, and of that whose
  /// torque the core has taken.
  std::optional<std::uint32_t> ended, ended_before, in_force;

  /// A clock of the engine: its inputs, what it shows after it; `late`: it came with a mailbox too
  /// old, which takes the torque away.
  void clock(bool ticks, std::uint32_t tick_count, bool runs, bool fresh, bool takes, bool late) {
    if (ticks) {
      in_force = ended_before;
      begins = false;
      stale = late;
    }
    ended_before = ended;
    changes += takes;
    if (runs && !running) begin(tick_count);
    running = runs;
    if (fresh) end();
    if (late) ended.reset();
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
