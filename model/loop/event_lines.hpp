// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What a law told, as text that Pure Data reads. Documentation: docs/devices/drums.md
#pragma once

#include <string>
#include <vector>

#include "loop.hpp"

namespace feltgate {

/// A line of FUDI for each hit: "MS NAME NUMBER VALUES;", MS being the time since the line before,
/// as Pure Data's qlist plays it. Events within `run_s`, whose names end in the same number, are
/// one line: the first one's name, and the values in order. Without a number there is none.
std::string event_lines(const std::vector<RunEvent>& events, double run_s);

}  // namespace feltgate
