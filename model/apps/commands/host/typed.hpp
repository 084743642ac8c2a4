// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reads lines that a user types while a motor is held armed. Documentation: docs/calibration.md
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace feltgate::host {

/// Reads a line of the standard input; calls `meanwhile` about twenty times a second while it
/// waits. Returns nothing when `go_on` returns false. Throws std::invalid_argument at the end of
/// the input; the message names `what` was expected.
std::optional<std::string> typed_line(const std::string& what, const std::function<bool()>& go_on,
                                      const std::function<void()>& meanwhile);

}  // namespace feltgate::host
