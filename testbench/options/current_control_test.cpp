// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/current_control.hpp"

#include "ports/current_control.hpp"

using namespace feltgate::test;
using feltgate::CurrentControl;

namespace {

struct Twin : BlockTwin<ports::current_control> {
  static constexpr int holds = CurrentControl::kLatencyClocks + 1;
  static void strobes(In& in, int clock) { in.valid = clock == 0; }
  void legal(In& in, Random& random) { in.armed = in.armed || !random.one_in(50); }
  void clock(const In& in) {
    const auto word = [](std::uint32_t w) { return static_cast<std::int32_t>(w); };
    block.clock({in.armed, in.valid, in.reference, in.current, in.emf, word(in.proportional),
                 word(in.integral), word(in.limit)});
  }
  Out out(const In&) const { return {block.out().voltage, block.out().resistive}; }

  CurrentControl block;
};

}  // namespace

TEST_CASE("current_control: RTL and twin, every clock") { lock_step(Twin(), {800'000}); }
