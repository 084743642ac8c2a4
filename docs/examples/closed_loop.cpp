// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
// Within 0.2 s a hand pushes a motor's lever with 0.2 Nm against a spring of 0.5 Nm/rad.
#include <cstdio>
#include "feltgate/backends/make_device.hpp"
#include "feltgate/plant/drive.hpp"
#include "feltgate/plant/hand.hpp"
#include "feltgate/plant/plant.hpp"
#include "feltgate/plant/plant_file.hpp"
using namespace feltgate;
int main(int, char** argv) {  // argv[1]: a plant, such as plants/p24.toml of the package
  const auto device = make_device("lever");
  const plant::Parameters motor = plant::read_plant_file(argv[1]);
  const plant::Hand hand = plant::pushing_hand(0.2, 0.2);
  plant::Plant lever(motor, motor.effects, plant::drive_of(device->design()), hand);
  device->select("spring_tension");
  device->set("self_test_pulse", 0);  // no self-test, for the hand pushes at once
  device->arm();
  for (int step = 1; step <= 1000000; ++step) {  // of 25 clocks, 0.5 us
    lever.advance(plant::Bridge::averaged(device->bridge_duty(), device->gates_enabled()), 25);
    device->run(25, lever.events());
    if (step % 100000 == 0) std::printf("%.3f rad\n", device->reading().angle_rad);
  }
}
