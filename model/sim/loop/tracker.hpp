// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A sensor of the host beside the core: it samples the lever at intervals, and its readings reach
// the law as mailbox words. Documentation: docs/scenes.md
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "../backends/backend.hpp"
#include "feltgate/random.hpp"

namespace feltgate {

/// [tracker] of a scene file.
struct TrackerSettings {
  std::string mailbox;          ///< gets the angle, rad
  std::string encoder_mailbox;  ///< gets the core's position, rad; empty: none
  bool of_encoder = false;      ///< samples the core's position instead of the angle
  double rate_hz = 0;
  double noise_rad = 0;       ///< standard deviation; Gaussian, cut at 4 sigma
  double resolution_rad = 0;  ///< step of the readings; 0: none
  double alpha = 1;           ///< of the filter s_n = alpha*x_n + (1 - alpha)*s_(n-1), s_0 = x_0
  double latency_s = 0;       ///< from a sample to the host's write
  std::uint64_t seed = 1;     ///< seed of the noise
  int line = 0;               ///< line in the file
};

/// A tracker's readings at one time.
struct TrackerSample {
  Clock at = 0;  ///< when the host has it
  double angle_rad = 0, encoder_rad = 0;
};

/// The sensor in a run.
class Tracker {
 public:
  Tracker(const TrackerSettings& settings, std::int64_t clock_hz);

  /// The next clock at which it samples, or at which the host gets a sample.
  Clock next() const;
  /// Takes a sample if one is due: the lever's angle and the core's position at `now`.
  void sample(Clock now, double angle_rad, double encoder_rad);
  /// The latest sample that has reached the host by `now` and was not taken yet.
  std::optional<TrackerSample> take(Clock now);

 private:
  Clock clock_of_sample(std::int64_t number) const;

  TrackerSettings settings_;
  double clock_hz_;
  Clock latency_;
  SplitMix64 random_;
  std::int64_t samples_ = 0;
  Clock next_sample_ = 0;
  double smooth_rad_ = 0;
  std::deque<TrackerSample> under_way_;
};

}  // namespace feltgate
