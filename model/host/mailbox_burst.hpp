// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Fresh values for the mailbox of a law at the full rate of the line: planes of a world, forces.
// Documentation: docs/host.md
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "host/law_engine.hpp"

namespace feltgate::host {

/// What became of the updates.
struct BurstCounts {
  std::uint64_t sent = 0;         ///< updates that went to the line
  std::uint64_t late = 0;         ///< updates that were not sent, because their time had passed
  std::uint64_t lost_frames = 0;  ///< frames that the board did not take, of all words
  std::uint64_t dropped = 0;      ///< checks that found a word dropped by a busy engine
};

/// Sends updates without waiting for answers, and looks now and then what arrived. An update that
/// is lost leaves the one before in force; if none arrives in time, the law's age ends the torque.
class MailboxBurst {
 public:
  /// `device` and `engine` must outlive this object; the engine's law must be known.
  MailboxBurst(Device& device, LawEngine& engine);

  /// Sets these values with one commit, unless `deadline` has passed. Errors: those of
  /// LawEngine::update(); LinkLost.
  bool send(const std::map<std::string, double>& values, Deadline deadline = Deadline::max());
  /// Asks the board what it took of the updates so far.
  const BurstCounts& check();
  const BurstCounts& counts() const { return counts_; }

 private:
  Device& device_;
  LawEngine& engine_;
  BurstCounts counts_;
  std::uint64_t unchecked_ = 0;  ///< frames since the last check
};

}  // namespace feltgate::host
