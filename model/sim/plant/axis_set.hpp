// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Motors, encoders and supply of a device with several axes, step by step.
// docs/devices/pantograph.md
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "brushed_motor.hpp"
#include "encoder.hpp"
#include "mechanics.hpp"
#include "parameters.hpp"

namespace feltgate::plant {

/// The drives and encoders of N joints on one supply.
template <std::size_t N>
class AxisSet {
 public:
  using Axes = std::array<double, N>;
  using Bridges = std::array<Bridge, N>;
  /// Mean torques over one step, at the joints, Nm.
  struct Torques {
    Axes motor = {};
    Axes dry = {};  ///< friction of the bristles; opposes positive speed
  };

  /// Errors: std::invalid_argument for an impossible drive or start.
  AxisSet(const AxesParameters& p, const Effects& on, const Drive& drive, const Axes& start_rad)
      : AxisSet(p, on, drive, start_rad, std::make_index_sequence<N>{}) {}

  /// Starts a step of dt_s.
  void begin(double dt_s) {
    if (dt_s != dt_s_) {
      dt_s_ = dt_s;
      for (BrushedMotor& motor : motors_) motor.set_step(dt_s);
      if (lugre_on_) {
        for (Lugre& lugre : lugres_) lugre.set_step(dt_s);
      }
    }
    for (auto& events : events_) events.clear();
  }
  /// Torques with these bridges; the speeds are those of the joints in the middle of the step.
  Torques drive(const Bridges& bridges, const Axes& middle_rad_s) {
    Torques t;
    double drawn_a = 0.0;
    for (std::size_t i = 0; i < N; ++i) {
      const double rad_s = ratio_ * middle_rad_s[i];
      const MotorStep s = motors_[i].advance(bridges[i], supply_.bus_v(), rad_s);
      t.motor[i] = ratio_ * s.torque_nm;
      t.dry[i] = ratio_ * friction_nm(i, rad_s);
      drawn_a += s.bridge_a;
    }
    supply_a_ = limited_ ? supply_.advance(drawn_a, dt_s_) : drawn_a;
    return t;
  }
  /// The same for ideal motors with these torques at the joints.
  Torques drive(const Axes& torque_nm, const Axes& middle_rad_s) {
    Torques t{torque_nm, {}};
    for (std::size_t i = 0; i < N; ++i) {
      t.dry[i] = ratio_ * friction_nm(i, ratio_ * middle_rad_s[i]);
    }
    return t;
  }
  /// Ends the step: the joints turned from `from` to `to` in the `clocks` after `now`. Returns
  /// false if a joint turned by more than one encoder state in a clock, which pins cannot show.
  bool turn(const Axes& from, const Axes& to, Clock now, Clock clocks) {
    for (std::size_t i = 0; i < N; ++i) {
      const double most = encoders_[i].count_rad() * static_cast<double>(clocks);
      if (!(std::abs(encoder_ratio_ * (to[i] - from[i])) <= most)) return false;
    }
    for (std::size_t i = 0; i < N; ++i) {
      encoders_[i].advance(encoder_ratio_ * to[i], now, clocks, events_[i]);
    }
    return true;
  }

  const std::vector<EncoderEvent>& events(std::size_t axis) const { return events_[axis]; }
  const Encoder& encoder(std::size_t axis) const { return encoders_[axis]; }
  Axes current_a() const {
    Axes a;
    for (std::size_t i = 0; i < N; ++i) a[i] = motors_[i].current_a();
    return a;
  }
  double bus_v() const { return supply_.bus_v(); }
  double supply_a() const { return supply_a_; }

 private:
  template <std::size_t... I>
  AxisSet(const AxesParameters& p, const Effects& on, const Drive& drive, const Axes& start_rad,
          std::index_sequence<I...> /*all*/)
      : ratio_(p.joint.ratio()),
        encoder_ratio_(p.joint.encoder_ratio()),
        limited_(on.supply_limit),
        lugre_on_(on.lugre),
        motors_{((void)I, BrushedMotor(p.motor, p.supply, drive, on))...},
        lugres_{((void)I, Lugre(p.lugre))...},
        supply_(p.supply),
        encoders_{Encoder(seeded(p.encoder, I), on.encoder_imperfect,
                          p.joint.encoder_ratio() * start_rad[I])...} {
    for (auto& events : events_) events.reserve(16);
  }
  /// Mean torque of the bristles at a motor's shaft over one step, Nm; excludes sigma2*omega.
  double friction_nm(std::size_t axis, double motor_rad_s) {
    return lugre_on_ ? lugres_[axis].advance(motor_rad_s) : 0.0;
  }
  static EncoderParameters seeded(EncoderParameters e, std::size_t axis) {
    e.seed += axis;
    return e;
  }

  double ratio_;          ///< turns of the motor per turn of the joint
  double encoder_ratio_;  ///< turns of the encoder per turn of the joint
  bool limited_;
  bool lugre_on_;
  std::array<BrushedMotor, N> motors_;
  std::array<Lugre, N> lugres_;
  Supply supply_;
  std::array<Encoder, N> encoders_;
  double dt_s_ = 0.0;
  double supply_a_ = 0.0;  ///< mean of the last step
  std::array<std::vector<EncoderEvent>, N> events_;
};

}  // namespace feltgate::plant
