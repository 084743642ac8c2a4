// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Faults at the pins that lever does not have: of the current loop of lever_current, of the encoder
// of lever_absolute, of that and the three phases of gimbal_motor, of all in gimbal_current,
// of the Hall lines of hall_motor.
// Documentation: docs/testing.md
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "campaigns/faults/pin_faults.hpp"

namespace feltgate::faults {

/// Names of these designs.
std::vector<std::string> option_designs();
/// Those of one of these designs; none for another.
const std::vector<PinKind>& option_kinds(const std::string& design);

/// Runs one fault. The sound core has a motor and a hand of its own: what it measures is what its
/// gates make.
PinResult run_option_fault(const std::string& root, const std::string& design, std::size_t kind,
                           std::uint64_t seed);

}  // namespace feltgate::faults
