// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The quantities that a hand feels in a run (motor torque, position, force), as short means, and
// the difference of two runs in them. Documentation: docs/speed-for-accuracy.md
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/plant/parameters.hpp"
#include "sim/plant/plant.hpp"

namespace feltgate::trim {

// A largest or rms value of a reference below these counts as this value: one count of 4096,
// 1 mNm, 10 mN.
constexpr double least_position_rad = 1.534e-3, least_torque_nm = 1e-3, least_force_n = 1e-2;

/// Means of a signal, one per window, each weighted by a triangle of twice that length around it,
/// so that a small shift in time changes a mean only a little. The first and the last mean have
/// half a triangle.
class Signal {
 public:
  /// `window`: in clocks; `least`: see above, in the signal's unit.
  Signal(Clock window, double least) : window_(static_cast<double>(window)), least_(least) {}
  /// `value` held over the `clocks` after those before.
  void add(Clock clocks, double value);
  const std::vector<double>& means() const { return means_; }
  double least() const { return least_; }

 private:
  double window_, least_;
  Clock now_ = 0;
  std::vector<double> means_;
};

/// What is felt in a run: one signal for each axis, or each direction of the hand's force.
struct Felt {
  std::vector<Signal> torque;    ///< Kt*i, on the lever or joint, Nm
  std::vector<Signal> position;  ///< from where it starts, rad
  std::vector<Signal> force;     ///< of the hand, N; Nm where it turns
  double simulated_s = 0;
  double cpu_s = 0;                 ///< CPU time of the thread that ran it
  std::size_t states = 0;           ///< of the plant; of several axes not counted
  plant::Evaluations evaluations;   ///< of one lever
  std::vector<std::string> broken;  ///< expectations of the scene that do not hold
  std::string fault;                ///< the first that opened the gates, with its time; or none
};

/// Largest and rms difference over the windows, relative to the reference's largest magnitude and
/// rms.
struct Loss {
  double peak = 0, rms = 0;
};

/// Of several axes the largest losses.
struct Difference {
  Loss torque, position, force;
  /// The largest of the six losses; a tolerance limits it.
  double worst() const;
};

/// `other` against `reference`, two runs of the same length.
Difference compare(const Felt& reference, const Felt& other);

/// CPU time of this thread so far, s.
double thread_cpu_s();

}  // namespace feltgate::trim
