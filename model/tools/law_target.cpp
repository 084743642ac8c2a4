// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/law-compiler.md
#include "tools/law_target.hpp"

#include "tools/commands.hpp"

namespace feltgate {

law::Target law_target(const std::string& design) {
  const auto e = design::elaborate(design::read_design(find_file(design, "rtl/designs")),
                                   design::read_registers(repository() + "/rtl/registers.toml"));
  law::Target t;
  t.design = e.design.name;
  t.tick_hz = e.design.tick_hz;
  t.clocks_per_tick = e.design.clocks_per_tick();
  t.counts_per_turn = 4 * e.design.lines;
  t.velocity = e.design.velocity;
  t.torque = e.design.torque;
  return t;
}

}  // namespace feltgate
