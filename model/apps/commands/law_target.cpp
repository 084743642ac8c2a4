// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/law-compiler.md
#include "apps/commands/law_target.hpp"

#include "apps/commands/commands.hpp"
#include "design/law_target.hpp"

namespace feltgate {

law::Target law_target(const std::string& design) {
  return design::law_target(
      design::elaborate(design::read_design(find_file(design, "rtl/designs")),
                        design::read_registers(repository() + "/rtl/registers.toml")));
}

}  // namespace feltgate
