// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Finds the target of the law compiler by the name of a design. Documentation: docs/laws.md
#pragma once

#include <string>

#include "apps/commands/commands.hpp"
#include "design/engine_map.hpp"

namespace feltgate {

/// Rates and formats of a design in rtl/designs. Throws std::invalid_argument as find_file().
inline law::Target law_target(const std::string& design) {
  return design::law_target(
      design::elaborate(design::read_design(find_file(design, "rtl/designs")),
                        design::read_registers(repository() + "/rtl/registers.toml")));
}

}  // namespace feltgate
