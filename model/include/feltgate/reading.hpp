// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One tick of the core in SI units. Documentation: docs/library.md
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "feltgate/core_ports.hpp"
#include "feltgate/design_info.hpp"
#include "feltgate/generated/causes.hpp"

namespace feltgate {

/// What the core showed when its snapshot was valid. Every number is its integer times a power of
/// two, which is exact, but angle and duty, which are rounded to binary64.
struct Reading {
  std::uint32_t tick = 0;     ///< since reset, wraps at 2^32
  double time_s = 0;          ///< when the tick began
  double angle_rad = 0;       ///< of the encoder
  double velocity_rad_s = 0;  ///< after its low-pass
  double torque_nm = 0;       ///< what the scene asks for, limited and ramped
  double tau_hat_nm = 0;      ///< what the observer sees
  double current_a = 0;       ///< asked of the motor
  double voltage_v = 0;       ///< asked of the bridge
  double duty = 0;            ///< the voltage as a share of the supply, -1 to 1
  int scene = 0;              ///< number, docs/registers.md
  bool armed = false;
  unsigned limits = 0;  ///< bits: limit::torque, limit::ramp, ...
  unsigned faults = 0;  ///< bit n: cause n of the supervisor (Fault)

  /// "torque, ramp", or nothing where no limit holds.
  std::string limit_names() const { return names(limit::names, limits); }
  /// "speed, stop", or nothing without a fault.
  std::string fault_names() const { return names(feltgate::fault_names, faults); }

 private:
  template <class Names>
  static std::string names(const Names& of_bits, unsigned bits) {
    std::string list;
    for (std::size_t n = 0; n < of_bits.size(); ++n) {
      if (((bits >> n) & 1u) != 0) list += (list.empty() ? "" : ", ") + std::string(of_bits[n]);
    }
    return list;
  }
};

/// The outputs of a tick in SI units, for the design that they come from.
inline Reading reading_of(const DesignInfo& d, const CoreOut& o) {
  const auto scaled = [](std::int64_t raw, Format f) {
    return std::ldexp(static_cast<double>(raw), -f.fraction);
  };
  Reading r;
  r.tick = o.tick_count;
  r.time_s = o.tick_count / static_cast<double>(d.tick_hz);
  r.angle_rad = o.position * d.count_rad;
  r.velocity_rad_s = scaled(o.velocity, d.velocity);
  r.torque_nm = scaled(o.tau_ref, d.torque);
  r.tau_hat_nm = scaled(o.tau_hat, d.torque);
  r.current_a = scaled(o.current_ref, d.current);
  r.voltage_v = scaled(o.voltage, d.voltage);
  r.duty = o.duty / static_cast<double>(d.pwm_period);
  r.scene = o.scene;
  r.armed = o.armed;
  r.limits = o.limits;
  r.faults = o.faults;
  return r;
}

}  // namespace feltgate
