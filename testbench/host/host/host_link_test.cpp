// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The host's frames and link against a board that has its own code for the format: without errors,
// with noise, silence, garbage, and with the cable pulled.
#include "catch.hpp"

#include <chrono>
#include <string>

#include "board_on_pipe.hpp"
#include "feltgate/generated/link.hpp"
#include "feltgate/generated/map.hpp"
#include "feltgate/random.hpp"

namespace {

using namespace feltgate;
using host::Bytes;
using test::BoardOnPipe;
using test::Noise;

double seconds_since(host::Deadline start) {
  return std::chrono::duration<double>(host::HostClock::now() - start).count();
}

constexpr int some_parameter = Map::A::torque_limit;

}  // namespace

TEST_CASE("host frames: the examples of docs/link.md") {
  CHECK(host::framed({0x01, 0x07, 0x00, 0x10, 0x01, 0, 0, 0}) ==
        Bytes{0xc0, 0x01, 0x07, 0x00, 0x10, 0x01, 0, 0, 0, 0x9e, 0x11, 0x73, 0xb4, 0xc0});
  CHECK(host::framed({0x02, 0x09, 0x18, 0x00, 0xdb, 0xc0, 0, 0}) ==
        Bytes{0xc0, 0x02, 0x09, 0x18, 0x00, 0xdb, 0xdd, 0xdb, 0xdc, 0x00, 0x00, 0xe9, 0xb5, 0xe0,
              0x3d, 0xc0});
  host::FrameReader reader;
  const Bytes wire{0xc0, 0x82, 0x09, 0x18, 0x00, 0x80, 0x00,
                   0x70, 0x00, 0x26, 0x57, 0x47, 0xcc, 0xc0};
  reader.add(wire.data(), wire.size());
  CHECK(reader.next() == Bytes{0x82, 0x09, 0x18, 0x00, 0x80, 0x00, 0x70, 0x00});
  CHECK_FALSE(reader.next());
}

TEST_CASE("host frames: random bytes come through, and every flipped bit is noticed") {
  SplitMix64 random(7);
  host::FrameReader reader;
  for (int round = 0; round < 2000; ++round) {
    Bytes payload;
    for (std::int64_t n = 1 + random.below(260); n > 0; --n) {
      const std::int64_t kind = random.below(4);
      payload.push_back(kind == 0   ? 0xc0
                        : kind == 1 ? 0xdb
                                    : static_cast<std::uint8_t>(random.below(256)));
    }
    Bytes wire = host::framed(payload);
    reader.add(wire.data(), wire.size());
    REQUIRE(reader.next() == payload);
    const auto at = static_cast<std::size_t>(random.below(static_cast<std::int64_t>(wire.size())));
    wire[at] ^= static_cast<std::uint8_t>(1u << random.below(8));
    reader.add(wire.data(), wire.size());
    while (const auto frame = reader.next()) {
      // If the first or last END of a frame was hit, its payload is still complete.
      REQUIRE((*frame == payload && (at == 0 || at + 1 == wire.size())));
    }
    const Bytes end{0xc0};
    reader.add(end.data(), end.size());
    while (reader.next()) {
    }
  }
  CHECK(reader.counts().bad_crc > 1000);
}

TEST_CASE("host link: words are read and written, a write once") {
  BoardOnPipe p;
  CHECK(p.link.read(LinkMap::A::identity) == 0x46454c54);
  CHECK(p.link.read(0x1000, 11).at(3) == 50'000'000);
  const auto all = p.link.read(0, 200);
  CHECK(all.size() == 200);
  for (std::uint32_t n = 0; n < 600; ++n) p.link.write(some_parameter, n);
  CHECK(p.link.read(some_parameter) == 599);
  CHECK(p.board.writes().size() == 600);
  CHECK(p.link.counts().retries == 0);
}

TEST_CASE("host link: a second host does not repeat the first one's last write") {
  BoardOnPipe p;
  for (std::uint32_t host = 0; host < 4; ++host) {
    host::Link link(*p.transport);
    link.write(some_parameter, host);
    REQUIRE(p.board.writes().size() == host + 1);
    REQUIRE(p.board.word(some_parameter) == host);
  }
}

TEST_CASE("host link: noise both ways costs time and no word") {
  Noise noise;
  SECTION("dropped bytes") { noise.drop = 0.004; }
  SECTION("flipped bits") { noise.flip = 0.004; }
  SECTION("half frames and junk") {
    noise.halve = 0.1;
    noise.junk = 0.2;
  }
  BoardOnPipe p(noise, 20);
  SplitMix64 random(3);
  std::vector<std::pair<int, std::uint32_t>> wanted;
  for (int n = 0; n < 150; ++n) {
    const auto word = static_cast<std::uint32_t>(random.bits());
    wanted.emplace_back(some_parameter, word);
    p.link.write(some_parameter, word);
    REQUIRE(p.link.read(some_parameter) == word);
  }
  CHECK(p.board.writes() == wanted);
  CHECK(p.link.counts().retries > 5);
}

TEST_CASE("host link: late answers are not taken for the next one's") {
  Noise noise;
  noise.delay_s = 0.3;  // later than the first repetition, which is answered as well
  BoardOnPipe p(noise);
  for (std::uint32_t n = 0; n < 3; ++n) {
    REQUIRE(p.link.read(LinkMap::A::identity) == 0x46454c54);
    p.link.write(some_parameter, n);
    REQUIRE(p.link.read(some_parameter) == n);
  }
  CHECK(p.board.writes().size() == 3);
  CHECK(p.link.counts().retries > 0);
  CHECK(p.link.counts().stray > 0);
}

TEST_CASE("host link: an answer of another address is none") {
  Noise noise;
  noise.other = 1;
  BoardOnPipe p(noise);
  for (std::uint32_t n = 0; n < 20; ++n) {
    REQUIRE(p.link.read(LinkMap::A::identity) == 0x46454c54);
    p.link.write(some_parameter, n);
    REQUIRE(p.link.read(some_parameter) == n);
  }
  CHECK(p.link.counts().stray >= 60);
}

TEST_CASE("host link: garbage and a running stream before the first request") {
  BoardOnPipe p;
  p.link.write(LinkMap::A::stream_words, 0xfff);
  p.link.write(LinkMap::A::stream_period, 700);
  const Bytes half{0xc0, 0x02, 0xdb};
  p.transport->write(half.data(), half.size());
  host::Link fresh(*p.transport);
  fresh.begin();
  CHECK(fresh.read(LinkMap::A::identity) == 0x46454c54);
  CHECK(p.board.frames_bad() == 1);
}

TEST_CASE("host link: a stream arrives whole between requests, and what is lost is counted") {
  BoardOnPipe p;
  p.link.write(LinkMap::A::stream_words, 0x00a);
  p.link.write(LinkMap::A::stream_period, 1000);
  std::uint32_t last = 0;
  for (int n = 0; n < 50; ++n) {
    if (n % 5 == 0) REQUIRE(p.link.read(LinkMap::A::identity) == 0x46454c54);
    const auto frame = p.link.stream(host::within(1));
    REQUIRE(frame);
    CHECK(frame->mask == 0x00e);
    REQUIRE(frame->words.size() == 3);
    if (n > 0) CHECK(frame->words[1] - last == 1000 * (1 + frame->lost));
    last = frame->words[1];
  }
  p.link.write(LinkMap::A::stream_period, 0);
  CHECK(p.link.counts().streamed >= 50);
}

TEST_CASE("host link: silence ends in LinkLost, in time; then it goes on where it was") {
  BoardOnPipe p({}, 0.4);
  p.link.write(some_parameter, 5);
  p.board.set_silent(true);
  const auto start = host::HostClock::now();
  CHECK_THROWS_AS(p.link.write(some_parameter, 6), host::LinkLost);
  CHECK(seconds_since(start) < 1.0);
  try {
    p.link.read(some_parameter);
    FAIL("it answered");
  } catch (const host::LinkLost& e) {
    CHECK(std::string(e.what()).find("pipe: no answer for 0.4 s") == 0);
    CHECK(std::string(e.what()).find("--baud") != std::string::npos);
  }
  p.board.set_silent(false);
  p.link.write(some_parameter, 7);
  CHECK(p.link.read(some_parameter) == 7);
}

TEST_CASE("host link: a pulled cable is named") {
  BoardOnPipe p;
  p.link.write(some_parameter, 5);
  p.board.unplug();
  try {
    for (int n = 0; n < 3; ++n) p.link.read(some_parameter);
    FAIL("it answered");
  } catch (const host::LinkLost& e) {
    CHECK(std::string(e.what()).find("went away") != std::string::npos);
  }
}

TEST_CASE("host link: ports that cannot be opened say why") {
  const auto told = [](const std::string& path) {
    try {
      host::open_serial(path, 1'000'000);
      return std::string("opened");
    } catch (const host::PortError& e) {
      return std::string(e.what());
    }
  };
  CHECK(told("/dev/ttyNOT").find("there is no such port; ") != std::string::npos);
  CHECK(told("/dev/null").find("is no serial port") != std::string::npos);
}
