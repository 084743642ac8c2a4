// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// make_designs FOLDER: writes the design of each kind, as `feltgate design --for-plant` does.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <fstream>

#include "kinds.hpp"
#include "studies/stability/for_plant.hpp"

int main(int argc, char** argv) {
  using namespace feltgate;
  if (argc != 2) return 2;
  const std::string root = FELTGATE_ROOT;
  const auto registers = design::read_registers(root + "/rtl/registers.toml");
  int failed = 0;
  for (const test::Kind& k : test::kinds) {
    const std::string path = fmt::format("{}/{}.toml", argv[1], k.name);
    try {
      const stability::PlantDesign made =
          stability::design_for_plant(root + "/rtl/designs/" + k.base + ".toml", test::plant_of(k),
                                      k.nominal_a, k.name, path, registers);
      std::ofstream(path) << made.text;
      fmt::print("{}\n", k.name);
      for (const std::string& note : made.notes) fmt::print("  {}\n", note);
    } catch (const std::exception& e) {
      fmt::print(stderr, "{}: {}\n", k.name, e.what());
      failed = 1;
    }
  }
  return failed;
}
