// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Converts a design to a target of the law compiler: its rates and formats. Documentation:
// docs/laws.md
#pragma once

#include "design/design.hpp"
#include "law/target.hpp"

namespace feltgate::design {

/// The properties of design `e` that the law compiler needs.
inline law::Target law_target(const Elaborated& e) {
  law::Target t;
  t.design = e.design.name;
  t.tick_hz = e.design.tick_hz;
  t.clocks_per_tick = e.design.clocks_per_tick();
  t.counts_per_turn = 4 * e.design.lines;
  t.velocity = e.design.velocity;
  t.torque = e.design.torque;
  return t;
}

}  // namespace feltgate::design
