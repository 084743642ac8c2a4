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

/// Means over one step, at the motor's shaft.
struct AxisStep {
  double current_a = 0.0;
  double motor_nm = 0.0;     ///< Kt*i, before friction
  double friction_nm = 0.0;  ///< bristles; opposes positive speed, excludes sigma2*omega
  double bridge_a = 0.0;     ///< drawn from the bus
};

/// The drive of one motor, step by step.
class AxisDrive {
 public:
  /// Errors: std::invalid_argument for an impossible drive (see BridgeModel).
  AxisDrive(const MotorParameters& motor, const LugreParameters& lugre,
            const SupplyParameters& supply, const Drive& drive, const Effects& effects)
      : motor_(motor, supply, drive, effects), lugre_on_(effects.lugre), lugre_(lugre) {}

  /// Sets the length of the following steps, s.
  void set_step(double dt_s) {
    motor_.set_step(dt_s);
    if (lugre_on_) lugre_.set_step(dt_s);
  }

  /// One step with this bridge; bus voltage (V) and motor speed (rad/s) are held.
  AxisStep advance(const Bridge& bridge, double bus_v, double motor_rad_s) {
    const MotorStep s = motor_.advance(bridge, bus_v, motor_rad_s);
    return {s.current_a, s.torque_nm, friction_nm(motor_rad_s), s.bridge_a};
  }

  /// Mean torque of the bristles over one step, Nm, for a motor that something else drives.
  double friction_nm(double motor_rad_s) { return lugre_on_ ? lugre_.advance(motor_rad_s) : 0.0; }

  double current_a() const { return motor_.current_a(); }
  double bristle_rad() const { return lugre_.z_rad(); }

 private:
  BrushedMotor motor_;
  bool lugre_on_;
  Lugre lugre_;
};

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
      for (AxisDrive& drive : drives_) drive.set_step(dt_s);
    }
    for (auto& events : events_) events.clear();
  }
  /// Torques with these bridges; the speeds are those of the joints in the middle of the step.
  Torques drive(const Bridges& bridges, const Axes& middle_rad_s) {
    Torques t;
    double drawn_a = 0.0;
    for (std::size_t i = 0; i < N; ++i) {
      const AxisStep s = drives_[i].advance(bridges[i], supply_.bus_v(), ratio_ * middle_rad_s[i]);
      t.motor[i] = ratio_ * s.motor_nm;
      t.dry[i] = ratio_ * s.friction_nm;
      drawn_a += s.bridge_a;
    }
    supply_a_ = limited_ ? supply_.advance(drawn_a, dt_s_) : drawn_a;
    return t;
  }
  /// The same for ideal motors with these torques at the joints.
  Torques drive(const Axes& torque_nm, const Axes& middle_rad_s) {
    Torques t{torque_nm, {}};
    for (std::size_t i = 0; i < N; ++i) {
      t.dry[i] = ratio_ * drives_[i].friction_nm(ratio_ * middle_rad_s[i]);
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
    for (std::size_t i = 0; i < N; ++i) a[i] = drives_[i].current_a();
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
        drives_{((void)I, AxisDrive(p.motor, p.lugre, p.supply, drive, on))...},
        supply_(p.supply),
        encoders_{Encoder(seeded(p.encoder, I), on.encoder_imperfect,
                          p.joint.encoder_ratio() * start_rad[I])...} {
    for (auto& events : events_) events.reserve(16);
  }
  static EncoderParameters seeded(EncoderParameters e, std::size_t axis) {
    e.seed += axis;
    return e;
  }

  double ratio_;          ///< turns of the motor per turn of the joint
  double encoder_ratio_;  ///< turns of the encoder per turn of the joint
  bool limited_;
  std::array<AxisDrive, N> drives_;
  Supply supply_;
  std::array<Encoder, N> encoders_;
  double dt_s_ = 0.0;
  double supply_a_ = 0.0;  ///< mean of the last step
  std::array<std::vector<EncoderEvent>, N> events_;
};

}  // namespace feltgate::plant
