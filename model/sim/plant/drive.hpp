// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The drive electronics that a design assumes. Documentation: docs/plant.md
#pragma once

#include "bridge.hpp"
#include "feltgate/design_info.hpp"

namespace feltgate::plant {

/// Clock, PWM and dead time of a design.
inline Drive drive_of(const DesignInfo& d) {
  Drive drive;
  drive.clock_hz = static_cast<double>(d.clock_hz);
  drive.pwm_hz = drive.clock_hz / d.pwm_period;
  drive.dead_time_s = d.dead_clocks / drive.clock_hz;
  if (d.shortest_clocks > 1) drive.shortest_s = d.shortest_clocks / drive.clock_hz;
  drive.switching =
      d.pwm_mode == 1 ? Drive::Switching::kLockedAntiphase : Drive::Switching::kSignMagnitude;
  return drive;
}

}  // namespace feltgate::plant
