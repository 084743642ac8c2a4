// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The format of every signal of the chain, derived from a design's base formats by the growth
// rules. The twin uses the result at compile time; the generator writes it into cfg.sv.
// Documentation: docs/fixed-point.md
#pragma once

#include <initializer_list>

#include "feltgate/format.hpp"

namespace feltgate {

/// Widths that are fixed by the FPGA fabric or by the architecture.
namespace fabric {
constexpr int multiplier_a_bits = 35;  ///< data operand: two signed 18x18 multipliers
constexpr int multiplier_b_bits = 18;  ///< coefficient operand
constexpr int product_bits = multiplier_a_bits + multiplier_b_bits;
constexpr int word_bits = 32;        ///< register port and parameter RAM
constexpr int travel_bits = 16;      ///< free-running count of the velocity estimator
constexpr int scene_guard_bits = 2;  ///< bits that a scene's terms keep below a torque step
}  // namespace fabric

/// The formats that a design states (signals), and those that its values need (coefficients).
struct BaseFormats {
  Format velocity;         ///< rad/s
  Format torque;           ///< Nm
  Format current;          ///< A
  Format voltage;          ///< V
  int observer_fraction;   ///< fraction bits of the observer's state
  int velocity_shift;      ///< n of the N-method: raw = 2^n * counts
  bool has_velocity_gain;  ///< a quantised gain replaces 2^n
  Format velocity_gain;    ///< rad/s per count
  Format velocity_a1;
  Format torque_constant;
  Format inertia_gain;
  Format observer_a1;
  Format torque_gain;
  Format observer_gain;
  Format voltage_gain;
  Format emf_constant;
  Format dead_voltage_slope;
  Format voltage_to_current;
  Format duty_gain;
  Format inverse_resistance;
  Format emf_over_resistance;
  Format compression_stiffness;
  Format tension_stiffness;
  Format attract_core_slope;
  Format repel_core_slope;
  Format wall_stiffness;
  Format damper_damping;
  Format wall_damping;
};

/// Every format of the chain, in the order of the data.
struct Formats {
  Format position;               ///< count, wraps
  Format scene_position;         ///< count, saturated: what a scene sees
  Format scene_offset;           ///< count: a scene's parameters
  Format scene_distance;         ///< count: reference minus position, exact
  Format scene_part;             ///< Nm: one term of a scene's torque, as it leaves the multiplier
  Format scene_torque;           ///< Nm: a scene's torque, rounded and not yet limited
  Format travel_difference;      ///< count in m1 ticks
  Format velocity_raw;           ///< rad/s before the low-pass, exact
  Format velocity;               ///< rad/s, also the low-pass state
  Format velocity_difference;    ///< low-pass input minus state, as the multiplier takes it
  Format inertia_torque;         ///< g*Jn*w
  Format drive_torque;           ///< Ktn*I
  Format observer;               ///< observer input and state
  Format observer_difference;    ///< observer input minus state, as the multiplier takes it
  Format observed;               ///< state minus inertia torque, before it is narrowed
  Format torque;                 ///< Nm
  Format ramp;                   ///< Nm, the torque while it ramps
  Format current;                ///< A
  Format current_part;           ///< A: one of the two products that make the current
  Format current_sum;            ///< A, before the limit
  Format voltage;                ///< V
  Format voltage_part;           ///< V: one product of the voltage law
  Format voltage_sum;            ///< V, less the back-EMF, before the limit
  Format emf;                    ///< V: the back-EMF
  Format applied;                ///< V: the limited part plus the back-EMF
  Format duty;                   ///< clock
  Format duty_sum;               ///< clock, before the limit
  Format limiter;                ///< output of the limiter; it has the binary point of the input
  Format with_addend;            ///< output of the limiter plus the back-EMF
  Format limiter_input;          ///< input of the limiter
  Format current_estimate_part;  ///< A: one product of the estimate
  Format current_estimate;       ///< A: (V - Ke*w)/R
  Format current_squared;        ///< A^2
  Format i2t;                    ///< A^2 tick
  Format charge;                 ///< Nm count^2
};

namespace growth {

/// f limited to `width` bits by dropping fraction bits.
constexpr Format fit(Format f, int width) {
  return f.width() <= width ? f : Format{f.sign, f.integer, f.fraction - (f.width() - width)};
}

/// f with another number of fraction bits.
constexpr Format with_fraction(Format f, int fraction) { return {f.sign, f.integer, fraction}; }

}  // namespace growth

/// The formats that follow from the base formats. No sum or product in the chain can overflow;
/// values are narrowed only into velocity, torque, current, voltage, duty and the estimate.
constexpr Formats derive(const BaseFormats& b) {
  Formats f{};
  f.position = {1, 31, 0};
  f.scene_position = {1, 17, 0};
  f.scene_offset = {1, 17, 8};
  f.scene_distance = growth::difference(f.scene_offset, f.scene_position);
  f.travel_difference = {1, fabric::travel_bits - 1, 0};
  f.velocity_raw = b.has_velocity_gain ? growth::product(f.travel_difference, b.velocity_gain)
                                       : growth::scaled(f.travel_difference, b.velocity_shift);
  f.velocity = b.velocity;
  f.velocity_difference =
      growth::fit(growth::difference(b.velocity, b.velocity), fabric::multiplier_a_bits);
  f.inertia_torque =
      growth::with_fraction(growth::product(b.velocity, b.inertia_gain), b.observer_fraction);
  f.drive_torque =
      growth::with_fraction(growth::product(b.current, b.torque_constant), b.observer_fraction);
  f.observer = growth::sum(f.inertia_torque, f.drive_torque);
  f.observer_difference =
      growth::fit(growth::difference(f.observer, f.observer), fabric::multiplier_a_bits);
  f.observed = growth::difference(f.observer, f.inertia_torque);
  f.torque = b.torque;
  f.ramp = growth::with_fraction(b.torque, 24);
  f.current = b.current;
  const Format by_tau_ref = growth::product(b.torque, b.torque_gain);
  const Format by_tau_hat = growth::product(b.torque, b.observer_gain);
  f.current_part = {1, growth::max_of(by_tau_ref.integer, by_tau_hat.integer), b.current.fraction};
  // Two parts, or in voltage mode the current of the set-point alone.
  const Format direct = growth::product(b.voltage, b.voltage_to_current);
  f.current_sum = {1, growth::max_of(f.current_part.integer + 1, direct.integer),
                   b.current.fraction};
  f.voltage = b.voltage;
  const Format resistive = growth::product(b.current, b.voltage_gain);
  const Format emf = growth::product(b.velocity, b.emf_constant);
  const Format dead = growth::product(b.torque, b.dead_voltage_slope);
  f.voltage_part = {1, growth::max_of(growth::max_of(resistive.integer, emf.integer), dead.integer),
                    b.voltage.fraction};
  // Three parts, or in voltage mode the set-point minus the back-EMF.
  f.voltage_sum = {1, growth::max_of(f.voltage_part.integer, b.voltage.integer) + 2,
                   b.voltage.fraction};
  f.emf = {1, emf.integer, b.voltage.fraction};
  f.applied = growth::sum(f.emf, b.voltage);
  f.duty = {1, 12, 0};
  int integer = 0;
  for (const Format& k :
       {b.compression_stiffness, b.tension_stiffness, b.attract_core_slope, b.repel_core_slope}) {
    integer = growth::max_of(integer, growth::product(f.scene_distance, k).integer);
  }
  for (const Format& k : {b.damper_damping, b.wall_damping}) {
    integer = growth::max_of(integer, growth::product(b.velocity, k).integer);
  }
  // A charge's distance goes through the torque's path too, as an integer.
  integer = growth::max_of(integer, f.scene_distance.integer - b.torque.fraction);
  f.scene_part = {1, growth::max_of(integer, b.torque.integer),
                  b.torque.fraction + fabric::scene_guard_bits};
  // Two parts, and rounding up may need one bit more.
  f.scene_torque = {1, f.scene_part.integer + 2, b.torque.fraction};
  f.limiter = {
      1, growth::max_of(growth::max_of(b.current.width(), b.torque.width()), b.voltage.width()) - 1,
      0};
  // Rounding up may need one bit more.
  f.duty_sum = {1, growth::product(f.applied, b.duty_gain).integer + 1, 0};
  f.with_addend = {1, growth::max_of(f.limiter.width(), f.applied.width()), 0};
  f.limiter_input = {1,
                     growth::max_of(growth::max_of(f.current_sum.width(), f.voltage_sum.width()),
                                    growth::max_of(f.scene_torque.width(), f.duty_sum.width())) -
                         1,
                     0};
  const Format estimate_v = growth::product(b.voltage, b.inverse_resistance);
  const Format estimate_w = growth::product(b.velocity, b.emf_over_resistance);
  // Whatever the motor, the estimate has 17 bits, its square 19 and the heat 32: a small motor's
  // have a finer step.
  const int estimate_integer =
      growth::max_of(growth::max_of(estimate_v.integer, estimate_w.integer), b.current.integer);
  f.current_estimate_part = {1, estimate_integer, 15 - estimate_integer};
  f.current_estimate = growth::difference(f.current_estimate_part, f.current_estimate_part);
  const int square = 2 * f.current_estimate.integer;
  f.current_squared = {0, square + 1, 18 - square};
  f.i2t = {0, square + 14, 18 - square};
  f.charge = {0, 16, 16};
  return f;
}

}  // namespace feltgate
