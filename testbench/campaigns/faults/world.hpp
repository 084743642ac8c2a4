// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The environment of the fault campaign: scenes that give torque, with motor, lever and a hand.
// Documentation: docs/verification.md
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "campaigns/faults/outcome.hpp"
#include "feltgate/core_ports.hpp"
#include "sim/plant/plant.hpp"

namespace feltgate::faults {

/// The word of a parameter, with its address.
struct Word {
  int address = 0;
  std::uint32_t data = 0;
};

struct Act {
  std::string name;
  int scene = 0;
  bool arm = true;
  std::vector<Word> words;  ///< written before arming
  plant::Hand hand;
  double warm_s = 0.1;     ///< time before the faults; the scene gives torque by then
  double window_s = 0.06;  ///< time in which the faults come
};

/// Wall, spring, damper, membrane, charge, setpoint, free, disarmed; of design `lever`.
std::vector<Act> acts();

/// Word of a parameter for a value in its unit. Throws std::invalid_argument.
Word word(const std::string& parameter, double value);
/// Hands.
plant::Hand leaning_hand(double from_rad, double to_rad, double sway_rad, double sway_hz);
plant::Hand moving_hand(double from_rad, double rad_s);

plant::Plant make_plant(const std::string& root, const plant::Hand& hand);
TorqueJudge::Motor motor_of_plant(const std::string& root);
double count_rad();

/// Converts gate times to the bridge input of the plant.
plant::Bridge bridge_of(const GateTimes& gates, int clocks);

}  // namespace feltgate::faults
