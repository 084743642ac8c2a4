// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Random but plausible life of a core: a lever that moves, a host that writes registers, a panel.
// Documentation: docs/testing.md
#pragma once

#include <cstdint>
#include <iterator>
#include <set>
#include <string>

#include "feltgate/feltgate_core.hpp"
#include "random.hpp"

namespace feltgate::test {

/// Inputs clock by clock; all state inside, so that a copy repeats the run.
template <class D>
class CoreStimulus {
 public:
  explicit CoreStimulus(std::uint64_t seed) : random_(seed) {}

  CoreIn operator()(std::int64_t) {
    move();
    host();
    panel();
    return in_;
  }

 private:
  /// Speed is held for a while: rest, hand-like, fast, and the edge of what the decoder can follow.
  void move() {
    if (left_-- <= 0) {
      left_ = 2'000 + random_.below(60'000);
      const std::uint32_t kind = random_.below(16);
      spacing_ = kind < 3    ? 0
                 : kind < 13 ? 600 + random_.below(30'000)
                 : kind < 15 ? 30 + random_.below(200)
                             : 1 + random_.below(8);
      up_ = random_.one_in(2);
      bad_cable_ = random_.one_in(12);
      dead_ = random_.one_in(10) ? 1 + random_.below(2) : 0;
      chatters_ = random_.one_in(10);
    }
    if (random_.one_in(bad_cable_ ? 3'000 : 400'000)) phase_ += 2;  // both channels at once
    if (spacing_ > 0 && --wait_ <= 0) {
      wait_ = spacing_;
      phase_ += up_ ? 1u : 3u;
      up_ = up_ != chatters_;
    }
    const bool a = (phase_ & 2u) != 0;
    const bool b = ((phase_ & 1u) != 0) != a;
    in_.encoder = {dead_ == 1 ? in_.encoder.a : a, dead_ == 2 ? in_.encoder.b : b,
                   (phase_ & 0xfffu) == 0};
  }

  void host() {
    in_.reg_write = random_.one_in(700);
    if (!in_.reg_write) return;
    // At the design's ramp a run of some thousand ticks would see nothing but ramps.
    if (!ramp_written_ || random_.one_in(20)) {
      ramp_written_ = true;
      in_.reg_addr = static_cast<std::uint16_t>(D::A::ramp_step);
      in_.reg_wdata = random_.below(1u << 24);
      return;
    }
    if (random_.one_in(24)) {  // at the design's nothing would be held for long enough
      in_.reg_addr = static_cast<std::uint16_t>(D::A::hold_time);
      in_.reg_wdata = random_.below(3);
      return;
    }
    const std::uint32_t what = random_.below(10);
    if (what < 5) {
      write_parameter();
    } else if (what < 8) {
      write_control();
    } else if (what == 8) {
      in_.reg_addr = static_cast<std::uint16_t>(D::C::command);
      in_.reg_wdata = random_.below(32);
    } else {
      in_.reg_write = false;  // a read
      in_.reg_addr = static_cast<std::uint16_t>(random_.below(0x400));
    }
  }

  /// Mostly around the design's value, sometimes anywhere in the word's format.
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
    // A lever that may run away, so that the observer comes to its ends.
    if (p.address == D::A::overspeed && how < 6) raw = high;
    // Self-tests that are over soon.
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
    const std::uint32_t scene = random_.below(10);
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

  void panel() {
    if (random_.one_in(50'000)) in_.arm = !in_.arm;
    if (random_.one_in(100'000)) in_.scene = static_cast<std::uint8_t>(random_.below(16));
    in_.set_zero = random_.one_in(100'000);
    if (in_.stop ? random_.one_in(2'000) : random_.one_in(200'000)) in_.stop = !in_.stop;
  }

  Random random_;
  CoreIn in_;
  std::int64_t left_ = 0;
  std::int64_t spacing_ = 0, wait_ = 0;
  bool up_ = true, bad_cable_ = false, ramp_written_ = false;
  bool chatters_ = false;
  std::uint32_t phase_ = 0, dead_ = 0;
};

/// What a run has exercised.
class Coverage {
 public:
  void add(const CoreOut& o) {
    ++clocks_;
    armed_ += o.armed;
    duty_pinned_ += (o.limits & 16u) != 0;
    tau_ref_pinned_ += (o.limits & 1u) != 0;
    eased_ += (o.limits & limit::hold) != 0;
    frozen_ += o.armed && (o.limits & limit::chatter) != 0;
    if (o.armed) scenes_.insert(o.scene);
    if (o.first_fault != 0) faults_.insert(o.first_fault);
  }
  void merge(const Coverage& o) {
    clocks_ += o.clocks_;
    armed_ += o.armed_;
    duty_pinned_ += o.duty_pinned_;
    tau_ref_pinned_ += o.tau_ref_pinned_;
    eased_ += o.eased_;
    frozen_ += o.frozen_;
    scenes_.insert(o.scenes_.begin(), o.scenes_.end());
    faults_.insert(o.faults_.begin(), o.faults_.end());
  }
  double armed_share() const { return share(armed_); }
  double duty_pinned_share() const { return share(duty_pinned_); }
  double tau_ref_pinned_share() const { return share(tau_ref_pinned_); }
  double eased_share() const { return share(eased_); }
  double frozen_share() const { return share(frozen_); }
  bool fault_seen(Fault cause) const { return faults_.count(static_cast<int>(cause)) != 0; }
  /// Scenes that ran armed, the reserved number 1 and those not built left out.
  int scenes_seen() const {
    int n = 0;
    for (const int s : scenes_) n += s == 0 || (s >= 2 && s <= 9) ? 1 : 0;
    return n;
  }
  int faults_seen() const { return static_cast<int>(faults_.size()); }
  std::string text() const {
    return "armed " + std::to_string(armed_share()) + ", duty pinned " +
           std::to_string(duty_pinned_share()) + ", tau_ref pinned " +
           std::to_string(tau_ref_pinned_share()) + ", eased " + std::to_string(eased_share()) +
           ", frozen " + std::to_string(frozen_share()) + ", scenes " +
           std::to_string(scenes_seen()) + ", faults " + std::to_string(faults_seen());
  }

 private:
  double share(std::int64_t n) const {
    return clocks_ == 0 ? 0.0 : static_cast<double>(n) / static_cast<double>(clocks_);
  }
  std::int64_t clocks_ = 0, armed_ = 0, duty_pinned_ = 0, tau_ref_pinned_ = 0, eased_ = 0,
               frozen_ = 0;
  std::set<int> scenes_, faults_;
};

}  // namespace feltgate::test
