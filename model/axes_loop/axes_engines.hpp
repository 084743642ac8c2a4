// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Which engines run several axes, from the names a user gives. Documentation: docs/devices.md
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "engines/axes_cores.hpp"

namespace feltgate {

struct AxesEngines {
  std::string lead;                 ///< "twin" or "lockstep"
  std::vector<std::string> riders;  ///< the law in "double", "quad"
  std::string reference;            ///< the most exact of them; empty: none
};

/// As choose_engines(); rtl brings its twin, and "all" has no float.
/// Throws std::invalid_argument naming what there is.
AxesEngines choose_axes_engines(const std::string& engines);

/// Cores of a design, as `lead` says, for a device with so many axes.
/// Errors: std::invalid_argument for a design that is not there or has another number of them.
std::unique_ptr<AxesCores> make_axes_cores(const std::string& design, const std::string& lead,
                                           const std::string& device, std::size_t axes);

}  // namespace feltgate
