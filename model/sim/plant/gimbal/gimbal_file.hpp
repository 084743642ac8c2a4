// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reader of gimbal files such as vectors/devices/gimbal.toml. Documentation:
// docs/devices/three-axes.md
#pragma once

#include <string>

#include "gimbal.hpp"

namespace feltgate::plant {

/// Reads and checks a gimbal; every key is required, unknown keys are errors.
/// Errors: config::ConfigError "file:line: what; mend".
GimbalParameters read_gimbal_file(const std::string& path);
/// The same from a text; errors name it `path`.
GimbalParameters read_gimbal_text(const std::string& text, const std::string& path);

}  // namespace feltgate::plant
