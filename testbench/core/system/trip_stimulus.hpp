// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A core's life made of faults: armed, run, tripped by one cause, cleared, armed again. The host
// reads all words all the time and the index comes often. Documentation:
// docs/blocks/feltgate_core.md
#pragma once

#include <cstdint>
#include <deque>

#include "feltgate/feltgate_core.hpp"
#include "random.hpp"

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
