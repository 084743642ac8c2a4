// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A closed loop that someone plays with while it runs: the twin, a plant, a hand that the caller
// moves, a host that may compute the wall instead of the core, and wires that break.
// Documentation: docs/page.md
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "loop/ensemble.hpp"
#include "loop/scene_law.hpp"
#include "loop/step_plan.hpp"
#include "page/warm_motor.hpp"
#include "plant/period_mean.hpp"
#include "plant/plant.hpp"

namespace feltgate::page {

/// What breaks between core and plant.
enum class Break { none, channel_dead, encoder_swapped, motor_swapped, supply_low };

/// How the lever is held: with a hand that has mass and damping, or lightly with a fingertip. Both
/// give way where they would push harder than the motor holds for good; a strong hand does not.
enum class Grip { none, hand, fingertip, strong };

/// One tick as a reader sees it; times in seconds since the start.
struct Sample {
  double time_s = 0;
  double angle_rad = 0;       ///< of the lever, not of the encoder
  double hand_rad = 0;        ///< where the hand wants it
  double tau_ref_nm = 0;      ///< what the scene asks for
  double tau_hat_nm = 0;      ///< what the observer sees
  double torque_nm = 0;       ///< what the motor does, averaged over a PWM period
  double hand_nm = 0;         ///< what the hand does
  double velocity_rad_s = 0;  ///< estimated
  double float_nm = 0;        ///< what the observer of the chain in double sees on the same samples
  double position_rad = 0;    ///< that the core counted
};

constexpr std::size_t sample_values = 10;  ///< numbers of a Sample

class LiveLoop {
 public:
  /// A design that is built in. The lever starts at rest at 0 rad, nobody holds it, disarmed.
  /// Errors: std::invalid_argument for an unknown design.
  LiveLoop(const std::string& design, const plant::Parameters& plant);

  const DesignInfo& design() const { return core_.design(); }
  /// By name. The scene `setpoint` acts while the lever is held: a free lever would only get
  /// faster. Errors: std::invalid_argument.
  void select(const std::string& scene);
  /// A parameter in its unit. Errors: std::invalid_argument.
  void set(const std::string& parameter, double value);
  /// The host loads this law for the scene `law`, whose parameters set() knows too; once, before
  /// the first advance().
  void run_law(std::unique_ptr<SceneLaw> law);
  void arm(bool wanted);
  /// Disarms and forgets faults; what is broken stays so.
  void clear_faults();
  void stop(bool pressed);
  /// The wall of the scene `wall` is computed by a host every `ticks` ticks and its torque held in
  /// between; 1: by the core. Contact in rad, stiffness in Nm/rad, damping in Nm s/rad.
  void host_wall(int ticks, double contact_rad, double stiffness_nm_rad, double damping_nm_s_rad);
  void break_it(Break what) { broken_ = what; }

  /// The hand takes the lever where it is, or lets it go.
  void hold(Grip grip);
  bool held() const { return grip_ != Grip::none; }
  /// Where the hand wants to be when the next advance() ends, rad; it moves there evenly, as far as
  /// it does not give way.
  void lead(double theta_rad) { wanted_rad_ = theta_rad; }

  /// Runs for so many ticks and keeps every `every`-th as a sample.
  /// Errors: plant::MotionError.
  void advance(std::int64_t ticks, int every);
  /// Those of the last advance().
  const std::vector<Sample>& samples() const { return samples_; }
  /// The last tick's.
  const Snapshot& snapshot() const { return last_; }
  const plant::Observables& observables() const { return plant_.observables(); }
  /// Of the motor's torque, which the host lowers while the motor is warm, Nm.
  double torque_limit_nm() const { return limit_nm_; }
  /// What a hand that gives way pushes with at most, when it rests, Nm.
  double gentle_nm() const { return 0.9 * motor_.cool_nm(); }
  double time_s() const { return static_cast<double>(core_.lead_const().now()) / clock_hz_; }
  /// Largest difference of tau_hat between the core's bits and double since the last call, Nm.
  double take_difference();

 private:
  void step(Clock clocks);
  void tick(const Snapshot& s);
  void control();
  void host(const Snapshot& s);
  void spare_motor();
  double within_reach(double wanted_rad) const;
  const std::vector<EncoderEvent>& through_the_wires(const std::vector<EncoderEvent>& events);

  plant::Plant plant_;
  std::unique_ptr<SceneLaw> law_;
  Ensemble core_;
  double clock_hz_;
  StepPlan plan_;
  plant::PeriodMean mean_;
  WarmMotor motor_;
  double limit_nm_;     ///< that is written
  double hand_nm_rad_;  ///< stiffness of a hand at the lever
  std::string scene_ = "free";
  bool armed_ = false;
  Grip grip_ = Grip::none;
  int host_ticks_ = 1;
  double contact_rad_ = 0, stiffness_nm_rad_ = 0, damping_nm_s_rad_ = 0;
  Break broken_ = Break::none;
  EncoderPins pins_;                 ///< as the core sees them
  bool dead_level_ = false;          ///< of a channel that is dead
  std::vector<EncoderEvent> wired_;  ///< events behind the broken wires
  double hand_rad_ = 0, wanted_rad_ = 0;
  std::int64_t ticks_ = 0;
  int every_ = 1;
  double difference_nm_ = 0;
  Snapshot last_;
  std::vector<Sample> samples_;
};

/// Where the lever was after a frame, and what the motor did.
struct ScriptRow {
  double theta_rad = 0, torque_nm = 0;
};

/// A motion that native program and page both make, to be compared: a hand goes into the wall,
/// stays and comes back, frame by frame.
std::vector<ScriptRow> follow_script(const std::string& design, const plant::Parameters& plant);

/// Hash over every snapshot of the twin of a design that gets these inputs: FNV-1a of 64 bits, over
/// the words of the core's snapshot. Equal bits, equal hash, on any machine.
std::uint64_t hash_of(const std::string& design, const RunInputs& inputs);

}  // namespace feltgate::page
