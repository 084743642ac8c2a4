// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the generated headers list of a design: a parameter, a constant. Documentation:
// docs/registers.md
#pragma once

#include <cstdint>

#include "feltgate/format.hpp"

namespace feltgate {

/// Name, unit, place and value of a parameter.
struct ParameterInfo {
  const char* name;
  const char* unit;
  int address;       ///< word address in the parameter RAM
  Format format;     ///< format of the word
  double si;         ///< exact value that the design states, in `unit`
  std::int64_t raw;  ///< the same value, quantised
  Format field;      ///< of its register: a limit has no sign, an integer the bits of the map
};

/// A constant of a design, by its name in the package cfg.
struct NamedConstant {
  const char* name;
  std::int64_t value;
};

/// What a write of `word` to a parameter stores: the nearest word that fits its format. A word with
/// bit 31 is negative. A plain integer, and a number of 32 bits without a sign, take any word.
constexpr std::uint32_t fitted(Format format, std::uint32_t word) {
  const int bits = format.width() - format.sign;
  if (bits >= 31) return word;
  const std::int64_t most = (std::int64_t{1} << bits) - 1;
  const std::int64_t least = format.sign != 0 ? -most - 1 : 0;
  const auto value = static_cast<std::int64_t>(static_cast<std::int32_t>(word));
  return static_cast<std::uint32_t>(value > most ? most : value < least ? least : value);
}

}  // namespace feltgate
