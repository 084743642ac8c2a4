// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// link_receiver: RTL against twin on every clock, and both against a reader of the wire that was
// written from the page. Documentation: docs/link.md
#include "feltgate/link_receiver.hpp"

#include <Vlink_receiver.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "../feltgate_linked/frames.hpp"
#include "catch.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

struct Twin : LinkReceiver {
  Twin() : LinkReceiver(ENGINE != 0) {}
};
/// As the page says it of such a board.
WireReader reader_of_page() {
  WireReader reader;
  reader.engine = ENGINE != 0;
  return reader;
}

struct Adapter {
  static void drive(Vlink_receiver& rtl, const Twin::In& in) {
    FELTGATE_DRIVE(rtl, in, byte, valid, error, taken);
  }
  template <class Check>
  static void compare(Check& check, const Vlink_receiver& rtl, const Twin::Out& out) {
    FELTGATE_COMPARE(check, rtl, out.request, valid, write, sequence, address, data);
    check("good", rtl.good_o, out.good);
    check("bad", rtl.bad_o, out.bad);
  }
};
using Bench = LockStep<Vlink_receiver, Twin, Adapter>;

/// A byte every 10 to 30 clocks; requests are taken at any time.
struct Stimulus {
  Stimulus(std::uint64_t seed, bool with_errors) : frames{Random(seed)}, errors(with_errors) {}

  RandomFrames frames;
  bool errors;
  Bytes wire;
  std::size_t at = 0;
  int gap = 0;
  Twin::In in{};

  Twin::In operator()(std::int64_t, const Twin::Out& out) {
    in = {};
    Random& random = frames.random;
    in.taken = out.request.valid && random.one_in(100);
    if (gap-- > 0) return in;
    gap = 9 + static_cast<int>(random.below(20));
    if (errors && random.one_in(200)) {
      in.error = true;
      return in;
    }
    while (at == wire.size()) {
      wire = frames.any();
      at = 0;
    }
    in.byte = wire[at++];
    in.valid = true;
    return in;
  }
};

/// The expected result of each frame by the documentation, a clock after its end.
struct Page {
  explicit Page(std::shared_ptr<WireReader> r) : reader(std::move(r)) {}

  std::shared_ptr<WireReader> reader;
  bool spoiled = false, good = false, bad = false;

  const char* operator()(const Twin::In& in, const Vlink_receiver& rtl, const Twin&,
                         bool in_reset) {
    if (in_reset) {
      *reader = reader_of_page();
      spoiled = false;
      return nullptr;
    }
    good = bad = false;
    if (in.error) spoiled = true;
    if (in.valid) {
      const bool empty = reader->raw.empty();
      if (reader->take(in.byte)) {
        good = reader->last.good && !spoiled;
        bad = !good;
        spoiled = false;
      } else if (in.byte == 0xc0 && empty) {
        bad = spoiled;
        spoiled = false;
      }
    }
    if ((rtl.good_o != 0) != good) return "good as the page says";
    if ((rtl.bad_o != 0) != bad) return "bad as the page says";
    if (!good) return nullptr;
    const WireReader::Frame& f = reader->last;
    if (!rtl.valid_o || (rtl.write_o != 0) != (f.kind == 2)) return "the request stands";
    if (rtl.sequence_o != f.sequence || rtl.address_o != f.address || rtl.data_o != f.value) {
      return "the request is the frame's";
    }
    return nullptr;
  }
};

}  // namespace

TEST_CASE("link_receiver: frames of every kind, RTL against twin and page") {
  std::int64_t good = 0, bad = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    auto reader = std::make_shared<WireReader>(reader_of_page());
    Bench bench("link_receiver", seed);
    bench.run(Stimulus(seed, seed % 2 == 0), scaled_clocks(2'000'000), {seed == 4 ? 30'000U : 0U},
              Page(reader));
    good += reader->good;
    bad += reader->bad;
  }
  CHECK(good > 3'000);
  CHECK(bad > 3'000);
}

TEST_CASE(
    "link_receiver: frames at the borders of what a request may be, RTL against twin and page") {
  Stimulus stimulus(5, false);
  const auto add = [&](const Bytes& frame) {
    stimulus.wire.insert(stimulus.wire.end(), frame.begin(), frame.end());
  };
  for (int kind = 0; kind < 256; ++kind) add(request(kind, kind, 0x12, 1));
  for (unsigned bit = 0; bit < 32; ++bit) {
    add(request(1, 3, 0, 1U << bit | 1U));
    add(request(1, 3, 0, 1U << bit | 64U));
  }
  for (unsigned words = 60; words <= 68; ++words) add(request(1, 4, 0x3f00, words));
  for (unsigned from = 0; from < 64; ++from) {  // to the map's end, and further by one bit's weight
    add(request(1, 5, 0x3fc0 + from, 64 - from));
    for (unsigned further = 1; further <= from; further *= 2) {
      add(request(1, 5, 0x3fc0 + from, 64 - from + further));
    }
  }
  Bytes open = request(2, 6, 0x20, 7);  // sound but for what stands before its end
  open.insert(open.end() - 1, 0xdb);
  add(open);
  const auto clocks = static_cast<std::int64_t>(40 * stimulus.wire.size());
  auto reader = std::make_shared<WireReader>(reader_of_page());
  Bench bench("link_receiver", 5);
  bench.run(stimulus, clocks, {}, Page(reader));
  CHECK(reader->good > 2 + 64);
  CHECK(reader->bad > 254 + 24 + 300);
}

TEST_CASE("link_receiver: kinds 1 and 2, 1 to 64 words, and no frame with a flipped bit") {
  Bytes wire;
  const auto add = [&wire](const Bytes& f) { wire.insert(wire.end(), f.begin(), f.end()); };
  std::vector<std::uint32_t> wanted{1, 2}, taken;  // their sequence numbers
  for (int kind = 0; kind < 256; ++kind) add(request(kind, kind, 0, 1));
  for (std::uint32_t words = 0; words < 70; ++words) {
    add(request(1, static_cast<int>(words), 0, words));
    if (words >= 1 && words <= 64) wanted.push_back(words);
  }
  const Bytes frame = request(2, 0x55, 0x123, 0x456789ab);
  for (std::size_t byte = 1; byte + 1 < frame.size(); ++byte) {
    for (int bit = 0; bit < 8; ++bit) {
      Bytes changed = frame;
      changed[byte] ^= static_cast<std::uint8_t>(1U << bit);
      add(changed);
    }
  }
  const auto size = static_cast<std::int64_t>(wire.size());
  const auto stimulus = [&](std::int64_t k) {
    Twin::In in;
    in.valid = k % 10 == 9 && k / 10 < size;
    if (in.valid) in.byte = wire[static_cast<std::size_t>(k / 10)];
    return in;
  };
  const auto keep = [&](const Twin::In&, const Vlink_receiver& rtl, const Twin&,
                        bool) -> const char* {
    if (rtl.good_o != 0) taken.push_back(rtl.sequence_o);
    return nullptr;
  };
  Bench bench("link_receiver", 6);
  bench.run(stimulus, 10 * size + 20, {}, keep);
  CHECK(taken == wanted);
}

TEST_CASE("link_receiver: frames of random bytes are no requests, and each is counted") {
  Twin twin;
  WireReader reader = reader_of_page();
  Random random(8);
  std::int64_t accepted = 0, refused = 0;
  const auto send = [&](std::uint8_t byte) {
    reader.take(byte);
    twin.clock({byte, true, false, false});
    for (int k = 0; k < 9; ++k) {
      accepted += twin.out().good;
      refused += twin.out().bad;
      twin.clock({});
    }
  };
  const std::int64_t frames = scaled_clocks(20'000);  // a million with FELTGATE_LONG=50
  for (std::int64_t k = 0; k < frames; ++k) {
    const std::uint32_t size = 8 + random.below(9);
    send(static_cast<std::uint8_t>(random.below(192)));  // so that none is empty
    for (std::uint32_t n = 1; n < size; ++n) send(static_cast<std::uint8_t>(random.below(256)));
    send(0xc0);
  }
  std::printf("random frames: %lld accepted, %lld refused\n", static_cast<long long>(accepted),
              static_cast<long long>(refused));
  CHECK(accepted == 0);
  CHECK(refused == reader.bad);
  CHECK(refused >= frames);
  CHECK(!twin.out().request.valid);
  // It still takes a request.
  for (const std::uint8_t byte : request(2, 1, 0x18, 6)) send(byte);
  CHECK(accepted == 1);
}

// link_receiver: when its twin says that it is idle, nothing changes without a byte.

namespace {

LinkReceiver::In byte_of(std::uint8_t byte) {
  LinkReceiver::In in;
  in.byte = byte;
  in.valid = true;
  return in;
}

struct Line {
  LinkReceiver twin;

  void send(std::uint32_t byte) {
    twin.clock(byte_of(static_cast<std::uint8_t>(byte)));
    for (int k = 0; k < 9; ++k) twin.clock({});
  }
  /// All of a frame but its last END.
  void send(const Bytes& frame) {
    for (std::size_t k = 0; k + 1 < frame.size(); ++k) send(frame[k]);
  }
  bool ends_good() {
    twin.clock(byte_of(LinkMap::frame_end));
    REQUIRE(twin.out().good != twin.out().bad);
    return twin.out().good;
  }
};

}  // namespace

TEST_CASE("link_receiver: it is idle but for the eight bits of a byte and the clock of a verdict") {
  LinkReceiver twin;
  REQUIRE(twin.idle());
  for (int n = 0; n < 3; ++n) {
    CAPTURE(n);
    twin.clock(byte_of(static_cast<std::uint8_t>(0x31 + n)));
    for (int bit = 0; bit < 8; ++bit) {
      CAPTURE(bit);
      REQUIRE_FALSE(twin.idle());
      twin.clock({});
    }
    REQUIRE(twin.idle());
    const LinkReceiver::Out before = twin.out();
    for (int k = 0; k < 20; ++k) twin.clock({});
    REQUIRE(twin.idle());
    REQUIRE(twin.out().request.data == before.request.data);
    REQUIRE(twin.out().request.address == before.request.address);
  }
  // Three bytes are no frame.
  twin.clock(byte_of(LinkMap::frame_end));
  REQUIRE(twin.out().bad);
  REQUIRE_FALSE(twin.idle());
  twin.clock({});
  REQUIRE_FALSE(twin.out().bad);
  REQUIRE(twin.idle());
  // An END behind an END is nothing.
  twin.clock(byte_of(LinkMap::frame_end));
  CHECK(twin.idle());
}

TEST_CASE("link_receiver: a good frame takes a clock too") {
  Line line;
  line.send(request(LinkMap::kind_read, 7, 0x1000, 1));
  REQUIRE(line.twin.idle());
  REQUIRE(line.ends_good());
  CHECK_FALSE(line.twin.idle());
  CHECK(line.twin.out().request.address == 0x1000);
  line.twin.clock({});
  CHECK(line.twin.out().request.valid);
  CHECK(line.twin.idle());
}

TEST_CASE("link_receiver: without an engine its addresses are none") {
  Line line;
  line.send(request(LinkMap::kind_read, 7, 0x4000, 1));
  CHECK_FALSE(line.ends_good());
}

TEST_CASE("link_receiver: a byte that is not valid is none, whatever it is") {
  Line line;
  line.send(request(LinkMap::kind_read, 7, 0x1000, 1));
  for (const std::uint32_t byte : {LinkMap::frame_end, LinkMap::frame_escape, 0x31U}) {
    LinkReceiver::In in;
    in.byte = static_cast<std::uint8_t>(byte);
    line.twin.clock(in);
    REQUIRE(line.twin.idle());
  }
  CHECK(line.ends_good());
}

TEST_CASE("link_receiver: two escapes in a row spoil the frame") {
  // The low byte of the address is the escape.
  Bytes frame = request(LinkMap::kind_read, 7, 0x10db, 1);
  Line line;
  line.send(frame);
  REQUIRE(line.ends_good());
  const auto escape = std::find(frame.begin(), frame.end(), LinkMap::frame_escape);
  frame.insert(escape, static_cast<std::uint8_t>(LinkMap::frame_escape));
  line.send(frame);
  CHECK_FALSE(line.ends_good());
}
