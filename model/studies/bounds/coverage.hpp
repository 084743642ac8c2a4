// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Determines the ticks of a run in which the error bounds hold: nothing saturates, no ramp
// separates core and reference, and the effect of earlier such events has decayed. Documentation:
// docs/error-bounds.md
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "studies/bounds/error_bounds.hpp"

namespace feltgate::bounds {

/// The state of a tick with respect to the theorem's assumptions.
struct TickState {
  bool velocity_saturated = false, tau_hat_saturated = false;
  bool ramping = false;         ///< in core or reference
  double tau_ref_error_nm = 0;  ///< core minus reference
};

/// Follows a run tick by tick.
class Coverage {
 public:
  Coverage() = default;
  Coverage(const ErrorBounds& b, const ChainNumbers& c)
      : tau_ref_bound_nm_(b.tau_ref_nm.against_reference),
        velocity_memory_(memory(c.at("velocity_a1").used())),
        torque_memory_(memory(
            c.at("observer_a1").used() *
            (1.0 - std::abs(c.at("torque_constant").used() * c.at("observer_gain").used())))) {}

  void tick(const TickState& t) {
    ++ticks_;
    const bool apart = std::abs(t.tau_ref_error_nm) > tau_ref_bound_nm_;
    // The scene jumped while only one of core and reference still ramps.
    parted_ = apart && (t.ramping || parted_);
    if (velocity_left_ > 0) --velocity_left_;
    if (torque_left_ > 0) --torque_left_;
    if (t.velocity_saturated) {
      velocity_left_ = velocity_memory_;
      torque_left_ = velocity_memory_ + torque_memory_;
    }
    if (t.tau_hat_saturated || parted_) torque_left_ = std::max(torque_left_, torque_memory_);
    outside_ += torque_left_ > 0 ? 1 : 0;
  }

  /// Whether the velocity's bound holds in this tick; then whether those of torques and current do.
  bool velocity() const { return velocity_left_ == 0; }
  bool torque() const { return torque_left_ == 0; }
  std::int64_t ticks() const { return ticks_; }
  std::int64_t outside() const { return outside_; }  ///< ticks without the torques' bounds

 private:
  /// Number of ticks in which an error of a one-pole state decays to 2^-40.
  static std::int64_t memory(double rate) {
    constexpr double never = 1e15;
    const double ticks = rate > 0 ? std::ceil(40.0 * std::log(2.0) / rate) : never;
    return static_cast<std::int64_t>(std::min(ticks, never));
  }

  double tau_ref_bound_nm_ = 0;
  std::int64_t velocity_memory_ = 0, torque_memory_ = 0;
  std::int64_t velocity_left_ = 0, torque_left_ = 0, ticks_ = 0, outside_ = 0;
  bool parted_ = false;
};

}  // namespace feltgate::bounds
