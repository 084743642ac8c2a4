// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The [hand] table of a scene whose device is a gimbal. Documentation: docs/gimbal.md
#pragma once

#include "config/toml_reader.hpp"
#include "gimbal.hpp"

namespace feltgate::plant {

/// Reads [hand] and [[hand.phase]] of a hand that turns a handle whose middle joint has these
/// stops. Errors: config::ConfigError "file:line: what; mend".
TurningHand read_turning_hand(config::TomlReader table, const AngleStops& stops);

}  // namespace feltgate::plant
