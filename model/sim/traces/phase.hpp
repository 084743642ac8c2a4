// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The four states of a quadrature pair: counting up, B leads A (00, 01, 11, 10 as AB).
// Documentation: docs/traces.md
#pragma once

#include "feltgate/encoder_source.hpp"

namespace feltgate::traces {

/// Pins at a phase; only its last two bits count, so that any position will do.
constexpr EncoderPins pins_at(unsigned phase) {
  const bool a = (phase & 2U) != 0;
  return {a, ((phase & 1U) != 0) != a, false};
}

/// Phase 0 to 3 of A and B: the inverse of pins_at.
constexpr unsigned phase_of(const EncoderPins& pins) {
  return (pins.a ? 2U : 0U) + (pins.a != pins.b ? 1U : 0U);
}

}  // namespace feltgate::traces
