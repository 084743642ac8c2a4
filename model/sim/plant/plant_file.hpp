// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reader of vectors/plants/NAME.toml. Documentation: docs/plant.md
#pragma once

#include <string>

#include "parameters.hpp"

namespace feltgate::plant {

/// Reads and checks a plant file; every key is required, unknown keys are errors.
/// Errors: config::ConfigError "file:line: what; mend".
Parameters read_plant_file(const std::string& path);

}  // namespace feltgate::plant
