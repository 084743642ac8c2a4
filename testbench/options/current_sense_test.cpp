// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/current_sense.hpp"

#include "ports/current_sense.hpp"

using namespace feltgate::test;
using feltgate::CurrentSense;

namespace {

/// Short windows, averages and times, as CMakeLists.txt builds it.
struct Twin : BlockTwin<ports::current_sense> {
  void clock(const In& in) { block.clock({in.data, in.strobe, in.armed, in.clear, in.threshold}); }
  Out out(const In&) const {
    const CurrentSense::Out& o = block.out();
    return {o.modulator_clock, o.current,      o.aligned, o.overcurrent,
            o.calibrated,      o.offset_fault, o.stuck,   o.saturated};
  }

  CurrentSense block{{3, 5, 4, 2, 130, 3, 512}};
};

}  // namespace

TEST_CASE("current_sense: RTL and twin, every clock") { lock_step(Twin(), {1'600'000, 8, 50'000}); }
