// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The Python interface of the plant: constants by name, and a motor that the caller drives.
// Documentation: docs/python.md
#pragma once

#include <toml++/toml.h>

#include <map>
#include <memory>
#include <string>

#include "apps/python/arrays.hpp"
#include "sim/plant/plant.hpp"

namespace feltgate::python {

class PyPlant {
 public:
  /// Keys of `set` are "section.key" of the plant file. Throws config::ConfigError as for a file.
  PyPlant(const std::string& path, const std::map<std::string, double>& set,
          const std::string& design, const plant::Hand& hand);

  const plant::Parameters& constants() const { return constants_; }
  /// Every number of the file, by "section.key".
  std::map<std::string, double> parameters() const;
  void reset();
  /// Applies each duty for `step_clocks`; returns the plant's values at the end of each step.
  py::dict run(const Doubles& duty, Clock step_clocks, bool gates_on);
  double theta_rad() const { return plant_->observables().theta_rad; }
  std::int64_t counts() const { return plant_->encoder().count(); }
  double time_s() const { return static_cast<double>(plant_->now()) / drive_.clock_hz; }

 private:
  toml::table table_;
  plant::Parameters constants_;
  plant::Drive drive_;
  plant::Hand hand_;
  std::unique_ptr<plant::Plant> plant_;
};

}  // namespace feltgate::python
