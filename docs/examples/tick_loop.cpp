// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
// A lever is pushed into a virtual wall at 2 rad/s, a tick of 1 us at a time.
#include <cstdio>

#include "feltgate/device.hpp"
#include "feltgate/generated/lever.hpp"

int main() {
  feltgate::TwinDevice device(feltgate::design_info<feltgate::Lever>());
  device.select("wall");
  device.set("self_test_pulse", 0);  // no self-test, for the lever does not rest
  device.set("wall_contact", device.counts(0.2));
  device.arm();
  for (double angle_rad = 0; angle_rad < 0.3; angle_rad += 2e-6) {
    const feltgate::Reading& r = device.tick_to(angle_rad);
    if (r.tick % 25000 == 0) std::printf("%.3f rad  %7.4f Nm\n", r.angle_rad, r.torque_nm);
  }
}
