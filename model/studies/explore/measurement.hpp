// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The measured figures of a design point, as plain numbers. Documentation:
// docs/speed-for-accuracy.md
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "feltgate/largest.hpp"

namespace feltgate::explore {

/// A parameter of the point, a line of the generator's values.txt.
struct Value {
  std::string name;
  int address = 0;
  std::int64_t raw = 0;
  double si = 0;
};

/// Reads the values. Throws std::runtime_error with file and line.
std::vector<Value> read_values(const std::string& path);
/// The value of this name. Throws std::runtime_error when it is missing.
const Value& value(const std::vector<Value>& values, const std::string& name);

/// Deviation of one signal from the exact one.
struct Error {
  double worst = 0, sum_squares = 0;
  std::int64_t count = 0;
  const char* worst_in = "";  ///< name of the motion

  void add(double deviation, const char* motion) {
    const double size = std::abs(deviation);
    const double now = larger(worst, size);
    if (now != worst) worst_in = motion;
    worst = now;
    sum_squares += size * size;
    ++count;
  }
  double rms() const {
    return count == 0 ? 0.0 : std::sqrt(sum_squares / static_cast<double>(count));
  }
};

struct Measurement {
  std::int64_t clocks_compared = 0, clocks_armed = 0, mismatches = 0;
  std::string first_mismatch;
  std::int64_t ticks = 0;                 ///< ticks with a measured error
  std::int64_t ticks_left_out = 0;        ///< of a motion after velocity or tau_hat left its format
  std::array<std::int64_t, 7> limited{};  ///< ticks with each bit of the limits word
  Error torque, tau_ref, tau_hat, velocity, voltage;
  double torque_settling_s = -1;  ///< 2 % of a step at a locked shaft; negative: not measured
  double estimator_delay_s = 0;
  double raw_velocity_rad_s = 0;  ///< largest before the low-pass, of the exact chain
  int latency_clocks = 0;
  double clock_hz = 0;
};

/// The JSON object of a point; without the errors if RTL and twin differed.
std::string measurement_json(const Measurement& m);

// The stimulus of a design point: the motions of the lever, with equal times for every point.

/// One motion in one scene, from rest after a reset.
struct Motion {
  const char* name;
  const char* scene;  ///< a design without this scene skips the motion
  double duration_s;
  double (*angle_rad)(double t_s);
  double setpoint_nm = 0;  ///< of the scene "setpoint"
  double window_s = 0;     ///< begin of the part that runs in lock-step
};

/// All motions in the order of the run: scenes across their borders, slow and small signals, a
/// chirp, and speeds at which torque and voltage reach their limits.
const std::vector<Motion>& motions();

/// Length of the lock-step part of each motion, seconds.
constexpr double lock_step_s = 8e-3;

}  // namespace feltgate::explore
