// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// link_transmitter: when its twin says that nothing is under way, or that it waits, nothing
// changes. Documentation: docs/blocks/link_transmitter.md
#include "catch.hpp"
#include "feltgate/link_transmitter.hpp"
#include "random.hpp"

using namespace feltgate;
using feltgate::test::Random;

TEST_CASE("link_transmitter: while it waits nothing changes but by a frame or a byte taken") {
  LinkTransmitter twin;
  REQUIRE(twin.idle());
  REQUIRE(twin.waits());
  Random random(7);
  LinkTransmitter::In in;
  int idle = 0, offered = 0, busy = 0;
  for (int k = 0; k < 200'000; ++k) {
    for (FrameByte* source : {&in.reply, &in.stream}) {
      if (source->valid) continue;
      // Often within a frame, otherwise seldom.
      const bool asked = source == &in.reply ? twin.out().reply_ready : twin.out().stream_ready;
      const bool begins = random.one_in(asked ? 5 : 2'000);
      *source = {begins, static_cast<std::uint8_t>(random.below(256)), random.one_in(4)};
    }
    in.ready = random.one_in(3);
    const bool begins = twin.idle() && (in.reply.valid || in.stream.valid);
    if (twin.waits() && !in.ready && !begins) {
      LinkTransmitter after = twin;
      after.clock(in);
      REQUIRE(after.idle() == twin.idle());
      REQUIRE(after.waits());
      REQUIRE(after.out().valid == twin.out().valid);
      REQUIRE(after.out().byte == twin.out().byte);
      ++(twin.idle() ? idle : offered);
    }
    if (!twin.waits()) ++busy;
    REQUIRE(twin.waits() == (twin.idle() || twin.out().valid));
    if (twin.out().valid || twin.out().reply_ready || twin.out().stream_ready) {
      REQUIRE_FALSE(twin.idle());
    }
    const LinkTransmitter::Out asked = twin.out();
    twin.clock(in);
    // A byte is held until it is taken.
    in.reply.valid = in.reply.valid && !asked.reply_ready;
    in.stream.valid = in.stream.valid && !asked.stream_ready;
  }
  CHECK(idle > 10'000);
  CHECK(offered > 1'000);
  CHECK(busy > 1'000);
}
