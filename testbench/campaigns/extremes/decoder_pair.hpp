// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The decoder alone, RTL and twin in lock-step. It is fast enough for a new state on every clock,
// and its count can start at any value. Documentation: docs/extremes.md
#pragma once

#include <string>

#include "campaigns/extremes/bench.hpp"
#include "encoder/quad_decoder/adapter.hpp"

namespace feltgate::extremes {

class DecoderPair {
 public:
  /// The RTL was verilated with this ResetPosition.
  static constexpr std::int32_t reset_position = 2147483000;

  DecoderPair() { rtl_.reset(1); }

  void set_filter(int samples) { in_.filter = static_cast<std::uint8_t>(samples); }

  /// Runs one clock with the pins of this state.
  void clock(std::int64_t state) {
    const EncoderPins pins = pins_at(state);
    in_.a = pins.a;
    in_.b = pins.b;
    test::QuadDecoderAdapter::drive(*rtl_, in_);
    rtl_.clock();
    twin_.clock(in_);
    test::Check check;
    test::QuadDecoderAdapter::compare(check, *rtl_, twin_.out());
    mismatches_ += check.failed() ? 1 : 0;
    ++clocks_;
    rtl_flags_ += rtl_->illegal_o != 0 ? 1 : 0;
    twin_flags_ += twin_.out().illegal ? 1 : 0;
  }
  /// Holds the state until every counter has processed it.
  void settle(std::int64_t state) {
    for (int k = 0; k < 40; ++k) clock(state);
  }

  /// Counts since reset, modulo 2^32, and clocks flagged as illegal.
  std::int64_t rtl_moved() const { return moved(static_cast<std::int32_t>(rtl_->position_o)); }
  std::int64_t twin_moved() const { return moved(twin_.out().position); }
  std::int32_t rtl_position() const { return static_cast<std::int32_t>(rtl_->position_o); }
  std::int32_t twin_position() const { return twin_.out().position; }
  std::int64_t rtl_flags() const { return rtl_flags_; }
  std::int64_t twin_flags() const { return twin_flags_; }

  void report(Outcome* outcome) const {
    outcome->rtl_s += static_cast<double>(clocks_) * 20e-9;
    outcome->twin_s += static_cast<double>(clocks_) * 20e-9;
    if (mismatches_ > 0 && outcome->mismatches == 0) outcome->first_mismatch = "decoder";
    outcome->mismatches += mismatches_;
  }

 private:
  static std::int64_t moved(std::int32_t position) {
    const std::uint32_t d =
        static_cast<std::uint32_t>(position) - static_cast<std::uint32_t>(reset_position);
    return static_cast<std::int32_t>(d);
  }

  RtlModel<Vquad_decoder> rtl_{1};
  QuadDecoder twin_{reset_position};
  QuadDecoder::In in_;
  std::int64_t clocks_ = 0, mismatches_ = 0, rtl_flags_ = 0, twin_flags_ = 0;
};

}  // namespace feltgate::extremes
