// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The twin of a design chosen by name, in SI units. Documentation: docs/library.md
#pragma once

#include <memory>
#include <string>

#include "feltgate/device.hpp"

namespace feltgate {

/// The twin of one of the designs that were built in: "lever", "paper", ...
/// Throws std::invalid_argument naming what there is.
std::unique_ptr<Device> make_device(const std::string& design);

}  // namespace feltgate
