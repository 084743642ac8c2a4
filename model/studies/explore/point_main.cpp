// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One design point: RTL against twin, the error against the exact design, delays. Compiled once per
// structure with POINT_HEADER, POINT_TYPE and the Verilated class Vpoint; the values of the point
// come at run time. Used by scripts/exploration/point.py. Documentation: docs/explore.md
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <vector>

#include "Vpoint.h"
#include POINT_HEADER
#include "feltgate/scenes.hpp"
#include "sim/plant/plant_file.hpp"
#include "sim/plant/winding.hpp"
#include "sim/reference/control_chain.hpp"
#include "studies/explore/error_run.hpp"
#include "studies/explore/lock_step_run.hpp"

namespace feltgate::explore {

constexpr double settling_step_nm = 0.2;

/// Settling time of the motor's torque with locked shaft, linear winding and the bridge averaged
/// over its period: seconds from a register write (at worst a whole tick before it takes effect)
/// until the torque stays within 2 % of the step around its final value; -1 if the design has no
/// scene "setpoint". Uses the fixed-point chain.
template <class D>
double torque_settling_s(const std::vector<Value>& values, const plant::MotorParameters& motor) {
  const int scene = D::scene_number("setpoint");
  if (!scene_built<D>(scene)) return -1;
  ControlChain<D, Fixed> chain;
  chain.reset();
  for (const Value& v : values) chain.words().set_raw(v.address, v.raw);
  chain.words().set_raw(D::A::ramp_step, fixed_of<D::f.ramp.key()>::max_raw());
  chain.words().set_raw(D::A::setpoint_torque, 0);
  ChainIn in;
  in.armed = true;
  in.scene = scene;
  for (int k = 0; k < 100; ++k) chain.tick(in);
  chain.words().set_raw(D::A::setpoint_torque,
                        std::llround(std::ldexp(settling_step_nm, D::f.torque.fraction)));

  // Time in clocks from the start of the tick in which the write is in force.
  constexpr std::int64_t duty_clock = 2 + 46;
  constexpr std::int64_t end = D::clock_hz / 20;  // 50 ms
  plant::Winding winding(motor.resistance_ohm, motor.inductance_h);
  winding.set_step(static_cast<double>(D::pwm_period) / static_cast<double>(D::clock_hz));
  std::vector<double> torque_nm;
  double current_a = 0, held_v = 0;
  std::int64_t next_tick = 0;
  for (std::int64_t period = 0; period * D::pwm_period < end; ++period) {
    // The bridge takes the duty that is there at the start of its period.
    const std::int64_t now = period * D::pwm_period;
    while (next_tick + duty_clock <= now) {
      chain.tick(in);
      held_v = static_cast<double>(chain.control().duty.raw()) / D::pwm_period * D::supply_v;
      next_tick += D::clocks_per_tick;
    }
    const auto step = winding.advance(current_a, held_v, held_v);
    current_a = step.end_a;
    torque_nm.push_back(motor.torque_constant_nm_a * current_a);
  }
  std::size_t last = torque_nm.size();
  while (last > 0 && std::abs(torque_nm[last - 1] - torque_nm.back()) <= 0.02 * settling_step_nm) {
    --last;
  }
  return static_cast<double>(D::clocks_per_tick +
                             (static_cast<std::int64_t>(last) + 1) * D::pwm_period) /
         static_cast<double>(D::clock_hz);
}

}  // namespace feltgate::explore

namespace {

using D = feltgate::POINT_TYPE;

feltgate::explore::Measurement measure(const std::string& values_path, const std::string& plant) {
  using namespace feltgate::explore;
  const auto values = read_values(values_path);
  Measurement m;
  m.latency_clocks = feltgate::Map::T::duty + 1 - feltgate::Map::T::sample;
  m.clock_hz = static_cast<double>(D::clock_hz);
  const double tick_s = 1.0 / static_cast<double>(D::tick_hz);
  const double cutoff_rad_s = -std::log1p(-value(values, "velocity_a1").si) / tick_s;
  m.estimator_delay_s = 0.5 * D::m1 * tick_s + 1.0 / cutoff_rad_s;
  LockStepRun<Vpoint, D>(values, &m).run();
  if (m.mismatches > 0) return m;
  ErrorRun<D>(values).run(&m);
  m.torque_settling_s = torque_settling_s<D>(values, feltgate::plant::read_plant_file(plant).motor);
  return m;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: point VALUES.txt PLANT.toml\n");
    return 2;
  }
  try {
    const auto m = measure(argv[1], argv[2]);
    std::printf("%s\n", feltgate::explore::measurement_json(m).c_str());
    return m.mismatches == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
