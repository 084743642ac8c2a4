// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Ports of the Verilated quad_decoder against its twin. Documentation: docs/blocks/quad_decoder.md
#pragma once

#include <Vquad_decoder.h>

#include "feltgate/quad_decoder.hpp"
#include "lock_step.hpp"

namespace feltgate::test {

struct QuadDecoderAdapter {
  static void drive(Vquad_decoder& rtl, const QuadDecoder::In& in) {
    rtl.a_i = in.a;
    rtl.b_i = in.b;
    rtl.z_i = in.z;
    rtl.filter_i = in.filter;
    rtl.polarity_i = in.polarity;
    rtl.set_zero_i = in.set_zero;
    rtl.clear_error_i = in.clear_error;
  }
  template <class Check>
  static void compare(Check& check, const Vquad_decoder& rtl, const QuadDecoder::Out& out) {
    check("position", rtl.position_o, out.position);
    check("travel", rtl.travel_o, out.travel);
    check("step", sign_extend<2>(rtl.step_o), out.step);
    check("levels", rtl.levels_o, out.levels);
    check("count", rtl.count_o, out.count);
    check("zero", rtl.zero_o, out.zero);
    check("error", rtl.error_o, out.error);
    check("illegal", rtl.illegal_o, out.illegal);
    check("error_count", rtl.error_count_o, out.error_count);
    check("rejected_count", rtl.rejected_count_o, out.rejected_count);
    check("index_position", rtl.index_position_o, out.index_position);
    check("index_wrong", rtl.index_wrong_o, out.index_wrong);
    check("index_seen", rtl.index_seen_o, out.index_seen);
  }
};

using QuadDecoderBench = LockStep<Vquad_decoder, QuadDecoder, QuadDecoderAdapter>;

}  // namespace feltgate::test
