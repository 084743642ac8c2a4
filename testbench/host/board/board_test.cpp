// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The board without hardware, without its terminal: ticks that do not depend on who listens, bad
// lines, recordings. Documentation: docs/host.md
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
  explicit Bench(const std::string& hand) {
    Setup setup;
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
  void write(std::uint32_t address, std::uint32_t value) {
    send(request(2, 1, address, value));
    run(0.01);
    REQUIRE(frames().size() == 1);
  }
  LeverBoard& board() { return *board_; }

 private:
  std::unique_ptr<LeverBoard> board_;
  Bytes kept_;
};

}  // namespace

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
