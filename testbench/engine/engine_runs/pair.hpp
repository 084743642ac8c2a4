// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The engine's twin twice, clock by clock and run by run, on a device whose axes show random
// numbers. Documentation: docs/blocks/engine.md
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "../machine/machine_programs.hpp"
#include "catch.hpp"
#include "feltgate/engine_runs.hpp"
#include "random.hpp"

namespace feltgate::test {

using H = EngineMap::H;

template <int N>
class Pair {
 public:
  using Runs = law::EngineRuns<N>;
  using In = typename Runs::In;
  using Out = typename Runs::Out;
  using Axes = typename Runs::Axes;
  static constexpr law::RunTiming timing{50, 12, 8, 11};  ///< as the lever's
  static constexpr int measured = 15;                     ///< clock of a tick with In::tick
  static constexpr int taken = 2;                         ///< clock in which the axes take torques
  static constexpr int told =
      measured + timing.known_for;  ///< a tick's watch is looked at after it

  explicit Pair(std::uint64_t seed, unsigned max_age = 4000)
      : by_clock(max_age, 21, timing),
        by_event(max_age, 21, timing),
        random_(seed),
        next_(draw()) {}

  Runs by_clock, by_event;
  In in;  ///< of a host; what the axes show is added
  std::int64_t done = 0, whole = 0;
  bool by_clock_alone = false;  ///< nothing is passed
  bool hasty = false;           ///< a word is not waited for

  void load(const EngineMemory& m) {
    by_clock.clocked().memory() = m;
    by_event.clocked().memory() = m;
  }
  void run(std::int64_t clocks) {
    for (std::int64_t at = 0; at < clocks;) at += pass_or_clock(clocks - at);
    same();
  }
  void ticks(int n) { run(n * std::int64_t{timing.clocks_per_tick} - clock_); }
  void until(int clock) {
    while (clock_ != clock) run(1);
  }
  void write(int address, std::uint32_t word) {
    in.addr = static_cast<unsigned>(address);
    in.wdata = word;
    in.write = true;
    one();
    in.write = false;
    for (int n = 0; !hasty && n < 20'000 && (n == 0 || busy()); ++n) run(1);
  }
  void read(int address) {
    in.addr = static_cast<unsigned>(address);
    in.read = true;
    one();
    in.read = false;
  }
  void commit() {
    write(H::commit, 1);
    for (int n = 0; n < 20'000 && by_clock.committing(); ++n) run(1);
  }
  void reset() {
    by_clock.reset();
    by_event.reset();
    was_armed_ = in.armed;
    by_event.show(&out_);
    same();
  }
  bool busy() { return by_clock.clocked().out().busy; }
  int clock() const { return clock_; }
  std::uint32_t count() const { return count_; }
  const Out& out() const { return out_; }
  Out now() { return by_clock.clocked().out(); }

  /// All that a host can read, and what it would after some clocks.
  void look() {
    auto &a = by_clock.clocked(), &b = by_event.clocked();
    for (int n = 0; n < 32; ++n) {
      In asked = in;
      asked.addr = static_cast<unsigned>(H::high + n);
      INFO("register " << n);
      CHECK(a.peek(asked).rdata == b.peek(asked).rdata);
    }
    const Out shown = a.out(), also = b.out();
    CHECK((!also.rdata_known || shown.rdata_known));
    const bool is_register = in.addr >> 9 == static_cast<unsigned>(H::high) >> 9;
    if (is_register) CHECK(shown.rdata_known == also.rdata_known);
    if (also.rdata_known) CHECK(shown.rdata == also.rdata);
    for (int t = 0; t < 4; ++t) CHECK(a.running(t) == b.running(t));
    if (a.memory().program != b.memory().program) FAIL("programs");
    if (a.memory().data != b.memory().data) FAIL("data");
    if (a.memory().table != b.memory().table) FAIL("tables");
    CHECK(by_clock.watch().running == by_event.watch().running);
    CHECK(by_clock.watch().begun == by_event.watch().begun);
    CHECK(by_clock.watch().ended == by_event.watch().ended);
    REQUIRE(a.told().size() == b.told().size());
    for (std::size_t n = 0; n < a.told().size(); ++n) {
      REQUIRE(a.told()[n].tick == b.told()[n].tick);
      REQUIRE(a.told()[n].number == b.told()[n].number);
      REQUIRE(a.told()[n].value == b.told()[n].value);
    }
  }

 private:
  struct Values {
    Axes position{}, velocity{}, tau_hat{};
  };
  Values draw() {
    Values v;
    for (std::size_t n = 0; n < N; ++n) {
      v.position[n] = static_cast<std::int32_t>(random_.between(-3000, 3000));
      v.velocity[n] = static_cast<std::int32_t>(random_.between(-30'000'000, 30'000'000));
      v.tau_hat[n] = static_cast<std::int32_t>(random_.between(-100'000, 100'000));
    }
    return v;
  }
  const Axes& position() const {
    return clock_ >= measured - timing.position_ahead ? next_.position : last_.position;
  }
  const Axes& velocity() const {
    return clock_ >= measured - timing.velocity_ahead ? next_.velocity : last_.velocity;
  }
  In input() const {
    In i = in;
    i.tick = clock_ == measured;
    i.tick_count = count_;
    i.position = position();
    i.velocity = velocity();
    i.tau_hat = clock_ >= measured ? next_.tau_hat : last_.tau_hat;
    return i;
  }
  void clock_passes() {
    ++done;
    if (clock_ == told) shown_ = by_clock.watch();
    if (++clock_ < timing.clocks_per_tick) return;
    clock_ = 0;
    ++count_;
    last_ = next_;
    next_ = draw();
  }
  void one() {
    const In i = input();
    if (clock_ == taken) {
      by_clock.take();
      if (by_event.on()) {
        by_event.torque(0);
      } else {
        by_event.take();
      }
    }
    by_clock.clock(i);
    by_event.clock(i);
    by_event.show(&out_);
    clock_passes();
    was_armed_ = in.armed;
    same();
  }
  int pass_or_clock(std::int64_t left) {
    const int passed = by_clock_alone || (in.armed && !was_armed_) ? 0 : pass(left);
    if (passed > 0) return passed;
    one();
    return 1;
  }
  int pass(std::int64_t left) {
    const int from = clock_;
    int to = static_cast<int>(std::min<std::int64_t>(timing.clocks_per_tick, from + left));
    if (!by_event.enter(input(), from)) return 0;
    const bool takes = from <= taken && taken < to, measures = from <= measured && measured < to;
    if (measures && !by_event.may_tick(measured - from)) {
      by_event.give_up();
      return 0;
    }
    std::array<std::int32_t, N> torque{};
    if (takes) torque = by_event.torque(taken - from);
    const Values values = next_;
    std::vector<std::pair<int, int>> expected, events;
    const bool shows = from <= told && told < to;
    for (int k = from; k < to; ++k) {
      if (takes && k == taken) {
        REQUIRE(now().torque == torque);
        by_clock.take();
      }
      if (now().event_valid) expected.emplace_back(k - from, now().event_number);
      by_clock.clock(input());
      clock_passes();
    }
    if (measures) by_event.tick(measured - from, values.position, values.velocity, values.tau_hat);
    by_event.advance(to - from, position(), velocity(),
                     [&](int clock, int number) { events.emplace_back(clock, number); });
    REQUIRE(events == expected);
    by_event.show(&out_);
    if (shows) {
      const EngineWatch& watch = by_event.watch();
      CHECK(shown_.begins == watch.begins);
      CHECK(shown_.stale == watch.stale);
      CHECK(shown_.in_force == watch.in_force);
      CHECK(shown_.changes_at_begin == watch.changes_at_begin);
    }
    if (by_event.on()) whole += to - from;
    was_armed_ = in.armed;
    return to - from;
  }
  void same() {
    const Out a = now(), &b = out_;
    INFO("clock " << done << ", of tick " << clock_ << ", on " << by_event.on());
    REQUIRE(a.torque == b.torque);
    REQUIRE(a.fresh == b.fresh);
    REQUIRE(a.late == b.late);
    REQUIRE(a.changed == b.changed);
    REQUIRE(a.crc_done == b.crc_done);
    REQUIRE(a.crc_good == b.crc_good);
    REQUIRE(a.event_valid == b.event_valid);
    if (a.event_valid) REQUIRE(a.event_number == b.event_number);
    if (a.event_valid) REQUIRE(a.event_value == b.event_value);
    REQUIRE(by_clock.watch().ended == by_event.watch().ended);
    REQUIRE(by_clock.watch().changes == by_event.watch().changes);
    REQUIRE(by_clock.committing() == by_event.committing());
    if (by_event.on()) return;
    REQUIRE(a.busy == b.busy);
    if (b.rdata_known) REQUIRE(a.rdata_known);
    if (b.rdata_known) REQUIRE(a.rdata == b.rdata);
  }

  Random random_;
  Values last_{}, next_;
  int clock_ = 0;
  std::uint32_t count_ = 0;
  bool was_armed_ = false;
  Out out_ = by_event.clocked().out();
  EngineWatch shown_;
};

}  // namespace feltgate::test
