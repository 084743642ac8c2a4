// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The twin from event to event against the twin clock by clock through every fault, every word
// read, and what it says of clocks to come. Documentation: docs/architecture.md
#include <cstdint>
#include <deque>
#include <set>

#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/paper.hpp"
#include "random.hpp"
#include "skip_compare.hpp"
#include "twins.hpp"

namespace feltgate::test {

/// Inputs clock by clock; all state inside, so that a copy repeats the run.
template <class D>
class TripStimulus {
 public:
  explicit TripStimulus(std::uint64_t seed) : random_(seed) {}

  CoreIn operator()(std::int64_t) {
    if (--left_ <= 0) begin();
    move();
    host();
    return in_;
  }

 private:
  using A = typename D::A;
  using C = typename D::C;
  static constexpr int kTick = D::clocks_per_tick;
  enum Cause { speed, polarity, heat, watchdog, stop, channel, illegal, index, wrong_way, none };
  static constexpr int kCauses = none + 1;
  struct Write {
    int address;
    std::uint32_t word;
  };

  void write(int address, std::uint32_t word) { writes_.push_back({address, word}); }
  void write(int address, std::int64_t word) { write(address, static_cast<std::uint32_t>(word)); }
  void as_designed(int address) {
    for (const auto& p : D::parameters) {
      if (p.address == address) write(address, static_cast<std::uint32_t>(p.raw));
    }
  }
  void control(bool arm) {
    const std::uint32_t scene = random_.one_in(3) ? static_cast<std::uint32_t>(D::S::damper)
                                                  : std::uint32_t{D::S::setpoint};
    std::uint32_t word = static_cast<std::uint32_t>(D::control_reset) | 1u << C::control_host |
                         scene << C::control_scene;
    if (arm) word |= 1u << C::control_arm;
    if (random_.one_in(8)) word |= 1u << C::control_mode;
    write(C::control, word);
  }

  /// Another cause: the fault before is cleared, the words are the design's but for what trips.
  void begin() {
    cause_ = static_cast<Cause>(random_.below(kCauses));
    turn_ = 0;
    left_ = kTick * (40 + random_.below(300));
    writes_.clear();
    control(false);
    write(C::command,
          1u << C::command_clear_faults | (random_.coin() ? 1u << C::command_kick : 0u));
    for (const int a : {A::overspeed, A::i2t_budget, A::polarity_speed, A::polarity_current,
                        A::polarity_ticks, A::watchdog_ticks, A::hold_time}) {
      as_designed(a);
    }
    const bool test = cause_ == wrong_way || random_.one_in(6);
    write(A::self_test_quiet, std::int64_t{test});
    write(A::self_test_pulse, test ? std::int64_t{1 + random_.below(2)} : std::int64_t{0});
    write(A::self_test_arms, std::int64_t{random_.below(4)});
    write(A::ramp_step, std::int64_t{1} << 24);
    write(A::setpoint_torque, random_.between(-60000, 60000));
    if (cause_ == polarity) {
      write(A::polarity_speed, std::int64_t{0});
      write(A::polarity_current, std::int64_t{0});
      write(A::polarity_ticks, random_.between(1, 12));
    }
    if (cause_ == watchdog) {
      write(A::watchdog_ticks, random_.between(1, 40));
      write(C::command, 1u << C::command_kick);
    }
    const bool sudden = cause_ == speed && random_.coin();
    if (sudden) write(A::overspeed, random_.between(0, 2000));
    control(true);
    if (cause_ == speed && !sudden) write(A::overspeed, random_.between(0, 2000));
    if (cause_ == heat) write(A::i2t_budget, random_.between(0, 1000));
    if (cause_ == stop && random_.coin()) write(C::command, 1u << C::command_stop);
    if (test) left_ += std::int64_t{kTick} << (Map::self_test_unit_bits + 2);
    starts_ = random_.below(test ? static_cast<std::uint64_t>(left_) : kTick * 20);
    spacing_ = cause_ == polarity ? 400
               : cause_ == speed  ? 10 + random_.below(60)
                                  : 40 + random_.below(3000);
    if (sudden) starts_ += kTick * 40;
    stops_ = random_.coin() ? starts_ + random_.below(kTick * 40) : left_;
    rests_ = cause_ != speed && cause_ != polarity && cause_ != channel && random_.one_in(3);
    up_ = random_.coin();
  }

  void move() {
    ++turn_;
    if (turn_ >= starts_ && turn_ < stops_ && !rests_ && --wait_ <= 0) {
      wait_ = spacing_;
      if (cause_ == polarity && spacing_ > 20) spacing_ -= spacing_ / 16;
      phase_ += cause_ == illegal && random_.one_in(3) ? 2u : up_ ? 1u : 3u;
      if (cause_ == channel) up_ = !up_;
    }
    if (cause_ == channel && spacing_ > 400) spacing_ = 400;
    const bool a = (phase_ & 2u) != 0;
    in_.encoder.a = a;
    in_.encoder.b = ((phase_ & 1u) != 0) != a;
    if (random_.one_in(cause_ == index ? 400 : 6000)) in_.encoder.z = !in_.encoder.z;
    const bool stops = cause_ == stop && random_.one_in(kTick * 100);
    if (in_.stop ? random_.one_in(60) : stops) in_.stop = !in_.stop;
  }

  void host() {
    in_.reg_write = false;
    if (--until_write_ <= 0 && !writes_.empty()) {
      in_.reg_addr = static_cast<std::uint16_t>(writes_.front().address);
      in_.reg_wdata = writes_.front().word;
      in_.reg_write = true;
      writes_.pop_front();
      until_write_ = kTick + 1 + random_.below(20);
      until_read_ = 1;
    } else if (--until_read_ <= 0) {
      until_read_ = 1 + random_.below(random_.coin() ? 6 : 200);
      in_.reg_addr = static_cast<std::uint16_t>(
          random_.one_in(4) ? random_.below(0x400) : C::snapshot + random_.below(64));
    }
  }

  Random random_;
  CoreIn in_;
  std::deque<Write> writes_;
  Cause cause_ = none;
  std::int64_t left_ = 0, turn_ = 0, starts_ = 0, stops_ = 0, spacing_ = 0, wait_ = 0;
  std::int64_t until_write_ = 0, until_read_ = 0;
  bool up_ = true, rests_ = false;
  std::uint32_t phase_ = 0;
};

}  // namespace feltgate::test

using namespace feltgate;
using test::compare_by_event;
using test::scaled_clocks;
using test::TripStimulus;

namespace {

/// A tick that is longer than its wave, and in which the PWM's period does not begin with a tick.
struct Slow : Lever {
  static constexpr int clocks_per_tick = 67;
};

/// From a core at the first clock of a tick: to clock c from event to event, with a halt at `halt`,
/// there a write, and on from event to event. The same as clock by clock.
template <class D>
void write_amid(const test::CoreOf<D>& start, const CoreIn& held, int halt, int c, bool arm) {
  test::CoreOf<D> by_clock = start, by_event = start;
  CoreIn in = held, strobe = held;
  in.reg_write = false;
  strobe.reg_write = true;
  strobe.reg_addr = static_cast<std::uint16_t>(arm ? D::C::control : D::A::ramp_step);
  strobe.reg_wdata = arm ? static_cast<std::uint32_t>(D::control_reset) | 1u << D::C::control_host |
                               1u << D::C::control_arm
                         : 1u << 20;
  test::Hash clocks, events;
  const auto clock = [&](const CoreIn& i) {
    by_clock.clock(i);
    if (by_clock.out().snapshot_valid) clocks.add(by_clock.out());
  };
  const auto note = [&] { events.add(by_event.out()); };
  for (int k = 0; k < c; ++k) clock(in);
  by_event.run(in, halt, note);
  by_event.run(in, c - halt, note);
  REQUIRE(by_clock.out() == by_event.out());
  clock(strobe);
  by_event.clock(strobe);
  if (by_event.out().snapshot_valid) note();
  REQUIRE(by_clock.out() == by_event.out());
  for (int k = 0; k < 7; ++k)
    clock(in), by_event.clock(in), by_event.out().snapshot_valid ? note() : void();
  REQUIRE(by_clock.out() == by_event.out());
  for (int k = 0; k < 2 * D::clocks_per_tick; ++k) clock(in);
  by_event.run(in, 2 * D::clocks_per_tick, note);
  REQUIRE(by_clock.out() == by_event.out());
  REQUIRE(by_clock.gate_clocks() == by_event.gate_clocks());
  REQUIRE(clocks.value() == events.value());
  if (c % 5 == 0 && halt == 0) {
    REQUIRE(test::heat_of<D>(by_clock) == test::heat_of<D>(by_event));
  }
}

/// A write in every clock of the ticks in which a fault comes up.
template <class D>
std::set<int> writes_amid_trips(std::uint64_t seed, int wanted) {
  test::Random random(seed);
  TripStimulus<D> stimulus(seed);
  test::CoreOf<D> core, start;
  CoreIn held;
  std::set<int> met;
  std::int64_t clock = 0;
  for (int found = 0; found < wanted && clock < 20'000'000;) {
    // From one tick to the next, the inputs of the start held: what would they bring?
    if (core.clock_of_tick() == 0) {
      start = core;
      held = stimulus(clock++);
      CoreIn in = held;
      in.reg_write = in.set_zero = false;
      test::CoreOf<D> ahead = core;
      for (int k = 0; k < D::clocks_per_tick; ++k) ahead.clock(in);
      const int cause = ahead.out().first_fault;
      if (core.out().first_fault == 0 && (cause != 0 || random.one_in(400))) {
        met.insert(cause);
        ++found;
        for (int c = 0; c < D::clocks_per_tick; ++c) {
          write_amid(start, in, 0, c, false);
          write_amid(start, in, static_cast<int>(random.below(static_cast<std::uint32_t>(c + 1))),
                     c, true);
        }
      }
      core.clock(held);
    } else {
      core.clock(stimulus(clock++));
    }
  }
  return met;
}

}  // namespace

TEST_CASE("a write in each clock of a tick that trips, from event to event") {
  std::set<int> met = writes_amid_trips<Lever>(61, 60);
  met.merge(writes_amid_trips<Slow>(62, 60));
  for (const Fault f :
       {Fault::speed, Fault::polarity, Fault::i2t, Fault::watchdog, Fault::channel, Fault::index}) {
    INFO("fault " << static_cast<int>(f));
    CHECK(met.count(static_cast<int>(f)) == 1);
  }
}

TEST_CASE("a stop that is held, from the reset on and while the host asks to arm") {
  for (int address = 0; address < 0x400; address += 37) {
    test::CoreOf<Lever> by_clock, by_event;
    CoreIn in;
    in.stop = true;
    in.reg_addr = static_cast<std::uint16_t>(address);
    for (int k = 1; k < 8; ++k) {
      for (int c = 0; c < k; ++c) by_clock.clock(in);
      by_event.run(in, k, [] {});
      REQUIRE(by_clock.out() == by_event.out());
    }
    const auto to_next_tick = [&] {
      do by_clock.clock(in);
      while (by_clock.clock_of_tick() != 0);
    };
    to_next_tick();
    to_next_tick();
    in.arm = true;  // asked for in the tick to come
    for (int c = 0; c < Lever::clocks_per_tick; ++c) write_amid(by_clock, in, c / 2, c, false);
    for (int c = 0; c < Lever::clocks_per_tick; ++c) {
      write_amid(by_clock, in, 0, c, true);
      write_amid(by_clock, in, c / 2, c, true);
    }
  }
}

TEST_CASE("a stop that goes away while the panel asks to arm") {
  // Held but for one clock, or a pulse of some clocks; the request comes in the same tick.
  for (const bool held : {true, false}) {
    for (int at = 0; at < Lever::clocks_per_tick; ++at) {
      for (const int length : {1, 2, 3, 7}) {
        test::CoreOf<Lever> by_clock, by_event;
        CoreIn in;
        const auto pass = [&](int clocks) {
          for (int k = 0; k < clocks; ++k) by_clock.clock(in);
          by_event.run(in, clocks, [] {});
          REQUIRE(by_clock.out() == by_event.out());
        };
        in.stop = held;
        pass(3 * Lever::clocks_per_tick);
        in.arm = true;
        if (at > 0) pass(at);
        in.stop = !held;
        pass(length);
        in.stop = held;
        pass(1);
        pass(5 * Lever::clocks_per_tick);
        in.stop = false;
        pass(5 * Lever::clocks_per_tick);
      }
    }
  }
}

TEST_CASE("every fault trips in the same clock from event to event") {
  test::Met met;
  for (const std::uint32_t longest : {9u, 60u, 3000u}) {
    const std::int64_t clocks = scaled_clocks(2'000'000);
    compare_by_event<Lever>(TripStimulus<Lever>(longest), 31 + longest, clocks, longest, &met);
    compare_by_event<Paper>(TripStimulus<Paper>(longest + 1), 41 + longest, clocks, longest, &met);
    compare_by_event<Slow>(TripStimulus<Slow>(longest + 3), 61 + longest, clocks / 2, longest,
                           &met);
    compare_by_event<Lever, false>(TripStimulus<Lever>(longest + 2), 51, clocks / 4, longest, &met);
  }
  for (const Fault f : {Fault::encoder, Fault::speed, Fault::polarity, Fault::i2t, Fault::watchdog,
                        Fault::stop, Fault::self_test, Fault::channel, Fault::index, Fault::word}) {
    INFO("fault " << static_cast<int>(f));
    CHECK(met.faults.count(static_cast<int>(f)) == 1);
  }
  CHECK(met.resets > 20);
  CHECK(met.flips > 200);
  CAPTURE(met.ticks, met.whole, met.settled);
  CHECK(met.whole * 10 > met.ticks);
  CHECK(met.settled * 10 > met.ticks);
}
