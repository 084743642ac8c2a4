// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/pwm_three_phase.hpp"

#include "ports/pwm_three_phase.hpp"

using namespace feltgate::test;
using feltgate::PwmThreePhase;

namespace {

/// A short period, as CMakeLists.txt builds it.
struct Twin : BlockTwin<ports::pwm_three_phase> {
  void clock(const In& in) {
    const auto on = [](std::uint16_t clocks) { return static_cast<std::int16_t>(clocks); };
    block.clock({in.clear, in.enable, on(in.on_a), on(in.on_b), on(in.on_c)});
  }
  Out out(const In& in) const {
    const PwmThreePhase::Out& o = block.out();
    const bool open = !in.clear;
    return {open && o.gate_a_hi, open && o.gate_a_lo, open && o.gate_b_hi, open && o.gate_b_lo,
            open && o.gate_c_hi, open && o.gate_c_lo, o.period_start};
  }
  /// The stop clears the gates without a clock.
  static void asynchronous(In& between, const In& in) { between.clear = in.clear; }

  PwmThreePhase block{24, 3, 4};
};

}  // namespace

TEST_CASE("pwm_three_phase: RTL and twin, every clock") { lock_step(Twin(), {800'000}); }
