// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Amounts as a user types them: a number, and a unit behind it or not. One rule for all commands:
// a unit is converted, a bare number is in the unit that `get` prints. Documentation: docs/host.md
#pragma once

#include <string>

#include "law/units.hpp"

namespace feltgate::law {

/// The board's own units (one encoder count in rad, one tick in s); 0 when there is no board.
struct BoardUnits {
  double count_rad = 0, tick_s = 0;
};

/// A number and the text of the unit that follows it.
struct Amount {
  double number = 0;
  std::string unit;
};

/// Splits `text` into number and unit. Throws std::invalid_argument when `text` does not begin with
/// a finite number; the message offers `example` as the mend.
Amount read_amount(const std::string& text, const std::string& example);

/// The amount in `text`, converted to `unit` (for example Nm, Nm/count, 128 ticks, rad/s). An empty
/// `unit` or "1" means that the amount has no unit. Throws std::invalid_argument "what; mend" when
/// the text has no number, an unknown unit, or a unit of another quantity.
double amount_in(const std::string& text, const std::string& unit, const BoardUnits& board = {});

}  // namespace feltgate::law
