// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The words that the blocks take (cfg::params_t), as numbers of a policy: Fixed has the RTL's
// integers, Real SI units. docs/blocks/host.md
#pragma once

#include <array>
#include <cstddef>

#include "feltgate/axis/design.hpp"
#include "feltgate/generated/map.hpp"

namespace feltgate::axis {

template <class T>
struct Words {
  T velocity_a1 = 0, inverse_resistance = 0, emf_over_resistance = 0, torque_constant = 0,
    inertia_gain = 0, nominal_current_squared = 0, observer_a1 = 0, overspeed = 0, i2t_budget = 0,
    polarity_speed = 0, polarity_current = 0, polarity_ticks = 0, emf_constant = 0,
    observer_gain = 0, voltage_setpoint = 0, voltage_step = 0, torque_limit = 0, ramp_step = 0,
    voltage_to_current = 0, torque_gain = 0, dead_voltage_slope = 0, region_torque = 0,
    hold_torque = 0, hold_time = 0, hold_limit = 0, current_limit = 0, voltage_gain = 0,
    voltage_gain_high = 0, dead_voltage = 0, voltage_window = 0, duty_gain = 0, duty_limit = 0,
    watchdog_ticks = 0, self_test_torque = 0, self_test_quiet = 0, self_test_pulse = 0,
    self_test_arms = 0, commutation_gain = 0, commutation_offset = 0;
  // Of the scene in force. Those of one place share a register: p.scene_1, 2, 3, 6 and 10.
  T first = 0;   ///< counts: contact, rest, centre, lower face
  T second = 0;  ///< counts: upper face
  T stiffness = 0, slope = 0;
  T strength = 0;
  T core = 0;  ///< counts
  T damping = 0;
  T torque = 0;

  /// The word at an address below 64; null where no block takes one.
  static T Words::*common(int address) {
    using A = Map::A;
    switch (address) {
      case A::velocity_a1:
        return &Words::velocity_a1;
      case A::inverse_resistance:
        return &Words::inverse_resistance;
      case A::emf_over_resistance:
        return &Words::emf_over_resistance;
      case A::torque_constant:
        return &Words::torque_constant;
      case A::inertia_gain:
        return &Words::inertia_gain;
      case A::nominal_current_squared:
        return &Words::nominal_current_squared;
      case A::observer_a1:
        return &Words::observer_a1;
      case A::overspeed:
        return &Words::overspeed;
      case A::i2t_budget:
        return &Words::i2t_budget;
      case A::polarity_speed:
        return &Words::polarity_speed;
      case A::polarity_current:
        return &Words::polarity_current;
      case A::polarity_ticks:
        return &Words::polarity_ticks;
      case A::emf_constant:
        return &Words::emf_constant;
      case A::observer_gain:
        return &Words::observer_gain;
      case A::voltage_setpoint:
        return &Words::voltage_setpoint;
      case A::voltage_step:
        return &Words::voltage_step;
      case A::torque_limit:
        return &Words::torque_limit;
      case A::ramp_step:
        return &Words::ramp_step;
      case A::voltage_to_current:
        return &Words::voltage_to_current;
      case A::torque_gain:
        return &Words::torque_gain;
      case A::dead_voltage_slope:
        return &Words::dead_voltage_slope;
      case A::region_torque:
        return &Words::region_torque;
      case A::hold_torque:
        return &Words::hold_torque;
      case A::hold_time:
        return &Words::hold_time;
      case A::hold_limit:
        return &Words::hold_limit;
      case A::current_limit:
        return &Words::current_limit;
      case A::voltage_gain:
        return &Words::voltage_gain;
      case A::voltage_gain_high:
        return &Words::voltage_gain_high;
      case A::dead_voltage:
        return &Words::dead_voltage;
      case A::voltage_window:
        return &Words::voltage_window;
      case A::duty_gain:
        return &Words::duty_gain;
      case A::duty_limit:
        return &Words::duty_limit;
      case A::watchdog_ticks:
        return &Words::watchdog_ticks;
      case A::self_test_torque:
        return &Words::self_test_torque;
      case A::self_test_quiet:
        return &Words::self_test_quiet;
      case A::self_test_pulse:
        return &Words::self_test_pulse;
      case A::self_test_arms:
        return &Words::self_test_arms;
      case A::commutation_gain:
        return &Words::commutation_gain;
      case A::commutation_offset:
        return &Words::commutation_offset;
      default:
        return nullptr;
    }
  }
};

/// What reads the words of an address into Words<T> of Fixed: bits and sign of each.
struct WordFormats {
  struct Format {
    std::int64_t Words<std::int64_t>::*to = nullptr;
    int bits = 32;
    bool has_sign = false;
    std::uint32_t above = 0;  ///< bits that equal the sign, or 0
    std::int64_t value(std::uint32_t word) const {
      return has_sign ? signed_bits(word, bits) : low_bits(word, bits);
    }
  };
  std::array<Format, 512> at{};
  int torque_bits;

  explicit WordFormats(const Design& d) : torque_bits(d["TORQUE_W"]) {
    for (const Word& w : d.words) {
      Format& f = at[static_cast<std::size_t>(w.address)];
      f = {w.address < 64 ? Words<std::int64_t>::common(w.address) : nullptr, w.bits, w.has_sign,
           ~low_bits(~0U, w.has_sign ? w.bits - 1 : w.bits)};
    }
  }
  /// A word of all scenes into its register.
  void load(Words<std::int64_t>& p, int address, std::uint32_t word) const {
    const Format& f = at[static_cast<std::size_t>(address)];
    if (f.to != nullptr) p.*f.to = f.value(word);
  }
  /// Whether load() would change nothing.
  bool holds(const Words<std::int64_t>& p, int address, std::uint32_t word) const {
    const Format& f = at[static_cast<std::size_t>(address)];
    return f.to == nullptr || p.*f.to == f.value(word);
  }
  /// A word of the scene in force, by its place in the scene's bank.
  void load_scene(Words<std::int64_t>& p, int place, std::uint32_t word) const {
    switch (place) {
      case 1:
        p.first = signed_bits(word, 26);
        break;
      case 2:
        p.second = signed_bits(word, 26);
        p.stiffness = low_bits(word, 17);
        p.strength = word;
        break;
      case 3:
        p.slope = low_bits(word, 17);
        break;
      case 6:
        p.core = low_bits(word, 18);
        break;
      default:
        p.damping = low_bits(word, 17);
        p.torque = signed_bits(word, torque_bits);
    }
  }
};

}  // namespace feltgate::axis
