// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// link_capture: RTL against twin on every clock; what was captured against the ticks that were
// sent. Documentation: docs/link.md
#include <Vlink_capture.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "../link/tick_words.hpp"
#include "catch.hpp"
#include "feltgate/link_capture.hpp"
#include "lock_step.hpp"
#include "ports.hpp"
#include "random.hpp"

// A capture from setting to reading, in lock-step: ticks of 28 clocks, writes in any of them, then
// all is read back from the RTL.

namespace feltgate::test {

constexpr int kRows = ROWS;
constexpr bool kEvents = EVENTS != 0;
constexpr int kTickClocks = 28;  ///< a word each two clocks from clock 2 on
constexpr int kLastWordClock = 24;

using CaptureTwin = LinkCapture<kRows, kEvents>;
using A = LinkMap::A;
using N = LinkMap::N;
constexpr std::uint32_t kStart = 1u << LinkMap::B::capture_control_start;
constexpr std::uint32_t kAbort = 1u << LinkMap::B::capture_control_abort;
constexpr std::uint32_t kTrigger = 1u << LinkMap::B::capture_control_trigger;

struct CaptureAdapter {
  static void drive(Vlink_capture& rtl, const CaptureTwin::In& in) {
    FELTGATE_DRIVE(rtl, in, word_valid, word_number, word_data, addr, wdata, write, event_valid);
    rtl.event_number_i = static_cast<std::uint16_t>(in.event_number);
  }
  template <class Check>
  static void compare(Check& check, const Vlink_capture& rtl, const CaptureTwin::Out& out) {
    check("rdata", rtl.rdata_o, out.rdata);
  }
};
using CaptureBench = LockStep<Vlink_capture, CaptureTwin, CaptureAdapter>;

using Content = std::function<std::uint32_t(std::uint32_t tick, int k)>;

/// What can be read when it is over.
struct Captured {
  std::uint32_t state = 0, first = 0, rows = 0;
  std::vector<std::array<std::uint32_t, 8>> ring;  ///< oldest first
};

class CaptureSession {
 public:
  explicit CaptureSession(std::size_t ticks, const Content& content = tick_word)
      : list_(kLead + ticks * kTickClocks), content_(content) {
    for (std::size_t t = 0; t < ticks; ++t) {
      for (int k = 0; k < LinkMap::snapshot_words; ++k) {
        auto& in = list_[kLead + t * kTickClocks + 2 * static_cast<std::size_t>(k) + 2];
        in.word_valid = true;
        in.word_number = static_cast<std::uint8_t>(number_at(k));
        in.word_data = content(static_cast<std::uint32_t>(t), number_at(k));
      }
    }
  }

  /// Before the first tick.
  CaptureSession& set(std::uint16_t addr, std::uint32_t data) {
    write(list_.at(lead_++), addr, data);
    return *this;
  }
  CaptureSession& trigger(int word, int mode, std::uint32_t level) {
    return set(A::trigger_word, static_cast<std::uint32_t>(word))
        .set(A::trigger_mode, static_cast<std::uint32_t>(mode))
        .set(A::trigger_level, level);
  }
  CaptureSession& at(std::size_t tick, int clock, std::uint16_t addr, std::uint32_t data) {
    write(list_.at(kLead + tick * kTickClocks + static_cast<std::size_t>(clock)), addr, data);
    return *this;
  }
  CaptureSession& event(std::size_t tick, int clock, int number) {
    auto& in = list_.at(kLead + tick * kTickClocks + static_cast<std::size_t>(clock));
    in.event_valid = true;
    in.event_number = number;
    return *this;
  }

  Captured play() {
    const std::size_t begin = list_.size();
    read(A::capture_state), read(A::capture_first), read(A::capture_rows);
    for (int at = 0; at < kRows * 8; ++at) {
      read(static_cast<std::uint16_t>(LinkMap::memory + static_cast<unsigned>(at)));
    }
    list_.resize(list_.size() + 4);
    std::vector<std::uint32_t> seen;
    const auto keep = [&seen](const CaptureTwin::In&, const Vlink_capture& rtl, const CaptureTwin&,
                              bool) -> const char* {
      seen.push_back(rtl.rdata_o);
      return nullptr;
    };
    const auto stimulus = [this](std::int64_t clock) {
      const std::int64_t k = clock - CaptureBench::kFirstReset;
      return k < 0 ? CaptureTwin::In{} : list_[static_cast<std::size_t>(k)];
    };
    CaptureBench bench("link_capture", 1);
    bench.run(stimulus, static_cast<std::int64_t>(list_.size()) + CaptureBench::kFirstReset, {},
              keep);
    // Three clocks from an address to its word; the observer sees what is there after the edge.
    const auto word = [&](std::size_t n) {
      return seen.at(begin + n + 2 + static_cast<std::size_t>(CaptureBench::kFirstReset));
    };
    Captured c{word(0), word(1), word(2), {}};
    for (std::uint32_t n = 0; n < kRows; ++n) {
      const std::size_t row = (c.first + n) % kRows;
      std::array<std::uint32_t, 8> words{};
      for (std::size_t k = 0; k < 8; ++k) words[k] = word(3 + row * 8 + k);
      if (n < c.rows) {
        c.ring.push_back(words);
      } else {
        for (const std::uint32_t w : words) REQUIRE(w == 0);
      }
    }
    return c;
  }

  /// The rows are those of the ticks from `first` on, `period` apart; what no word is in is 0.
  void check(const Captured& c, std::uint32_t mask, std::uint32_t first, std::uint32_t period = 1) {
    for (std::size_t n = 0; n < c.ring.size(); ++n) {
      const auto tick = first + static_cast<std::uint32_t>(n) * period;
      std::array<std::uint32_t, 8> wanted{};
      std::size_t column = 0;
      for (int k = 0; k < LinkMap::snapshot_words && column < 8; ++k) {
        if ((mask >> k & 1u) != 0) wanted[column++] = content_(tick, k);
      }
      INFO("row " << n << " of " << c.ring.size() << ", tick " << tick);
      REQUIRE(c.ring[n] == wanted);
    }
  }

 private:
  static constexpr std::size_t kLead = 12;
  static void write(CaptureTwin::In& in, std::uint16_t addr, std::uint32_t data) {
    in.addr = addr;
    in.wdata = data;
    in.write = true;
  }
  void read(std::uint16_t addr) {
    CaptureTwin::In in;
    in.addr = addr;
    list_.push_back(in);
  }
  std::vector<CaptureTwin::In> list_;
  std::size_t lead_ = 0;
  Content content_;
};

constexpr auto kDone = static_cast<std::uint32_t>(CaptureTwin::State::done);
constexpr auto kWaits = static_cast<std::uint32_t>(CaptureTwin::State::wait);
constexpr auto kIdle = static_cast<std::uint32_t>(CaptureTwin::State::idle);
constexpr std::uint32_t kTick = 1u << N::tick;

/// The word k is `value(tick)`, the others are as they are.
template <class Value>
Content with(int word, const Value& value) {
  return [word, value](std::uint32_t tick, int k) {
    return k == word ? static_cast<std::uint32_t>(value(tick)) : tick_word(tick, k);
  };
}
/// Below zero before the tick, above from it on.
inline Content rises_in(std::uint32_t tick, int word = N::position) {
  return with(
      word, [tick](std::uint32_t t) { return (static_cast<std::int32_t>(t - tick) + 1) * 5 - 3; });
}

struct Plan {
  std::uint32_t mask = kTick | 1u << N::position, pre = 3, period = 0;
};
inline CaptureSession session(const Plan& plan, std::size_t ticks, const Content& content) {
  CaptureSession s(ticks, content);
  s.set(A::capture_words, plan.mask)
      .set(A::capture_pre, plan.pre)
      .set(A::capture_period, plan.period);
  return s;
}

}  // namespace feltgate::test

using namespace feltgate;
using namespace feltgate::test;

namespace {

/// A host that sets, starts, aborts and reads at random; the words seldom leave small numbers.
struct Stimulus {
  Random random;
  TickWords words;

  CaptureTwin::In operator()(std::int64_t) {
    CaptureTwin::In in;
    const auto word = words.next([this](std::uint32_t, int) {
      return random.one_in(20) ? static_cast<std::uint32_t>(random.bits()) : random.below(16) - 8;
    });
    in.word_valid = word.valid;
    in.word_number = word.number;
    in.word_data = word.data;
    in.event_valid = random.one_in(40);
    in.event_number = static_cast<int>(random.coin() ? random.below(16) : random.below(512));
    in.addr = static_cast<std::uint16_t>(A::capture_control + random.below(11));
    if (random.coin())
      in.addr = static_cast<std::uint16_t>(LinkMap::memory + random.below(kRows * 8));
    if (random.one_in(40)) in.addr ^= static_cast<std::uint16_t>(1u << random.below(16));
    if (!random.one_in(busy ? 30 : 800)) return in;
    in.write = true;
    in.addr = static_cast<std::uint16_t>(A::capture_control + random.below(10));
    in.wdata = random.below(16) - (random.one_in(4) ? 8 : 0);
    if (in.addr == A::capture_words || random.one_in(20))
      in.wdata = static_cast<std::uint32_t>(random.bits());
    if (in.addr == A::trigger_mode && random.coin()) in.wdata = LinkMap::trigger_event;
    if (in.addr == A::trigger_word && random.coin()) in.wdata = random.below(12);
    if (in.addr == A::capture_period)
      in.wdata = random.one_in(30) ? 0x10000u << random.below(16) : random.below(4);
    if (in.addr == A::capture_control || random.one_in(4)) {
      in.addr = A::capture_control;
      in.wdata = random.coin()      ? kStart
                 : random.one_in(3) ? kAbort
                                    : static_cast<std::uint32_t>(random.below(8));
    }
    if (random.one_in(100)) busy = !busy;
    return in;
  }
  bool busy = true;
};

}  // namespace

TEST_CASE("link_capture: random hosts, words and resets") {
  std::array<std::int64_t, 5> ends{};
  std::int64_t by_event = 0;
  bool hand = false;
  std::uint32_t mode = 0;
  auto before = CaptureTwin::State::idle;
  const auto count = [&](const CaptureTwin::In& in, const Vlink_capture&, const CaptureTwin& twin,
                         bool) -> const char* {
    using State = CaptureTwin::State;
    const bool fired = before == State::wait && (twin.state() == State::rest);
    by_event += fired && mode == LinkMap::trigger_event && !hand;
    if (in.write && in.addr == A::capture_control) {
      hand = (in.wdata & kTrigger) != 0 || (hand && (in.wdata & kStart) == 0);
    } else if (fired) {
      hand = false;
    }
    if (in.write && in.addr == A::trigger_mode) mode = in.wdata & 7;
    before = twin.state();
    ++ends[static_cast<std::size_t>(twin.state())];
    return nullptr;
  };
  CaptureBench bench("link_capture", 1);
  const std::int64_t clocks = scaled_clocks(800'000);
  bench.run(Stimulus{Random(2), TickWords(3)}, clocks, {60'000}, count);
  bench.run(Stimulus{Random(4), TickWords(5, true)}, clocks / 2, {60'000}, count);
  for (std::size_t k = 0; k < ends.size() - (kRows > 16); ++k) REQUIRE(ends[k] > clocks / 100);
  if (kEvents && kRows == 16) REQUIRE(by_event > 10);
}

TEST_CASE("link_capture: a rise to the level, with every number of rows before it") {
  for (const std::uint32_t pre :
       {0u, 1u, 7u, std::uint32_t{kRows} / 2, std::uint32_t{kRows} - 2, std::uint32_t{kRows} - 1}) {
    const std::uint32_t tick = pre + kRows / 2 + 5;
    auto s = session({kTick | 1u << N::position, pre}, tick + kRows + 3, rises_in(tick));
    const auto c = s.trigger(N::position, 1, 0).set(A::capture_control, kStart).play();
    REQUIRE(c.state == kDone);
    REQUIRE(c.rows == kRows);
    s.check(c, kTick | 1u << N::position, tick - pre);
  }
}

TEST_CASE("link_capture: levels are signed, reached is enough to rise and not to fall") {
  struct Case {
    int mode;
    std::int32_t level, before, after;
    bool fires;
  };
  constexpr std::int32_t low = INT32_MIN, high = INT32_MAX;
  for (const Case& t : {Case{1, 0, -1, 0, true},
                        {1, -5, -6, -5, true},
                        {1, 0, -2, -1, false},
                        {1, 0, 0, 1, false},
                        {1, high, low, high, true},
                        {1, low, low, high, false},
                        {2, 0, 0, -1, true},
                        {2, -5, -5, -6, true},
                        {2, 0, 1, 0, false},
                        {2, 0, -1, -2, false},
                        {2, low, high, low, false},
                        {2, high, high, low, true},
                        {0, 0, -1, 1, false},
                        {3, 6, 0, 8, false},
                        {3, 6, 0, 2, true},
                        {3, 6, 2, 4, true},
                        {3, 6, 6, 2, false},
                        {3, low, 0, low, true},
                        {3, 0, 0, -1, false}}) {
    const std::uint32_t tick = 11;
    auto s =
        session({kTick, 4}, tick + kRows + 3,
                with(N::tau_ref, [&](std::uint32_t k) { return k < tick ? t.before : t.after; }));
    const auto c = s.trigger(N::tau_ref, t.mode, static_cast<std::uint32_t>(t.level))
                       .set(A::capture_control, kStart)
                       .play();
    INFO("mode " << t.mode << ", level " << t.level << ", " << t.before << " to " << t.after);
    REQUIRE((c.state == kDone) == t.fires);
    if (t.fires) s.check(c, kTick, tick - 4);
  }
}

TEST_CASE("link_capture: a trigger in the very first tick, and one that stood before is none") {
  // The start between two ticks and within one: the next tick that begins is the first.
  for (const int clock : {0, 1, 2, 3, 13, kLastWordClock, kLastWordClock + 1, kTickClocks - 1}) {
    const std::uint32_t begun = 5 + (clock > 1 ? 1u : 0u);
    for (const std::uint32_t tick : {4u, begun - 1, begun}) {
      auto s = session({kTick, 0}, begun + kRows + 3, rises_in(tick));
      const auto c = s.trigger(N::position, 1, 0).at(5, clock, A::capture_control, kStart).play();
      INFO("start in clock " << clock << ", rises in tick " << tick);
      REQUIRE((c.state == kDone) == (tick == begun));
      if (tick == begun) s.check(c, kTick, begun);
    }
    auto s = session({kTick, 0}, 30, tick_word);
    s.trigger(0, LinkMap::trigger_event, 3).event(5, std::max(clock - 1, 0), 3);
    REQUIRE(s.at(5, clock, A::capture_control, kStart).play().state == kWaits);
  }
}

TEST_CASE("link_capture: by hand, in every clock of a tick, and with the start") {
  for (int clock = 0; clock < kTickClocks; ++clock) {
    auto s = session({kTick, 2}, kRows + 20, tick_word);
    const auto c =
        s.set(A::capture_control, kStart).at(8, clock, A::capture_control, kTrigger).play();
    REQUIRE(c.state == kDone);
    s.check(c, kTick, clock > kLastWordClock ? 7 : 6);
  }
  auto s = session({kTick, 2}, kRows + 20, tick_word);
  const auto c = s.set(A::capture_control, kStart | kTrigger).play();
  REQUIRE(c.state == kDone);
  s.check(c, kTick, 0);
  // A trigger before the start is forgotten.
  auto t = session({kTick, 2}, kRows + 20, tick_word);
  REQUIRE(t.set(A::capture_control, kTrigger).set(A::capture_control, kStart).play().state !=
          kDone);
}

TEST_CASE("link_capture: an abort in any clock leaves whole rows, one after the other") {
  for (const std::uint32_t tick : {1u, 5u, std::uint32_t{kRows} + 3}) {
    for (int clock = 0; clock < kTickClocks; ++clock) {
      auto s = session({0xffu | kTick, 3}, tick + 4, tick_word);
      const auto c = s.set(A::capture_control, kStart)
                         .at(tick, clock, A::capture_control, kAbort | kStart)
                         .play();
      INFO("tick " << tick << ", clock " << clock);
      REQUIRE(c.state == kIdle);
      const std::uint32_t whole =
          tick + (clock > kLastWordClock ? 1u : 0u);  // rows that came to their end
      const std::uint32_t left = whole < kRows                           ? whole
                                 : clock >= 2 && clock <= kLastWordClock ? kRows - 1
                                                                         : kRows;
      REQUIRE(c.rows == left);
      s.check(c, 0xff, whole - left);
    }
  }
  // After the end it changes nothing.
  auto s = session({kTick, 0}, kRows + 9, tick_word);
  const auto c = s.set(A::capture_control, kStart | kTrigger)
                     .at(kRows + 4, 3, A::capture_control, kAbort)
                     .play();
  REQUIRE(c.state == kDone);
  s.check(c, kTick, 0);
}

TEST_CASE("link_capture: a start while another runs, or is over, begins anew") {
  for (const std::uint32_t tick : {2u, 6u, 10u, std::uint32_t{kRows} + 20}) {
    for (const int clock : {0, 2, 14, kLastWordClock, kLastWordClock + 1}) {
      auto s = session({kTick, 4}, tick + kRows + 20,
                       with(N::status, [](std::uint32_t t) { return t == 9; }));
      s.trigger(N::status, 3, 1).set(A::capture_control, kStart);
      const auto c = s.at(tick, clock, A::capture_control, kStart)
                         .at(tick + 8, 0, A::capture_control, kTrigger)
                         .play();
      REQUIRE(c.state == kDone);
      const std::uint32_t begun = tick + (clock > 1 ? 1u : 0u);
      const std::uint32_t fired = 9 >= begun + 4 ? 9 : tick + 8;
      s.check(c, kTick, fired - 4);
    }
  }
}

TEST_CASE("link_capture: what makes up the rows holds still while they are taken") {
  auto s = session({kTick, 4, 1}, kRows + 20, tick_word);
  s.set(A::capture_control, kStart);
  s.at(2, 3, A::capture_words, 0xff).at(3, 3, A::capture_pre, 1).at(9, 3, A::capture_period, 5);
  s.at(12, 0, A::capture_control, kTrigger).at(14, 0, A::capture_words, 0);
  const auto c = s.play();
  REQUIRE(c.state == kDone);
  s.check(c, kTick, 8);
  // Set after it, they belong to the next; the memory is as it was.
  auto t = session({kTick | 1, 0}, kRows + 20, tick_word);
  t.set(A::capture_control, kStart | kTrigger).at(kRows + 10, 0, A::capture_words, 0);
  t.check(t.play(), kTick | 1, 0);
}

TEST_CASE("link_capture: a row every so many ticks, triggers between them") {
  for (const std::uint32_t period : {2u, 3u, 10u}) {
    for (std::uint32_t tick = 30; tick < 30 + period; ++tick) {
      auto s = session({kTick, 2, period}, tick + (kRows + 3) * period, rises_in(tick));
      const auto c = s.trigger(N::position, 1, 0).set(A::capture_control, kStart).play();
      REQUIRE(c.state == kDone);
      const std::uint32_t row =
          (tick + period - 1) / period * period;  // of the trigger, or the next
      s.check(c, kTick, row - 2 * period, period);
    }
    if (kRows > 16) break;
  }
  // The longest period: one row, and no second one.
  auto s = session({kTick, 0, 0x10000}, 40, tick_word);
  const auto c =
      s.set(A::capture_control, kStart | kTrigger).at(39, 27, A::capture_control, kAbort).play();
  REQUIRE(c.rows == 1);
}

// link_capture: every bit of what is set, compared and counted.

namespace {

std::uint32_t read_back(std::uint16_t addr, std::uint32_t written) {
  std::vector<CaptureTwin::In> list(20);
  list[5].addr = addr;
  list[5].wdata = written;
  list[5].write = true;
  for (std::size_t k = 6; k < list.size(); ++k) list[k].addr = addr;
  CaptureBench bench("link_capture", 1);
  return bench.run_list(list).out().rdata;
}

}  // namespace

TEST_CASE("link_capture: what is written is read back, as much of it as there is") {
  struct Case {
    std::uint16_t addr;
    std::uint32_t written, read;
  };
  for (const Case& t : {Case{A::capture_words, 0xffffffffu, 0xfff},
                        {A::capture_pre, kRows - 1, kRows - 1},
                        {A::capture_pre, kRows, kRows - 1},
                        {A::capture_pre, 0x80000000u, kRows - 1},
                        {A::capture_period, 0xffff, 0xffff},
                        {A::capture_period, 0x10000, 0xffff},
                        {A::trigger_word, 11, 11},
                        {A::trigger_word, 0x100, 15},
                        {A::trigger_mode, 15, kEvents ? 7 : 3},
                        {A::trigger_level, 0x87654321u, 0x87654321u},
                        {A::capture_state, 3, 0},
                        {A::capture_control, 0, 0},
                        {0x1010, 7, 0},
                        {A::capture_first, 3, 0}}) {
    REQUIRE(read_back(t.addr, t.written) == t.read);
  }
  for (int bit = 16; bit < 32; ++bit) {  // of one bit beyond what there is
    REQUIRE(read_back(A::capture_pre, 1u << bit) == kRows - 1);
    REQUIRE(read_back(A::capture_period, 1u << bit) == 0xffff);
  }
}

TEST_CASE("link_capture: a long period, counted in all its bits") {
  for (const std::uint32_t period : {0x1555u, 0x0aabu}) {
    auto s = session({kTick, 0, period}, 2 * period + 5, tick_word);
    const auto c = s.set(A::capture_control, kStart | kTrigger)
                       .at(2 * period + 4, 27, A::capture_control, kAbort)
                       .play();
    REQUIRE(c.rows == 3);
    s.check(c, kTick, 0, period);
  }
}

TEST_CASE("link_capture: each bit triggers where it rises, whatever the others do") {
  for (int bit = 0; bit < 32; ++bit) {
    for (const std::uint32_t others : {0u, 0xffffffffu, 0x5a5a5a5au}) {
      const std::uint32_t one = 1u << bit, tick = 11;
      auto s = session({kTick, 4}, tick + kRows + 3, with(N::tau_ref, [&](std::uint32_t t) {
                         // Before its tick the others come and go beside it, then it does.
                         const std::uint32_t all = t % 2 == 0 ? others : ~others;
                         return t < tick ? all & ~one : all | one;
                       }));
      const auto c =
          s.trigger(N::tau_ref, LinkMap::trigger_bit, one).set(A::capture_control, kStart).play();
      INFO("bit " << bit << ", others " << others);
      REQUIRE(c.state == kDone);
      s.check(c, kTick, tick - 4);
    }
    // Set all along it never rises.
    auto high = session({kTick, 4}, 20, with(N::tau_ref, [&](std::uint32_t t) {
                          return t % 2 == 0 ? 0xffffffffu : 1u << bit;
                        }));
    const auto c = high.trigger(N::tau_ref, LinkMap::trigger_bit, 1u << bit)
                       .set(A::capture_control, kStart)
                       .play();
    REQUIRE(c.state == kWaits);
    if (kRows > 16) break;
  }
}

TEST_CASE("link_capture: a tick at once is one word by word") {
  Random random(6);
  CaptureTwin at_once, by_words;
  std::array<std::int64_t, 5> states{};
  for (int t = 0; t < 20'000; ++t) {
    CaptureTwin::In in;
    if (random.one_in(3)) {
      in.write = true;
      in.addr = static_cast<std::uint16_t>(A::capture_control + random.below(10));
      in.wdata = in.addr == A::capture_words ? kTick | 1u << N::position : random.below(8);
    }
    for (CaptureTwin* twin : {&at_once, &by_words}) {
      twin->clock(in);
      twin->clock({});
    }
    std::array<std::uint32_t, LinkMap::snapshot_words> words{};
    for (std::uint32_t& w : words) w = random.below(16) - 8;
    if (kEvents && random.one_in(5)) {  // in the clock before the tick, or told of after it
      CaptureTwin::In event;
      event.event_valid = true;
      event.event_number = static_cast<int>(random.below(4));
      by_words.clock(event);
      random.coin() ? at_once.clock(event) : at_once.event(event.event_number);
    }
    at_once.tick(words);
    for (std::size_t k = 0; k < words.size(); ++k) {
      CaptureTwin::In word;
      word.word_valid = true;
      word.word_number = static_cast<std::uint8_t>(number_at(static_cast<int>(k)));
      word.word_data = words[word.word_number];
      by_words.clock(word);
    }
    const int reads = random.one_in(4) ? 20 : 1;
    for (int k = 0; k < reads; ++k) {
      CaptureTwin::In read;
      read.addr =
          static_cast<std::uint16_t>(random.one_in(3) ? LinkMap::memory + random.below(kRows * 8)
                                                      : A::capture_control + random.below(11));
      at_once.clock(read);
      by_words.clock(read);
      REQUIRE(at_once.state() == by_words.state());
      // A word comes three clocks after its address, and before they were not at the same clock.
      if (k >= 3) REQUIRE(at_once.out().rdata == by_words.out().rdata);
    }
    ++states[static_cast<std::size_t>(at_once.state())];
  }
  if (kRows > 16) return;  // a long ring seldom fills
  for (const std::int64_t n : states) CHECK(n > 100);
}

// link_capture triggered by an event of a law.

TEST_CASE("link_capture: an event of the number, or of any") {
  constexpr std::uint32_t any = LinkMap::any_event;
  struct Case {
    std::uint32_t mode, level;
    int number;
    bool fires;
  };
  for (const Case& t : {Case{4, 0, 0, true},
                        {4, 0, 1, false},
                        {4, 0, 256, false},
                        {4, 511, 511, true},
                        {4, 511, 510, false},
                        {4, 256, 256, true},
                        {4, 256, 0, false},
                        {4, any, 0, true},
                        {4, any, 511, true},
                        {4, any | 7, 300, true},
                        {4, 0xfffffc00u | 5, 5, true},
                        {4, 0xfffffc00u | 5, 4, false},
                        {12, 5, 5, true},
                        {0, 0, 0, false},
                        {1, 0, 0, false},
                        {2, 0, 0, false},
                        {3, 0, 0, false},
                        {5, 0, 0, false},
                        {6, 0, 0, false},
                        {7, 0, 0, false}}) {
    // Nothing else that could trigger: the word of the trigger is the status, which stays 0.
    auto s = session({kTick, 4}, 11 + kRows + 3, with(N::status, [](std::uint32_t) { return 0; }));
    const auto c = s.trigger(N::status, static_cast<int>(t.mode), t.level)
                       .set(A::capture_control, kStart)
                       .event(11, 6, t.number)
                       .play();
    INFO("mode " << t.mode << ", level " << t.level << ", number " << t.number);
    REQUIRE((c.state == kDone) == (t.fires && kEvents));
    if (c.state == kDone) s.check(c, kTick, 7);
  }
}
