// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The door to SystemC's fixed point, the independent oracle. Only <fx.h> is included: all of
// <systemc> would tie the program to one C++ standard at link time. The library wants a sc_main.
// It is not thread-safe: one thread per process uses it. Documentation: docs/fixed-point.md
#pragma once

#include <sysc/datatypes/fx/fx.h>

#include <cstdint>

#include "feltgate/fixed.hpp"

// The library refers to it; the tests bring their own main() and never call it.
extern "C" [[gnu::used]] inline int sc_main(int /*argc*/, char** /*argv*/) { return 0; }

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

inline sc_dt::sc_q_mode systemc_mode(Round round) {
  switch (round) {
    case Round::truncate:
      return sc_dt::SC_TRN;
    case Round::half_up:
      return sc_dt::SC_RND;
    case Round::convergent:
      return sc_dt::SC_RND_CONV;
    case Round::toward_zero:
      return sc_dt::SC_TRN_ZERO;
  }
  return sc_dt::SC_TRN;
}

inline sc_dt::sc_o_mode systemc_mode(Overflow overflow) {
  return overflow == Overflow::wrap ? sc_dt::SC_WRAP : sc_dt::SC_SAT;
}

}  // namespace feltgate::test
