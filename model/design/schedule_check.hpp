// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Checks that a schedule can work. Documentation: docs/schedule.md (generated)
#pragma once

#include "design/schedule.hpp"

namespace feltgate::design {

/// Throws config::ConfigError with file, line and reason for a late result, for words that collide,
/// and for a clock outside the tick.
void check_schedule(const RegisterMap& map, const Schedule& s);

}  // namespace feltgate::design
