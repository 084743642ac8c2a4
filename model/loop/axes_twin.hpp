// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The bit-exact twin of several axes as the device of a plant's loop, in the scene of programs; the
// program is given from outside and stands where an engine does. Documentation: docs/pantograph.md
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "../plant/sampled_law.hpp"
#include "feltgate/design_info.hpp"
#include "feltgate/feltgate_axes.hpp"

namespace feltgate {

/// Cores of design D, one for each joint of the plant. Every clock goes through FeltgateAxes; the
/// bridges are averaged: what a core changes acts with the next step of the plant, at most
/// most_clocks later, as a lever's does.
template <class D, class Plant>
class AxesTwin : public plant::AxesDevice<Plant> {
 public:
  static constexpr std::size_t axes = Plant::axes;
  using Twin = FeltgateAxes<D, static_cast<int>(axes), false>;

  /// `program` is run with every tick, with the angles and speeds that the cores have of it; its
  /// torques are rounded to their format and rendered with the next tick. The cores' counts begin
  /// at 0: what they are then of the joints is `home_rad`, as after homing.
  AxesTwin(plant::AxesLaw<axes> program, std::array<double, axes> home_rad)
      : program_(std::move(program)), home_rad_(home_rad), info_(design_info<D>()) {
    for (auto& axis : in_.axis) axis.scene = static_cast<std::uint8_t>(info_.scene_number("law"));
  }

  plant::AxesCommand<axes> act(const plant::AxesSense<Plant>& sense) override {
    if (at_ == 0) {
      for (std::size_t n = 0; n < axes; ++n) in_.axis[n].encoder = first_pins(sense, n);
    }
    std::array<std::size_t, axes> next{};
    for (; at_ < sense.now; ++at_) {
      for (std::size_t n = 0; n < axes; ++n) {
        const auto& events = sense.events[n];
        while (next[n] < events.size() && events[next[n]].clock <= at_) {
          in_.axis[n].encoder = events[next[n]++].pins;
        }
      }
      clock();
    }
    // An edge at the end of the stretch belongs to the clock to come.
    for (std::size_t n = 0; n < axes; ++n) {
      if (!sense.events[n].empty()) in_.axis[n].encoder = sense.events[n].back().pins;
    }
    plant::AxesCommand<axes> command;
    for (std::size_t n = 0; n < axes; ++n) {
      const CoreOut& out = twin_.out().axis[n];
      command.bridges[n] = plant::Bridge::averaged(
          out.duty_active / static_cast<double>(D::pwm_period), out.gates_enable);
    }
    return command;
  }
  Clock next(Clock now) const override {
    return now + most_clocks - (now + most_clocks - phase_) % most_clocks;
  }

  const Twin& twin() const { return twin_; }
  const CoreOut& out(std::size_t axis) const { return twin_.out().axis[axis]; }
  std::uint64_t runs() const { return runs_; }
  /// Asks for torque, as it does from the beginning, or no longer.
  void request(bool arm) { wanted_ = arm; }
  void stop(bool pressed) { in_.stop = pressed; }

  static constexpr Clock most_clocks = 250;
  static_assert(D::pwm_period % most_clocks == 0, "steps end with the period of the PWM");

 private:
  // Events before the first are those of the first step of the plant: the count before them.
  static EncoderPins first_pins(const plant::AxesSense<Plant>& sense, std::size_t n) {
    return sense.plant.encoder(n).pins();
  }

  void clock() {
    // The request must have been low in a tick before it is seen to rise.
    in_.arm = wanted_ && at_ >= 4 * D::clocks_per_tick;
    const bool measured = twin_.measured();
    const auto duty_before = twin_.out().axis[0].duty_active;
    twin_.clock(in_);
    if (twin_.out().axis[0].duty_active != duty_before) phase_ = (at_ + 1) % most_clocks;
    if (!measured) return;
    plant::AxesMotion<axes> motion;
    for (std::size_t n = 0; n < axes; ++n) {
      const CoreOut& out = twin_.out().axis[n];
      motion.theta_rad[n] = home_rad_[n] + out.position * info_.count_rad;
      motion.omega_rad_s[n] =
          std::ldexp(static_cast<double>(out.velocity), -info_.velocity.fraction);
    }
    const auto torque = program_(motion);
    for (std::size_t n = 0; n < axes; ++n) in_.axis[n].law_torque = rounded(torque[n]);
    ++runs_;
  }

  // Half up and saturated, as an engine's output.
  std::int32_t rounded(double nm) const {
    const double words = std::ldexp(1.0, info_.torque.width() - 1);
    const double raw = std::floor(std::ldexp(nm, info_.torque.fraction) + 0.5);
    return static_cast<std::int32_t>(std::clamp(raw, -words, words - 1.0));
  }

  plant::AxesLaw<axes> program_;
  std::array<double, axes> home_rad_;
  DesignInfo info_;
  Twin twin_;
  typename Twin::In in_;
  Clock at_ = 0;
  Clock phase_ = 0;  ///< of the period of the PWM, within a step
  bool wanted_ = true;
  std::uint64_t runs_ = 0;
};

}  // namespace feltgate
