// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The outputs of the core in one tick, in SI units. Documentation: docs/library.md
#pragma once

#include <cstdint>
#include <cstring>
#include <string>

#include "feltgate/core_ports.hpp"
#include "feltgate/design_info.hpp"
#include "feltgate/generated/causes.hpp"

namespace feltgate {

/// The outputs of the core when its snapshot was valid. Each number is its integer times a power of
/// two, which is exact; only angle and duty are rounded to binary64.
struct Reading {
  std::uint32_t tick = 0;     ///< since reset, wraps at 2^32
  double time_s = 0;          ///< start of the tick
  double angle_rad = 0;       ///< from the encoder
  double velocity_rad_s = 0;  ///< after the low-pass
  double torque_nm = 0;       ///< the scene's torque, limited and ramped
  double tau_hat_nm = 0;      ///< the observer's estimate of the load
  double current_a = 0;       ///< reference for the motor
  double voltage_v = 0;       ///< reference for the bridge
  double duty = 0;            ///< voltage / supply, -1 to 1
  int scene = 0;              ///< scene number, docs/registers.md
  bool armed = false;
  unsigned limits = 0;  ///< bits: limit::torque, limit::ramp, ...
  unsigned faults = 0;  ///< bit n: cause n of safety (Fault)

  /// Names as in "torque, ramp"; empty where no limit acts.
  std::string limit_names() const { return names(limit::names, limits); }
  /// Names as in "speed, stop"; empty without a fault.
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

/// Sets `r` to the outputs of a tick in SI units; `d` must be the design that they come from.
inline void read(const DesignInfo& d, const CoreOut& o, Reading& r) {
  // raw * 2^-fraction, exact; std::ldexp takes fifty instructions.
  const auto scaled = [](std::int64_t raw, Format f) {
    const std::uint64_t power = static_cast<std::uint64_t>(1023 - f.fraction) << 52;
    double step;
    std::memcpy(&step, &power, sizeof step);
    return static_cast<double>(raw) * step;
  };
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
}
inline Reading reading_of(const DesignInfo& d, const CoreOut& o) {
  Reading r;
  read(d, o, r);
  return r;
}

}  // namespace feltgate
