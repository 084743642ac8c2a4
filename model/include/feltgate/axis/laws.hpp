// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// All laws of an axis with the constants of a design, and the constants of the blocks that act in
// each clock. It does not change while an axis runs. docs/architecture.md
#pragma once

#include "feltgate/axis/arming.hpp"
#include "feltgate/axis/hold_timer.hpp"
#include "feltgate/axis/motor_heat.hpp"
#include "feltgate/axis/observer.hpp"
#include "feltgate/axis/overspeed.hpp"
#include "feltgate/axis/polarity.hpp"
#include "feltgate/axis/ramp.hpp"
#include "feltgate/axis/scene.hpp"
#include "feltgate/axis/tick_monitor.hpp"
#include "feltgate/axis/torque_law.hpp"
#include "feltgate/axis/velocity_estimator.hpp"

namespace feltgate::axis {

struct Laws {
  explicit Laws(const Design& d)
      : velocity(d),
        spans(d),
        observer(d),
        scene(d),
        ramp(d),
        torque(d),
        heat(d),
        overspeed(d),
        polarity(d),
        clocks_per_tick(d["CLOCKS_PER_TICK"]),
        m1(d["M1"]),
        wait_ticks(Arming::wait_ticks(d)),
        most_periods(TickMonitor::most(d)),
        self_test_drop(d["SELF_TEST_DROP"]),
        test_torque(std::int64_t{1} << (d["SCENE_TORQUE_W"] - 1)),
        require_watchdog(d["REQUIRE_WATCHDOG"] != 0),
        control_reset(static_cast<std::uint32_t>(d["CONTROL_RESET"])) {}

  VelocityEstimator<Fixed> velocity;
  SpanMeter spans;
  Observer<Fixed> observer;
  Scene<Fixed> scene;
  Ramp<Fixed> ramp;
  TorqueLaw<Fixed> torque;
  MotorHeat<Fixed> heat;
  Overspeed<Fixed> overspeed;
  Polarity<Fixed> polarity;
  int clocks_per_tick, m1, wait_ticks, most_periods, self_test_drop;
  std::int64_t test_torque;
  bool require_watchdog;
  std::uint32_t control_reset;
};

}  // namespace feltgate::axis
