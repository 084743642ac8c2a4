// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A motor with a lever behind the core's twin, wired right or wrong. Documentation:
// docs/blocks/safety.md
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "feltgate/device.hpp"
#include "sim/plant/drive.hpp"
#include "sim/plant/plant.hpp"
#include "sim/plant/plant_file.hpp"
#include "twins.hpp"

namespace feltgate::test {

enum class Wiring { right, motor_swapped, encoder_swapped };

inline plant::Parameters motor_of(const std::string& name) {
  return plant::read_plant_file(std::string(FELTGATE_ROOT) + "/vectors/plants/" + name + ".toml");
}

/// Runs one tick at a time, without the self-test. The bridge is averaged and uses the duty at the
/// start of the tick.
template <class D>
class Rig {
 public:
  Rig(const plant::Parameters& motor, const plant::Hand& hand, Wiring w = Wiring::right)
      : plant(motor, motor.effects, plant::drive_of(design_info<D>()), hand), wiring(w) {
    device.clock(seen(plant.encoder().pins()));
    plant.advance(plant::Bridge::off(), 1);
    device.set("self_test_pulse", 0);
    for (int k = 0; k < 10; ++k) tick();
  }
  void tick() {
    const double sign = wiring == Wiring::motor_swapped ? -1.0 : 1.0;
    const Clock clocks = D::clocks_per_tick - device.now() % D::clocks_per_tick;
    plant.advance(plant::Bridge::averaged(sign * device.bridge_duty(), device.gates_enabled()),
                  clocks);
    events = plant.events();
    for (EncoderEvent& e : events) e.pins = seen(e.pins);
    device.run(clocks, events);
  }
  const CoreOut& out() const { return device.out(); }
  const plant::Observables& lever() const { return plant.observables(); }

  TwinDevice device{design_info<D>()};
  plant::Plant plant;
  Wiring wiring;

 private:
  EncoderPins seen(EncoderPins pins) const {
    if (wiring != Wiring::encoder_swapped) return pins;
    return {pins.b, pins.a, pins.z};
  }
  std::vector<EncoderEvent> events;
};

}  // namespace feltgate::test
