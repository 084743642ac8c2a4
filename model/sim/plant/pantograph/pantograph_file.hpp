// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reader of vectors/devices/NAME.toml for pantographs. Documentation: docs/devices/pantograph.md
#pragma once

#include <string>

#include "pantograph_parameters.hpp"

namespace feltgate::plant {

/// Reads and checks a pantograph; every key is required, unknown keys are errors.
/// Errors: config::ConfigError "file:line: what; mend".
PantographParameters read_pantograph_file(const std::string& path);
/// The same from a text; errors name it `path`.
PantographParameters read_pantograph_text(const std::string& text, const std::string& path);

}  // namespace feltgate::plant
