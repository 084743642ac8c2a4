// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Device time without any fault: nothing may be flagged. Documentation: docs/testing.md
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace feltgate::faults {

struct CleanResult {
  double scenes_s = 0, recordings_s = 0, dither_s = 0;  ///< device time of each kind
  std::int64_t alarms = 0;                              ///< faults, and motors disarmed
  std::string first;                                    ///< description of the first alarm
  double seconds() const { return scenes_s + recordings_s + dither_s; }
};

/// Runs the twin for `seconds` of device time. A twelfth is closed loop (scenes, hands and their
/// strength come from the seed); the rest is the shipped recordings in a loop, dither on one edge,
/// and a lever at rest.
CleanResult run_clean(const std::string& root, double seconds, std::uint64_t seed,
                      const std::function<void(double done)>& progress);

/// The same of a design with a current loop, an absolute encoder or three phases, in closed loop
/// alone. Errors: std::invalid_argument for another design.
CleanResult run_option_clean(const std::string& root, const std::string& design, double seconds,
                             std::uint64_t seed, const std::function<void(double done)>& progress);

}  // namespace feltgate::faults
