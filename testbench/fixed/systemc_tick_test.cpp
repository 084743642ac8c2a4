// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Trajectory of a whole control tick: `fixed` against the same equations in SystemC's sc_fixed,
// every state of every tick; the first diverging tick and signal are named.
// FELTGATE_DEFECT=1..4 breaks the chain. Documentation: docs/fixed-point.md
#include <sstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "seeded_defect.hpp"
#include "systemc_value.hpp"
#include "tick_chain.hpp"

namespace {

using namespace feltgate;
using namespace feltgate::test;
using sc_dt::sc_fixed;
using sc_dt::sc_fxval;
using sc_dt::sc_ufixed;

/// The tick written for SystemC: intermediates are sc_fxval (exact), each assignment narrows.
/// Formats are (width, integer bits with sign): [S,I,F] is <S+I+F, S+I>.
class SystemCTick {
 public:
  explicit SystemCTick(std::int32_t count)
      : delay_(tick::window, sc_fixed<32, 32>(static_cast<int>(count))) {}

  TickStates tick(const TickStimulus& in) {
    const sc_fixed<32, 32> now = in.count;
    const sc_fixed<32, 32, sc_dt::SC_TRN, sc_dt::SC_WRAP> difference = now - delay_[position_];
    delay_[position_] = now;
    position_ = (position_ + 1) % delay_.size();
    const sc_fixed<11, 11, sc_dt::SC_TRN, sc_dt::SC_SAT> raw = difference * 2;

    const sc_fixed<45, 12, sc_dt::SC_RND, sc_dt::SC_WRAP> velocity_step =
        a1_ * (raw - velocity_state_);
    velocity_state_ = velocity_state_ + velocity_step;
    const sc_fixed<32, 11, sc_dt::SC_RND, sc_dt::SC_SAT> velocity = velocity_state_;

    const sc_fxval inertia_torque = inertia_ * velocity;
    const sc_fixed<40, 10, sc_dt::SC_RND, sc_dt::SC_SAT> input = ktn_ * current_ + inertia_torque;
    const sc_fixed<41, 11, sc_dt::SC_RND, sc_dt::SC_WRAP> observer_step = a1_ * (input - observer_);
    observer_ = observer_ + observer_step;
    const sc_fixed<21, 5, sc_dt::SC_RND, sc_dt::SC_SAT> tau_hat = observer_ - inertia_torque;

    const sc_fxval torque_ref = systemc_value(in.torque_ref, 16);
    current_ = by_ref_ * torque_ref + by_hat_ * tau_hat;
    if (current_ > limit_) current_ = limit_;
    if (current_ < -limit_) current_ = -limit_;

    const bool low = torque_ref < border_ && torque_ref > -border_;
    const sc_fixed<20, 6, sc_dt::SC_RND_CONV, sc_dt::SC_SAT> voltage =
        (low ? kv_low_ : kv_high_) * current_;
    const sc_fixed<13, 13, sc_dt::SC_TRN_ZERO, sc_dt::SC_SAT> duty = duty_ * voltage;
    return {integer(raw, 0),       integer(velocity_state_, 33),
            integer(velocity, 21), integer(observer_, 30),
            integer(tau_hat, 16),  integer(current_, 16),
            integer(voltage, 14),  integer(duty, 0)};
  }

 private:
  /// The raw value: x * 2^fraction, which has no fraction left.
  static std::int64_t integer(const sc_fxval& x, int fraction) {
    return static_cast<std::int64_t>((x << fraction).to_int64());
  }

  std::vector<sc_fixed<32, 32>> delay_;
  std::size_t position_ = 0;
  sc_fixed<44, 11, sc_dt::SC_TRN, sc_dt::SC_SAT> velocity_state_ = 0;
  sc_fixed<40, 10, sc_dt::SC_TRN, sc_dt::SC_SAT> observer_ = 0;
  sc_fixed<22, 6, sc_dt::SC_RND, sc_dt::SC_SAT> current_ = 0;
  const sc_ufixed<18, -10> a1_ = systemc_value(tick::a1, 28);
  const sc_ufixed<16, -2> inertia_ = systemc_value(tick::inertia, 18);
  const sc_ufixed<16, -4> ktn_ = systemc_value(tick::ktn, 20);
  const sc_ufixed<18, 4> by_ref_ = systemc_value(tick::by_ref, 14);
  const sc_ufixed<15, 2> by_hat_ = systemc_value(tick::by_hat, 13);
  const sc_fxval kv_low_ = systemc_value(tick::kv_low, 14);
  const sc_fxval kv_high_ = systemc_value(tick::kv_high, 14);
  const sc_fxval border_ = systemc_value(tick::border, 16);
  const sc_fxval limit_ = systemc_value(tick::limit, 16);
  const sc_ufixed<18, 6> duty_ = systemc_value(tick::duty, 12);
};

struct Comparison {
  std::uint64_t hash_a;
  std::uint64_t hash_b;
  std::string first_divergence;  ///< empty when there is none
};

/// Two chains with `TickStates tick(const TickStimulus&)` on one stimulus.
template <class A, class B>
Comparison compare(A& a, B& b, long ticks) {
  TickPattern pattern;
  TrajectoryHash hash_a;
  TrajectoryHash hash_b;
  std::ostringstream first;
  for (long k = 0; k < ticks; ++k) {
    const TickStimulus in = pattern.next();
    const TickStates x = a.tick(in);
    const TickStates y = b.tick(in);
    hash_a.add(x);
    hash_b.add(y);
    for (std::size_t s = 0; s < tick_signals && x != y && first.tellp() == 0; ++s) {
      if (x[s] != y[s]) {
        first << "tick " << k << ", " << tick_signal_names[s] << ": " << x[s] << " and " << y[s];
      }
    }
  }
  return {hash_a.value(), hash_b.value(), first.str()};
}

template <int Defect>
Comparison compare_with_systemc(long ticks, TickSaturations& saturations) {
  FixedTick<Defect> ours(TickPattern::first_count);
  SystemCTick theirs(TickPattern::first_count);
  Comparison result = compare(ours, theirs, ticks);
  saturations = ours.saturations();
  return result;
}

Comparison compare_under_test(long ticks, TickSaturations& saturations) {
  switch (seeded_defect()) {
    case kUnlimitedCurrentToObserver:
      return compare_with_systemc<kUnlimitedCurrentToObserver>(ticks, saturations);
    case kTruncatedLowPass:
      return compare_with_systemc<kTruncatedLowPass>(ticks, saturations);
    case kNarrowObserverSum:
      return compare_with_systemc<kNarrowObserverSum>(ticks, saturations);
    case kOneTickLate:
      return compare_with_systemc<kOneTickLate>(ticks, saturations);
    default:
      return compare_with_systemc<0>(ticks, saturations);
  }
}

}  // namespace

TEST_CASE("300 000 ticks of the chain have the same trajectory in fixed and in SystemC",
          "[fixed][systemc]") {
  constexpr long ticks = 300000;
  TickSaturations s;
  const Comparison result = compare_under_test(ticks, s);
  WARN("trajectory hash " << std::hex << result.hash_a << std::dec << " over " << ticks
                          << " ticks; saturated: raw velocity " << s.raw_velocity << ", tau_hat "
                          << s.tau_hat << ", current " << s.current);
  INFO("first divergence: " << result.first_divergence);
  CHECK(result.first_divergence.empty());
  CHECK(result.hash_a == result.hash_b);
  for (const long count : {s.raw_velocity, s.tau_hat, s.current}) {
    CHECK(count > 0);
    CHECK(count < ticks / 5);
  }
}
