// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reads the [hand] table of a scene. Documentation: docs/plant.md
#pragma once

#include "config/toml_reader.hpp"
#include "hand.hpp"

namespace feltgate::plant {

/// Reads [hand] and [[hand.phase]]; files of traces are relative to the folder of the scene.
/// Errors: config::ConfigError "file:line: what; mend".
Hand read_hand(config::TomlReader table);

/// Reads a recorded motion: a CSV with the header "time_s,theta_rad".
/// Errors: config::ConfigError with file and line of the first bad row.
Trace read_trace_file(const std::string& path);

}  // namespace feltgate::plant
