// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What a scene expects of its figures, held to a run. Documentation: docs/scenes.md
#pragma once

#include <map>
#include <string>
#include <vector>

#include "felt.hpp"
#include "scenario.hpp"

namespace feltgate {

struct ExpectationsHeld {
  std::vector<Expected> all;
  std::vector<std::string> broken;  ///< one line each
};

/// Those of the scene that are for `design`. Throws config::ConfigError for a figure that is not
/// there.
ExpectationsHeld hold_expectations(const Scenario& scenario, const std::string& design,
                                   const std::map<std::string, double>& figures);

}  // namespace feltgate
