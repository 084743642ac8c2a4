// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A pantograph: two motors, a five-bar linkage, stops, encoders and a hand at the pen. It closes
// the loop of a design with two axes in simulation. Equations, step and convergence:
// docs/devices/pantograph.md
#pragma once

#include <array>
#include <string>
#include <vector>

#include "../axis_set.hpp"
#include "../plant.hpp"
#include "linkage_mechanics.hpp"
#include "pen_hand.hpp"

namespace feltgate::plant {

/// Constants of a pantograph.
struct PantographParameters : AxesParameters {
  std::string name;
  LinkageGeometry linkage;
  LinkageBodies bodies;  ///< includes joint_inertia_kg_m2
  AngleStops stops;      ///< of theta5 - theta1
  Vec2 start_m;          ///< pen at clock 0, unless the hand gives a start
};

// Reader of vectors/devices/NAME.toml for pantographs.

/// Reads and checks a pantograph; every key is required, unknown keys are errors.
/// Errors: config::ConfigError "file:line: what; mend".
PantographParameters read_pantograph_file(const std::string& path);
/// The same from a text; errors name it `path`.
PantographParameters read_pantograph_text(const std::string& text, const std::string& path);

/// Outputs at the end of the last step unless stated as mean. Pairs: joint 1, joint 5.
struct PantographSeen {
  Joints theta_rad = {}, omega_rad_s = {};
  Vec2 pen_m, pen_m_s;
  Joints current_a = {};    ///< of the motors
  Joints motor_nm = {};     ///< at the cranks, before friction; mean of the last step
  Joints friction_nm = {};  ///< dry and viscous, at the cranks; mean of the last step
  Vec2 hand_n;              ///< of the hand on the pen
  Vec2 hand_m;              ///< of a hand with a mass
  double bus_v = 0.0;
  double supply_a = 0.0;  ///< mean of the last step
  /// Energies since the start, J: inputs by pen and motors, and losses. stored_j is the energy in
  /// the motion and in the stops; it equals its first value plus inputs minus losses.
  double hand_work_j = 0.0, motor_work_j = 0.0;
  double dry_j = 0.0, viscous_j = 0.0, stop_j = 0.0;
};

/// The pantograph, step by step.
class Pantograph {
 public:
  static constexpr std::size_t axes = 2;

  /// The pen starts at rest at the hand's start, else at that of the parameters.
  /// Errors: std::invalid_argument for an impossible start or drive.
  Pantograph(const PantographParameters& parameters, const Effects& effects, const Drive& drive,
             const PenHand& hand = {});

  /// Advances by `clocks` >= 1 FPGA clocks with these bridges (gates, duty or off); 25 to 250
  /// clocks (5 us) between two events. Errors: MotionError.
  void advance(const std::array<Bridge, 2>& bridges, Clock clocks);
  /// The same for ideal motors with these torques at the cranks, Nm, before friction.
  void advance(const Joints& torque_nm, Clock clocks);

  /// The first clock after now() at which the hand's motion changes.
  Clock next_corner() const { return hand_.next_corner(now_); }
  void take(const PenPhase& phase) { hand_.take(phase); }
  void steer(Vec2 target_m, Vec2 rate_m_s) { hand_.steer(target_m, rate_m_s, now_); }

  /// Time since the start, in clocks; all times in seconds are computed from it.
  Clock now() const { return now_; }
  double seconds() const { return static_cast<double>(now_) / clock_hz_; }
  double clock_hz() const { return clock_hz_; }
  /// Pin changes of an axis (0 or 1) during the last step.
  const std::vector<EncoderEvent>& events(std::size_t axis) const { return axes_.events(axis); }
  const Encoder& encoder(std::size_t axis) const { return axes_.encoder(axis); }
  const PantographSeen& seen() const { return seen_; }
  const PantographParameters& parameters() const { return p_; }
  const Linkage& linkage() const { return mechanics_.linkage(); }
  const LinkageDynamics& dynamics() const { return mechanics_.dynamics(); }
  /// Kinetic energy plus the energy in the stops, without that in the bristles, J.
  double stored_j() const { return mechanics_.stored_j(state_); }

 private:
  void begin(Clock clocks);
  void finish(const AxisSet<axes>::Torques& torques, Clock clocks);
  [[noreturn]] void refuse(const char* what, const Joints& before) const;

  PantographParameters p_;
  Effects on_;
  double clock_hz_;
  LinkageMechanics mechanics_;
  PenHandRun hand_;
  LinkageState state_;
  AxisSet<axes> axes_;

  Clock now_ = 0;
  double dt_s_ = 0.0;
  Joints middle_rad_s_ = {};         ///< predicted speeds in the middle of the step
  Joints acceleration_rad_s2_ = {};  ///< mean of the last step
  PantographSeen seen_;
};

}  // namespace feltgate::plant
