// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The time of TwinDevice::tick_to. Documentation: docs/speed-for-accuracy.md
#include "studies/bench/device_speed.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "feltgate/device.hpp"
#include "feltgate/generated/lever.hpp"
#include "studies/bench/cpu_time.hpp"

namespace feltgate::bench {

double device_ns_per_tick(std::size_t ticks) {
  TwinDevice<Lever> device;
  device.select("wall");
  device.set("self_test_pulse", 0);  // no self-test, for the lever does not rest
  device.set("wall_contact", device.counts(0.005));
  device.arm();
  std::vector<double> angles_rad(ticks);
  for (std::size_t k = 0; k < ticks; ++k)
    angles_rad[k] = 0.01 * std::sin(2e-4 * static_cast<double>(k));
  device.tick_to(0);
  double pushed = 0;
  const double s = cpu_seconds([&] {
    for (const double angle_rad : angles_rad) pushed += device.tick_to(angle_rad).torque_nm;
  });
  if (!device.armed() || pushed == 0) throw std::logic_error("the wall was not felt");
  return 1e9 * s / static_cast<double>(ticks);
}

}  // namespace feltgate::bench
