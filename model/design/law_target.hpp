// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What a law is compiled for: rates and formats of a design. Documentation: docs/law-compiler.md
#pragma once

#include "design/design.hpp"
#include "law/target.hpp"

namespace feltgate::design {

/// What a law's compiler must know of a design.
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
