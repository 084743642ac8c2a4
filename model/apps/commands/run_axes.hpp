// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Results of feltgate run of a scene whose device has several axes. Documentation: docs/devices.md
#pragma once

#include <string>

#include "sim/axes_loop/axes_run.hpp"

namespace feltgate {

/// The result for reading on a terminal, and as a JSON object, pretty-printed.
std::string axes_text(const AxesResult& result);
std::string axes_json(const AxesResult& result);

}  // namespace feltgate
