// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// link_stream: RTL against twin on every clock, and its frames against the ticks that were sent.
// Documentation: docs/link.md
#include <Vlink_stream.h>

#include <algorithm>
#include <set>
#include <vector>

#include "../link/tick_words.hpp"
#include "catch.hpp"
#include "feltgate/link_stream.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Twin = LinkStream;
using A = LinkMap::A;

struct Adapter {
  static void drive(Vlink_stream& rtl, const Twin::In& in) {
    FELTGATE_DRIVE(rtl, in, word_valid, word_number, word_data, addr, wdata, write, ready);
  }
  template <class Check>
  static void compare(Check& check, const Vlink_stream& rtl, const Twin::Out& out) {
    FELTGATE_COMPARE(check, rtl, out, rdata, valid, byte, last);
  }
};
using Bench = LockStep<Vlink_stream, Twin, Adapter>;

/// A host that writes, a transmitter that is ready one clock in `pace`.
struct Stimulus {
  Random random;
  TickWords words;
  bool writes = true;
  std::uint32_t mask = 0, period = 0;
  std::uint32_t pace = 1;
  int at = 0;

  Twin::In operator()(std::int64_t) {
    Twin::In in;
    const auto word = words.next(tick_word);
    in.word_valid = word.valid;
    in.word_number = word.number;
    in.word_data = word.data;
    in.ready = random.one_in(pace);
    if (at < 2) {  // after the reset that the bench begins with
      in.addr = at == 0 ? A::stream_words : A::stream_period;
      in.wdata = at == 0 ? mask : period;
      in.write = true;
    } else {
      in.addr = static_cast<std::uint16_t>(A::stream_words + random.below(4));
    }
    if (at < 2 && wait-- <= 0) ++at;
    if (at == 2 && writes) {
      if (random.one_in(8)) in.addr ^= static_cast<std::uint16_t>(1u << random.below(16));
      in.write = random.one_in(200);
      in.wdata = random.coin()   ? random.below(4)
                 : random.coin() ? 1u << random.below(32)
                                 : static_cast<std::uint32_t>(random.bits());
      if (random.one_in(300)) pace = 1 + random.below(random.coin() ? 3 : 40);
    }
    return in;
  }
  int wait = 8;
};

/// Frames as they come out of the RTL.
struct Frames {
  std::vector<std::vector<std::uint8_t>>* all;
  std::vector<std::uint8_t> now;

  const char* operator()(const Twin::In& in, const Vlink_stream& rtl, const Twin&, bool reset) {
    if (reset) now.clear(), shown = false;
    if (shown && in.ready && !reset) {
      now.push_back(byte);
      if (last) all->push_back(now), now.clear();
    }
    shown = rtl.valid_o != 0;
    byte = rtl.byte_o;
    last = rtl.last_o != 0;
    return nullptr;
  }
  bool shown = false, last = false;
  std::uint8_t byte = 0;
};

struct Frame {
  unsigned kind, count, mask;
  std::vector<std::uint32_t> words;
};
Frame parsed(const std::vector<std::uint8_t>& bytes) {
  REQUIRE(bytes.size() >= 8);
  REQUIRE(bytes.size() % 4 == 0);
  Frame f{bytes[0], bytes[1], static_cast<unsigned>(bytes[2] | bytes[3] << 8), {}};
  for (std::size_t k = 4; k < bytes.size(); k += 4) {
    f.words.push_back(static_cast<std::uint32_t>(bytes[k]) | bytes[k + 1] << 8 |
                      bytes[k + 2] << 16 | static_cast<std::uint32_t>(bytes[k + 3]) << 24);
  }
  return f;
}
/// Checks that all words are of the tick in the frame; returns this tick.
std::uint32_t check_frame(const Frame& f) {
  REQUIRE(f.kind == LinkMap::kind_stream);
  REQUIRE((f.mask >> LinkMap::N::tick & 1u) == 1);
  std::size_t at = 0;
  std::uint32_t tick = 0;
  for (int k = 0; k < LinkMap::N::tick; ++k) at += f.mask >> k & 1u;
  REQUIRE(at < f.words.size());
  tick = f.words[at];
  at = 0;
  for (int k = 0; k < LinkMap::snapshot_words; ++k) {
    if ((f.mask >> k & 1u) == 0) continue;
    REQUIRE(at < f.words.size());
    REQUIRE(f.words[at++] == tick_word(tick, k));
  }
  REQUIRE(at == f.words.size());
  REQUIRE(f.mask >> LinkMap::snapshot_words == 0);
  return tick;
}

/// The frames of a host that writes its settings and nothing else.
std::vector<Frame> play(const Stimulus& stimulus, std::int64_t clocks) {
  std::vector<std::vector<std::uint8_t>> raw;
  Bench bench("link_stream", 1);
  bench.run(stimulus, clocks, {}, Frames{&raw, {}});
  std::vector<Frame> frames;
  for (const auto& bytes : raw) frames.push_back(parsed(bytes));
  return frames;
}

}  // namespace

TEST_CASE("link_stream: random ticks, registers, transmitters and resets") {
  std::vector<std::vector<std::uint8_t>> raw;
  Bench bench("link_stream", 1);
  bench.run(Stimulus{Random(2), TickWords(3)}, scaled_clocks(600'000), {}, Frames{&raw, {}});
  bench.run(Stimulus{Random(14), TickWords(15, false, true)}, scaled_clocks(400'000), {40'000});
  REQUIRE(raw.size() > 1000);
  std::set<unsigned> masks;
  for (const auto& bytes : raw) {
    const Frame f = parsed(bytes);
    check_frame(f);
    masks.insert(f.mask);
  }
  REQUIRE(masks.size() > raw.size() / 20);
}

TEST_CASE("link_stream: bytes without a pause but where the next word is looked for") {
  struct Case {
    std::uint32_t mask;
    int longest;  ///< clocks
  };
  for (const Case& c : {Case{0, 3}, {0x001, 2}, {0x401, 8}, {0x800, 9}, {0xfff, 1}}) {
    Stimulus stimulus{Random(16), TickWords(17), false, c.mask, 5};
    int pause = 0, longest = 0, pauses = 0;
    bool within = false;
    const auto watch = [&](const Twin::In&, const Vlink_stream& rtl, const Twin&,
                           bool) -> const char* {
      if (rtl.valid_o == 0) return ++pause, nullptr;
      if (within) longest = std::max(longest, pause), pauses += pause > 0;
      pause = 0;
      within = rtl.last_o == 0;
      return nullptr;
    };
    Bench bench("link_stream", 1);
    bench.run(stimulus, 6000, {}, watch);
    INFO("mask " << c.mask);
    REQUIRE(longest == c.longest);
    REQUIRE(pauses > 10);
  }
}

TEST_CASE("link_stream: every period, counted") {
  for (const std::uint32_t period : {2u, 3u, 7u, 50u}) {
    const auto frames = play({Random(6), TickWords(7), false, 0, period}, 40'000);
    REQUIRE(frames.size() > 10);
    for (std::size_t n = 1; n < frames.size(); ++n) {
      REQUIRE(check_frame(frames[n]) - check_frame(frames[n - 1]) == period);
      REQUIRE(frames[n].count == ((frames[0].count + n) & 255u));
    }
    REQUIRE(frames[0].count == 0);
  }
}

TEST_CASE("link_stream: off is off") {
  REQUIRE(play({Random(10), TickWords(11), false, 0xfff, 0}, 20'000).empty());
}

TEST_CASE("link_stream: a period beyond its bits is the longest, what is written is read back") {
  for (const std::uint32_t period : {0u, 1u, 0xffffffu, 0x1000000u, 0xffffffffu}) {
    Twin twin;
    std::vector<Twin::In> list(40);
    list[10].addr = A::stream_period;
    list[10].wdata = period;
    list[10].write = true;
    for (std::size_t k = 11; k < list.size(); ++k) list[k].addr = A::stream_period;
    Bench bench("link_stream", 1);
    REQUIRE(bench.run_list(list).out().rdata == (period > 0xffffffu ? 0xffffffu : period));
  }
}

TEST_CASE("link_stream: the longest period, and as many dropped frames", "[endurance]") {
  for (const std::uint32_t period : {0xffffffu, 1u}) {
    // A tick in every clock, more than the core has, so that the counters come round. The first
    // frame is never taken, so all that follow are dropped.
    const auto stimulus = [period](std::int64_t k) {
      Twin::In in;
      in.word_valid = true;
      in.word_number = LinkMap::N::status;
      in.word_data = static_cast<std::uint32_t>(k);
      in.addr = A::stream_dropped;
      in.write = k == Bench::kFirstReset;
      if (in.write) in.addr = A::stream_period, in.wdata = period;
      return in;
    };
    std::uint32_t dropped = 0;
    const auto note = [&](const Twin::In&, const Vlink_stream&, const Twin& twin,
                          bool) -> const char* { return dropped = twin.out().rdata, nullptr; };
    Bench bench("link_stream", 1);
    bench.run(stimulus, (std::int64_t{1} << 24) + 100, {}, note);
    INFO("period " << period << ", dropped " << dropped);
    REQUIRE((period == 1 ? dropped > 1u << 24 : dropped == 1));
  }
}

TEST_CASE("link_stream: the twin's whole ticks at once are its clocks") {
  Random random(12);
  int passed = 0, stepped = 0, bytes = 0;
  for (int n = 0; n < 50; ++n) {
    Stimulus stimulus{Random(random.bits()), TickWords(13, true), false, 1, 2 + random.below(30)};
    Twin by_clock, by_tick;
    // Up to the end of a tick in which nothing is sent.
    std::int64_t k = 0;
    const auto tick = [&] {
      const std::uint32_t now = stimulus.words.tick();
      std::vector<Twin::In> list;
      while (stimulus.words.tick() == now) list.push_back(stimulus(k++));
      list.push_back(stimulus(k++));  // the clock between two ticks
      return list;
    };
    for (int t = 0; t < 6; ++t) {
      for (const Twin::In& in : tick()) by_clock.clock(in), by_tick.clock(in);
    }
    for (int t = 0; t < 200; ++t) {
      const bool passes = by_tick.idle() && by_tick.ticks_to_frame() > 0;
      if (passes) by_tick.pass_ticks(1);
      ++(passes ? passed : stepped);
      for (const Twin::In& in : tick()) {
        by_clock.clock(in);
        if (!passes) {
          by_tick.clock(in);
          REQUIRE(by_clock.out().valid == by_tick.out().valid);
          REQUIRE(by_clock.out().byte == by_tick.out().byte);
          bytes += by_clock.out().valid && in.ready;
        } else {
          REQUIRE_FALSE(by_clock.out().valid);
        }
      }
    }
  }
  REQUIRE(passed > 1000);
  REQUIRE(stepped > 1000);
  REQUIRE(bytes > 1000);
}

// link_stream: the twin's prediction for coming ticks, for code that skips them.

namespace {

struct Host {
  LinkStream twin;

  void write(std::uint16_t address, std::uint32_t data) {
    LinkStream::In in;
    in.addr = address;
    in.wdata = data;
    in.write = true;
    twin.clock(in);
  }
  void word(unsigned k) {
    LinkStream::In in;
    in.word_valid = true;
    in.word_number = static_cast<std::uint8_t>(number_at(static_cast<int>(k)));
    in.word_data = 0x100 + k;
    twin.clock(in);
  }
  void tick() {
    for (unsigned k = 0; k < LinkMap::snapshot_words; ++k) word(k);
  }
  /// Bytes until the frame is over, each as soon as it is there.
  int take_frame() {
    int bytes = 0;
    for (int k = 0; k < 500 && !twin.idle(); ++k) {
      LinkStream::In in;
      in.ready = true;
      bytes += twin.out().valid ? 1 : 0;
      twin.clock(in);
    }
    return bytes;
  }
};

}  // namespace

TEST_CASE("link_stream: a stream that is off wants no tick") {
  Host h;
  CHECK_FALSE(h.twin.on());
  CHECK(h.twin.waits());
  CHECK(h.twin.idle());
  CHECK_FALSE(h.twin.keeps());
  CHECK(h.twin.ticks_to_frame() == LinkStream::kNever);
  h.write(A::stream_words, 0x7);
  h.tick();
  CHECK_FALSE(h.twin.on());
  CHECK_FALSE(h.twin.keeps());
}

TEST_CASE("link_stream: which ticks it keeps") {
  Host h;
  h.write(A::stream_words, 0x3);  // two, and always that of the tick
  h.write(A::stream_period, 3);
  CHECK(h.twin.on());
  for (int frame = 0; frame < 3; ++frame) {
    CAPTURE(frame);
    CHECK(h.twin.ticks_to_frame() == 0);
    CHECK(h.twin.keeps());
    h.word(0);
    CHECK_FALSE(h.twin.idle());
    CHECK(h.twin.keeps());
    for (unsigned k = 1; k < LinkMap::snapshot_words; ++k) h.word(k);
    CHECK_FALSE(h.twin.keeps());  // the frame has its words
    CHECK(h.twin.waits());
    CHECK(h.take_frame() == 4 + 3 * 4);
    CHECK(h.twin.idle());
    CHECK(h.twin.waits());
    CHECK(h.twin.ticks_to_frame() == 2);
    CHECK_FALSE(h.twin.keeps());
    if (frame == 1) {
      h.twin.pass_ticks(2);
    } else {
      h.tick();
      CHECK(h.twin.ticks_to_frame() == 1);
      CHECK_FALSE(h.twin.keeps());
      h.tick();
    }
  }
}

TEST_CASE("link_stream: switched off amid a frame it ends the frame") {
  Host h;
  h.write(A::stream_words, 0x2);
  h.write(A::stream_period, 1);
  h.word(0);
  h.write(A::stream_period, 0);
  CHECK(h.twin.on());
  CHECK(h.twin.keeps());
  for (unsigned k = 1; k < LinkMap::snapshot_words; ++k) h.word(k);
  CHECK(h.twin.on());
  CHECK(h.take_frame() == 4 + 2 * 4);
  CHECK_FALSE(h.twin.on());
  CHECK(h.twin.ticks_to_frame() == LinkStream::kNever);
}

TEST_CASE("link_stream: between two words it looks for the next one, and does not wait") {
  Host h;
  h.write(A::stream_words, 1u << 5);
  h.write(A::stream_period, 1);
  h.tick();
  LinkStream::In in;
  in.ready = true;
  for (int k = 0; k < 4; ++k) {
    CHECK(h.twin.out().valid);
    CHECK(h.twin.waits());
    h.twin.clock(in);
  }
  CHECK_FALSE(h.twin.out().valid);
  CHECK_FALSE(h.twin.waits());
}
