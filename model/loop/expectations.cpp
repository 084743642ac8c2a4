// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Comparison of a run's figures with its scene's expectations. Documentation: docs/scenes.md
#include "loop/expectations.hpp"

#include <fmt/format.h>

#include "config/nearest.hpp"
#include "config/toml_reader.hpp"

namespace feltgate {

ExpectationsHeld hold_expectations(const Scenario& scenario, const std::string& design,
                                   const std::map<std::string, double>& figures) {
  ExpectationsHeld held;
  for (const Expectation& x : scenario.expectations) {
    if (x.design && *x.design != design) continue;
    const auto it = figures.find(x.figure);
    if (it == figures.end()) {
      std::vector<std::string> names;
      for (const auto& [name, value] : figures) names.push_back(name);
      throw config::ConfigError(
          fmt::format("{}:{}: figure \"{}\" is not one of this run; {}docs/scenes.md lists them",
                      scenario.path, x.line, x.figure, config::did_you_mean(x.figure, names)));
    }
    const Expected e{x.figure, it->second, x.low, x.high, x.line};
    held.all.push_back(e);
    if (e.kept()) continue;
    held.broken.push_back(fmt::format("{}:{}: {} = {:.6g} is outside its bounds; expected {}",
                                      scenario.path, x.line, x.figure, e.value, e.wanted()));
  }
  return held;
}

}  // namespace feltgate
