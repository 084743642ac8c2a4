// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Ports of the Verilated quad_decoder against its twin. Documentation: docs/blocks/quad_decoder.md
#pragma once

#include <Vquad_decoder.h>

#include "feltgate/quad_decoder.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

namespace feltgate::test {

struct QuadDecoderAdapter {
  static void drive(Vquad_decoder& rtl, const QuadDecoder::In& in) {
    FELTGATE_DRIVE(rtl, in, a, b, z, filter, polarity, set_zero, clear_error);
  }
  template <class Check>
  static void compare(Check& check, const Vquad_decoder& rtl, const QuadDecoder::Out& out) {
    check("position", rtl.position_o, out.position);
    check("travel", rtl.travel_o, out.travel);
    check("step", sign_extend<2>(rtl.step_o), out.step);
    FELTGATE_COMPARE(check, rtl, out, levels, count, zero, error, illegal, error_count,
                     rejected_count, index_position, index_wrong, index_seen);
  }
};

using QuadDecoderBench = LockStep<Vquad_decoder, QuadDecoder, QuadDecoderAdapter>;

}  // namespace feltgate::test
