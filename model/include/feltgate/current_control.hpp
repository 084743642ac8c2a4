// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/options/current_control.sv: the PI law of the motor current, whose integrator
// follows the applied voltage as the winding's resistance does; and its gains from a winding.
// Documentation: docs/blocks/current.md
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace feltgate {

constexpr int kCurrentControlBits = 17;       ///< fraction bits of voltage, current, integral gain
constexpr int kCurrentProportionalBits = 13;  ///< fraction bits of the proportional gain

/// Words of the two gains.
struct CurrentGains {
  std::int32_t proportional = 0;  ///< [0,4,13], parts of the supply per part of full-scale current
  std::int32_t integral = 0;  ///< [0,0,17], part of the way that the integrator goes in a sample
  bool in_range = false;      ///< both words hold what was asked, neither is 0
};

/// The gains that cancel the winding's pole, so that the open loop is 2 pi bandwidth / s. All
/// arguments are above 0. `sample_s`: from result to result. `full_scale_a`: current of 1.0.
inline CurrentGains current_gains(double resistance_ohm, double inductance_h, double bandwidth_hz,
                                  double sample_s, double full_scale_a, double supply_v) {
  constexpr double pi = 3.14159265358979323846;
  const double part = -std::expm1(-resistance_ohm * sample_s / inductance_h);
  const double ohm = 2 * pi * bandwidth_hz * sample_s * resistance_ohm / part;
  const double proportional =
      std::round(std::ldexp(ohm * full_scale_a / supply_v, kCurrentProportionalBits));
  const double integral = std::round(std::ldexp(part, kCurrentControlBits));
  constexpr double most = (1 << 17) - 1;  // both words have 17 bits
  return {static_cast<std::int32_t>(std::min(proportional, most)),
          static_cast<std::int32_t>(std::min(integral, most)),
          proportional >= 1 && proportional <= most && integral >= 1 && integral <= most};
}

/// Bit-exact and clock-exact with the RTL.
class CurrentControl {
 public:
  /// LSB of the supply's voltage.
  static constexpr std::int64_t kSupply = 1 << kCurrentControlBits;
  static constexpr int kLatencyClocks = 20;  ///< from valid to the voltage
  static constexpr int kBusyClocks = 39;     ///< fewest from a taken valid to the next one
  struct In {
    bool armed = false;             ///< false: voltage and integrator are 0
    bool valid = false;             ///< one clock: current is new, take all but the last two
    std::int32_t reference = 0;     ///< [1,1,17] of full scale
    std::int32_t current = 0;       ///< [1,1,17] of full scale, as CurrentSense has it
    std::int32_t emf = 0;           ///< [1,0,17] of the supply: back-EMF, fed forward
    std::int32_t proportional = 0;  ///< [0,4,13]
    std::int32_t integral = 0;      ///< [0,0,17], taken with the result
    std::int32_t limit = 0;         ///< [0,0,17] of the supply: greatest |voltage|, taken before it
  };
  struct Out {
    std::int32_t voltage = 0;    ///< [1,0,17] of the supply: the duty; held between results
    std::int32_t resistive = 0;  ///< [1,1,17] of the supply: whole part of the integrator
  };

  void reset() { *this = CurrentControl(); }

  void clock(const In& in) {
    if (!in.armed) {
      reset();
      return;
    }
    if (step_ == 0 && !in.valid) return;
    switch (step_) {
      case 0:
        base_ = std::int64_t{out_.resistive} + in.emf;
        wanted_ = base_ + ((std::int64_t{in.proportional} * (in.reference - in.current) + kHalf) >>
                           kCurrentProportionalBits);
        break;
      case kLatencyClocks - 1: {
        const std::int64_t limit = in.limit;
        out_.voltage = static_cast<std::int32_t>(std::clamp(wanted_, -limit, limit));
        break;
      }
      case kLatencyClocks:
        added_ = (out_.voltage - base_) * in.integral;
        break;
      case kBusyClocks - 1:
        integrator_ += added_;
        out_.resistive = static_cast<std::int32_t>(integrator_ >> kCurrentControlBits);
        break;
      default:
        break;
    }
    step_ = step_ == kBusyClocks - 1 ? 0 : step_ + 1;
  }

  const Out& out() const { return out_; }

 private:
  static constexpr std::int64_t kHalf = std::int64_t{1} << (kCurrentProportionalBits - 1);
  Out out_;
  int step_ = 0;                             // clocks since a current was taken, 0: none
  std::int64_t base_ = 0, wanted_ = 0;       // LSB of the voltage
  std::int64_t added_ = 0, integrator_ = 0;  // LSB of the integrator
};

}  // namespace feltgate
