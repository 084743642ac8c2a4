// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Units as written in a law file: products and quotients of symbols with powers and SI prefixes.
// An angle is a number: rad is 1, deg pi/180, turn 2 pi. Documentation: docs/laws.md
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "law/law.hpp"

namespace feltgate::law {

/// The meaning of a unit's text.
struct UnitValue {
  Unit unit;
  double to_si = 1;
};

/// Thrown for a unit's text with an error: its place in the text, what is wrong, mend.
struct UnitError {
  std::size_t offset;
  std::string what, mend;
};

inline bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// One symbol, optionally with a prefix n, u, m, k or M: "Nm", "kHz", "um".
std::optional<UnitValue> unit_symbol(std::string_view symbol);
/// The symbols without their prefixed forms, for suggestions.
const std::vector<std::string>& unit_symbols();

/// Length of the unit at the begin of `text`, 0 if there is none; `value` gets its meaning. Throws
/// UnitError for an ambiguous quotient and for a power beyond 8.
std::size_t scan_unit(std::string_view text, UnitValue& value);

Unit operator+(const Unit& a, const Unit& b);  ///< of a product
Unit operator-(const Unit& a, const Unit& b);  ///< of a quotient
Unit operator*(const Unit& a, int power);
/// The unit as text: "Nm", "kg m^2", "1/s"; "a number" for no unit.
std::string text_of(const Unit& unit);

inline constexpr Unit kNumber{};
inline constexpr Unit kNewtonMetre{{2, 1, -2, 0}};
inline constexpr Unit kSecond{{0, 0, 1, 0}};
inline constexpr Unit kPerSecond{{0, 0, -1, 0}};

// Amounts as a user types them: a number, and a unit behind it or not. One rule for all commands:
// a unit is converted, a bare number is in the unit that `get` prints.

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
