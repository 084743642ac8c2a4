// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lines that somebody types while a motor is held. Documentation: docs/calibration.md
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace feltgate::host {

/// A line of the standard input. `meanwhile` is called some twenty times a second until one comes.
/// Throws std::invalid_argument at the end of the input, with `what` it should have been; nothing
/// where `go_on` says no.
std::optional<std::string> typed_line(const std::string& what, const std::function<bool()>& go_on,
                                      const std::function<void()>& meanwhile);

}  // namespace feltgate::host
