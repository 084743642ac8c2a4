// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/absolute_encoder.hpp"

#include "ports/absolute_encoder.hpp"

using namespace feltgate::test;
using feltgate::AbsoluteEncoder;

namespace {

/// Random bits have the right parity every second time, and so are readings.
struct Twin : BlockTwin<ports::absolute_encoder> {
  void legal(In& in, Random& random) { in.sample = in.sample || random.one_in(100); }
  void clock(const In& in) { block.clock({in.sample, in.data}); }
  Out out(const In&) const {
    const AbsoluteEncoder::Out& o = block.out();
    return {o.select_n, o.serial_clock, o.command, o.position, o.valid, o.starts, o.faults};
  }

  AbsoluteEncoder block;
};

}  // namespace

TEST_CASE("absolute_encoder: RTL and twin, every clock") {
  lock_step(Twin(), {1'600'000, 8, 100'000});
}
