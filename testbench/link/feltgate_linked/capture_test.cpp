// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Captures a contact and reads it back over the UART, RTL and twin in lock-step: each word belongs
// to its tick. Documentation: docs/link.md
#include <array>
#include <map>
#include <memory>

#include "catch.hpp"
#include "feltgate_linked_twin.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using A = LinkMap::A;
using N = LinkMap::N;

using Tick = std::array<std::uint32_t, LinkMap::snapshot_words>;
constexpr std::uint32_t kMask = 1U << N::status | 1U << N::position | 1U << N::tick |
                                1U << N::velocity | 1U << N::tau_ref | 1U << N::current_ref |
                                1U << N::voltage | 1U << N::duty;
constexpr std::uint32_t kPre = 100, kRows = 1U << LinkMap::rows_log2;

/// Data that a session has received.
struct Seen {
  std::map<std::uint32_t, Tick> ticks;  ///< signals at the core's ports, by the word `tick`
  std::vector<std::vector<std::uint32_t>> replies;
  std::vector<std::vector<std::uint32_t>> streamed;  ///< mask, then the words
  std::uint32_t first = 0;
  bool over = false;
};

/// A lever is pushed into a wall; a host sends one request after another.
struct Session {
  std::shared_ptr<Seen> seen;
  UartLine line{D::clock_hz, BAUD};
  Bytes frame;
  LinkedIn in;
  Tick tick{};
  int number = 12, sequence = 0;
  std::size_t step = 0;
  unsigned phase = 0;
  std::int64_t wait = 5000;
  bool asked = false;

  LinkedIn operator()(std::int64_t clock, const LinkedOut& out) {
    note(out.core);
    line.clock(out.uart_tx);
    for (const std::uint8_t byte : line.take_received()) take(byte);
    if (!asked && --wait <= 0) ask();
    if (clock > 60'000 && clock % 700 == 0) ++phase;
    in.encoder = pins_at(phase);
    in.uart_rx = line.level();
    return in;
  }

  void note(const CoreOut& core) {
    if (!core.word_valid) return;
    const std::size_t number = linked::number_of(core.word_slot);
    tick[number] = core.word_data;
    if (number == N::status) seen->ticks[tick[N::tick]] = tick;
  }

  void ask() {
    constexpr std::uint32_t host = static_cast<std::uint32_t>(D::control_reset) |
                                   1U << D::C::control_host |
                                   static_cast<std::uint32_t>(D::S::wall) << D::C::control_scene;
    const std::array<std::array<std::uint32_t, 2>, 12> writes{{
        {D::A::self_test_pulse, 0},
        {D::A::wall_contact, 30U << 8},
        {D::C::control, host},
        {D::C::control, host | 1U << D::C::control_arm},
        {A::stream_words, 1U << N::position | 1U << N::duty},
        {A::stream_period, 90},
        {A::capture_words, kMask},
        {A::capture_pre, kPre},
        {A::trigger_word, N::tau_ref},
        {A::trigger_mode, 2},
        {A::trigger_level, 0},
        {A::capture_control, 1U << LinkMap::B::capture_control_start},
    }};
    Bytes wire;
    if (step < writes.size()) {
      wire = request(2, ++sequence, writes[step][0], writes[step][1]);
    } else if (step == writes.size()) {
      wire = request(1, ++sequence, A::capture_state, 1);  // repeated until the capture is done
    } else if (step == writes.size() + 1) {
      wire = request(1, ++sequence, A::capture_first, 2);
    } else {
      // Reads eight rows at a time: the first, those around the trigger, the last.
      static constexpr std::uint32_t rows[] = {0, 8, kPre - 8, kPre, kPre + 8, 600, kRows - 8};
      const std::size_t n = step - writes.size() - 2;
      if (n == std::size(rows)) {
        seen->over = true;
        asked = true;
        return;
      }
      // A read does not wrap around: a block of rows may end at the end of the memory.
      const std::uint32_t row = (seen->first + rows[n]) % kRows;
      wire = request(1, ++sequence, LinkMap::memory + row * 8, std::min(kRows - row, 8U) * 8);
    }
    for (const std::uint8_t byte : wire) line.send(byte);
    asked = true;
  }

  void take(std::uint8_t byte) {
    if (byte != LinkMap::frame_end) {
      frame.push_back(byte);
      return;
    }
    const Bytes body = unescaped(frame);
    frame.clear();
    if (body.size() < 12) return;
    std::vector<std::uint32_t> words = body_words(body);
    if (body[0] == LinkMap::kind_stream) {
      words.insert(words.begin(), body[2] | static_cast<std::uint32_t>(body[3]) << 8);
      seen->streamed.push_back(words);
      return;
    }
    asked = false;
    wait = 200;
    if (step == 12 && words[0] != 4) return;
    if (step == 13) seen->first = words[0];
    if (step > 12) seen->replies.push_back(words);
    ++step;
  }
};

}  // namespace

TEST_CASE("feltgate_linked: a contact, captured and streamed, is that of the core tick by tick") {
  auto seen = std::make_shared<Seen>();
  Session session;
  session.seen = seen;
  Bench bench("feltgate_linked", 1);
  bench.run(session, 720'000);
  REQUIRE(seen->over);
  REQUIRE(seen->replies.size() == 8);
  REQUIRE(seen->replies[0][1] == kRows);

  // The first tick with a negative torque, and the tick before it, are in the expected rows.
  std::size_t compared = 0;
  std::uint32_t trigger = 0;
  for (const auto& [n, words] : seen->ticks) {
    if (static_cast<std::int32_t>(words[N::tau_ref]) < 0 && trigger == 0) trigger = n;
  }
  REQUIRE(trigger > kPre);
  for (std::size_t r = 1; r < seen->replies.size(); ++r) {
    const auto& rows = seen->replies[r];
    for (std::size_t at = 0; at + 8 <= rows.size(); at += 8) {
      const std::uint32_t n = rows[at + 2];  // status, position, tick, ...
      REQUIRE(seen->ticks.count(n) == 1);
      const Tick& wanted = seen->ticks[n];
      std::size_t column = at;
      for (int k = 0; k < LinkMap::snapshot_words; ++k) {
        if ((kMask >> k & 1U) != 0) REQUIRE(rows[column++] == wanted[static_cast<std::size_t>(k)]);
      }
      if (at == 0) {
        static constexpr std::uint32_t first[] = {0, 8, kPre - 8, kPre, kPre + 8, 600, kRows - 8};
        REQUIRE(n == trigger - kPre + first[r - 1]);
      }
      ++compared;
    }
  }
  REQUIRE(compared >= 7);
  REQUIRE(seen->streamed.size() > 20);
  for (const auto& f : seen->streamed) {
    REQUIRE(f.size() == 4);
    const Tick& wanted = seen->ticks[f[2]];
    REQUIRE(f[1] == wanted[N::position]);
    REQUIRE(f[3] == wanted[N::duty]);
  }
}
