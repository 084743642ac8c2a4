// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The events of a law as text for Pure Data. Documentation: docs/devices/drums.md
#pragma once

#include <string>
#include <vector>

#include "loop.hpp"

namespace feltgate {

/// One line of FUDI per hit: "MS NAME NUMBER VALUES;", where MS is the time since the line before;
/// Pure Data's qlist plays it. Events within `run_s` whose names end in the same number become one
/// line, with the name of the first one and the values in order. Without a number, NUMBER is left
/// out.
std::string event_lines(const std::vector<RunEvent>& events, double run_s);

}  // namespace feltgate
