// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Names that a design knows, with errors that name the mend. Documentation: docs/python.md
#pragma once

#include <string>

#include "design/design.hpp"
#include "engines/engine.hpp"

namespace feltgate::python {

/// A design that is compiled in, however coarse. Errors: config::ConfigError.
design::Elaborated elaborated_files(const std::string& design_path,
                                    const std::string& registers_path);

/// All three throw std::invalid_argument for a name that there is not.
const ParameterInfo& parameter_of(const DesignInfo& design, const std::string& name);
int scene_of(const DesignInfo& design, const std::string& name);
/// closed_loop, open_loop or voltage: the mode of the control word.
int mode_of(const std::string& name);

}  // namespace feltgate::python
