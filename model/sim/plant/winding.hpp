// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Current of the winding: exact solution of L*di/dt = u - R*i over a step with constant driving
// voltage; it can stay at 0, where dead voltage or diodes block it. docs/plant.md
#pragma once

#include <cmath>

namespace feltgate::plant {

/// Current at the end of a step and its mean over the step, A.
struct CurrentStep {
  double end_a;
  double mean_a;
};

/// The current of one winding, step by step.
class Winding {
 public:
  Winding(double resistance_ohm, double inductance_h)
      : per_ohm_(1.0 / resistance_ohm), tau_s_(inductance_h / resistance_ohm) {}

  /// Sets the length of the following steps, s.
  void set_step(double dt_s) {
    dt_s_ = dt_s;
    decay_ = std::exp(-dt_s / tau_s_);
    mean_weight_ = -std::expm1(-dt_s / tau_s_) * tau_s_ / dt_s;
  }

  /// `positive_v` drives the current while it is positive (terminal voltage - back-EMF - dead
  /// voltage), `negative_v` while it is negative; positive_v <= negative_v. At 0 the current stays
  /// 0 while positive_v <= 0 <= negative_v.
  CurrentStep advance(double current_a, double positive_v, double negative_v) const {
    if (current_a > 0.0 || (current_a == 0.0 && positive_v > 0.0)) {
      return from_positive(current_a, positive_v, negative_v);
    }
    if (current_a < 0.0 || negative_v < 0.0) {
      const CurrentStep mirror = from_positive(-current_a, -negative_v, -positive_v);
      return {-mirror.end_a, -mirror.mean_a};
    }
    return {0.0, 0.0};
  }

  /// The current without inductance, where it follows the voltage at once.
  double settled_a(double positive_v, double negative_v) const {
    if (positive_v > 0.0) return positive_v * per_ohm_;
    return negative_v < 0.0 ? negative_v * per_ohm_ : 0.0;
  }

 private:
  CurrentStep from_positive(double current_a, double positive_v, double negative_v) const {
    const double final_a = positive_v * per_ohm_;
    const double end_a = final_a + (current_a - final_a) * decay_;
    if (end_a >= 0.0) return {end_a, final_a + (current_a - final_a) * mean_weight_};
    return through_zero(current_a, final_a, negative_v);
  }

  // From a positive current to 0 at time t, then on to negative values if a voltage drives it.
  CurrentStep through_zero(double current_a, double final_a, double negative_v) const {
    const double t = tau_s_ * std::log((current_a - final_a) / -final_a);
    double charge = final_a * t + current_a * tau_s_;
    double end_a = 0.0;
    if (negative_v < 0.0) {
      const double settled = negative_v * per_ohm_;
      const double rest = dt_s_ - t;
      end_a = -settled * std::expm1(-rest / tau_s_);
      charge += settled * rest - end_a * tau_s_;
    }
    return {end_a, charge / dt_s_};
  }

  double per_ohm_;
  double tau_s_;
  double dt_s_ = 0.0;
  double decay_ = 0.0;
  double mean_weight_ = 0.0;
};

}  // namespace feltgate::plant
