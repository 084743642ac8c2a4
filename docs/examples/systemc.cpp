// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
// Twin and motor as sc_modules: a hand pushes against a virtual spring; waveform in lever.vcd.
#include "feltgate/generated/lever.hpp"
#include "feltgate/plant/hand.hpp"
#include "feltgate/plant/plant_file.hpp"
#include "feltgate/systemc/motor_module.hpp"
#include "feltgate/systemc/twin_module.hpp"
using namespace feltgate;
int sc_main(int, char** argv) {  // argv[1]: a plant, such as plants/p24.toml of the package
  systemc::Board<Lever> board("board");
  systemc::TwinModule<Lever> core("core");
  systemc::MotorModule motor("motor", plant::read_plant_file(argv[1]), design_info<Lever>(),
                             plant::pushing_hand(0.2));
  board.connect(core);
  board.connect(motor);
  board.out.trace(sc_core::sc_create_vcd_trace_file("lever"), "core");
  board.in.scene_i = Lever::S::spring_tension;
  sc_core::sc_start(1, sc_core::SC_US);
  board.in.arm_i = true;
  sc_core::sc_start(20, sc_core::SC_MS);
  return motor.plant().observables().theta_rad > 0.01 ? 0 : 1;
}
