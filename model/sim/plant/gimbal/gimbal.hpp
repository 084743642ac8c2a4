// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A gimbal: three motors, a handle in two rings, encoders and a hand that turns the handle. It
// closes the loop of a design with three axes in simulation. Documentation:
// docs/devices/three-axes.md
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "../axis_set.hpp"
#include "../plant.hpp"
#include "../profile.hpp"
#include "gimbal_mechanics.hpp"

namespace feltgate::plant {

/// Constants of a gimbal.
struct GimbalParameters : AxesParameters {
  std::string name;
  GimbalBodies bodies;  ///< includes joint_inertia_kg_m2
  AngleStops stops;     ///< of the middle joint
};

/// One phase of a hand that turns the handle.
struct TurnPhase {
  enum class Kind {
    kFree,    ///< nothing touches the handle
    kSpring,  ///< spring and damper to an orientation that turns about `axis` by `way`, rad, from
              ///< where the handle is
    kTorque,  ///< the hand applies `way`, Nm, about `axis`, starting from 0
  };
  Kind kind = Kind::kFree;
  double duration_s = std::numeric_limits<double>::infinity();  ///< infinite: forever
  Vec3 axis{0.0, 0.0, 1.0};                                     ///< of length 1, base's frame
  Profile way;
  double stiffness_nm_rad = 2.0;  ///< of the spring; an assumed value
  double damping_nm_s_rad = 0.05;
};

/// A hand that turns the handle.
struct TurningHand {
  GimbalJoints start_rad = {};    ///< of the joints at clock 0
  std::vector<TurnPhase> phases;  ///< empty: free forever; the last phase lasts forever
};

/// Outputs at the end of the last step unless stated as mean. Order: outer, middle, inner joint.
struct GimbalSeen {
  GimbalJoints theta_rad = {}, omega_rad_s = {};
  Quaternion handle;   ///< orientation
  Vec3 turning_rad_s;  ///< of the handle, base's frame
  GimbalJoints current_a = {};
  GimbalJoints motor_nm = {};  ///< at the joints, before friction; mean of the last step
  Vec3 hand_nm;                ///< of the hand on the handle, base's frame
  Quaternion target;           ///< of the hand's spring
  double bus_v = 0.0;
  /// Energies since the start, J; stored_j() equals its first value plus these inputs minus the
  /// losses.
  double hand_work_j = 0.0, motor_work_j = 0.0;
  double dry_j = 0.0, viscous_j = 0.0, stop_j = 0.0;
};

/// The gimbal, step by step.
class Gimbal {
 public:
  static constexpr std::size_t axes = 3;

  /// Starts at rest. Errors: std::invalid_argument for an impossible drive.
  Gimbal(const GimbalParameters& parameters, const Effects& effects, const Drive& drive,
         const TurningHand& hand = {});

  /// Advances by `clocks` >= 1 FPGA clocks with these bridges; at most 250 (5 us).
  /// Errors: MotionError.
  void advance(const std::array<Bridge, 3>& bridges, Clock clocks);
  /// The same for ideal motors with these torques at the joints, Nm, before friction.
  void advance(const GimbalJoints& torque_nm, Clock clocks);

  /// The first clock after now() at which the hand's motion changes.
  Clock next_corner() const;
  /// The hand's spring now holds this orientation, which turns at this rate (base's frame).
  void steer(const Quaternion& target, Vec3 rate_rad_s);

  Clock now() const { return now_; }
  double seconds() const { return static_cast<double>(now_) / clock_hz_; }
  double clock_hz() const { return clock_hz_; }
  const std::vector<EncoderEvent>& events(std::size_t axis) const { return axes_.events(axis); }
  const Encoder& encoder(std::size_t axis) const { return axes_.encoder(axis); }
  const GimbalSeen& seen() const { return seen_; }
  const GimbalParameters& parameters() const { return p_; }
  double stored_j() const { return mechanics_.stored_j(state_); }

 private:
  void begin(Clock clocks);
  void lead();
  void begin_phase();
  void finish(const AxisSet<axes>::Torques& torques, Clock clocks);

  GimbalParameters p_;
  Effects on_;
  double clock_hz_;
  TurningHand hand_;
  GimbalMechanics mechanics_;
  GimbalState state_;
  AxisSet<axes> axes_;
  Clock now_ = 0;
  double dt_s_ = 0.0;
  GimbalJoints middle_rad_s_ = {}, acceleration_rad_s2_ = {};
  std::size_t phase_ = 0;
  bool started_ = false, last_ = true, steered_ = false;
  Clock phase_begin_ = 0, phase_end_ = 0;
  ProfileRun way_;
  Quaternion held_;  ///< orientation at the start of the phase or of steering
  Vec3 steered_rad_s_;
  Clock steered_since_ = 0;
  GimbalLoad load_;
  GimbalSeen seen_;
};

// Reader of gimbal files such as vectors/devices/gimbal.toml.

/// Reads and checks a gimbal; every key is required, unknown keys are errors.
/// Errors: config::ConfigError "file:line: what; mend".
GimbalParameters read_gimbal_file(const std::string& path);
/// The same from a text; errors name it `path`.
GimbalParameters read_gimbal_text(const std::string& text, const std::string& path);

}  // namespace feltgate::plant
