// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/arming.hpp"

#include "ports/arming.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::arming> {
  static Arming::In request(const In& in) {
    return {in.host,    in.host_arm,     in.panel_arm, in.disarm, in.fault,
            in.stopped, in.kick_missing, in.wait,      in.refuse};
  }
  void clock(const In& in) { block.clock(in.tick, request(in), in.trip, wait_ticks); }
  Out out(const In& in) const {
    const Arming::In a = request(in);
    const bool locks = block.locks(a, wait_ticks);
    return {block.request(a),  block.counts(a), block.ready(a), locks,
            locks && !in.trip, block.armed(),   block.open()};
  }

  Arming block;
  int wait_ticks = Arming::wait_ticks(design());
};

/// Nothing stands against arming, but a request waits: about as long as it may, or a bit longer.
struct Waits : Twin {
  void legal(In& in, Random& random) {
    if (at-- == 0) at = wait_ticks + static_cast<int>(random.between(-3, 20));
    const bool begins = at >= wait_ticks - 5 && random.coin(), wait = at > 3;
    in = {};
    in.tick = true;
    in.panel_arm = !begins;
    in.wait = wait;
  }
  int at = 0;
};

}  // namespace

TEST_CASE("arming: RTL and twin, every clock") { lock_step(Twin(), {800'000}); }

TEST_CASE("arming: a request that waits is refused in the same tick") {
  lock_step(Waits(), {500'000, 1});
}
