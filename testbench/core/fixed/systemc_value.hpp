// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Exact values for SystemC's fixed point, the independent oracle. Documentation:
// docs/fixed-point.md
#pragma once

#include <cstdint>

#include "feltgate/fixed.hpp"
#include "studies/bench/systemc_numbers.hpp"

namespace feltgate::test {

/// raw * 2^-fraction as SystemC's unbounded fixed-point value, exactly.
inline sc_dt::sc_fxval systemc_value(int128_t raw, int fraction) {
  const auto high = static_cast<std::int64_t>(raw >> 63);
  const auto low = static_cast<std::int64_t>(raw & ones<int128_t>(63));
  sc_dt::sc_fxval value(static_cast<sc_dt::int64>(high));
  value <<= 63;
  value += sc_dt::sc_fxval(static_cast<sc_dt::int64>(low));
  return fraction >= 0 ? value >> fraction : value << -fraction;
}

}  // namespace feltgate::test
