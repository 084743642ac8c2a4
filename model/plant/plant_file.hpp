// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reads vectors/plants/NAME.toml and the [effects] table of a scene. Documentation: docs/plant.md
#pragma once

#include <string>

#include "config/toml_reader.hpp"
#include "parameters.hpp"

namespace feltgate::plant {

/// Reads and checks a plant file; every key is required, unknown keys are errors.
/// Errors: config::ConfigError "file:line: what; mend".
Parameters read_plant_file(const std::string& path);

/// The same from a parsed table, `file` being the name that errors print.
Parameters read_plant(const toml::table& root, const std::string& file);

/// Effects of a scene's [effects] table over `base`: a missing key keeps the value of `base`.
Effects read_effects(config::TomlReader table, const Effects& base);

}  // namespace feltgate::plant
