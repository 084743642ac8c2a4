// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The properties of a design that the law compiler needs. Documentation: docs/laws.md
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "feltgate/design_info.hpp"
#include "feltgate/format.hpp"
#include "feltgate/generated/engine.hpp"
#include "law/spans.hpp"

namespace feltgate::law {

struct Target {
  std::string design = "lever";
  std::int64_t tick_hz = 1000000;
  int clocks_per_tick = 50;
  int round_clocks = EngineMap::round_clocks;
  int axes = 1;  ///< axes of the engine; a run reads the inputs of all of them
  int counts_per_turn = 4096;
  Format velocity{1, 10, 21};  ///< rad/s
  Format torque{1, 4, 16};     ///< Nm
  int thread = 0;

  double count_rad() const { return 2 * pi / counts_per_turn; }
  static constexpr double position_counts = 131072;  ///< proofs hold for |position| up to this
};

inline Target target_of(const DesignInfo& design) {
  Target t;
  t.design = design.name;
  t.tick_hz = design.tick_hz;
  t.clocks_per_tick = design.clocks_per_tick;
  t.counts_per_turn = static_cast<int>(std::lround(2 * pi / design.count_rad));
  t.velocity = design.velocity;
  t.torque = design.torque;
  return t;
}

}  // namespace feltgate::law
