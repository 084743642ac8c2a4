// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The bit-exact twin of several axes as the device of a plant's loop, in the scene of programs. The
// program is a function from outside, which replaces the engine. Documentation:
// docs/devices/pantograph.md
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>

#include "feltgate/design_info.hpp"
#include "feltgate/feltgate_axes.hpp"
#include "sampled_law.hpp"

namespace feltgate {

/// The measurements of a tick, as the cores give them to an engine.
template <std::size_t N>
struct AxesWords {
  std::array<std::int32_t, N> position = {};  ///< counts; 0 in the pose in which the angles are 0
  std::array<std::int64_t, N> velocity = {};  ///< raw, in the design's format
  std::array<std::int32_t, N> tau_hat = {};
  std::uint32_t tick = 0;
};
/// A program: torques in the design's format, raw. It runs once per tick; its torque acts in the
/// next.
template <std::size_t N>
using AxesProgram = std::function<std::array<std::int32_t, N>(const AxesWords<N>&)>;

/// Makes a program of a law in real numbers; torques are rounded to nearest, ties up, and
/// saturated.
template <std::size_t N>
AxesProgram<N> program_of(plant::AxesLaw<N> law, const DesignInfo& design) {
  return [law = std::move(law), count_rad = design.count_rad, velocity = design.velocity,
          torque = design.torque](const AxesWords<N>& words) {
    plant::AxesMotion<N> motion;
    for (std::size_t n = 0; n < N; ++n) {
      motion.theta_rad[n] = words.position[n] * count_rad;
      motion.omega_rad_s[n] =
          std::ldexp(static_cast<double>(words.velocity[n]), -velocity.fraction);
    }
    const auto asked_nm = law(motion);
    const double most = std::ldexp(1.0, torque.width() - 1);
    std::array<std::int32_t, N> raw{};
    for (std::size_t n = 0; n < N; ++n) {
      const double rounded = std::floor(std::ldexp(asked_nm[n], torque.fraction) + 0.5);
      raw[n] = static_cast<std::int32_t>(std::clamp(rounded, -most, most - 1.0));
    }
    return raw;
  };
}

/// Cores of design D, one for each joint of the plant. Every clock goes through FeltgateAxes. The
/// bridges are averaged: a change of a core's output acts with the next step of the plant, at most
/// most_clocks later, as for the lever.
template <class D, class Plant>
class AxesTwin : public plant::AxesDevice<Plant> {
 public:
  static constexpr std::size_t axes = Plant::axes;
  using Twin = FeltgateAxes<D, static_cast<int>(axes), false>;

  /// The cores' counts begin at 0; `home` is the joints' counts at that moment, as after homing.
  /// `ticks`: delay of the program from input to torque. For twice this time after arming the
  /// torque may jump, and the cores ramp, as they do with an engine.
  AxesTwin(AxesProgram<axes> program, std::array<std::int64_t, axes> home, int ticks = 1)
      : program_(std::move(program)), home_(home), ticks_(ticks), info_(design_info<D>()) {
    for (auto& axis : in_.axis) axis.scene = static_cast<std::uint8_t>(info_.scene_number("law"));
  }

  plant::AxesCommand<axes> act(const plant::AxesSense<Plant>& sense) override {
    if (!began_) {  // The second call has at_ 0 too, and pins of its end.
      began_ = true;
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
    // An edge at the end of the stretch belongs to the next clock.
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
  /// Requests torque, or withdraws the request; it is set from the start.
  void request(bool arm) { wanted_ = arm; }
  void stop(bool pressed) { in_.stop = pressed; }

  static constexpr Clock most_clocks = 250;
  static_assert(D::pwm_period % most_clocks == 0, "steps end with the period of the PWM");

 private:
  // The encoder's present pins, which stand until the first event.
  static EncoderPins first_pins(const plant::AxesSense<Plant>& sense, std::size_t n) {
    return sense.plant.encoder(n).pins();
  }

  void clock() {
    // A rising request counts only after it was low in a tick.
    in_.arm = wanted_ && at_ >= 4 * D::clocks_per_tick;
    in_.law_restart = since_arming_ <= 2 * ticks_;
    const bool measured = twin_.measured();
    const auto duty_before = twin_.out().axis[0].duty_active;
    twin_.clock(in_);
    if (twin_.out().axis[0].duty_active != duty_before) phase_ = (at_ + 1) % most_clocks;
    if (!measured) return;
    AxesWords<axes> words;
    words.tick = twin_.out().axis[0].tick_count;
    for (std::size_t n = 0; n < axes; ++n) {
      const CoreOut& out = twin_.out().axis[n];
      words.position[n] = static_cast<std::int32_t>(home_[n] + out.position);
      words.velocity[n] = out.velocity;
      words.tau_hat[n] = out.tau_hat;
    }
    const auto torque = program_(words);
    for (std::size_t n = 0; n < axes; ++n) in_.axis[n].law_torque = torque[n];
    ++runs_;
    since_arming_ = twin_.out().axis[0].armed ? std::min(since_arming_ + 1, 2 * ticks_ + 1) : 0;
  }

  AxesProgram<axes> program_;
  std::array<std::int64_t, axes> home_;
  int ticks_;
  int since_arming_ = 0;  ///< ticks
  DesignInfo info_;
  Twin twin_;
  typename Twin::In in_;
  bool began_ = false;  ///< act() was called
  Clock at_ = 0;
  Clock phase_ = 0;  ///< start of the PWM period, within a plant step
  bool wanted_ = true;
  std::uint64_t runs_ = 0;
};

}  // namespace feltgate
