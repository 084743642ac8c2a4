// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The four states of a quadrature pair: counting up, A leads B (00, 10, 11, 01 as AB).
// Documentation: docs/traces.md
#pragma once

#include "feltgate/encoder_source.hpp"

namespace feltgate::traces {

/// Pins at a phase; only its last two bits count, so that any position will do.
constexpr EncoderPins pins_at(unsigned phase) {
  const bool b = (phase & 2U) != 0;
  return {((phase & 1U) != 0) != b, b, false};
}

/// Phase 0 to 3 of A and B: the inverse of pins_at.
constexpr unsigned phase_of(const EncoderPins& pins) {
  return (pins.b ? 2U : 0U) + (pins.a != pins.b ? 1U : 0U);
}

}  // namespace feltgate::traces
