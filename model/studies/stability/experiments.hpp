// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Experiments in the full plant: the effect of counts and noise on a linearly stable wall.
// Documentation: docs/stability.md
#pragma once

#include <vector>

#include "studies/stability/bit_loop.hpp"

namespace feltgate::stability {

/// Result of pressing a lever into a wall several times, with a constant torque each time.
struct Rest {
  double stiffness_nm_rad = 0;
  double first_count = 0;  ///< the first press, as counts of penetration
  int presses = 0;
  int quiet = 0;             ///< number of presses after which position and torque come to rest
  int counts = 0;            ///< largest movement, in counts from lowest to highest
  double torque_rms_nm = 0;  ///< of the reference around its mean, largest
  double motor_torque_rms_nm = 0;
};
/// Presses with the torque of `count`, `count` + 1, ... counts of penetration. Half between two
/// counts is the worst for friction: either count's torque is then K*q/2 away from the press.
Rest rest_in_wall(const design::Elaborated& design, const plant::Parameters& plant,
                  const Wall& wall, double count, int presses);

/// 2 f / q: below it friction can hold a lever between the torques of two counts.
double encoder_rule_nm_rad(const design::Elaborated& design, const plant::Parameters& plant);

/// A host that renders a wall from a position with Gaussian noise, through exponential smoothing.
struct HostCase {
  double rate_hz = 0;
  double stiffness_nm_rad = 0;
  double noise_rad = 0;    ///< standard deviation, drawn anew at each reading
  double smoothing = 1.0;  ///< alpha of s += alpha * (x - s); 1 is none
};
struct HostFigures {
  double rate_hz = 0;        ///< nearest whole number of ticks
  double torque_rms_nm = 0;  ///< of the reference around its mean
  double angle_rms_rad = 0;  ///< of the lever
};
/// Runs a host's wall while a hand with impedance leans lightly on its face.
HostFigures host_wall(const design::Elaborated& design, const plant::Parameters& plant,
                      const HostCase& c);

/// Ticks of a scene period: the nearest; a multiple of the PWM period where that changes the rate
/// by less than 1 %, so that the loop repeats after one of them.
int scene_ticks(const design::Design& design, double rate_hz);

}  // namespace feltgate::stability
