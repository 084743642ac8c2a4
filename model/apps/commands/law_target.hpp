// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Finds the target of the law compiler by the name of a design. Documentation: docs/law-compiler.md
#pragma once

#include <string>

#include "law/compile.hpp"

namespace feltgate {

/// Rates and formats of a design in rtl/designs. Throws std::invalid_argument as find_file().
law::Target law_target(const std::string& design);

}  // namespace feltgate
