// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/params.hpp"

#include "ports/params.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::params> {
  void legal(In& in, Random& random) {
    in.write = in.write && random.one_in(20);
    if (random.one_in(3))
      in.address = static_cast<std::uint16_t>(random.pick(design().words).address);
    if (random.coin()) in.clock = at;
    at = at < 49 ? at + 1 : 0;
  }
  void clock(const In& in) {
    block.clock(memory, formats(), in.clock, in.scene, in.write, in.address, in.data, in.read_addr);
  }
  Out out(const In&) const {
    Out o;
    o.read_data = filled > 1 ? block.read_data() : any_value;
    o.p = memory.p;
    o.word_error = block.word_error();
    return o;
  }
  void reset(const In& in) {
    block.reset();
    clock(in);  // a write lands, the port goes on
    block.reset();
    if (filled < 2) ++filled;
  }

  ParamsMemory memory{design(), formats()};
  Params block;
  int at = 0;
  int filled = 0;  ///< the port's registers have no reset
};

}  // namespace

TEST_CASE("params: RTL and twin, every clock") {
  lock_step(Twin(), {800'000, 8, 5000, "word_error"});
}
