// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// link_transmitter: RTL against twin on every clock; each frame arrives whole, between two ENDs, as
// the page says it. When its twin says that nothing is under way, or that it waits, nothing
// changes. Documentation: docs/link.md
#include "feltgate/link_transmitter.hpp"

#include <Vlink_transmitter.h>

#include <deque>
#include <memory>

#include "../feltgate_linked/frames.hpp"
#include "catch.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Twin = LinkTransmitter;

struct Adapter {
  static void drive(Vlink_transmitter& rtl, const Twin::In& in) {
    rtl.reply_valid_i = in.reply.valid;
    rtl.reply_byte_i = in.reply.byte;
    rtl.reply_last_i = in.reply.last;
    rtl.stream_valid_i = in.stream.valid;
    rtl.stream_byte_i = in.stream.byte;
    rtl.stream_last_i = in.stream.last;
    rtl.ready_i = in.ready;
  }
  template <class Check>
  static void compare(Check& check, const Vlink_transmitter& rtl, const Twin::Out& out) {
    FELTGATE_COMPARE(check, rtl, out, reply_ready, stream_ready, valid, byte);
  }
};
using Bench = LockStep<Vlink_transmitter, Twin, Adapter>;

/// Frames of one source, a byte at a time, held until it is taken.
struct Source {
  Bytes body;
  std::size_t at = 0;
  int gap = 0;

  FrameByte next(Random& random, bool taken, std::uint8_t first) {
    if (taken) {
      gap = random.one_in(4) ? static_cast<int>(random.below(30)) : 0;
      if (++at == body.size()) {
        body.clear();
        gap = random.coin() ? static_cast<int>(random.below(1000)) : 0;
      }
    }
    if (gap-- > 0) return {};
    if (body.empty()) {
      body = {first};
      const std::uint32_t more = 3 + random.below(30);
      for (std::uint32_t k = 0; k < more; ++k) {
        static constexpr std::uint8_t special[] = {0xc0, 0xdb, 0xdc, 0xdd};
        body.push_back(random.one_in(3) ? special[random.below(4)]
                                        : static_cast<std::uint8_t>(random.below(256)));
      }
      at = 0;
    }
    return {true, body[at], at + 1 == body.size()};
  }
};

struct Stimulus {
  explicit Stimulus(std::uint64_t seed) : random(seed) {}

  Random random;
  Source reply, stream;
  Twin::In in{};
  Twin::Out before{};

  Twin::In operator()(std::int64_t, const Twin::Out& out) {
    const bool reply_taken = in.reply.valid && before.reply_ready;
    const bool stream_taken = in.stream.valid && before.stream_ready;
    in.reply = reply.next(random, reply_taken, 0x81);
    in.stream = stream.next(random, stream_taken, 0x40);
    in.ready = random.one_in(8);
    before = out;
    return in;
  }
};

/// Checks that the bytes taken from the sources come out as frames, one after the other.
struct Wire {
  struct Seen {
    Bytes taken, sent;
    std::deque<Bytes> frames;
    std::int64_t arrived[2] = {};
    Twin::Out before{};
  };
  std::shared_ptr<Seen> seen;

  const char* operator()(const Twin::In& in, const Vlink_transmitter&, const Twin& twin,
                         bool in_reset) {
    Seen& s = *seen;
    if (in_reset) {
      s.taken.clear();
      s.sent.clear();
      s.frames.clear();
      s.before = twin.out();
      return nullptr;
    }
    const char* broken = nullptr;
    if (s.before.reply_ready && in.reply.valid) take(in.reply);
    if (s.before.stream_ready && in.stream.valid) take(in.stream);
    if (s.before.valid && in.ready) {
      s.sent.push_back(s.before.byte);
      if (s.sent.size() > 1 && s.before.byte == 0xc0) {
        if (s.frames.empty() || s.frames.front() != s.sent) broken = "a frame is what was taken";
        if (!s.frames.empty()) s.frames.pop_front();
        ++s.arrived[s.sent[1] == 0x40];
        s.sent.clear();
      }
    }
    s.before = twin.out();
    return broken;
  }
  void take(const FrameByte& b) {
    seen->taken.push_back(b.byte);
    if (!b.last) return;
    seen->frames.push_back(framed(seen->taken));
    seen->taken.clear();
  }
};

}  // namespace

TEST_CASE("link_transmitter: two sources, RTL against twin, frames as the page says") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    auto seen = std::make_shared<Wire::Seen>();
    Bench bench("link_transmitter", seed);
    bench.run(Stimulus(seed), scaled_clocks(500'000), {seed == 4 ? 20'000U : 0U}, Wire{seen});
    CHECK(seen->arrived[0] > 100);
    CHECK(seen->arrived[1] > 20);
  }
}

TEST_CASE("link_transmitter: a reply goes first") {
  Twin twin;
  Twin::In in;
  in.reply = {true, 1, true};
  in.stream = {true, 2, true};
  in.ready = true;
  int replies = 0, streams = 0;
  for (int k = 0; k < 2000; ++k) {
    replies += twin.out().reply_ready;
    streams += twin.out().stream_ready;
    twin.clock(in);
  }
  CHECK(replies > 10);
  CHECK(streams == 0);
}

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
