// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The cogging of a motor, from a slow turn both ways, and the laws that turn so and take it away.
// Documentation: docs/calibration.md
#pragma once

#include <string>
#include <vector>

#include "design/design.hpp"
#include "host/calibrate/columns.hpp"
#include "host/calibrate/regression.hpp"

namespace feltgate::host {

/// What a voltage law makes of a torque near zero: the dead voltage is proportional to the torque
/// below linear_nm, so the motor gives nothing before edge_nm. command() is the reference for a
/// torque, torque() is its inverse. No more than cap_nm is added, since the ripple of a small
/// current overcomes part of the dead time, and that within rise_nm from 0. Of three phases what
/// the dead times take also depends on the shaft's angle, and on whether two or three of them
/// conduct.
struct SmallTorque {
  double linear_nm = 0, edge_nm = 0, cap_nm = 0, rise_nm = 0;
  int pole_pairs = 0;   ///< of a motor with three phases; else 0
  double zero_rad = 0;  ///< where its electrical angle is 0
  double lost_nm = 0;   ///< torque of the voltage that is given back at large torques

  bool exact() const { return edge_nm == 0; }
  double command(double torque_nm, double angle_rad) const;
  double torque(double command_nm, double angle_rad) const;
};

/// Nothing is missing if the current is controlled, or if no dead voltage is given back.
SmallTorque small_torque_of(const design::Elaborated& design);

/// cosine*cos(n*angle) + sine*sin(n*angle) on the lever, n times per turn.
struct CoggingTerm {
  int per_turn = 0;
  double cosine_nm = 0, sine_nm = 0;
  Interval amplitude_nm;
  double odd_nm = 0;  ///< amplitude of what changes its sign with the direction
};

struct Cogging {
  std::vector<CoggingTerm> terms;  ///< largest first; empty: none stands out
  int period = 1;                  ///< so often per turn the whole repeats
  double largest_nm = 0;           ///< of the sum, over a turn
  double friction_nm = 0;          ///< half of the difference of the directions
  double steady_nm = 0;            ///< on the lever, both ways, at every angle
  double noise_nm = 0;             ///< largest standard deviation of an amplitude
  double least_nm = 0;             ///< an amplitude below this is not looked for
  int searched = 0;                ///< harmonics
  double turns_up = 0, turns_down = 0, rad_s_up = 0, rad_s_down = 0;
  std::vector<std::string> warnings;

  /// On the lever.
  double at(double angle_rad) const;
};

/// From the columns of time, position, tau_hat and, if the design has a SmallTorque, tau_ref: a
/// turn or more up and as much down, driven. Means of both ways have no friction in them. Errors:
/// MeasurementError "file:line: what; mend".
Cogging identify_cogging(const ColumnTable& turn, const design::Elaborated& design,
                         double confidence);

/// A law that turns the lever of a design slowly up and down again.
std::string slow_turn_law(const design::Elaborated& design);
/// The law `into` without the cogging; `name` is its file in errors, and if that is empty, the law
/// does nothing else. `from` is the recording. Errors: std::invalid_argument, law::LawError.
std::string compensating_law(const Cogging& cogging, const SmallTorque& small,
                             const std::string& from, const std::string& into,
                             const std::string& name);

}  // namespace feltgate::host
