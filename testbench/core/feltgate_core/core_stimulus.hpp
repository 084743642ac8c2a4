// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Random but plausible stimulus of a core: a lever that moves, a host that writes registers, a
// panel, the modulators of a current loop. Documentation: docs/testing.md
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <iterator>
#include <type_traits>

#include "core_coverage.hpp"
#include "feltgate/core_ports.hpp"
#include "feltgate/design_info.hpp"
#include "feltgate/feltgate_core.hpp"
#include "random.hpp"
#include "sim/backends/absolute_sensor.hpp"
#include "sim/plant/sigma_delta.hpp"
#include "twins.hpp"

namespace feltgate::test {

/// The modulator at a winding that the duty in force drives; at times its line stands, it has an
/// offset, or the winding is shorted; or the driver has a fault.
class CurrentStimulus {
 public:
  void set(const CoreOut& out, CoreIn* in) {
    if (left_-- <= 0) {
      left_ = 1'000 + random_.below(150'000);
      trouble_ = random_.below(8);
      if (trouble_ < 3) left_ %= 20'000;
    }
    if (out.duty_active == 0) current_a_ = trouble_ == 3 ? 2 : 0;
    const double ohm = trouble_ == 0 ? 0.05 : 0.42;
    current_a_ += (out.duty_active * 0.024 - ohm * current_a_) * (20e-9 / 82e-6);
    const bool rises = out.current_clock && !clock_;
    clock_ = out.current_clock;
    if (rises) bit_ = modulator_.next(current_a_ + (trouble_ == 1 ? 40 : 0));
    in->current_data = trouble_ == 2 || bit_;
    in->driver_fault = trouble_ == 4 && left_ < 200;
  }

 private:
  Random random_{77};
  plant::SigmaDelta modulator_{32};
  double current_a_ = 0;
  std::int64_t left_ = 0;
  std::uint32_t trouble_ = 9;
  bool clock_ = false, bit_ = false;
};

/// The modulators at phases A and B of a winding between the six gates; at times a line stands or
/// has an offset, the winding is shorted, a phase is open, or the driver has a fault.
class PhasesStimulus {
 public:
  void set(const CoreOut& out, CoreIn* in) {
    if (left_-- <= 0) {
      left_ = 1'000 + random_.below(150'000);
      trouble_ = random_.below(30);
      which_ = random_.below(2);
      if (trouble_ < 3) left_ %= 20'000;
    }
    flow(out.gates);
    const bool rises = out.current_clock && !clock_;
    clock_ = out.current_clock;
    for (std::size_t n = 0; rises && n < 2; ++n) {
      const bool mine = n == which_;
      const double wrong_a = mine && trouble_ == 1 ? 4 : mine && trouble_ == 3 && idle_ ? 0.3 : 0;
      bits_[n] = modulators_[n].next(amperes_[n] + wrong_a) || (mine && trouble_ == 2);
    }
    in->current_data = static_cast<std::uint8_t>(bits_[0] | bits_[1] << 1);
    in->driver_fault = trouble_ == 4 && left_ < 200;
  }

 private:
  void flow(unsigned gates) {
    std::array<double, 3> volts{};
    double mean_v = 0;
    for (std::size_t l = 0; l < 3; ++l) {
      const bool hi = (gates >> 2 * l & 1u) != 0, lo = (gates >> 2 * l & 2u) != 0;
      volts[l] = hi || (!lo && amperes_[l] < 0) ? 5.0 : 0.0;
      mean_v += volts[l] / 3;
    }
    idle_ = gates == 0;
    const double ohm = trouble_ == 0 ? 0.2 : 2.9;
    for (std::size_t l = 0; l < 2; ++l) {
      amperes_[l] += (volts[l] - mean_v - ohm * amperes_[l]) * (20e-9 / 1e-3);
      if (idle_) amperes_[l] = 0;
    }
    if (trouble_ == 5) amperes_[which_] = 0;
    amperes_[2] = -amperes_[0] - amperes_[1];
  }

  Random random_{77};
  std::array<plant::SigmaDelta, 2> modulators_{plant::SigmaDelta{2}, plant::SigmaDelta{2}};
  std::array<double, 3> amperes_{};
  std::array<bool, 2> bits_{};
  std::int64_t left_ = 0;
  std::uint32_t trouble_ = 9, which_ = 0;
  bool clock_ = false, idle_ = true;
};

/// Inputs clock by clock; all state inside, so that a copy repeats the run.
template <class D>
class CoreStimulus {
 public:
  /// Neighbouring seeds of the generator give the same sequence shifted by one; the seed is changed
  /// here to prevent this.
  explicit CoreStimulus(std::uint64_t seed)
      : random_(Random(seed).bits()),
        outside_(Random(~seed).bits()),
        turn_(static_cast<std::uint32_t>(seed % 14)) {}

  CoreIn operator()(std::int64_t) {
    move();
    host();
    panel();
    if (kOutside) outside();
    return in_;
  }
  /// `out`: outputs of the clock before. Another axis's test begins and ends with a tick.
  CoreIn operator()(std::int64_t clock, const CoreOut& out) {
    const bool last = out.snapshot_valid;
    if (kOutside && first_) {
      if (outside_.one_in(in_.axis_testing ? 100 : 2'000)) in_.axis_testing = !in_.axis_testing;
      if (outside_.one_in(400)) in_.axis_waits = !in_.axis_waits;
    }
    first_ = last;
    if constexpr (D::current_loop != 0) current_.set(out, &in_);
    if constexpr (D::hall != 0) set_hall();
    if constexpr (D::absolute_encoder != 0) {
      const double rad = (static_cast<double>(counted_) + 0.5) * D::count_rad;
      sensor_.turn(rad, rad, clock, 1);
      in_.encoder_data = sensor_.pin(clock, out.serial);
    }
    return (*this)(clock);
  }

 private:
  /// Keeps a speed for a while: rest, hand-like, fast, or the highest speed that the decoder can
  /// follow.
  void move() {
    if (left_-- <= 0) {
      left_ = 2'000 + random_.below(60'000);
      const std::uint32_t kind = random_.below(16);
      spacing_ = kind < 3    ? 0
                 : kind < 13 ? 600 + random_.below(30'000)
                 : kind < 15 ? std::max<std::int64_t>(30, kLeast) + random_.below(200)
                             : kLeast + random_.below(8);
      up_ = random_.one_in(2);
      bad_cable_ = random_.one_in(12);
      dead_ = random_.one_in(7) ? 1 + random_.below(2) : 0;
      chatters_ = random_.one_in(10);
      many_indices_ = random_.one_in(8);
      gathers_ = false;
      break_sensor();
    }
    if (random_.one_in(bad_cable_ ? 3'000 : 400'000)) phase_ += 2;  // both channels change at once
    if (spacing_ > 0 && --wait_ <= 0) {
      wait_ = spacing_;
      if (gathers_) spacing_ -= spacing_ / 8;
      phase_ += up_ ? 1u : 3u;
      counted_ += up_ ? 1 : -1;
      up_ = up_ != chatters_;
    }
    const bool a = (phase_ & 2u) != 0;
    const bool b = ((phase_ & 1u) != 0) != a;
    in_.encoder = {dead_ == 1 ? in_.encoder.a : a, dead_ == 2 ? in_.encoder.b : b,
                   (phase_ & (many_indices_ ? 0x7u : 0xfffu)) == 0};
  }

  /// Hall lines of the shaft; with a bad cable two sectors ahead, or all high.
  void set_hall() {
    const double gain = design_info<D>().find("commutation_gain")->si;
    const double sectors = std::floor(6 * gain * static_cast<double>(counted_));
    const int sector = static_cast<int>(sectors - 6 * std::floor(sectors / 6));
    in_.hall = hall_code((sector + (bad_cable_ ? 2 : 0)) % 6);
    if (bad_cable_ && spacing_ > 5'000) in_.hall = 7;
  }
  struct Write {
    int address;  ///< or one of these
    std::uint32_t word;
  };
  /// Clocks from count to count in the fastest motion: to an absolute encoder more is a jump.
  static constexpr std::int64_t kLeast =
      D::absolute_period * D::clocks_per_tick / std::max(1, 2 * D::absolute_jump_step) + 1;
  static constexpr int kSetOff = -1;  ///< moves the lever by one count every `word` clocks
  static constexpr int kRest = -2;    ///< no write for `word` clocks
  static constexpr int kBreak = -3;   ///< sets the defect of the encoder, see break_encoder()

  void host() {
    if (rest_ > 0) --rest_;
    in_.reg_write = rest_ == 0 && random_.one_in(700);
    if (!in_.reg_write) {
      if (random_.one_in(500)) look();
      return;
    }
    if (!test_written_) {  // a design with the self-test on from power-up would do little else
      test_written_ = true;
      return write(D::A::self_test_pulse, 0);
    }
    if (plan_.empty() && random_.one_in(14)) make_plan();
    if (!plan_.empty()) {
      const Write next = plan_.front();
      plan_.pop_front();
      if (next.address >= 0) return write(next.address, next.word);
      in_.reg_write = false;
      if (next.address == kRest) {
        rest_ = next.word;
        return;
      }
      if (next.address == kBreak) return break_encoder(next.word);
      return set_off(next.word);
    }
    // With the design's ramp a run of some thousand ticks would see only ramps.
    if (!ramp_written_ || random_.one_in(20)) {
      ramp_written_ = true;
      write(D::A::ramp_step, random_.below(1u << 24));
      return;
    }
    if (random_.one_in(16)) {  // with the design's hold time no torque would be held long enough
      write(D::A::hold_time, random_.below(3));
      return;
    }
    const std::uint32_t what = random_.below(9);
    if (what < 5) {
      write_parameter();
    } else if (what < 8) {
      write_control();
    } else {
      write(D::C::command, random_.below(32));
    }
  }
  /// Takes over the random motion: from now on one count every `spacing` clocks, then faster.
  void set_off(std::uint32_t spacing) {
    left_ = 30'000;
    spacing_ = spacing;
    wait_ = 0;
    bad_cable_ = false;
    gathers_ = true;
    chatters_ = false;
    dead_ = 0;
    up_ = !up_;
  }
  /// Makes one channel dead, or the cable bad, or the index appear at every eighth count; or stops
  /// all motion.
  void break_encoder(std::uint32_t how) {
    left_ = 25'000;
    spacing_ = how == 4 ? 0 : 200 + random_.below(200);
    gathers_ = chatters_ = false;
    dead_ = how < 2 ? 1 + how : 0;
    bad_cable_ = how == 2;
    many_indices_ = how == 3;
    break_sensor();
  }
  /// Breaks an absolute encoder where the cable is bad or a channel is dead; else mends it.
  void break_sensor() {
    const auto defect = static_cast<AbsoluteSensor::Defect>(1 + breaks_.below(6));
    sensor_.set(bad_cable_ || dead_ != 0 ? defect : AbsoluteSensor::Defect::none);
  }
  void write(int address, std::uint32_t word) {
    in_.reg_addr = static_cast<std::uint16_t>(address);
    in_.reg_wdata = word;
  }

  /// Makes reads, mostly of the snapshot.
  void look() {
    const std::uint32_t what = random_.below(8);
    const auto any = random_.below(static_cast<std::uint32_t>(snapshot_slots.size()));
    in_.reg_addr =
        static_cast<std::uint16_t>(what < 6    ? D::C::snapshot + snapshot_slots[any]
                                   : what == 6 ? static_cast<std::uint32_t>(D::C::control)
                                               : random_.below(0x400));
  }

  /// Makes a sequence of writes for a state that random words would hardly ever reach.
  void make_plan() {
    const auto then = [this](int address, std::uint32_t word) { plan_.push_back({address, word}); };
    const auto as_designed = [&](int address) {
      for (const auto& p : D::parameters) {
        if (p.address == address) then(address, static_cast<std::uint32_t>(p.raw));
      }
    };
    const auto some = [this](unsigned bits) { return random_.below(std::uint64_t{1} << bits); };
    constexpr std::uint32_t host =
        static_cast<std::uint32_t>(D::control_reset) | 1u << D::C::control_host;
    const auto arm = [&] {
      then(D::C::control, host);
      then(D::C::command, 1u << D::C::command_clear_faults | 1u << D::C::command_thaw);
      then(D::C::control, host | 1u << D::C::control_arm | any_scene() << D::C::control_scene);
    };
    switch (turn_ = (turn_ + 5) % 14) {  // each in turn
      case 0:                            // a cold motor gets too hot
        then(D::A::nominal_current_squared, 0x7fffffff);
        as_designed(D::A::i2t_budget);
        // A test that does not arm a shaft that is held would leave no current.
        if (kKnob) then(D::A::self_test_pulse, 0);
        arm();
        if (kKnob) heat(then, host | 1u << D::C::control_arm);
        then(D::A::i2t_budget, some(8 + random_.below(12)));
        then(D::A::nominal_current_squared, some(random_.below(10)));
        for (int k = 0; k < 4; ++k) write_something(then);
        then(kRest, random_.below(10'000));
        for (int k = 0; k < 4; ++k) write_something(then);
        as_designed(D::A::nominal_current_squared);
        as_designed(D::A::i2t_budget);
        break;
      case 1:  // the host stops its kicks
        arm();
        then(D::C::command, 1u << D::C::command_kick);
        then(D::A::watchdog_ticks, random_.below(120));
        write_something(then);
        as_designed(D::A::watchdog_ticks);
        break;
      case 2:
      case 6:  // the lever seems to run away
        arm();
        then(D::A::polarity_ticks, random_.below(6));
        then(D::A::polarity_speed, some(random_.below(D::f.velocity.fraction + 1)));
        then(D::A::polarity_current, some(random_.below(D::f.current.fraction)));
        for (int k = 0; k < 2; ++k) {  // in both directions
          then(kSetOff, 2'000);
          then(kRest, 12'000);
        }
        for (int k = 0; k < 6; ++k) write_something(then);
        as_designed(D::A::polarity_ticks);
        as_designed(D::A::polarity_speed);
        as_designed(D::A::polarity_current);
        break;
      case 3:  // a self-test that accepts any answer
        then(D::A::self_test_quiet, 0);
        then(D::A::self_test_pulse, 1 + random_.below(3));
        arm();
        break;
      case 4:  // the lever is too fast
        arm();
        then(D::A::overspeed, some(D::f.velocity.fraction + random_.below(9)));
        write_something(then);
        as_designed(D::A::overspeed);
        break;
      case 5:  // a heavy lever: the observer reaches its limits
        then(D::C::control, host);
        then(D::A::inertia_gain, (1u << D::P::inertia_gain.width()) - 1);
        then(D::A::overspeed, 0x7fffffff);
        arm();
        then(kSetOff, 40);
        then(kRest, 30'000);
        then(D::C::control, host);
        as_designed(D::A::inertia_gain);
        break;
      case 7:
      case 8:
        arm();
        then(kBreak, random_.below(4));
        then(kRest, 25'000);
        break;
      case 9:  // a torque is held
        arm();
        then(D::A::hold_torque, some(10));
        then(D::A::hold_time, 0);
        then(kBreak, 4);
        then(kRest, 20'000);
        as_designed(D::A::hold_torque);
        break;
      default:
        if (random_.coin()) as_designed(D::A::duty_limit);
        arm();
        break;
    }
  }
  /// Near the greatest torque, until the measured current is too much: a small motor's I2t is
  /// coarse.
  template <class Then>
  void heat(Then&& then, std::uint32_t control) {
    then(D::A::ramp_step, (1u << (D::P::ramp_step.width() - 1)) - 1);
    then(D::A::setpoint_torque, static_cast<std::uint32_t>(0.048 * (1 << D::f.torque.fraction)));
    then(D::C::control, control | static_cast<std::uint32_t>(D::S::setpoint)
                                      << D::C::control_scene);
    then(kRest, 4'000);
    then(D::A::nominal_current_squared, 0);
    then(D::A::i2t_budget, random_.below(8));
    then(kRest, 2'000);
  }
  template <class Then>
  void write_something(Then&& then) {
    const CoreIn kept = in_;
    random_.coin() ? write_parameter() : write_control();
    then(in_.reg_addr, in_.reg_wdata);
    in_ = kept;
  }

  /// Writes a parameter: mostly near the design's value, sometimes any value of the word's format.
  void write_parameter() {
    const auto& p =
        D::parameters[random_.below(static_cast<std::uint32_t>(std::size(D::parameters)))];
    in_.reg_addr = static_cast<std::uint16_t>(p.address);
    const std::int64_t high = (std::int64_t{1} << (p.format.width() - p.format.sign)) - 1;
    std::int64_t raw = p.raw < 0 ? -p.raw : p.raw;
    const std::uint32_t how = random_.below(8);
    if (how < 3) raw = random_.between(raw / 2, raw < high / 2 ? raw + raw / 2 : high);
    if (how == 3)
      raw = static_cast<std::int64_t>(random_.bits() & static_cast<std::uint64_t>(high));
    // The lever may run away, so that the observer reaches its limits.
    if (p.address == D::A::overspeed && how < 6) raw = high;
    // A duty limit of next to nothing takes part at 0.
    if (p.address == D::A::duty_limit && how > 5) raw = random_.below(4);
    // Short self-tests.
    const bool test_time = p.address == D::A::self_test_quiet || p.address == D::A::self_test_pulse;
    if (test_time && how < 6) raw = random_.below(4);
    if (raw > high) raw = high;
    // Limits and times are magnitudes; a set-point and an offset may be negative.
    const bool may_be_negative =
        p.address == D::A::setpoint_torque || p.address == D::A::voltage_setpoint ||
        p.address == D::A::observer_gain || p.address == D::A::tension_rest;
    if (may_be_negative && random_.one_in(2)) raw = -raw;
    in_.reg_wdata = static_cast<std::uint32_t>(raw);
  }

  void write_control() {
    in_.reg_addr = static_cast<std::uint16_t>(D::C::control);
    const std::uint32_t scene = any_scene();
    std::uint32_t word = static_cast<std::uint32_t>(D::control_reset) | scene
                                                                            << D::C::control_scene;
    if (!random_.one_in(8)) word |= 1u << D::C::control_host;
    if (!random_.one_in(4)) word |= 1u << D::C::control_arm;
    if (random_.one_in(4)) word |= random_.below(3) << D::C::control_mode;
    if (random_.one_in(6)) word ^= 1u << D::C::control_motor_polarity;
    if (random_.one_in(6)) word ^= 1u << D::C::control_encoder_polarity;
    if (random_.one_in(6)) word ^= 1u << D::C::control_pwm_mode;
    if (random_.one_in(4)) word |= random_.below(16) << D::C::control_filter;
    in_.reg_wdata = word;
  }

  /// Drives programs and other axes, if the design has them.
  void outside() {
    Random& r = outside_;
    if (r.one_in(40)) {
      in_.law_torque = static_cast<std::int32_t>(r.bits()) >> (32 - D::f.torque.width());
      in_.law_torque >>= r.below(8);
    }
    const auto toggle = [&r](bool& x, std::uint32_t on, std::uint32_t off) {
      if (r.one_in(x ? off : on)) x = !x;
    };
    toggle(in_.law_late, 80'000, 300);
    toggle(in_.law_restart, 5'000, 200);
    toggle(in_.axis_fault, 400'000, 100);
    toggle(in_.axis_silent, 200'000, 2'000);
    toggle(in_.axis_blocked, 50'000, 5'000);
  }

  void panel() {
    if (random_.one_in(50'000)) in_.arm = !in_.arm;
    if (random_.one_in(100'000)) in_.scene = static_cast<std::uint8_t>(random_.below(16));
    // Several zero commands in a row may come in any clock of a tick.
    if (random_.one_in(40'000)) zeros_ = 1 + random_.below(20);
    in_.set_zero = zeros_ > 0 && random_.one_in(D::clocks_per_tick);
    if (in_.set_zero) --zeros_;
    if (in_.stop ? stop_left_-- == 0 : random_.one_in(150'000)) {
      in_.stop = !in_.stop;
      stop_left_ = random_.coin() ? random_.below(6) : random_.below(4'000);
    }
  }

  static constexpr bool kKnob = D::phases == 3 && D::absolute_encoder != 0;
  static constexpr bool kOutside = test::scene_built<D>(Map::S::law);
  std::uint32_t any_scene() { return random_.below(kOutside ? 11 : 10); }

  std::conditional_t<D::phases == 3, PhasesStimulus, CurrentStimulus> current_;
  AbsoluteSensor sensor_{test::absolute_parameters<D>()};
  std::int64_t counted_ = 0;  ///< of an absolute encoder
  Random breaks_{78};
  Random random_, outside_;
  std::uint32_t turn_;
  CoreIn in_;
  bool first_ = false;  ///< the next clock is the first of a tick
  std::int64_t left_ = 0, spacing_ = 0, wait_ = 0;
  bool up_ = true, bad_cable_ = false, ramp_written_ = false;
  bool test_written_ = design_info<D>().find("self_test_pulse")->raw == 0;
  bool chatters_ = false, many_indices_ = false, gathers_ = false;
  std::deque<Write> plan_;
  std::uint32_t rest_ = 0, zeros_ = 0, phase_ = 0, dead_ = 0, stop_left_ = 0;
};

}  // namespace feltgate::test
