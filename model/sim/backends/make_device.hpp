// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The twin of a design chosen by name, as a device in SI units. Documentation: docs/library.md
#pragma once

#include <memory>
#include <string>

#include "feltgate/device.hpp"

namespace feltgate {

/// The twin of a built-in design: "lever", "paper", ...
/// Errors: std::invalid_argument that names the choices.
std::unique_ptr<Device> make_device(const std::string& design);

}  // namespace feltgate
