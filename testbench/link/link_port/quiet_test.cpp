// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// link_port: when its twin says that it waits, nothing changes while the inputs hold.
// Documentation: docs/link.md
#include <vector>

#include "catch.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/link_port.hpp"
#include "random.hpp"

using namespace feltgate;
using feltgate::test::Random;
using Port = LinkPort<Lever>;

namespace {

bool same(const Port::Out& a, const Port::Out& b) {
  return a.taken == b.taken && a.reg_addr == b.reg_addr && a.reg_wdata == b.reg_wdata &&
         a.reg_write == b.reg_write && a.addr == b.addr && a.wdata == b.wdata &&
         a.write == b.write && a.reply.valid == b.reply.valid && a.reply.byte == b.reply.byte &&
         a.reply.last == b.reply.last;
}

/// Clocks in which it waits, of one life with requests at random.
struct Waits {
  int idle = 0, reply = 0, busy = 0;
};

Waits lived(std::uint64_t seed) {
  Random random(seed);
  Port twin({true, 2, 0});
  Port::In in;
  Waits found;
  std::uint8_t sequence = 0;
  for (int k = 0; k < 50'000; ++k) {
    const bool taken = twin.peek(in).taken;
    twin.clock(in);
    if (taken) in.request.valid = false;
    in.good = in.bad = false;
    if (!in.request.valid && random.one_in(60)) {
      in.request.write = random.coin();
      in.request.sequence = random.one_in(4) ? sequence : ++sequence;
      in.request.address = static_cast<std::uint16_t>(
          random.coin() ? random.below(1024) : LinkMap::words + random.below(32));
      in.request.data = 1 + random.below(3);
      in.request.valid = random.one_in(5);  // else a frame that is no request changes the words
      in.good = in.request.valid;
      in.bad = !in.good;
    }
    in.clear_faults = random.one_in(300);
    in.tick = random.one_in(50);
    in.reg_busy = random.one_in(3);
    in.reg_rdata = random.below(1u << 31);
    in.ready = random.one_in(8);
    Port::In held = in;
    held.ready = false;
    if (!twin.waits(held)) {
      ++found.busy;
      continue;
    }
    Port after = twin;
    after.clock(held);
    REQUIRE(after.waits(held));
    REQUIRE(same(after.peek(held), twin.peek(held)));
    // What a word of the link says, and a later request, are as if the clock had not been.
    Port::In later = held;
    later.request = {true, false, 9, LinkMap::A::frames_good, 1};
    Port a = after, b = twin;
    for (int n = 0; n < 40; ++n) {
      later.ready = true;
      REQUIRE(same(a.peek(later), b.peek(later)));
      const bool read = a.peek(later).taken;
      a.clock(later);
      b.clock(later);
      if (read) later.request.valid = false;
    }
    ++(twin.reply().valid ? found.reply : found.idle);
  }
  return found;
}

}  // namespace

TEST_CASE("link_port: while it waits nothing changes") {
  const Waits found = lived(3);
  CHECK(found.idle > 1'000);
  CHECK(found.reply > 1'000);
  CHECK(found.busy > 1'000);
}

TEST_CASE("link_port: what it does not wait in") {
  Port twin;
  Port::In in;
  twin.clock(in);
  CHECK(twin.waits(in));
  for (bool Port::In::*news : {&Port::In::good, &Port::In::bad, &Port::In::clear_faults}) {
    Port::In changed = in;
    changed.*news = true;
    CHECK_FALSE(twin.waits(changed));
  }
  // The panel's clear waits for the port.
  in.clear_faults = in.reg_busy = true;
  twin.clock(in);
  in.clear_faults = false;
  CHECK_FALSE(twin.waits(in));
  in.reg_busy = false;
  twin.clock(in);
  CHECK(twin.waits(in));
  // A read that is not taken yet, and a write that is not done.
  in.request = {true, false, 1, 0x1000, 1};
  CHECK_FALSE(twin.waits(in));
  in.request.write = true;
  CHECK_FALSE(twin.waits(in));
  // Another address, or kind, of a request that does not stand is still taken over.
  in.request = {};
  CHECK(twin.waits(in));
  in.request.address = 5;
  CHECK_FALSE(twin.waits(in));
  twin.clock(in);
  CHECK(twin.waits(in));
  in.request.write = true;
  CHECK_FALSE(twin.waits(in));
}

TEST_CASE(
    "link_port: a board of which nothing is said has the number 0, no features, no simulation") {
  for (const std::uint16_t address : {LinkMap::A::board, LinkMap::A::features}) {
    Port twin;
    Port::In in;
    in.request = {true, false, 3, address, 1};
    in.ready = true;
    std::vector<unsigned> bytes;
    for (int k = 0; k < 100; ++k) {
      const bool taken = twin.peek(in).taken;
      if (twin.reply().valid) bytes.push_back(twin.reply().byte);
      twin.clock(in);
      if (taken) in.request.valid = false;
    }
    CAPTURE(address);
    REQUIRE(bytes.size() == 8);
    for (std::size_t k = 4; k < 8; ++k) CHECK(bytes[k] == 0);
  }
}
