// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Selects the back-ends of several axes by the names that a user gives. Documentation:
// docs/devices.md
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "sim/backends/axes_cores.hpp"
#include "sim/loop/backend_choice.hpp"

namespace feltgate {

/// Like choose_backends(), but rtl includes its twin, and "all" has no float.
/// Errors: std::invalid_argument that names the choices.
BackendChoice choose_axes_backends(const std::string& engines);

/// Makes the cores of a design, of the kind `lead`, for a device with `axes` axes.
/// Errors: std::invalid_argument for a design that does not exist or has another number of axes.
std::unique_ptr<AxesCores> make_axes_cores(const std::string& design, const std::string& lead,
                                           const std::string& device, std::size_t axes);

}  // namespace feltgate
