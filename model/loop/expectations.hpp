// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Compares the figures of a run with what its scene expects. Documentation: docs/scenes.md
#pragma once

#include <map>
#include <string>
#include <vector>

#include "felt.hpp"
#include "scenario.hpp"

namespace feltgate {

/// Expectations with the run's values.
struct ExpectationsHeld {
  std::vector<Expected> all;
  std::vector<std::string> broken;  ///< one line per broken expectation
};

/// The expectations of the scene that apply to `design`. Errors: config::ConfigError for a figure
/// that does not exist.
ExpectationsHeld hold_expectations(const Scenario& scenario, const std::string& design,
                                   const std::map<std::string, double>& figures);

}  // namespace feltgate
