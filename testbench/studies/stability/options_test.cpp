// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What a study refuses, whoever calls it: not a number would never end.
// Documentation: docs/stability.md
#include <cmath>

#include "catch.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/stability/study.hpp"

using namespace feltgate;
using namespace feltgate::stability;

TEST_CASE("rates and dampings of a study are numbers of their range") {
  const std::string root = FELTGATE_ROOT;
  const auto design = design::elaborate(design::read_design(root + "/rtl/designs/lever.toml"),
                                        design::read_registers(root + "/rtl/registers.toml"));
  const auto plant = plant::read_plant_file(root + "/vectors/plants/linear.toml");
  StudyOptions options;
  options.bits = options.experiments = false;
  options.rates_hz = {1000};
  for (const double damping : {std::nan(""), HUGE_VAL, -0.1, 1.1}) {
    options.damping_nm_s_rad = {0.001, damping};
    CHECK_THROWS_AS(run_study(design, plant, plant, options), std::invalid_argument);
  }
  options.damping_nm_s_rad = {0.001};
  for (const double rate : {std::nan(""), HUGE_VAL, 0.0, 2e6}) {
    options.rates_hz = {rate};
    CHECK_THROWS_AS(run_study(design, plant, plant, options), std::invalid_argument);
  }
}
