// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/options/field_oriented.sv: the currents of three phases in the rotor's frame,
// their two laws, and three on-times. Its gains are those of current_control.hpp, with the voltage
// supply/root 3 as supply. Documentation: docs/blocks/three_phase.md
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "feltgate/current_control.hpp"

namespace feltgate {

/// Bit-exact and clock-exact with the RTL.
class FieldOriented {
 public:
  static constexpr int kLatencyClocks = 261;  ///< from valid to out().valid
  struct In {
    bool armed = false;              ///< false: voltage and integrators are 0
    bool valid = false;              ///< one clock: takes all but the last three
    bool direct = false;             ///< true: emf alone is the voltage, the integrators are 0
    std::int32_t reference = 0;      ///< [1,1,17] of full scale: peak of a phase
    std::int32_t current_a = 0;      ///< [1,1,17] of full scale, as CurrentSense has it
    std::int32_t current_b = 0;      ///< the same
    std::int32_t emf = 0;            ///< [1,0,17] of supply/root 3: peak of a phase, fed forward
    std::int32_t position = 0;       ///< counts; wraps
    std::uint32_t gain = 0;          ///< 2^-32 electrical turn per count
    std::uint32_t offset = 0;        ///< 2^-32 electrical turn; the low 12 bits do not count
    bool polarity = false;           ///< true: phases B and C change places
    std::uint32_t proportional = 0;  ///< [0,4,13], taken with each product
    std::uint32_t integral = 0;      ///< [0,0,17], the same
    std::uint32_t limit = 0;         ///< [0,0,17] of supply/root 3: greatest length of the voltage
  };
  struct Out {
    std::int32_t current_q = 0;  ///< [1,3,17] of full scale: along the axis of torque
    /// [1,1,17] of supply/root 3: whole parts of the integrators, along the axis and across it.
    std::int32_t resistive = 0, across = 0;
    bool open = false;      ///< a phase has no current; held while armed
    std::int16_t on_a = 0;  ///< clocks of the high switch in a period, 0 to period
    std::int16_t on_b = 0;
    std::int16_t on_c = 0;
    bool valid = false;  ///< one clock: the on-times are new
  };

  /// `period` in clocks: even, 4 to 4094.
  explicit FieldOriented(int period = 1000) : period_(period) { reset(); }

  void reset() {
    const int period = period_;
    *this = FieldOriented(period, Blank{});
    out_.on_a = out_.on_b = out_.on_c = static_cast<std::int16_t>(period / 2);
  }

  void clock(const In& in) {
    if (!in.armed) {
      reset();
      return;
    }
    out_.valid = false;
    if (operation_ == 0 && step_ == 0) {
      if (!in.valid) return;
      take(in);
    }
    if (step_ == 0) load(in);
    if (step_ == last_step()) store(in);
    if (operation_ == kAgain && step_ == 3) legs();
    if (step_ < last_step()) {
      ++step_;
    } else {
      step_ = 0;
      operation_ = operation_ == kAlongI ? 0 : operation_ + 1;
    }
  }

  const Out& out() const { return out_; }

 private:
  struct Blank {};
  FieldOriented(int period, Blank) : period_(period) {}

  // An operation takes operands, computes, and gives a result: a product in 19 clocks, a turn
  // in 35.
  enum Operation : int {
    kPark = 2,
    kAcrossP = 3,
    kAlongP = 4,
    kPolar = 5,
    kLength = 6,
    kTurned = 8,
    kAgain = 11,
    kApplied = 12,
    kAcrossI = 13,
    kAlongI = 14
  };
  static constexpr int kGuard = 3;                              // bits of the CORDIC below an LSB
  static constexpr std::int64_t kShrink = 79594;                // 2^17 / 1.64676
  static constexpr std::int64_t kShrinkBeta = 45954;            // of that 1/root 3
  static constexpr std::int64_t kTurn = std::int64_t{1} << 20;  // of the CORDIC's angles

  struct Vector {
    std::int64_t x = 0, y = 0;
  };

  /// An angle, 2^-20 turn, -2^19 to 2^19 - 1.
  static std::int64_t wrapped(std::int64_t angle) {
    return (((angle + kTurn / 2) % kTurn + kTurn) % kTurn) - kTurn / 2;
  }
  /// A turn of the CORDIC: by `angle`, if `back` the other way; or, `to_axis`, until y is 0, and
  /// `angle` grows by that of v.
  static Vector turned(Vector v, std::int64_t* angle, bool back, bool to_axis) {
    static constexpr std::array<std::int64_t, 16> arcs = {
        131072, 77376, 40884, 20753, 10417, 5213, 2607, 1304, 652, 326, 163, 81, 41, 20, 10, 5};
    if (to_axis ? v.x < 0 : *angle < -kTurn / 4 || *angle >= kTurn / 4) {
      v = {-v.x - 1, -v.y - 1};
      *angle = wrapped(*angle + kTurn / 2);
    }
    for (std::size_t k = 0; k < arcs.size(); ++k) {
      const bool falls = to_axis ? v.y < 0 : *angle >= 0;
      const bool clockwise = falls == back;
      const Vector part = {v.x >> k, v.y >> k};
      v.x += clockwise ? part.y : -part.y;
      v.y += clockwise ? -part.x : part.x;
      *angle = wrapped(*angle + (falls ? -arcs[k] : arcs[k]));
    }
    return v;
  }

  int last_step() const {
    const bool turns = operation_ == kPark || operation_ == kPolar || operation_ == kTurned ||
                       operation_ == kApplied;
    return turns ? 34 : 18;
  }

  void take(const In& in) {
    direct_ = in.direct;
    mirror_ = in.polarity;
    reference_ = in.reference;
    emf_ = in.emf;
    const std::int64_t both = std::int64_t{in.current_a} + in.current_b;
    const std::int64_t beta = both + in.current_b;
    at_ = {(in.current_a * kShrink) >> 14, ((mirror_ ? -beta : beta) * kShrinkBeta) >> 14};
    const std::uint32_t angle = in.gain * static_cast<std::uint32_t>(in.position);
    theta_ = wrapped(std::int64_t{angle >> 12} + (in.offset >> 12));
    high_ = false;
    low_ = 0;
    const std::array<std::int64_t, 3> phases = {in.current_a, in.current_b, both};
    for (std::size_t n = 0; n < phases.size(); ++n) {
      if (phases[n] >> 8 == 0 || phases[n] >> 8 == -1) low_ |= 1U << n;
      high_ = high_ || (phases[n] >> 12 != 0 && phases[n] >> 12 != -1);
    }
    if (direct_) {
      integrator_ = {};
      out_.resistive = out_.across = 0;
    }
  }

  /// Whether a phase has been low since `start_`, while the angle moved by a 32nd of a turn.
  void watch() {
    const auto now = static_cast<std::uint32_t>(theta_ >> 12) & 0xffU;
    quiet_ &= low_;
    if (!high_ || quiet_ == 0) {
      quiet_ = 7;
      start_ = now;
      return;
    }
    const std::uint32_t moved = ((now - start_) & 0xffU) >> 3;
    out_.open = out_.open || (moved != 0 && moved != 31);
  }

  /// Whole part of an integrator and what is fed forward: along 1, across 0.
  std::int64_t base(std::size_t along) const {
    return (integrator_[along] >> kCurrentControlBits) + (along == 1 ? emf_ : 0);
  }
  static std::int64_t part(std::int64_t error, std::uint32_t gain) {
    constexpr std::int64_t half = std::int64_t{1} << (kCurrentProportionalBits - 1);
    return (error * static_cast<std::int64_t>(gain) + half) >> kCurrentProportionalBits;
  }

  void load(const In& in) {
    const std::uint32_t proportional = direct_ ? 0 : in.proportional;
    const std::uint32_t integral = direct_ ? 0 : in.integral;
    std::int64_t angle = theta_;
    switch (operation_) {
      case kPark:
        at_ = turned(at_, &angle, true, false);
        watch();
        break;
      case kAcrossP:
        part_ = part(-(at_.y >> kGuard), proportional);
        break;
      case kAlongP:
        part_ = part(reference_ - (at_.x >> kGuard), proportional);
        break;
      case kPolar:
        angle_ = 0;
        at_ = turned({wanted_[1], wanted_[0]}, &angle_, false, true);
        break;
      case kTurned:
        angle = wrapped(angle_ + theta_);
        at_ = turned(radius(), &angle, false, false);
        break;
      case kApplied:
        angle = angle_;
        at_ = turned(radius(), &angle, false, false);
        break;
      case kAcrossI:
        part_ = ((saturated_ ? at_.y >> kGuard : wanted_[0]) - base(0)) * integral;
        break;
      case kAlongI:
        part_ = ((saturated_ ? at_.x >> kGuard : wanted_[1]) - base(1)) * integral;
        break;
      default:
        break;
    }
  }

  void store(const In& in) {
    switch (operation_) {
      case kPark:
        out_.current_q = static_cast<std::int32_t>(at_.x >> kGuard);
        break;
      case kAcrossP:
      case kAlongP: {
        constexpr std::int64_t end = std::int64_t{16} << kCurrentControlBits;
        const std::size_t along = operation_ == kAlongP ? 1 : 0;
        wanted_[along] = std::clamp(part_ + base(along), -end, end - 1);
        break;
      }
      case kLength: {
        const std::int64_t length = (at_.x * kShrink) >> 17, limit = in.limit;
        saturated_ = length > limit;
        length_ = saturated_ ? limit : length;
        break;
      }
      case kAcrossI:
        integrator_[0] += part_;
        out_.across = static_cast<std::int32_t>(integrator_[0] >> kCurrentControlBits);
        break;
      case kAlongI:
        integrator_[1] += part_;
        out_.resistive = static_cast<std::int32_t>(integrator_[1] >> kCurrentControlBits);
        break;
      default:
        break;
    }
  }

  /// The limited voltage, before it is turned.
  Vector radius() const { return {(length_ * kShrink) >> 14, 0}; }

  /// Space vectors, in 2^-4 clocks: docs/blocks/three_phase.md
  void legs() {
    constexpr int down = 17 + kGuard + 6 - 4;
    const std::int64_t u = (at_.x * ((period_ * 454047 + 8192) / 16384)) >> down;
    const std::int64_t v = (at_.y * (period_ * 16)) >> down;
    const std::int64_t middle = period_ / 2 * 16 + 8;
    const bool a_between = (u + v < 0) != (u - v < 0), b_between = (u < 0) == (v < 0);
    const std::int64_t outer = a_between ? 2 * v : b_between ? u + v : u - v;
    const std::int64_t upper = (middle + outer) >> 4, lower = (middle - outer) >> 4;
    const std::int64_t from_lower = middle - outer + (b_between ? 4 * v : -4 * v);
    const std::int64_t between = (a_between ? middle + 2 * u : from_lower) >> 4;
    const std::int64_t leg_b = a_between ? upper : b_between ? between : lower;
    const std::int64_t leg_c = a_between || b_between ? lower : between;
    out_.on_a = static_cast<std::int16_t>(a_between ? between : upper);
    out_.on_b = static_cast<std::int16_t>(mirror_ ? leg_c : leg_b);
    out_.on_c = static_cast<std::int16_t>(mirror_ ? leg_b : leg_c);
    out_.valid = true;
  }

  int period_;
  Out out_;
  int operation_ = 0, step_ = 0;
  bool direct_ = false, mirror_ = false, saturated_ = false, high_ = false;
  std::uint32_t low_ = 0, quiet_ = 0, start_ = 0;  // phases, phases, 2^-8 turn
  std::int64_t reference_ = 0, emf_ = 0, theta_ = 0, angle_ = 0;
  Vector at_;
  std::int64_t part_ = 0, length_ = 0;
  std::array<std::int64_t, 2> wanted_{}, integrator_{};  // across, along
};

}  // namespace feltgate
