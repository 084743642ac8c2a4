// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// quad_decoder: ports of the RTL against its twin, stimuli and an independent oracle.
// Documentation: docs/blocks/encoder.md
#pragma once

#include <Vquad_decoder.h>

#include <array>
#include <cstdint>
#include <vector>

#include "feltgate/quad_decoder.hpp"
#include "lock_step.hpp"
#include "ports.hpp"
#include "random.hpp"

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

/// Pins at a phase of the cycle 00 01 11 10 of (A,B); any integer, modulo 4.
inline QuadDecoder::In at_phase(int phase) {
  QuadDecoder::In in;
  const int p = phase & 3;
  in.a = p == 2 || p == 3;
  in.b = p == 1 || p == 2;
  return in;
}

/// A list of inputs built by hand: each call appends clocks.
class Script {
 public:
  explicit Script(QuadDecoder::In first) : now(first) {}
  Script& hold(int clocks) {
    for (int k = 0; k < clocks; ++k) list.push_back(now);
    return *this;
  }
  Script& phase(int p, int clocks) {
    const QuadDecoder::In pins = at_phase(p);
    now.a = pins.a;
    now.b = pins.b;
    return hold(clocks);
  }
  QuadDecoder::In now;
  std::vector<QuadDecoder::In> list;
};

/// Settings of a random run: mean distances in clocks; 0: never.
struct Mix {
  std::uint8_t filter = 0;
  bool polarity = false;
  std::uint32_t dwell = 3;      ///< between two steps of the shaft
  std::uint32_t turn = 40;      ///< between two reversals
  std::uint32_t glitch = 0;     ///< between two bursts on a random pin
  std::uint32_t jump = 0;       ///< between two illegal steps
  std::uint32_t index = 50;     ///< between two changes of Z
  std::uint32_t zero = 200;     ///< between two set-zero pulses
  std::uint32_t clear = 2000;   ///< between two clears
  std::uint32_t registers = 0;  ///< between two changes of filter or polarity
};

/// A shaft with random motion, and glitches of 1 to 20 clocks on its pins.
class Wander {
 public:
  Wander(std::uint64_t seed, const Mix& mix) : mix_(mix), random_(seed) {
    in_.filter = mix.filter;
    in_.polarity = mix.polarity;
    phase_ = static_cast<int>(random_.below(4));
  }
  QuadDecoder::In operator()(std::int64_t) {
    if (once(mix_.turn)) up_ = !up_;
    if (once(mix_.dwell)) phase_ += up_ ? 1 : -1;
    if (once(mix_.jump)) phase_ += 2;
    if (once(mix_.index)) z_ = !z_;
    if (once(mix_.glitch)) {
      glitch_channel_ = random_.below(3);
      glitch_left_ = 1 + random_.below(20);
    }
    if (once(mix_.registers)) {
      in_.filter = static_cast<std::uint8_t>(random_.below(16));
      in_.polarity = random_.coin();
    }
    const QuadDecoder::In pins = at_phase(phase_);
    const bool disturbed = glitch_left_ > 0;
    if (disturbed) --glitch_left_;
    in_.a = pins.a != (disturbed && glitch_channel_ == 0);
    in_.b = pins.b != (disturbed && glitch_channel_ == 1);
    in_.z = z_ != (disturbed && glitch_channel_ == 2);
    in_.set_zero = once(mix_.zero);
    in_.clear_error = once(mix_.clear);
    return in_;
  }

 private:
  bool once(std::uint32_t mean) { return mean != 0 && random_.one_in(mean); }

  Mix mix_;
  Random random_;
  QuadDecoder::In in_;
  int phase_ = 0;
  bool up_ = true;
  bool z_ = false;
  std::uint32_t glitch_channel_ = 0;
  std::uint32_t glitch_left_ = 0;
};

/// An independent model of the decoder: a level is valid when the last filter+1 samples agree, the
/// phase is an angle modulo 4, and all outputs have a fixed delay. It shares no code with the twin.
/// The filter must not change during a run.
class Oracle {
 public:
  explicit Oracle(std::int32_t start) : start_(static_cast<std::uint32_t>(start)) { restart(); }

  /// Call it after each clock. Returns nullptr, or the property that the outputs break.
  const char* operator()(const QuadDecoder::In& in, const QuadDecoder::Out& out, bool in_reset) {
    if (in_reset) {
      restart();
      return nullptr;
    }
    const std::uint32_t position = travel_ - zero_;
    if (in.set_zero) zero_ = travel_;
    if (index_) index_position_ = position;
    index_ = false;
    // The sample of two clocks ago takes effect now.
    late_[clock_ % 3] = in;
    const int step = clock_ >= 2 ? accept(late_[(clock_ - 2) % 3]) : 0;
    ++clock_;
    travel_ += static_cast<std::uint32_t>(in.polarity ? -step : step);
    error_ = step_illegal_ || (error_ && !in.clear_error);

    if (static_cast<std::uint32_t>(out.position) != position) return "position follows the phase";
    if (out.travel != (travel_ & 0xffffU)) return "travel follows the phase";
    if (out.step != (in.polarity ? -step : step)) return "step is the change of phase";
    if (out.error != error_) return "error flags a jump of two phases";
    if (static_cast<std::uint32_t>(out.index_position) != index_position_) {
      return "index_position is the position at the rising edge of Z";
    }
    return nullptr;
  }

 private:
  void restart() {
    clock_ = 0;
    travel_ = start_;
    zero_ = 0;
    index_position_ = 0;
    index_ = error_ = step_illegal_ = false;
  }
  int accept(const QuadDecoder::In& in) {
    const std::array<bool, 3> pins{in.a, in.b, in.z};
    const std::uint32_t window = (2U << in.filter) - 1;
    const std::array<bool, 3> before = level_;
    for (std::size_t c = 0; c < 3; ++c) {
      if (clock_ == 2) {  // the first sample is the reference
        level_[c] = pins[c];
        history_[c] = pins[c] ? ~0U : 0U;
        continue;
      }
      history_[c] = (history_[c] << 1) | (pins[c] ? 1U : 0U);
      if ((history_[c] & window) == window) level_[c] = true;
      if ((history_[c] & window) == 0) level_[c] = false;
    }
    step_illegal_ = false;
    if (clock_ == 2) return 0;
    index_ = level_[2] && !before[2];
    const int turned = (angle(level_) - angle(before)) & 3;
    step_illegal_ = turned == 2;
    return turned == 1 ? 1 : (turned == 3 ? -1 : 0);
  }
  static int angle(const std::array<bool, 3>& level) {
    return level[0] ? (level[1] ? 2 : 3) : (level[1] ? 1 : 0);
  }

  std::uint32_t start_;
  std::uint64_t clock_ = 0;
  std::array<QuadDecoder::In, 3> late_{};
  std::array<std::uint32_t, 3> history_{};
  std::array<bool, 3> level_{};
  std::uint32_t travel_ = 0;
  std::uint32_t zero_ = 0;
  std::uint32_t index_position_ = 0;
  bool index_ = false;
  bool error_ = false;
  bool step_illegal_ = false;
};

}  // namespace feltgate::test
