// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A value over time, made of segments (hold, step, ramp, minimum jerk, sine): an angle that a hand
// imposes, or a torque that it applies. Documentation: docs/plant.md
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace feltgate::plant {

/// `to` and `amplitude` are in rad or Nm, depending on the use of the profile.
struct Segment {
  enum class Kind { kHold, kStep, kRamp, kMinimumJerk, kSine };
  Kind kind = Kind::kHold;
  double duration_s = 0.0;
  double to = 0.0;         ///< step, ramp, minimum jerk: value at the end
  double amplitude = 0.0;  ///< sine: amplitude; its centre makes the value continuous
  double frequency_hz = 0.0;
  double phase_rad = 0.0;  ///< pi/2: starts and ends at rest
  double ease_s = 0.0;  ///< ramp: time to its speed from rest at the beginning, and back at the end
  int line = 0;         ///< line in the scene file; 0: not from a file
};

using Profile = std::vector<Segment>;

/// Sum of the durations, s.
double duration_s(const Profile& profile);

/// Value and its rate (per second) at one time.
struct ProfileSample {
  double value = 0.0;
  double rate = 0.0;
};

/// A profile in progress: each segment starts where the segment before ended, the first at `start`.
/// After the last segment the final value is held. Times must not decrease from call to call.
class ProfileRun {
 public:
  ProfileRun() = default;
  ProfileRun(Profile profile, double start);
  ProfileSample at(double time_s);
  /// Time at which the next segment after `time_s` begins or the last one ends; infinite: never.
  double next_corner_s(double time_s) const;

 private:
  Profile profile_;
  std::size_t index_ = 0;
  double begin_s_ = 0.0;
  double start_ = 0.0;
  std::size_t timed_ = static_cast<std::size_t>(-1);  ///< segment that per_s_ belongs to
  double per_s_ = 0.0;
};

/// Recorded samples, interpolated by cubic Hermite pieces (slope: central difference) so that the
/// velocity is continuous; at rest before the first and after the last sample.
struct Trace {
  std::vector<double> time_s;  ///< strictly increasing
  std::vector<double> theta_rad;
  std::string file{};  ///< file that it was read from, if any
};

/// A trace in progress. Times must not decrease from call to call.
class TraceRun {
 public:
  TraceRun() = default;
  explicit TraceRun(Trace trace) : trace_(std::move(trace)) {}
  ProfileSample at(double time_s);

 private:
  double slope(std::size_t i) const;
  Trace trace_;
  std::size_t index_ = 0;
};

/// Reads a recorded motion: a text table with the columns time_s and theta_rad.
/// Errors: config::ConfigError with file and line of the first bad row.
Trace read_trace_file(const std::string& path);

}  // namespace feltgate::plant
