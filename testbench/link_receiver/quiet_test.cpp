// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// link_receiver: when its twin says that it is idle, nothing changes without a byte. Documentation:
// docs/blocks/link_receiver.md
#include <array>

#include "catch.hpp"
#include "feltgate/link_receiver.hpp"

using namespace feltgate;

namespace {

LinkReceiver::In byte_of(std::uint8_t byte) {
  LinkReceiver::In in;
  in.byte = byte;
  in.valid = true;
  return in;
}

/// A read of one word, sequence 7: eight bytes and their CRC.
std::array<std::uint8_t, 12> read_of(std::uint16_t address) {
  std::array<std::uint8_t, 12> frame{LinkMap::kind_read, 7, static_cast<std::uint8_t>(address),
                                     static_cast<std::uint8_t>(address >> 8), 1};
  std::uint32_t crc = crc32_start;
  for (std::size_t k = 0; k < 8; ++k) {
    for (int bit = 0; bit < 8; ++bit) crc = crc32_shift(crc, (frame[k] >> bit & 1) != 0);
  }
  for (std::size_t k = 0; k < 4; ++k) frame[8 + k] = static_cast<std::uint8_t>(~crc >> 8 * k);
  return frame;
}

struct Line {
  LinkReceiver twin;

  void send(std::uint32_t byte) {
    twin.clock(byte_of(static_cast<std::uint8_t>(byte)));
    for (int k = 0; k < 9; ++k) twin.clock({});
  }
  /// As it goes over the line, without its END.
  void send(const std::array<std::uint8_t, 12>& frame) {
    for (const std::uint8_t byte : frame) {
      if (byte == LinkMap::frame_end || byte == LinkMap::frame_escape) {
        send(LinkMap::frame_escape);
        send(byte == LinkMap::frame_end ? LinkMap::escaped_end : LinkMap::escaped_escape);
      } else {
        send(byte);
      }
    }
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
  line.send(read_of(0x1000));
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
  line.send(read_of(0x4000));
  CHECK_FALSE(line.ends_good());
}

TEST_CASE("link_receiver: a byte that is not valid is none, whatever it is") {
  Line line;
  line.send(read_of(0x1000));
  for (const std::uint32_t byte : {LinkMap::frame_end, LinkMap::frame_escape, 0x31U}) {
    LinkReceiver::In in;
    in.byte = static_cast<std::uint8_t>(byte);
    line.twin.clock(in);
    REQUIRE(line.twin.idle());
  }
  CHECK(line.ends_good());
}

TEST_CASE("link_receiver: two escapes in a row spoil the frame") {
  // 0x10db: its low byte is the escape.
  const auto frame = read_of(0x10db);
  Line line;
  line.send(frame);
  REQUIRE(line.ends_good());
  line.send(frame[0]);
  line.send(frame[1]);
  line.send(LinkMap::frame_escape);
  line.send(LinkMap::frame_escape);
  line.send(LinkMap::escaped_escape);
  for (std::size_t k = 3; k < frame.size(); ++k) line.send(frame[k]);
  CHECK_FALSE(line.ends_good());
}
