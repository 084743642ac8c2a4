// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Whether a schedule can work. Documentation: docs/schedule.md (generated)
#pragma once

#include "design/schedule.hpp"

namespace feltgate::design {

/// Throws config::ConfigError with file, line and reason for what comes late, meets or lies
/// outside.
void check_schedule(const RegisterMap& map, const Schedule& s);

}  // namespace feltgate::design
