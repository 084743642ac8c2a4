// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The board without hardware, without its terminal: garbage on the line, ticks that do not depend
// on who listens, recordings. Documentation: docs/host.md
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>

#include "catch.hpp"
#include "feltgate/crc32.hpp"
#include "feltgate/generated/link.hpp"
#include "host/board/board.hpp"
#include "sim/plant/plant_file.hpp"

using namespace feltgate;
using namespace feltgate::board;

namespace {

using Bytes = std::vector<std::uint8_t>;
using M = LinkMap;

/// A request by this file's own code.
Bytes request(std::uint8_t kind, std::uint8_t sequence, std::uint32_t address,
              std::uint32_t value) {
  Bytes raw{kind, sequence, static_cast<std::uint8_t>(address),
            static_cast<std::uint8_t>(address >> 8)};
  for (int k = 0; k < 4; ++k) raw.push_back(static_cast<std::uint8_t>(value >> 8 * k));
  const std::uint32_t sum = crc32(raw.data(), raw.size());
  for (int k = 0; k < 4; ++k) raw.push_back(static_cast<std::uint8_t>(sum >> 8 * k));
  Bytes wire{0xc0};
  for (const std::uint8_t byte : raw) {
    if (byte == 0xc0) {
      wire.insert(wire.end(), {0xdb, 0xdc});
    } else if (byte == 0xdb) {
      wire.insert(wire.end(), {0xdb, 0xdd});
    } else {
      wire.push_back(byte);
    }
  }
  wire.push_back(0xc0);
  return wire;
}

/// Whole frames among bytes, without escapes and CRC; wrong ones are failures.
std::vector<Bytes> frames_of(const Bytes& wire) {
  std::vector<Bytes> frames;
  Bytes frame;
  bool escaped = false;
  for (const std::uint8_t byte : wire) {
    if (byte == 0xc0) {
      if (frame.empty()) continue;
      REQUIRE(frame.size() > 4);
      REQUIRE(~crc32(frame.data(), frame.size()) == crc32_good);
      frame.resize(frame.size() - 4);
      frames.push_back(std::move(frame));
      frame.clear();
    } else if (byte == 0xdb) {
      escaped = true;
    } else {
      frame.push_back(escaped ? (byte == 0xdc ? 0xc0 : 0xdb) : byte);
      escaped = false;
    }
  }
  return frames;
}

std::uint32_t word_of(const Bytes& frame, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t k = 0; k < 4; ++k) word |= std::uint32_t{frame[at + k]} << 8 * k;
  return word;
}

class Bench {
 public:
  explicit Bench(const std::string& hand = "free", Setup setup = {}) {
    setup.hand = hand;
    board_ = std::make_unique<LeverBoard>(
        make_core(setup.design, "twin", {}),
        plant::read_plant_file(FELTGATE_ROOT "/vectors/plants/p24.toml"),
        hand_named(hand, FELTGATE_ROOT "/vectors/scenes"), setup);
  }
  void send(const Bytes& bytes) { board_->receive(bytes); }
  void run(double seconds) { board_->run_to(board_->now() + std::llround(seconds * 50e6)); }
  std::vector<Bytes> frames() {
    const Bytes more = board_->take_sent();
    kept_.insert(kept_.end(), more.begin(), more.end());
    // An incomplete frame stays in kept_ until its end arrives.
    const auto end = std::find(kept_.rbegin(), kept_.rend(), 0xc0).base();
    const Bytes whole(kept_.begin(), end);
    kept_.erase(kept_.begin(), end);
    return frames_of(whole);
  }
  /// The reply to one request.
  Bytes ask(std::uint8_t kind, std::uint32_t address, std::uint32_t value) {
    send(request(kind, ++sequence_, address, value));
    run(0.01);
    const auto got = frames();
    REQUIRE(got.size() == 1);
    REQUIRE(got[0][0] == (kind | 0x80));
    REQUIRE(got[0][1] == sequence_);
    return got[0];
  }
  std::uint32_t read(std::uint32_t address) { return word_of(ask(1, address, 1), 4); }
  void write(std::uint32_t address, std::uint32_t value) { (void)ask(2, address, value); }
  LeverBoard& board() { return *board_; }

 private:
  std::unique_ptr<LeverBoard> board_;
  std::uint8_t sequence_ = 0;
  Bytes kept_;
};

/// A request that is spoilt in one way.
Bytes spoilt(int k, SplitMix64* random) {
  Bytes wire = request(2, static_cast<std::uint8_t>(k), static_cast<std::uint32_t>(k) & 0xfff,
                       static_cast<std::uint32_t>(random->bits()));
  const auto within = [&] { return 1 + random->below(static_cast<std::int64_t>(wire.size()) - 2); };
  switch (random->below(5)) {
    case 0:
      wire[static_cast<std::size_t>(within())] ^= static_cast<std::uint8_t>(1u << random->below(8));
      break;
    case 1:
      wire.erase(wire.begin() + within());
      break;
    case 2:
      wire.resize(wire.size() / 2);
      wire.push_back(0xc0);
      break;
    case 3:
      wire = request(3, 1, 0x018, 0);
      break;
    default:
      for (std::uint8_t& byte : wire) byte = static_cast<std::uint8_t>(random->bits());
      wire.front() = wire.back() = 0xc0;
  }
  return wire;
}

}  // namespace

TEST_CASE("board: answers as docs/link.md says", "[board]") {
  Bench b;
  CHECK(b.read(M::A::identity) == M::identity);
  CHECK(b.read(M::A::features) == (1 | 2 | 4 | 10 << 8 | 8 << 16));  // simulated, all there
  CHECK(b.read(M::A::clock_hz) == 50'000'000);
  CHECK(b.read(M::A::last_write_sequence) == M::no_sequence);
  b.write(0x018, 0x1234);  // torque_limit
  CHECK(b.read(0x018) == 0x1234);
  CHECK(b.read(0x3fff) == 0);
  // A read of many words is of consecutive addresses.
  const Bytes many = b.ask(1, M::A::identity, 10);
  CHECK(many.size() == 4 + 10 * 4);
  CHECK(word_of(many, 4) == M::identity);
  CHECK(word_of(many, 4 + 7 * 4) == 0);  // frames_bad
}

TEST_CASE("board: a repeated write is done once", "[board]") {
  Bench b;
  const Bytes write = request(2, 9, 0x018, 6);
  for (int k = 0; k < 3; ++k) {
    b.send(write);
    b.run(0.01);
    CHECK(b.frames().size() == 1);
  }
  CHECK(b.read(0x018) == 6);
  CHECK(b.read(M::A::last_write_sequence) == 9);
  // The same sequence with another value is a repetition too.
  b.send(request(2, 9, 0x018, 7));
  b.run(0.01);
  CHECK(b.frames().size() == 1);
  CHECK(b.read(0x018) == 6);
}

TEST_CASE("board: garbage changes no word, and is counted", "[board]") {
  Bench b;
  const auto words = [&b] {
    Bytes all;
    for (const auto& [from, count] : {std::pair<std::uint32_t, std::uint32_t>{0, 64},
                                      {0x40, 8},
                                      {0x200, 2},
                                      {M::A::stream_words, 2},
                                      {M::A::capture_state, 9}}) {
      const Bytes part = b.ask(1, from, count);
      all.insert(all.end(), part.begin() + 4, part.end());
    }
    return all;
  };
  const Bytes before = words();
  SplitMix64 random(3);
  for (int k = 0; k < 3000; ++k) {
    b.send(spoilt(k, &random));
    b.run(150e-6);
  }
  b.run(0.1);
  CHECK(b.frames().empty());
  CHECK(words() == before);
  CHECK(b.read(M::A::frames_bad) >= 3000);
  CHECK(b.read(M::A::last_write_sequence) == M::no_sequence);
}

TEST_CASE("board: ticks do not depend on who listens, or when one looks", "[board]") {
  Bench quiet("swing"), listened("swing"), chopped("swing");
  for (Bench* b : {&quiet, &listened, &chopped}) b->write(0x200, 1 | 7 << 2);  // host, scene 7
  listened.send(request(2, 99, M::A::stream_period, 500));
  listened.run(0.3);
  const auto frames = listened.frames();
  CHECK(frames.size() > 400);
  quiet.run(0.3);
  CHECK(quiet.board().outcome().tick_sum == listened.board().outcome().tick_sum);
  CHECK(quiet.board().outcome().byte_sum != listened.board().outcome().byte_sum);
  // The stream counts its frames and ticks.
  std::uint32_t last_tick = 0, in_row = 0;
  for (const Bytes& f : frames) {
    if (f[0] != 0x40) continue;
    if (in_row++ > 0) CHECK(word_of(f, 4) - last_tick == 500);
    CHECK(f[1] == static_cast<std::uint8_t>(in_row - 1));
    last_tick = word_of(f, 4);
  }
  for (int k = 0; k < 990; ++k) chopped.run(0.3e-3);
  chopped.board().run_to(quiet.board().now());
  CHECK(chopped.board().now() == quiet.board().now());
  CHECK(chopped.board().outcome().tick_sum == quiet.board().outcome().tick_sum);
}

TEST_CASE("board: a stream faster than the wire drops whole frames and counts them", "[board]") {
  Bench b("swing");
  b.write(M::A::stream_words, 0xfff);
  b.send(request(2, 50, M::A::stream_period, 100));
  b.run(0.1);
  const auto frames = b.frames();  // every one of them is whole
  CHECK(frames.size() > 100);
  CHECK(frames.size() < 200);
  b.send(request(2, 51, M::A::stream_period, 0));
  b.run(0.01);
  (void)b.frames();
  CHECK(b.read(M::A::stream_dropped) > 800);
}

TEST_CASE("board: a capture around a trigger, every tick", "[board]") {
  Bench b("swing");
  b.write(M::A::capture_words, 1u << 1 | 1u << 2);  // position, tick
  b.write(M::A::capture_pre, 256);
  b.write(M::A::trigger_word, 1);
  b.write(M::A::trigger_mode, 1);
  const auto level = static_cast<std::int32_t>(b.read(0x301)) + 60;
  b.write(M::A::trigger_level, static_cast<std::uint32_t>(level));
  b.write(M::A::capture_control, 1);
  b.run(0.5);
  REQUIRE(b.read(M::A::capture_state) == 4);
  REQUIRE(b.read(M::A::capture_rows) == 1024);
  const std::uint32_t first = b.read(M::A::capture_first);
  const auto row = [&](std::uint32_t n, std::uint32_t column) {
    return b.read(M::memory + 8 * ((first + n) % 1024) + column);
  };
  CHECK(static_cast<std::int32_t>(row(255, 0)) < level);
  CHECK(static_cast<std::int32_t>(row(256, 0)) >= level);
  CHECK(row(1023, 1) - row(0, 1) == 1023);
  CHECK(row(5, 2) == 0);  // unused columns
}

TEST_CASE("board: a bad line spoils as many bytes as it should", "[line]") {
  const Bytes sent(100'000, 0x55);
  CHECK(BadLine(0, 1).through(sent) == sent);
  BadLine line(0.03, 1);
  const Bytes got = line.through(sent);
  const auto wrong = std::count_if(got.begin(), got.end(), [](int b) { return b != 0x55; });
  CHECK(static_cast<double>(wrong) == Approx(1000).margin(150));
  CHECK(got != sent);
  CHECK(BadLine(0.03, 1).through(sent) == got);
  CHECK(BadLine(0.03, 2).through(sent) != got);
}

TEST_CASE("board: a wrong recording is refused with its line", "[recording]") {
  const auto message = [](const std::string& text) -> std::string {
    const std::string path = "wrong.board";
    std::ofstream(path) << text;
    std::string said = "accepted";
    try {
      (void)read_recording(path);
    } catch (const std::invalid_argument& e) {
      said = e.what();
    }
    std::remove(path.c_str());
    return said;
  };
  const std::string end = "end 5\nticks 1 0\nsent 0 0\n";
  CHECK(message("feltgate-board/1\n3 c0ff\n" + end) == "accepted");
  CHECK(message("").find("wrong.board:0: it has no end") == 0);
  CHECK(message("hello\n").find("wrong.board:1: no recording of a board") == 0);
  CHECK(message("feltgate-board/1\n3 c0\n").find("wrong.board:2: it has no end") == 0);
  CHECK(message("feltgate-board/1\n3 c0f\n" + end).find("wrong.board:2: \"3 c0f\"") == 0);
  CHECK(message("feltgate-board/1\n3 xx\n" + end).find("wrong.board:2: \"3 xx\"") == 0);
  CHECK(message("feltgate-board/1\nfrom 3\n" + end).find("wrong.board:2: \"from 3\"") == 0);
  CHECK(message("feltgate-board/1\n9 c0\n3 c0\n" + end).find("wrong.board:3: time runs back") == 0);
  CHECK(message("feltgate-board/1\n99999999999999999999 c0\n" + end).find("too large") !=
        std::string::npos);
  CHECK_THROWS_AS(hand_named("wave", "."), std::invalid_argument);
}
