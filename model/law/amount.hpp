// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Amounts as a user types them: a number, and a unit behind it or not. One rule for all commands:
// a unit is converted, a bare number is in the unit that `get` prints. Documentation: docs/host.md
#pragma once

#include <string>

#include "law/units.hpp"

namespace feltgate::law {

/// What a board's own units are; 0 where there is no board.
struct BoardUnits {
  double count_rad = 0, tick_s = 0;
};

/// A number and the text of the unit behind it.
struct Amount {
  double number = 0;
  std::string unit;
};

/// Throws std::invalid_argument for what begins with no finite number, with `example` as mend.
Amount read_amount(const std::string& text, const std::string& example);

/// The text in `unit`, which is such as Nm, Nm/count, 128 ticks, rad/s; empty and 1: it takes none.
/// Throws std::invalid_argument "what; mend": no number, no unit, a unit of something else.
double amount_in(const std::string& text, const std::string& unit, const BoardUnits& board = {});

}  // namespace feltgate::law
