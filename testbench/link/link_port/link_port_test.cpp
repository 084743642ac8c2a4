// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// link_port: RTL against twin in every clock, before and after the edge, beside a core's port and a
// slave. Documentation: docs/link.md
#include "feltgate/link_port.hpp"

#include <Vlink_port.h>

#include <vector>

#include "catch.hpp"
#include "lock_step.hpp"
#include "ports.hpp"
#include "random.hpp"
#ifdef LAW
#include "feltgate/generated/lever_law.hpp"
#else
#include "feltgate/generated/lever.hpp"
#endif

using namespace feltgate;
using namespace feltgate::test;

namespace {

#ifdef LAW
using Design = LeverLaw;
#else
using Design = Lever;
#endif
struct Twin : LinkPort<> {
  Twin()
      : LinkPort<>({true, 2, 0x80a06U, Design::design_crc,
                    static_cast<std::uint32_t>(Design::clock_hz), Design::clocks_per_tick,
                    Design::engine != 0}) {}
};

struct Adapter {
  static void drive(Vlink_port& rtl, const Twin::In& in) {
    FELTGATE_DRIVE(rtl, in.request, valid, write, sequence, address, data);
    FELTGATE_DRIVE(rtl, in, good, bad, clear_faults, inputs, tick, reg_busy, reg_rdata, rdata,
                   ready);
  }
  template <class Check>
  static void compare(Check& check, const Vlink_port& rtl, const Twin::Out& out) {
    FELTGATE_COMPARE(check, rtl, out, taken, reg_addr, reg_wdata, reg_write, addr, wdata, write);
    check("valid", rtl.valid_o, out.reply.valid);
    check("byte", rtl.byte_o, out.reply.byte);
    check("last", rtl.last_o, out.reply.last);
  }
};
using Bench = LockStep<Vlink_port, Twin, Adapter>;

/// Requests as link_receiver holds them: until taken, or until the next one.
struct Stimulus {
  Random random;
  Twin::In in{};
  int tick = 0;
  std::int64_t gap = 5;

  Twin::In operator()(std::int64_t) {
    LinkRequest& r = in.request;
    in.good = false;
    in.bad = random.one_in(500);
    if (random.one_in(30)) r.valid = false;
    if (gap-- <= 0) {
      r.valid = !r.valid;
      gap = random.below(r.valid ? 3'000 : 200);
      if (r.valid) {
        r.write = random.coin();
        if (!random.one_in(3)) r.sequence = static_cast<std::uint8_t>(random.below(256));
        static constexpr std::uint16_t base[] = {0, 0x200, 0x300, 0x1000, 0x1000, 0x1020, 0x3ff0};
        r.address = static_cast<std::uint16_t>(base[random.below(7)] + random.below(15));
        if (Design::engine != 0 && random.coin()) r.address |= LinkMap::engine;
        r.data = r.write ? static_cast<std::uint32_t>(random.bits() >> 32) : 1 + random.below(12);
        in.good = true;
      }
    }
    in.clear_faults = random.one_in(700);
    in.inputs = static_cast<std::uint8_t>(random.below(256));
    tick = tick == 49 ? 0 : tick + 1;
    in.tick = tick == 40;
    in.reg_busy = tick == 0 ? false : in.reg_busy || random.one_in(40);
    in.reg_rdata = static_cast<std::uint32_t>(random.bits() >> 32);
    in.rdata = random.coin() ? 0 : static_cast<std::uint32_t>(random.bits() >> 32);
    in.ready = random.one_in(5);
    return in;
  }
};

}  // namespace

TEST_CASE("link_port: requests at random, RTL against twin") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Bench bench("link_port", seed);
    bench.run(Stimulus{Random(seed)}, scaled_clocks(600'000), {seed > 2 ? 5'000U : 0U});
  }
}

TEST_CASE("link_port: a host in a hurry, and one that asks for all words at once") {
  struct Hurry {
    Stimulus host;
    bool writes;
    Twin::In operator()(std::int64_t clock) {
      const bool before = host.in.request.valid;
      if (host.gap > 60) host.gap = host.random.below(60);
      Twin::In in = host(clock);
      LinkRequest& r = host.in.request;
      if (r.valid && !before) {  // each is another one, and replaces what still waits
        r.write = writes;
        ++r.sequence;
        if (!writes) r.data = 1u << host.random.below(7);
        if (host.random.coin())
          r.address ^= static_cast<std::uint16_t>(1u << host.random.below(13));
        in.request = r;
      }
      in.ready = host.random.one_in(writes ? 30 : 1);
      return in;
    }
  };
  for (const bool writes : {false, true}) {
    Bench bench("link_port", 5);
    bench.run(Hurry{Stimulus{Random(writes ? 5 : 6)}, writes}, scaled_clocks(800'000));
  }
}

TEST_CASE("link_port: 2^17 frames, counted to the end of 16 bits and again") {
  const auto stimulus = [](std::int64_t k) {
    Twin::In in;
    in.good = true;
    in.bad = k % 2 == 0;
    in.ready = true;
    in.tick = k % 50 == 0;
    const auto own = static_cast<std::uint16_t>(k / 400 % 2 == 0 ? LinkMap::A::frames_good
                                                                 : LinkMap::A::frames_bad);
    in.request = {k % 200 < 150, false, static_cast<std::uint8_t>(k / 200), own, 1};
    return in;
  };
  Bench bench("link_port", 1);
  bench.run(stimulus, (std::int64_t{1} << 17) + 1000);
}

#ifdef LAW
TEST_CASE("link_port: a word of the engine is taken 40 clocks after the port was last busy") {
  for (const int busy_until : {0, 30, 500}) {
    Twin twin;
    Twin::In in;
    in.request = {true, false, 1, static_cast<std::uint16_t>(LinkMap::engine + 7), 2};
    in.ready = true;
    std::uint32_t sent[12] = {};
    std::size_t bytes = 0;
    int since = 0;  // clocks with the address, not busy
    for (int k = 0; k < 700 && bytes < 12; ++k) {
      in.reg_busy = k < busy_until;
      const Twin::Out out = twin.peek(in);
      in.reg_rdata = since >= 33 ? 0x5000U + out.reg_addr : 0xbadU;
      if (out.reply.valid) sent[bytes++] = out.reply.byte;
      const auto before = out.reg_addr;
      twin.clock(in);
      if (out.taken) in.request.valid = false;
      since = in.reg_busy || twin.peek(in).reg_addr != before ? 0 : since + 1;
    }
    REQUIRE(bytes == 12);
    CHECK(sent[4] + 256 * sent[5] == 0x9007);
    CHECK(sent[8] + 256 * sent[9] == 0x9008);
  }
}
#else

// link_port: when its twin says that it waits, nothing changes while the inputs hold.

using Port = LinkPort<>;

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
#endif
