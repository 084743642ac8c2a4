// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/snapshot.hpp"

#include "block_signals.hpp"
#include "ports/snapshot.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::snapshot> {
  void legal(In& in, Random& random) {
    in.freeze = in.freeze && in.tick;
    in.thaw = in.thaw && in.tick;
    if (random.coin()) in.read_addr = Map::C::read_duty - Map::C::snapshot;
  }
  void clock(const In& in) {
    block.clock(memory, in.tick, in.begin, in.end, in.freeze, in.thaw, values_of(in.values),
                in.read_addr);
  }
  Out out(const In&) const {
    const SnapshotWord& w = block.word;
    return {filled > 1 ? block.read_data() : any_value, {w.valid, w.place, w.data}};
  }
  void reset(const In& in) {
    block.reset();
    block.read(memory, in.read_addr);
    if (filled < 2) ++filled;
  }

  Snapshot block;
  Snapshot::Memory memory{};
  int filled = 0;  ///< the port's registers have no reset
};

}  // namespace

TEST_CASE("snapshot: RTL and twin, every clock") { lock_step(Twin(), {800'000}); }
