// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Looks up the names of a design; errors give the mend. Documentation: docs/python.md
#pragma once

#include <string>

#include "design/design.hpp"
#include "sim/backends/backend.hpp"

namespace feltgate::python {

/// Elaborates the files of a compiled-in design; a coarse resolution is accepted. Throws
/// config::ConfigError.
design::Elaborated elaborated_files(const std::string& design_path,
                                    const std::string& registers_path);

/// The following functions throw std::invalid_argument for an unknown name.
const ParameterInfo& parameter_of(const DesignInfo& design, const std::string& name);
int scene_of(const DesignInfo& design, const std::string& name);
/// closed_loop, open_loop or voltage: the mode of the control word.
int mode_of(const std::string& name);

}  // namespace feltgate::python
