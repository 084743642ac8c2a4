// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Prints what delay and passivity controller do to two coupled levers. Usage: teleoperation
// REPOSITORY. Documentation: docs/devices.md#teleoperation
#include "teleoperation.hpp"

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  using namespace feltgate::examples;
  try {
    std::puts(
        "| delay, ms | controller | least energy, mJ | of the plant, mJ | fastest at the end, "
        "rad/s | apart, rad |");
    std::puts("|---|---|---|---|---|---|");
    for (const double delay_ms : {0.0, 20.0, 50.0, 100.0, 200.0}) {
      for (const bool passivity : {false, true}) {
        Coupling coupling;
        coupling.passivity = passivity;
        const Teleoperated t = teleoperate(argc > 1 ? argv[1] : ".", 1e-3 * delay_ms, coupling);
        std::printf("| %g | %s | %.2f | %.2f | %.3f | %.3f |\n", delay_ms, passivity ? "on" : "off",
                    1e3 * t.least_energy_j, 1e3 * t.least_of_plant_j, t.fastest_rad_s, t.apart_rad);
        std::fflush(stdout);
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "teleoperation: %s\n", error.what());
    return 2;
  }
}
