// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reads recorded motions of a hand. Documentation: docs/plant.md
#pragma once

#include <string>

#include "profile.hpp"

namespace feltgate::plant {

/// Reads a recorded motion: a text table with the columns time_s and theta_rad.
/// Errors: config::ConfigError with file and line of the first bad row.
Trace read_trace_file(const std::string& path);

}  // namespace feltgate::plant
