// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate_linked: single requests, and thousands of random frames, at the twin's pins; its RTL has
// the same bits (wire_test.cpp). Documentation: docs/link.md
#include <cstdio>

#include "catch.hpp"
#include "feltgate_linked_twin.hpp"
#include "port_core.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

/// A host at the twin's pins.
struct Host {
  Twin board;
  In in;
  std::int64_t now = 0;
  Bytes got;

  void run(std::int64_t clocks) {
    board.run(in, clocks, [] {});
    now += clocks;
    for (const std::uint8_t byte : board.take_received()) got.push_back(byte);
  }
  void send(const Bytes& wire) {
    for (const std::uint8_t byte : wire) board.send(byte);
  }
  /// Sends, and collects the bytes received until the line is silent.
  Bytes ask(const Bytes& wire) {
    got.clear();
    send(wire);
    while (board.unsent() > 0) run(100);
    std::size_t before = 0;
    do {
      before = got.size();
      run(1500 * D::clock_hz / 50'000'000 + 40 * D::clock_hz / BAUD);
    } while (got.size() != before);
    return got;
  }
  /// Returns the words of the reply to a read; the reply must come.
  std::vector<std::uint32_t> read(int sequence, std::uint32_t address, std::uint32_t words) {
    const Bytes wire = ask(request(1, sequence, address, words));
    return words_of(wire, 0x81, sequence, address, words);
  }
  std::uint32_t write(int sequence, std::uint32_t address, std::uint32_t value) {
    return words_of(ask(request(2, sequence, address, value)), 0x82, sequence, address, 1)[0];
  }
  /// Arms. Returns the status of the reply or, with an engine, the status after its CRC is
  /// computed.
  std::uint32_t arm(int sequence) {
    const std::uint32_t status = write(sequence, D::C::control, control_word(true, D::S::damper));
    if (D::engine == 0) return status;
    run(100'000);
    return read(sequence, static_cast<std::uint32_t>(D::C::read_status), 1)[0];
  }
  static std::vector<std::uint32_t> words_of(const Bytes& wire, int kind, int sequence,
                                             std::uint32_t address, std::uint32_t words) {
    REQUIRE(wire.size() > 9);
    REQUIRE(wire.front() == 0xc0);
    REQUIRE(wire.back() == 0xc0);
    const Bytes body = unescaped(Bytes(wire.begin() + 1, wire.end() - 1));
    REQUIRE(body.size() == 8 + 4 * words);
    REQUIRE(framed(Bytes(body.begin(), body.end() - 4)) == wire);
    CHECK(body[0] == kind);
    CHECK(body[1] == sequence);
    CHECK(body[2] + 256U * body[3] == address);
    return body_words(body);
  }
};

}  // namespace

TEST_CASE("feltgate_linked: reads and writes") {
  Host host;
  host.run(5000);
  const auto head = host.read(1, LinkMap::A::identity, 11);
  CHECK(head[0] == 0x46454c54);
  CHECK(head[1] == LinkMap::version);
  CHECK(head[2] == D::design_crc);
  CHECK(head[3] == D::clock_hz);
  CHECK(head[4] == D::clocks_per_tick);
  CHECK(head[6] == 1);
  CHECK(head[7] == 0);
  CHECK(head[8] == LinkMap::no_sequence);
  host.in.inputs = 0xa5;
  CHECK(host.read(2, LinkMap::A::inputs, 1)[0] == 0xa5);
  host.write(3, D::A::torque_limit, 0xc0dbU);
  CHECK(host.read(4, D::A::torque_limit, 1)[0] == 0xc0db);
  CHECK(host.read(5, LinkMap::A::last_write_sequence, 1)[0] == 3);
  const auto all = host.read(6, 0, 64);
  for (const auto& p : D::parameters) {
    if (p.address < 64 && p.address != D::A::torque_limit) {
      CHECK(all[static_cast<std::size_t>(p.address)] == static_cast<std::uint32_t>(p.raw));
    }
  }
  CHECK(host.read(7, 0x3fc0, 64)[63] == 0);
  CHECK((head[5] >> LinkMap::B::features_engine & 1U) == (D::engine != 0));
  CHECK(host.ask(request(1, 8, 0x3fc1, 64)).empty());
  CHECK(host.ask(request(1, 8, EngineMap::port_first, 1)).empty() == (D::engine == 0));
  CHECK(host.ask(request(1, 8, 0x7fff, 2)).empty());
  CHECK(host.ask(request(1, 8, 0x8000, 1)).empty());
}

TEST_CASE("feltgate_linked: a repeated write is done once, its reply has the status of the write") {
  Host host;
  host.run(5000);
  const auto once = host.board.core().writes();
  host.write(7, D::C::control, control_word(false, D::S::damper));
  host.write(7, D::C::control, control_word(false, D::S::damper));
  host.write(7, D::C::control, control_word(false, D::S::wall));
  CHECK(host.board.core().writes() == once + 1);
  CHECK(host.board.out().core.scene == D::S::damper);
  const std::uint32_t armed = host.arm(8);
  CHECK((armed >> D::C::status_armed & 1U) == 1);
  const std::uint32_t refused = host.write(9, D::A::inverse_resistance, 1);
  CHECK((refused >> D::C::status_refused & 1U) == 1);
  const std::uint32_t taken = host.write(10, D::A::overspeed, 0x7fffffff);
  CHECK((taken >> D::C::status_refused & 1U) == 0);
}

TEST_CASE("feltgate_linked: a disarm amid a long reply acts in the tick in which it is whole") {
  for (const bool stop : {false, true}) {
    Host host;
    host.run(5000);
    host.arm(1);
    REQUIRE(host.board.out().core.armed);
    host.got.clear();
    host.send(request(1, 2, 0, 64));
    host.send(request(2, 3, D::A::ramp_step, 5));  // waits for its reply
    host.send(stop ? request(2, 4, D::C::command, 1U << D::C::command_stop)
                   : request(2, 4, D::C::control, control_word(false, D::S::damper)));
    while (host.board.unsent() > 0) {
      host.run(1);
      if (host.board.unsent() > 1) REQUIRE(host.board.out().core.gates_enable);
    }
    CHECK(host.got.size() < 40);  // of 264 and more
    host.run(2 * D::clocks_per_tick);
    CHECK(!host.board.out().core.gates_enable);
    CHECK((host.board.out().core.faults != 0) == stop);
  }
}

TEST_CASE("feltgate_linked: random frames: what is no request changes nothing") {
  Host host;
  host.run(5000);
  RandomFrames frames(Random(11), false);
  WireReader reader;
  reader.engine = D::engine != 0;
  std::int64_t bad_frames = 0, replies = 0, done = 0;
  int last = -1;
  std::uint32_t words[512] = {};
  for (const auto& p : D::parameters) words[p.address] = static_cast<std::uint32_t>(p.raw);
  const std::int64_t wanted = scaled_clocks(FRAMES);
  while (reader.good + reader.bad < wanted) {
    Bytes wire = frames.any();
    if (frames.random.one_in(2)) wire.push_back(0xc0);  // otherwise the next frame's END ends it
    const std::int64_t writes = host.board.core().writes();
    host.got.clear();
    std::int64_t good = 0, expected = 0;
    for (const std::uint8_t byte : wire) {
      if (!reader.take(byte)) continue;
      const WireReader::Frame& f = reader.last;
      if (!f.good) ++bad_frames;
      if (!f.good) continue;
      ++good;
      if (f.kind != 2 || f.sequence == last) continue;
      last = f.sequence;
      if (f.address < 0x200) words[f.address] = f.value;
      // A disarmed core accepts every write to an address with a register.
      if (f.address < 0x200 || f.address == D::C::control || f.address == D::C::command) {
        ++expected;
      }
      if (f.address == D::C::control || f.address == D::C::command) ++done;
    }
    host.ask(wire);
    REQUIRE(host.board.core().writes() == writes + expected);
    if (good == 0) REQUIRE(host.got.empty());
    if (good > 0) REQUIRE(!host.got.empty());
    replies += good;
    // Disarms, so that the next write is not refused.
    if (host.board.out().core.armed) {
      last = (last + 1) & 255;
      REQUIRE(!host.ask(request(2, last, D::C::control, control_word(false, 0))).empty());
      for (const std::uint8_t byte : request(2, last, D::C::control, control_word(false, 0))) {
        reader.take(byte);
      }
    }
  }
  std::printf("frames: %lld accepted, %lld refused\n", static_cast<long long>(reader.good),
              static_cast<long long>(reader.bad));
  CHECK(bad_frames > wanted / 4);
  CHECK(replies > wanted / 4);
  CHECK(done > 0);
  host.ask({0xc0});
  const int next = (last + 1) & 255;
  const auto counts = host.read(next, LinkMap::A::frames_good, 2);
  CHECK(counts[0] == ((reader.good + 1) & 0xffff));
  CHECK(std::abs(static_cast<std::int64_t>(counts[1]) - (reader.bad & 0xffff)) <= 1);
  for (std::uint32_t at = 0; at < 512; at += 64) {
    const auto read = host.read(next, at, 64);
    for (std::uint32_t k = 0; k < 64; ++k) {
      CHECK(read[k] == word_kept<D>(static_cast<int>(at + k), words[at + k]));
    }
  }
}
