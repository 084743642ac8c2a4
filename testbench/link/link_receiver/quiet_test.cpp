// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// link_receiver: when its twin says that it is idle, nothing changes without a byte. Documentation:
// docs/link.md
#include <algorithm>

#include "../feltgate_linked/frames.hpp"
#include "catch.hpp"
#include "feltgate/link_receiver.hpp"

using namespace feltgate;
using namespace feltgate::test;

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
