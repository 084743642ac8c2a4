// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The design first_power asks for no more than 0.05 Nm and 2 A in any scene, whatever the lever
// does. From power-up it and lever have the self-test on, which finds swapped channels.
// docs/boards/first-hour.md
#include "feltgate/generated/first_power.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "catch.hpp"
#include "feltgate/device.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/largest.hpp"
#include "twins.hpp"

namespace {

using feltgate::FirstPower;
using feltgate::Lever;
using feltgate::TwinDevice;

constexpr int kTicks = 310'000;

struct Most {
  double torque_nm = 0, current_a = 0, voltage_v = 0;
  long long armed = 0;
};

/// A lever that swings far and fast through every scene, armed again whenever it was disarmed.
template <class D>
Most most_of(double swing_rad_s) {
  Most most;
  for (const char* scene : {"free", "setpoint", "membrane", "spring_compression", "spring_tension",
                            "damper", "charge_attract", "charge_repel", "wall"}) {
    TwinDevice device{feltgate::design_info<D>()};
    device.select(scene);
    device.arm();
    const double amplitude_rad = 1.0, rate = swing_rad_s / amplitude_rad;
    for (int tick = 0; tick < kTicks; ++tick) {
      // At rest for the self-test, then a swing.
      const double t = std::max(0, tick - 60'000) * 1e-6;
      const feltgate::Reading& r = device.tick_to(amplitude_rad * std::sin(rate * t));
      most.torque_nm = feltgate::larger(most.torque_nm, std::abs(r.torque_nm));
      most.current_a = feltgate::larger(most.current_a, std::abs(r.current_a));
      most.voltage_v = feltgate::larger(most.voltage_v, std::abs(r.voltage_v));
      most.armed += r.armed;
    }
  }
  return most;
}

/// A lever that goes the wrong way in the first pulse is a fault before any scene.
template <class D>
void check_wrong_way() {
  for (const double sign : {1.0, -1.0}) {
    TwinDevice device{feltgate::design_info<D>()};
    device.select("setpoint");
    device.arm();
    double torque_nm = 0;
    std::string faults;
    for (int tick = 0; tick < 60'000; ++tick) {
      const feltgate::Reading& r = device.tick_to(sign * 2e-6 * std::clamp(tick - 20'500, 0, 3000));
      torque_nm = std::max(torque_nm, std::abs(r.torque_nm));
      faults = r.fault_names();
    }
    CHECK(faults == (sign < 0 ? "self_test" : ""));
    CHECK(torque_nm <= 0.05 + 1e-4);
  }
}

}  // namespace

TEST_CASE("first_power: 0.05 Nm and 2 A are never exceeded, in no scene") {
  const Most most = most_of<FirstPower>(20);
  CHECK(most.armed > 9 * (kTicks - 10));
  CHECK(most.torque_nm <= 0.05 + 1e-4);
  CHECK(most.torque_nm > 0.045);
  CHECK(most.current_a <= 2.0 + 1e-3);
  CHECK(most.voltage_v < 3);
}

TEST_CASE("first_power, lever: from power-up the self-test finds swapped channels") {
  check_wrong_way<FirstPower>();
  check_wrong_way<Lever>();
}
