// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A simulated motor on the bench: voltages in, a gauge or the encoder's count out. The gauge has
// noise, the count has its steps. Documentation: docs/calibration.md
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "feltgate/random.hpp"
#include "host/calibrate/gauge.hpp"
#include "host/identify/identify.hpp"
#include "sim/plant/plant.hpp"
#include "sim/plant/plant_file.hpp"

namespace feltgate::test {

inline plant::Parameters shipped(const std::string& name) {
  return plant::read_plant_file(FELTGATE_ROOT "/vectors/plants/" + name + ".toml");
}

inline plant::Drive lever_drive() {
  plant::Drive drive;
  drive.pwm_hz = 50e3;
  return drive;
}

/// What a gauge of this noise shows at a voltage against the blocked shaft, a tenth of a second on.
inline double gauge_nm(const plant::Parameters& p, double volts, double noise_nm,
                       SplitMix64* random) {
  plant::Hand hand;
  hand.phases.push_back({});
  hand.phases.back().kind = plant::HandPhase::Kind::kLocked;
  plant::Plant plant(p, p.effects, lever_drive(), hand);
  for (int k = 0; k < 4000; ++k) {
    plant.advance(plant::Bridge::averaged(volts / p.supply.voltage_v), 250);
  }
  return plant.observables().motor_torque_nm + noise_nm * random->gaussian();
}

/// A voltage held for some time, or the gates open.
struct Held {
  double volts, seconds;
  bool open = false;
};

/// A free lever driven so, a row every `every_s`, its position in whole counts.
inline host::Recording drive(const plant::Parameters& p, const std::vector<Held>& plan,
                             double every_s = 1e-3) {
  plant::Plant plant(p, p.effects, lever_drive(), {});
  host::Recording r;
  r.name = "simulated";
  const double count_rad = 2 * M_PI / (4 * p.encoder.lines);
  const auto row_clocks = static_cast<Clock>(std::llround(every_s * 50e6));
  Clock next = 0, end = 0;
  for (const Held& h : plan) {
    end += static_cast<Clock>(std::llround(h.seconds * 50e6));
    while (plant.now() < end) {
      if (plant.now() >= next) {
        r.time_s.push_back(static_cast<double>(plant.now()) / 50e6);
        r.voltage_v.push_back(h.open ? 0 : h.volts);
        r.angle_rad.push_back(std::floor(plant.observables().theta_rad / count_rad) * count_rad);
        next += row_clocks;
      }
      plant.advance(
          h.open ? plant::Bridge::off() : plant::Bridge::averaged(h.volts / p.supply.voltage_v),
          50);
    }
  }
  return r;
}

}  // namespace feltgate::test
