// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One design point: RTL against twin, the error against the exact design, delays. Compiled once per
// structure with POINT_HEADER, POINT_TYPE and the Verilated class Vpoint; the values of the point
// come at run time. Used by scripts/exploration/point.py. Documentation: docs/explore.md
#include <cmath>
#include <cstdio>
#include <exception>

#include "Vpoint.h"
#include POINT_HEADER
#include "sim/plant/plant_file.hpp"
#include "studies/explore/error_run.hpp"
#include "studies/explore/lock_step_run.hpp"
#include "studies/explore/settling.hpp"

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
