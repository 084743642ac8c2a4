// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A force law in floating point, sampled and late, as the device of a loop. docs/pantograph.md
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <utility>

#include "two_axis_loop.hpp"

namespace feltgate::plant {

/// What a law is given: angles and speeds of both cranks.
struct AxesMotion {
  Joints theta_rad = {}, omega_rad_s = {};
};
/// Torques at the cranks, Nm.
using AxesLaw = std::function<Joints(const AxesMotion&)>;

struct Sampling {
  double rate_hz = 10e3;
  double delay_s = 0.0;  ///< from the sample to the torque
  /// On: angles are the counts' middles, speeds their differences behind a low-pass. Off: exact.
  bool encoder = true;
  double velocity_hz = 80.0;  ///< corner of that low-pass
  /// On: V = R*I + Ke*w + Vd*sgn(I) on an averaged bridge. Off: ideal torques.
  bool voltage = false;
  double limit_nm = 1e9;  ///< of each torque
};

class SampledLaw : public AxesDevice {
 public:
  SampledLaw(AxesLaw law, const Sampling& sampling) : law_(std::move(law)), s_(sampling) {}

  AxesCommand act(const AxesSense& sense) override {
    if (sense.now >= clock_of(sample_, sense.plant)) {
      const AxesMotion motion = motion_of(sense.plant);
      Joints torque = law_(motion);
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
  Clock clock_of(Clock sample, const Pantograph& plant) const {
    return std::llround(static_cast<double>(sample) * plant.clock_hz() / s_.rate_hz);
  }

  AxesMotion motion_of(const Pantograph& plant) {
    AxesMotion m{plant.seen().theta_rad, plant.seen().omega_rad_s};
    if (!s_.encoder) return m;
    const JointParameters& joint = plant.parameters().joint;
    const double keep = std::exp(-6.283185307179586476925286766559 * s_.velocity_hz / s_.rate_hz);
    for (std::size_t i = 0; i < 2; ++i) {
      const Encoder& encoder = plant.encoder(i);
      const double per = joint.encoder_on_motor ? 1.0 / joint.ratio() : 1.0;
      m.theta_rad[i] = per * (static_cast<double>(encoder.count()) + 0.5) * encoder.count_rad();
      const double raw = sample_ == 0 ? 0.0 : (m.theta_rad[i] - last_rad_[i]) * s_.rate_hz;
      speed_rad_s_[i] = keep * speed_rad_s_[i] + (1.0 - keep) * raw;
      m.omega_rad_s[i] = speed_rad_s_[i];
    }
    last_rad_ = m.theta_rad;
    return m;
  }

  AxesCommand command(const Joints& torque, const AxesMotion& motion,
                      const PantographParameters& p) const {
    AxesCommand c;
    c.ideal = !s_.voltage;
    c.torque_nm = torque;
    if (c.ideal) return c;
    const double ratio = p.joint.ratio();
    for (std::size_t i = 0; i < 2; ++i) {
      const double amps = torque[i] / (ratio * p.motor.torque_constant_nm_a);
      const double dead_v = amps == 0.0 ? 0.0 : std::copysign(p.motor.dead_voltage_v, amps);
      const double volts = p.motor.resistance_ohm * amps + dead_v +
                           p.motor.back_emf_constant_v_s_rad * ratio * motion.omega_rad_s[i];
      c.bridges[i] = Bridge::averaged(volts / p.supply.voltage_v);
    }
    return c;
  }

  AxesLaw law_;
  Sampling s_;
  Clock sample_ = 0, next_ = 0;
  std::deque<std::pair<Clock, AxesCommand>> late_;
  AxesCommand command_{true, {}, {}};
  Joints last_rad_ = {}, speed_rad_s_ = {};
};

/// A wall over y < edge_m and a drag everywhere, felt at the pen: F = k*(edge - y) - b*v.
struct WallAndDrag {
  double edge_m = 0.1, stiffness_n_m = 0.0, wall_damping_ns_m = 0.0, drag_ns_m = 0.0;

  /// Force on the pen, N. The wall never pulls.
  Vec2 force_n(Vec2 pen, Vec2 speed) const {
    Vec2 f = -drag_ns_m * speed;
    if (pen.y < edge_m) {
      f.y += std::max(0.0, stiffness_n_m * (edge_m - pen.y) - wall_damping_ns_m * speed.y);
    }
    return f;
  }
  /// The same as a law of the cranks, by this linkage's own kinematics.
  AxesLaw law(const Linkage& linkage) const {
    return [wall = *this, linkage](const AxesMotion& m) {
      const LinkagePose p = linkage.pose(m.theta_rad);
      return p.torque(wall.force_n(p.pen, p.pen_speed(m.omega_rad_s)));
    };
  }
};

}  // namespace feltgate::plant
