// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Pins of an encoder that a test turns count by count. Documentation: docs/blocks/encoder.md
#pragma once

#include "feltgate/encoder_source.hpp"

namespace feltgate::test {

/// Gray order of (A, B): 00 01 11 10 counts up; any phase, modulo 4.
inline EncoderPins pins_at(unsigned phase, bool z = false) {
  return {(phase & 2U) != 0, ((phase >> 1 ^ phase) & 1U) != 0, z};
}

}  // namespace feltgate::test
