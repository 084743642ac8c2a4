// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Extremes of the position: the decoder at and beyond its clock, its filter, wraps of 16 and 32
// bits. Documentation: docs/extremes.md
#include <algorithm>
#include <cmath>
#include <string>

#include "campaigns/extremes/bench.hpp"
#include "core/quad_decoder/adapter.hpp"
#include "feltgate/largest.hpp"

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

namespace {

constexpr double count_rad = 6.283185307179586 / 4096;
constexpr double clock_hz = 50e6;

/// States per clock at `quarters`/4; the decoder can detect only jumps of two states as lost.
Outcome states_per_clock(const std::vector<int>& rates) {
  Outcome o;
  for (const int quarters : rates) {
    DecoderPair d;
    d.settle(0);
    constexpr int clocks = 4000;
    std::int64_t state = 0, singles = 0, doubles = 0, backs = 0;
    for (int k = 1; k <= clocks; ++k) {
      const std::int64_t next = static_cast<std::int64_t>(k) * quarters / 4;
      const std::int64_t jump = next - state;
      singles += jump == 1 ? 1 : 0;
      doubles += jump == 2 ? 1 : 0;
      backs += jump == 3 ? 1 : 0;  // three states forward look like one state back
      state = next;
      d.clock(state);
    }
    d.settle(state);
    const std::string at = " at " + number(quarters / 4.0) + " states a clock";
    o.add("counts" + at, "", exactly(static_cast<double>(singles - backs)), d.rtl_moved(),
          d.twin_moved(), state);
    o.findings.back().real_may_differ = singles - backs != state;
    o.add("clocks flagged" + at, "", exactly(static_cast<double>(doubles)), d.rtl_flags(),
          d.twin_flags());
    if (quarters <= 8) {
      o.add("counts lost and not flagged" + at, "", exactly(0),
            state - d.rtl_moved() - 2 * d.rtl_flags(), state - d.twin_moved() - 2 * d.twin_flags());
    }
    d.report(&o);
  }
  return o;
}

Outcome decoder_limit(const Settings&) {
  Outcome o = states_per_clock({4});
  // One state per clock, in rad/s.
  const double limit = count_rad * clock_hz;
  o.add("speed that this is, 1024 lines", "rad/s", near(76699, 0.5), limit, limit, limit);
  o.note = "The double column is the motion itself.";
  return o;
}

Outcome decoder_beyond(const Settings&) {
  Outcome o = states_per_clock({5, 6, 7, 8});
  o.note =
      "A jump of two states is flagged and not counted, so true = counted + 2 x flagged. The "
      "double column is the motion itself.";
  return o;
}

Outcome decoder_aliasing(const Settings&) {
  Outcome o = states_per_clock({10, 12, 14, 16});
  o.note =
      "Beyond two states a clock nothing can be known: a jump of three is counted as one back and "
      "not flagged, a jump of four is invisible. The double column is the motion itself.";
  return o;
}

/// Returns the least clocks per state at which the filter of F samples still counts every state.
std::pair<int, int> least_dwell(int filter) {
  int rtl = 99, twin = 99;
  for (int dwell = 16; dwell >= 1; --dwell) {
    DecoderPair d;
    d.set_filter(filter);
    d.settle(0);
    constexpr int states = 200;
    for (int k = 1; k <= states; ++k) {
      for (int c = 0; c < dwell; ++c) d.clock(k);
    }
    d.settle(states);
    if (d.rtl_moved() == states) rtl = dwell;
    if (d.twin_moved() == states) twin = dwell;
    if (d.rtl_moved() != states && d.twin_moved() != states) break;
  }
  return {rtl, twin};
}

Outcome filter_limit(const Settings&) {
  Outcome o;
  for (const int f : {0, 1, 4, 7, 8, 15}) {
    // A channel keeps its level for two states; the filter accepts it after F + 1 samples.
    const int expected = (f + 2) / 2;
    const auto [rtl, twin] = least_dwell(f);
    o.add("least clocks per state, filter " + number(f), "clock", exactly(expected), rtl, twin);
    if (f == 15) {
      o.add("speed that this is, 1024 lines", "rad/s", near(9587, 0.5), count_rad * clock_hz / rtl,
            count_rad * clock_hz / twin);
    }
  }
  o.note = "200 states per trial, the decoder alone.";
  return o;
}

Outcome wrap_16(const Settings&) {
  // The velocity's 16-bit travel wraps at 613.6 rad/s; the difference over a window must stay
  // correct.
  Outcome o;
  for (const char* design : {"lever", "paper"}) {
    Bench b(design, Cores::lock_step);
    b.set("overspeed", 900);
    // Most of the way at one state per clock, the last thousands of states at the tested speed.
    constexpr std::int64_t fast = 28000, slow = 8000;
    b.run(4);
    const Clock from = b.now() + 50;
    for (std::int64_t k = 0; k < fast; ++k) b.move(from + k, 1);
    b.run(b.ticks(28e-3));
    const double speed = 613.6;
    b.turn(b.now(), speed / count_rad, slow);
    double low = 1e9, high = -1e9, real_low = 1e9, real_high = -1e9;
    std::int64_t position = 0, travel = 0, wrapped = 0, widest = 0;
    const std::int64_t settle = b.ticks(11e-3);
    const std::int64_t length =
        std::llround(static_cast<double>(slow) * count_rad / speed * 1e6) - 2;
    std::int64_t k = 0;
    b.run(length, [&](const Sample& x) {
      if (x.raw.travel < travel - 30000) wrapped = x.raw.position;
      travel = x.raw.travel;
      position = x.raw.position;
      widest = std::max<std::int64_t>(widest, std::abs(position));
      if (++k < settle) return;
      low = smaller(low, x.core.velocity_rad_s);
      high = larger(high, x.core.velocity_rad_s);
      real_low = smaller(real_low, x.real.velocity_rad_s);
      real_high = larger(real_high, x.real.velocity_rad_s);
    });
    const std::string in = std::string(" (") + design + ")";
    // 2^n counts of the window, whose number moves by one; the start has decayed by exp(-5.5).
    const double gain = std::string(design) == "paper" ? 4 * 386e-6 : 2 * 767e-6;
    const double exact = speed / count_rad * gain;
    const double start = exact * std::exp(-500 * 10.2e-3);
    const double step = std::string(design) == "paper" ? 4 : 2;
    o.add(Cores::lock_step, "position at which travel wraps" + in, "count", near(32768, 1),
          wrapped);
    o.add(Cores::lock_step, "lowest velocity over the wrap" + in, "rad/s",
          between(exact - start - step, exact + step), low, real_low);
    o.add(Cores::lock_step, "highest velocity over the wrap" + in, "rad/s",
          between(exact - start - step, exact + step), high, real_high);
    b.report(&o);
  }
  return o;
}

Outcome wrap_32(const Settings&) {
  Outcome o;
  DecoderPair d;
  d.settle(0);
  // Over 2^31 and back, one state a clock; counts modulo 2^32 stay exact.
  constexpr std::int64_t over = 2147483648LL - DecoderPair::reset_position;  // counts to the wrap
  for (std::int64_t k = 1; k <= over; ++k) d.clock(k);
  d.settle(over);
  o.add("position after 2^31 counts", "count", exactly(-2147483648.0), d.rtl_position(),
        d.twin_position());
  for (std::int64_t k = over; k <= 3 * over; ++k) d.clock(k);
  d.settle(3 * over);
  o.add("counts from start across the wrap", "count", exactly(3 * over), d.rtl_moved(),
        d.twin_moved());
  for (std::int64_t k = 3 * over; k >= 0; --k) d.clock(k);
  d.settle(0);
  o.add("back at the start", "count", exactly(DecoderPair::reset_position), d.rtl_position(),
        d.twin_position());
  const double hours = 2147483648.0 * count_rad / 613.6 / 3600;
  o.add("time to the wrap at 613.6 rad/s, one way", "h", near(1.49, 0.005), hours, hours, hours);
  d.report(&o);
  o.note = "The decoder alone; its count starts 648 below the wrap.";
  return o;
}

}  // namespace

std::vector<Case> encoder_cases() {
  return {
      {"Encoder", "decoder_limit", "One state on every clock: nothing is lost and nothing flagged.",
       decoder_limit},
      {"Encoder", "decoder_beyond",
       "Between one and two states a clock: everything that is not counted is flagged.",
       decoder_beyond},
      {"Encoder", "decoder_aliasing",
       "From two to four states a clock: jumps of three count backwards, jumps of four vanish, "
       "without a flag.",
       decoder_aliasing},
      {"Encoder", "filter_limit",
       "With the glitch filter on, a state must last ceil((F+1)/2) clocks.", filter_limit},
      {"Encoder", "wrap_16",
       "The 16-bit travel wraps in the middle of a turn at 613.6 rad/s; the velocity does not see "
       "it.",
       wrap_16},
      {"Encoder", "wrap_32", "The 32-bit position wraps forth and back; nothing is lost.", wrap_32},
  };
}

}  // namespace feltgate::extremes
