// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One tick of the design `lever`, written by hand: 64-bit integers, shifts and masks, with the
// binary points of the signals as literals. It is the reference for the speed of `fixed`. Its bits
// must be equal, so it also checks the laws without sharing code with them. Documentation:
// docs/bench.md
#pragma once

#include <array>
#include <cstdint>

#include "feltgate/generated/lever.hpp"
#include "sim/reference/real_chain.hpp"

namespace feltgate {

class ShiftChain {
 public:
  using Word = std::int64_t;

  ShiftChain() { reset(); }

  void reset() {
    *this = ShiftChain(Nothing{});
    for (const ParameterInfo& p : Lever::parameters) {
      set_word(p.address, static_cast<std::uint32_t>(p.raw & 0xffffffff));
    }
  }

  /// Takes a word as the host writes it, and decodes it once.
  void set_word(int address, std::uint32_t word);

  void tick(const ChainIn& in) {
    const int counts = travel_difference(in.travel);
    const Word doubled = Word{counts} * (1 << 22);  // .21
    const Word raw = saturated(doubled, 31);
    velocity_saturated = raw != doubled;
    velocity += half_up((raw - velocity) * p_.velocity_a1, P::velocity_a1.fraction);

    const Word drive =
        in.armed ? (current * p_.torque_constant) >> drop(P::torque_constant, 16, 30) : 0;
    const Word inertia = (velocity * p_.inertia_gain) >> drop(P::inertia_gain, 21, 30);
    const Word input = drive + inertia;
    observer_ = in.armed ? observer_ + half_up(((input - observer_) >> 4) * p_.observer_a1,
                                               drop(P::observer_a1, 26, 30))
                         : input;
    const Word observed = half_up(observer_ - inertia, 14);  // .30 to .16
    tau_hat = saturated(observed, 20);
    tau_hat_saturated = tau_hat != observed;

    ramping_ = ramping_ || in.restart;
    limit_and_ramp(in.armed, in.scene, torque(in.scene, in.position));
    control(in.armed, in.mode);
  }

  // Results of the tick, as the core shows them.
  Word velocity = 0, tau_hat = 0, tau_ref = 0, current = 0, voltage = 0, duty = 0;
  bool limit_torque = false, limit_ramp = false, limit_current = false, limit_voltage = false,
       limit_duty = false, velocity_saturated = false, tau_hat_saturated = false;

 private:
  struct Nothing {};
  explicit ShiftChain(Nothing) {}
  enum class Side : std::uint8_t { unknown, below, above };

  struct Parameters {
    Word velocity_a1, torque_constant, inertia_gain, observer_a1, emf_constant, observer_gain,
        voltage_setpoint, torque_limit, ramp_step, voltage_to_current, torque_gain,
        dead_voltage_slope, region_torque, current_limit, voltage_gain, voltage_gain_high,
        dead_voltage, voltage_window, voltage_step, duty_gain, duty_limit, setpoint_torque,
        membrane_lower, membrane_upper, membrane_torque, compression_contact, compression_stiffness,
        tension_rest, tension_stiffness, damper_damping, attract_centre, attract_strength,
        attract_core, attract_core_slope, repel_centre, repel_strength, repel_core,
        repel_core_slope, wall_contact, wall_stiffness, wall_damping;
  };

  using P = Lever::P;
  /// Bits to drop from signal * coefficient, for a result with `to` bits after the point.
  static constexpr int drop(Format coefficient, int signal, int to) {
    return coefficient.fraction + signal - to;
  }
  static Word half_up(Word x, int k) { return (x + (Word{1} << (k - 1))) >> k; }
  /// x, saturated to [-2^bits, 2^bits).
  static Word saturated(Word x, int bits) {
    const Word end = Word{1} << bits;
    return x < -end ? -end : (x > end - 1 ? end - 1 : x);
  }
  /// The low `bits` bits of x as a signed number.
  static Word wrapped(Word x, int bits) {
    const Word sign = Word{1} << (bits - 1);
    return ((x & (2 * sign - 1)) ^ sign) - sign;
  }
  /// Limits x to +-limit. A negative limit counts as 0, and so does one of more than `bits` bits.
  static Word limited(Word x, Word limit, bool* hit, int bits = 22) {
    const bool misfit = limit >= Word{1} << (bits - 1);
    *hit = misfit || x > limit || x < -limit;
    const Word bound = limit < 0 || misfit ? 0 : limit;
    return x > bound ? bound : (x < -bound ? -bound : x);
  }

  int travel_difference(std::int16_t travel) {
    const int oldest = line_[at_];
    line_[at_] = travel;
    if (++at_ == line_.size()) at_ = 0;
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(travel - oldest));
  }

  Word torque(int scene, std::int32_t position) {
    const Word theta = saturated(position, 17);
    if (scene != Lever::S::membrane) side_ = Side::unknown;
    switch (scene) {
      case Lever::S::setpoint:
        return p_.setpoint_torque;
      case Lever::S::membrane:
        return membrane(theta * 256);
      case Lever::S::spring_compression: {
        const Word x = p_.compression_contact - theta * 256;  // .8
        return x < 0 ? 0
                     : half_up(x * p_.compression_stiffness, drop(P::compression_stiffness, 8, 16));
      }
      case Lever::S::spring_tension: {
        const Word x = p_.tension_rest - theta * 256;
        return half_up(x * p_.tension_stiffness, drop(P::tension_stiffness, 8, 16));
      }
      case Lever::S::damper:
        return -half_up(velocity * p_.damper_damping, drop(P::damper_damping, 21, 16));
      case Lever::S::charge_attract:
        return charge((p_.attract_centre >> 8) - theta, true);
      case Lever::S::charge_repel:
        return charge((p_.repel_centre >> 8) - theta, false);
      case Lever::S::wall:
        return wall(p_.wall_contact - theta * 256);
      default:
        return 0;
    }
  }

  Word wall(Word x) const {
    if (x >= 0) return 0;
    // Both parts keep two bits below the torque; the spring's has 29 bits.
    const Word spring = saturated((x * p_.wall_stiffness) >> drop(P::wall_stiffness, 8, 18), 28);
    const Word tau =
        half_up(spring - ((velocity * p_.wall_damping) >> drop(P::wall_damping, 21, 18)), 2);
    return tau < 0 ? tau : 0;
  }

  Word membrane(Word theta) {
    if (theta < p_.membrane_lower || theta > p_.membrane_upper) {
      side_ = theta < p_.membrane_lower ? Side::below : Side::above;
      return 0;
    }
    if (p_.membrane_torque < 0 || side_ == Side::unknown) return 0;
    return side_ == Side::above ? p_.membrane_torque : -p_.membrane_torque;
  }

  Word charge(Word distance, bool attract) const {
    const Word core = attract ? p_.attract_core : p_.repel_core;
    if (core > 0 && distance <= core && distance >= -core) {
      const Word pull = half_up(distance * (attract ? p_.attract_core_slope : p_.repel_core_slope),
                                drop(attract ? P::attract_core_slope : P::repel_core_slope, 0, 16));
      return attract ? pull : -pull;
    }
    const Word strength = attract ? p_.attract_strength : p_.repel_strength;
    const Word square = distance * distance;
    const Word force = strength >> 16 >= square ? 65535 : strength / square;
    return attract != (distance > 0) ? -force : force;
  }

  void limit_and_ramp(bool armed, int scene, Word tau) {
    if (!armed || scene != scene_) ramping_ = true;
    scene_ = scene;
    const Word target =
        wrapped(limited(armed ? tau : 0, p_.torque_limit, &limit_torque, 21), 21) * 256;
    limit_torque = limit_torque && armed;
    limit_ramp = armed && ramping_;
    if (!limit_ramp) {
      reference_ = target;
    } else {
      const Word step = p_.ramp_step < 1 ? 1 : p_.ramp_step;  // .24
      const Word excess = reference_ - target;
      if (excess <= step && -excess <= step) {
        ramping_ = false;
      } else {
        reference_ = wrapped(reference_ + (excess > step ? -step : step), 29);
      }
    }
    tau_ref = reference_ >> 8;
  }

  void control(bool armed, int mode) {
    const bool direct = mode == 2;
    const bool high = tau_ref > p_.region_torque || tau_ref < -p_.region_torque;
    const Word emf = (velocity * p_.emf_constant) >> drop(P::emf_constant, 21, 14);
    bool unused = false;
    Word sum = 0, volts = 0;  // volts: less the back-EMF
    if (direct) {
      sum = (voltage * p_.voltage_to_current) >> drop(P::voltage_to_current, 14, 16);
      volts = voltage + limited(p_.voltage_setpoint - voltage, p_.voltage_step, &unused) - emf;
    } else {
      const Word by_hat =
          mode == 1 ? 0 : (tau_hat * p_.observer_gain) >> drop(P::observer_gain, 16, 16);
      sum = ((tau_ref * p_.torque_gain) >> drop(P::torque_gain, 16, 16)) + by_hat;
      const Word slope = (tau_ref * p_.dead_voltage_slope) >> drop(P::dead_voltage_slope, 16, 14);
      volts = wrapped(limited(slope, p_.dead_voltage, &unused), 22);
    }
    const Word asked = wrapped(limited(sum, p_.current_limit, &limit_current), 22);
    current = armed ? asked : 0;
    limit_current = limit_current && armed;

    if (!direct)
      volts += (current * (high ? p_.voltage_gain_high : p_.voltage_gain)) >>
               drop(P::voltage_gain, 16, 14);
    const Word inside = limited(volts, p_.voltage_window, &limit_voltage, 20);
    const Word applied = armed ? inside + emf : 0;
    limit_voltage = limit_voltage && armed;
    voltage = saturated(applied, 19);
    duty = wrapped(limited(half_up(applied * p_.duty_gain, drop(P::duty_gain, 14, 0)),
                           p_.duty_limit, &limit_duty, 13),
                   13);
  }

  Parameters p_{};
  std::array<std::int16_t, Lever::m1> line_{};
  std::size_t at_ = 0;
  Word observer_ = 0, reference_ = 0;
  int scene_ = 0;
  bool ramping_ = true;
  Side side_ = Side::unknown;
};

}  // namespace feltgate
