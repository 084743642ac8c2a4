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

/// Nothing stands against arming but that a request waits, about as long as it may; at times the
/// host takes over, soon or late, with a request of its own.
struct Waits : Twin {
  void legal(In& in, Random& random) {
    if (left-- == 0) {
      left = length = wait_ticks + static_cast<int>(random.between(-5, 15));
      const auto moment = static_cast<int>(random.between(0, 25));
      handed = random.coin() ? -1 : random.coin() ? moment : length - moment;
    }
    in = {};
    in.tick = true;
    in.host = left < handed;
    in.panel_arm = left < length;
    in.host_arm = in.host;
    in.wait = left > 3;
  }
  int left = 0, length = 0, handed = 0;
};

}  // namespace

TEST_CASE("arming: RTL and twin, every clock") { lock_step(Twin(), {800'000}); }

TEST_CASE("arming: a request that waits is refused in the same tick") {
  lock_step(Waits(), {500'000, 1});
}
