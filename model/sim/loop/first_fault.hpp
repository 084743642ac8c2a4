// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The first of a run's faults in words. Documentation: docs/safety.md
#pragma once

#include <map>
#include <string>

#include "felt.hpp"

namespace feltgate {

/// The earliest of these faults, with its time; empty if there is none.
std::string first_fault(const std::map<std::string, Acted>& faults);

}  // namespace feltgate
