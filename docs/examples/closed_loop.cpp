// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
// A hand pushes a motor's lever with 0.2 Nm against a virtual spring of 0.5 Nm/rad.
#include <cstdio>
#include "feltgate/engines/make_device.hpp"
#include "feltgate/plant/drive.hpp"
#include "feltgate/plant/plant.hpp"
#include "feltgate/plant/plant_file.hpp"
using namespace feltgate;
int main(int, char** argv) {  // argv[1]: a plant, such as plants/p24.toml of the package
  const auto device = make_device("lever");
  const plant::Parameters motor = plant::read_plant_file(argv[1]);
  const plant::HandPhase push{
      plant::HandPhase::Kind::kTorque, 1, {{plant::Segment::Kind::kRamp, 0.2, 0.2}}};
  plant::Plant lever(motor, motor.effects, plant::drive_of(device->design()), {{}, {}, {push}});
  device->select("spring_tension");
  device->arm();
  for (int step = 1; step <= 1000000; ++step) {  // of 25 clocks, 0.5 us
    lever.advance(plant::Bridge::averaged(device->bridge_duty(), device->gates_enabled()), 25);
    device->run(25, lever.events());
    if (step % 100000 == 0) std::printf("%.3f rad\n", device->reading().angle_rad);
  }
}
