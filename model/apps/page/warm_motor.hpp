// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The page's host limits the torque, so that the motor does not heat until the supervisor's fault
// `i2t`. Documentation: docs/page.md
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "feltgate/design_info.hpp"

namespace feltgate::page {

/// Sums the heat of the current as the supervisor does, from the words of each snapshot. While the
/// motor is warm, it lowers the torque limit from the design's to a torque that does not heat it
/// further.
class WarmMotor {
 public:
  /// `torque_constant_nm_a` is the plant's. At power-up the motor counts as half warm.
  WarmMotor(const DesignInfo& design, double torque_constant_nm_a)
      : torque_constant_nm_a_(std::min(torque_constant_nm_a, design.torque_constant_nm_a)),
        voltage_step_v_(std::ldexp(1.0, -design.voltage.fraction)),
        velocity_step_rad_s_(std::ldexp(1.0, -design.velocity.fraction)) {
    for (const char* name : {nominal, budget, limit, per_volt, per_speed}) {
      note(name, design.find(name)->si);
    }
    heat_a2_ = budget_a2_ / 2;
  }

  /// Notes a parameter that the caller writes, in its unit.
  void note(const std::string& parameter, double value) {
    if (parameter == nominal) nominal_a2_ = value;
    if (parameter == budget) budget_a2_ = value;
    if (parameter == limit) most_nm_ = value;
    if (parameter == per_volt) a_per_v_ = value * voltage_step_v_;
    if (parameter == per_speed) a_s_per_rad_ = value * velocity_step_rad_s_;
  }
  /// Counts a tick with these words of the snapshot.
  void pass(std::int64_t voltage, std::int64_t velocity) {
    const double current_a =
        static_cast<double>(voltage) * a_per_v_ - static_cast<double>(velocity) * a_s_per_rad_;
    heat_a2_ = std::max(0.0, heat_a2_ + current_a * current_a - nominal_a2_);
  }
  /// A torque that does not heat the motor further, Nm: 55 % of the torque at the nominal current,
  /// because the supervisor counts the drop of brushes and dead time, up to 1 V, as current too.
  double cool_nm() const { return 0.55 * std::sqrt(nominal_a2_) * torque_constant_nm_a_; }
  /// The present torque limit: the design's up to 70 % of the heat budget, cool_nm() from 90 %.
  double limit_nm() const {
    const double least = std::min(most_nm_, cool_nm());
    const double left = std::clamp((0.9 - heat_a2_ / budget_a2_) / 0.2, 0.0, 1.0);
    return least + left * (most_nm_ - least);
  }

  static constexpr const char* limit = "torque_limit";

 private:
  static constexpr const char* nominal = "nominal_current_squared";
  static constexpr const char* budget = "i2t_budget";
  static constexpr const char* per_volt = "inverse_resistance";
  static constexpr const char* per_speed = "emf_over_resistance";

  double torque_constant_nm_a_, voltage_step_v_, velocity_step_rad_s_;
  double nominal_a2_ = 0, budget_a2_ = 0, most_nm_ = 0, a_per_v_ = 0, a_s_per_rad_ = 0;
  double heat_a2_ = 0;  ///< summed over the ticks
};

}  // namespace feltgate::page
