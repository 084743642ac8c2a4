// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// An interactive closed loop: the twin, a plant, a hand that the caller moves, an optional host
// that computes the wall in place of the core, and wires that can break. Documentation:
// docs/page.md
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "feltgate/design_info.hpp"
#include "sim/loop/ensemble.hpp"
#include "sim/loop/loop.hpp"
#include "sim/loop/scene_law.hpp"
#include "sim/loop/step_plan.hpp"
#include "sim/plant/plant.hpp"

namespace feltgate::page {

/// Sums the heat of the current as the supervisor does, from the words of each snapshot. While the
/// motor is warm, it lowers the torque limit from the design's to a torque that does not heat it
/// further.
class WarmMotor {
 public:
  /// `torque_constant_nm_a` is the plant's. At power-up the motor counts as half warm.
  WarmMotor(const DesignInfo& d, double torque_constant_nm_a)
      : torque_constant_nm_a_(std::min(torque_constant_nm_a, d.torque_constant_nm_a)),
        nominal_a2_(d.find("nominal_current_squared")->si),
        budget_a2_(d.find("i2t_budget")->si),
        most_nm_(d.find(limit)->si),
        a_per_v_(std::ldexp(d.find("inverse_resistance")->si, -d.voltage.fraction)),
        a_s_per_rad_(std::ldexp(d.find("emf_over_resistance")->si, -d.velocity.fraction)),
        heat_a2_(budget_a2_ / 2) {}

  /// Counts a tick with these words of the snapshot.
  void pass(std::int64_t voltage, std::int64_t velocity) {
    const double current_a =
        static_cast<double>(voltage) * a_per_v_ - static_cast<double>(velocity) * a_s_per_rad_;
    heat_a2_ = std::max(0.0, heat_a2_ + current_a * current_a - nominal_a2_);
  }
  /// A torque that does not heat the motor further, Nm: 55 % of the torque at the nominal current,
  /// because the supervisor counts the drop of brushes and dead time, up to 1 V, as current too.
  double cool_nm() const { return 0.55 * std::sqrt(nominal_a2_) * torque_constant_nm_a_; }
  /// The present torque limit: the design's up to 70 % of the heat budget, cool_nm() from 90 %.
  double limit_nm() const {
    const double least = std::min(most_nm_, cool_nm());
    const double left = std::clamp((0.9 - heat_a2_ / budget_a2_) / 0.2, 0.0, 1.0);
    return least + left * (most_nm_ - least);
  }

  static constexpr const char* limit = "torque_limit";

 private:
  double torque_constant_nm_a_, nominal_a2_, budget_a2_, most_nm_, a_per_v_, a_s_per_rad_;
  double heat_a2_;  ///< summed over the ticks
};

/// A fault of the wiring between core and plant.
enum class Break { none, channel_dead, encoder_swapped, motor_swapped, supply_low };

/// How the lever is held: by a hand with mass and damping, or lightly by a fingertip. Both yield
/// before they exceed the torque that the motor can hold permanently; a strong hand does not.
enum class Grip { none, hand, fingertip, strong };

/// The values of one tick; times in seconds since the start.
struct Sample {
  double time_s = 0;
  double angle_rad = 0;       ///< of the lever, not of the encoder
  double hand_rad = 0;        ///< the hand's target of the lever's angle
  double tau_ref_nm = 0;      ///< torque reference of the scene
  double tau_hat_nm = 0;      ///< estimate of the observer
  double torque_nm = 0;       ///< torque of the motor, averaged over a PWM period
  double hand_nm = 0;         ///< torque of the hand
  double velocity_rad_s = 0;  ///< estimated
  double float_nm = 0;        ///< tau_hat of the chain in double on the same samples
  double position_rad = 0;    ///< position counted by the core
};

constexpr std::size_t sample_values = 10;  ///< numbers of a Sample

/// A word of the snapshot: its number, and how many of its bits are behind the point of its unit.
struct Word {
  const char* name;
  const char* unit;
  std::int64_t (*value)(const Snapshot&);
  int (*fraction)(const DesignInfo&);
};

/// Every word of a snapshot, in the order of the struct.
extern const std::array<Word, 14> snapshot_words;

class LiveLoop {
 public:
  /// `design` must be built in. The lever starts at rest at 0 rad, not held, with the motor
  /// disarmed. Throws std::invalid_argument for an unknown design.
  LiveLoop(const std::string& design, const plant::Parameters& plant);

  const DesignInfo& design() const { return core_.design(); }
  /// Selects a scene by name. The scene `setpoint` acts only while the lever is held, because a
  /// free lever would accelerate without end. Throws std::invalid_argument.
  void select(const std::string& scene);
  /// Sets a parameter in its unit. Throws std::invalid_argument.
  void set(const std::string& parameter, double value);
  /// Loads this law for the scene `law`; set() then accepts its parameters too. Call it at most
  /// once, before the first advance().
  void run_law(std::unique_ptr<SceneLaw> law);
  void arm(bool wanted);
  /// Disarms and clears the faults; broken wires stay broken.
  void clear_faults();
  void stop(bool pressed);
  /// The wall of the scene `wall` is computed by a host every `ticks` ticks and its torque held in
  /// between; 1: by the core. Contact in rad, stiffness in Nm/rad, damping in Nm s/rad.
  void host_wall(int ticks, double contact_rad, double stiffness_nm_rad, double damping_nm_s_rad);
  void break_it(Break what) { broken_ = what; }

  /// The hand grips the lever at its position, or releases it.
  void hold(Grip grip);
  bool held() const { return grip_ != Grip::none; }
  /// The angle, rad, to which the hand moves at constant speed during the next advance(), unless it
  /// yields.
  void lead(double theta_rad) { wanted_rad_ = theta_rad; }

  /// Runs for `ticks` ticks and keeps every `every`-th as a sample. Throws plant::MotionError.
  void advance(std::int64_t ticks, int every);
  /// The samples of the last advance().
  const std::vector<Sample>& samples() const { return samples_; }
  /// The snapshot of the last tick.
  const Snapshot& snapshot() const { return last_; }
  /// The hand's target of the lever's angle at the end of the last advance().
  double hand_rad() const { return held() ? hand_rad_ : plant_.observables().theta_rad; }
  const plant::Observables& observables() const { return plant_.observables(); }
  /// Limit of the motor's torque, Nm; the host lowers it while the motor is warm.
  double torque_limit_nm() const { return limit_nm_; }
  /// Largest torque at rest of a hand that yields, Nm.
  double gentle_nm() const { return 0.9 * motor_.cool_nm(); }
  double time_s() const { return static_cast<double>(core_.lead_const().now()) / clock_hz_; }

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
  double limit_nm_;     ///< the limit written last
  double hand_nm_rad_;  ///< stiffness of a hand at the lever
  std::string scene_ = "free";
  bool armed_ = false;
  Grip grip_ = Grip::none;
  int host_ticks_ = 1;
  double contact_rad_ = 0, stiffness_nm_rad_ = 0, damping_nm_s_rad_ = 0;
  Break broken_ = Break::none;
  EncoderPins pins_;                 ///< levels at the core
  bool dead_level_ = false;          ///< level of a dead channel
  std::vector<EncoderEvent> wired_;  ///< events after the broken wires
  double hand_rad_ = 0, wanted_rad_ = 0;
  std::int64_t ticks_ = 0;
  int every_ = 1;
  Snapshot last_;
  std::vector<Sample> samples_;
};

/// Hash (64-bit FNV-1a) over the words of all snapshots of a design's twin with recorded inputs.
/// Equal bits give an equal hash on any machine.
std::uint64_t hash_of(const std::string& design, const RunInputs& inputs);

}  // namespace feltgate::page
