// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A force law in floating point, sampled and delayed, as a loop's device.
// docs/devices/pantograph.md
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <utility>

#include "sim/plant/axes_loop.hpp"
#include "sim/plant/parameters.hpp"

namespace feltgate::plant {

/// Inputs of a law: angles and speeds of all joints.
template <std::size_t N>
struct AxesMotion {
  std::array<double, N> theta_rad = {}, omega_rad_s = {};
};
/// Torques at the joints, Nm.
template <std::size_t N>
using AxesLaw = std::function<std::array<double, N>(const AxesMotion<N>&)>;

/// Sampling, delay and drive of the law.
struct Sampling {
  double rate_hz = 10e3;
  double delay_s = 0.0;  ///< from the sample to the torque
  /// true: angles are the middles of counts, speeds their differences after a low-pass. false:
  /// exact values.
  bool encoder = true;
  double velocity_hz = 80.0;  ///< corner of that low-pass
  /// true: V = R*I + Ke*w + Vd*sgn(I) on an averaged bridge. false: ideal torques.
  bool voltage = false;
  double limit_nm = 1e9;  ///< limit of each torque
};

template <class Plant>
class SampledLaw : public AxesDevice<Plant> {
 public:
  static constexpr std::size_t axes = Plant::axes;
  using Axes = std::array<double, axes>;
  using Command = AxesCommand<axes>;

  SampledLaw(AxesLaw<axes> law, const Sampling& sampling)
      : law_(std::move(law)), s_(sampling), command_{true, {}, {}} {}

  Command act(const AxesSense<Plant>& sense) override {
    if (sense.now >= clock_of(sample_, sense.plant)) {
      const AxesMotion<axes> motion = motion_of(sense.plant);
      Axes torque = law_(motion);
      for (double& t : torque) t = std::clamp(t, -s_.limit_nm, s_.limit_nm);
      late_.push_back({sense.now + std::llround(s_.delay_s * sense.plant.clock_hz()),
                       command(torque, motion, sense.plant.parameters())});
      ++sample_;
    }
    while (!late_.empty() && late_.front().first <= sense.now) {
      command_ = late_.front().second;
      late_.pop_front();
    }
    next_ = clock_of(sample_, sense.plant);
    if (!late_.empty()) next_ = std::min(next_, late_.front().first);
    return command_;
  }
  Clock next(Clock) const override { return next_; }

 private:
  Clock clock_of(Clock sample, const Plant& plant) const {
    return std::llround(static_cast<double>(sample) * plant.clock_hz() / s_.rate_hz);
  }

  AxesMotion<axes> motion_of(const Plant& plant) {
    AxesMotion<axes> m{plant.seen().theta_rad, plant.seen().omega_rad_s};
    if (!s_.encoder) return m;
    const double per = 1.0 / plant.parameters().joint.encoder_ratio();
    const double keep = std::exp(-6.283185307179586476925286766559 * s_.velocity_hz / s_.rate_hz);
    for (std::size_t i = 0; i < axes; ++i) {
      const auto& encoder = plant.encoder(i);
      m.theta_rad[i] = per * (static_cast<double>(encoder.count()) + 0.5) * encoder.count_rad();
      const double raw = sample_ == 0 ? 0.0 : (m.theta_rad[i] - last_rad_[i]) * s_.rate_hz;
      speed_rad_s_[i] = keep * speed_rad_s_[i] + (1.0 - keep) * raw;
      m.omega_rad_s[i] = speed_rad_s_[i];
    }
    last_rad_ = m.theta_rad;
    return m;
  }

  Command command(const Axes& torque, const AxesMotion<axes>& motion,
                  const AxesParameters& p) const {
    Command c;
    c.ideal = !s_.voltage;
    c.torque_nm = torque;
    if (c.ideal) return c;
    const double ratio = p.joint.ratio();
    for (std::size_t i = 0; i < axes; ++i) {
      const double amps = torque[i] / (ratio * p.motor.torque_constant_nm_a);
      const double dead_v = amps == 0.0 ? 0.0 : std::copysign(p.motor.dead_voltage_v, amps);
      const double volts = p.motor.resistance_ohm * amps + dead_v +
                           p.motor.back_emf_constant_v_s_rad * ratio * motion.omega_rad_s[i];
      c.bridges[i] = Bridge::averaged(volts / p.supply.voltage_v);
    }
    return c;
  }

  AxesLaw<axes> law_;
  Sampling s_;
  Clock sample_ = 0, next_ = 0;
  std::deque<std::pair<Clock, Command>> late_;
  Command command_;
  Axes last_rad_ = {}, speed_rad_s_ = {};
};

}  // namespace feltgate::plant
