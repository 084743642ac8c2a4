// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Experiments in the full plant: the effect of counts and noise on a linearly stable wall.
// Documentation: docs/speed-for-accuracy.md
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
  double noise_rad = 0;       ///< standard deviation, drawn anew at each reading
  double smoothing = 1.0;     ///< alpha of s += alpha * (x - s); 1 is none
  double press_nm = 0.02025;  ///< of the hand, which aims as far beyond the face as that takes
};
struct HostFigures {
  double rate_hz = 0;          ///< nearest whole number of ticks
  double torque_rms_nm = 0;    ///< of the reference around its mean
  double angle_rms_rad = 0;    ///< of the lever
  double torque_swing_nm = 0;  ///< of the reference, from lowest to highest
  int counts = 0;              ///< of the position, likewise
};
/// Runs a host's wall while a hand with impedance leans lightly on its face.
HostFigures host_wall(const design::Elaborated& design, const plant::Parameters& plant,
                      const HostCase& c);

/// A host's wall without damping in a hand with impedance, 0.065 Nm s/rad and a grip of 30 Nm/rad.
struct HeldWall {
  double rate_hz = 0, stiffness_nm_rad = 0;
  double needed_nm_s_rad = 0;  ///< damping K (T/2 + t_d), readings' age included
  double border_nm_rad = 0;    ///< with the hand, by eigenvalues
  double bits_nm_rad = 0;      ///< the same by bisection on the bits; NaN where it has few counts
  HostFigures leaning, pressing;  ///< with 20 mNm, and with 0.25 Nm
};
/// `linear` is for the borders, `full` for the rest.
HeldWall held_wall(const design::Elaborated& design, const plant::Parameters& linear,
                   const plant::Parameters& full, double rate_hz, double stiffness_nm_rad);

/// Ticks of a scene period: the nearest; a multiple of the PWM period where that changes the rate
/// by less than 1 %, so that the loop repeats after one of them.
int scene_ticks(const design::Design& design, double rate_hz);

}  // namespace feltgate::stability
