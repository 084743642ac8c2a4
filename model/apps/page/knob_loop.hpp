// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The page's knob: the design gimbal_motor tick by tick, its motor of three phases, a hand, and a
// host that moves the detent. Documentation: docs/page.md
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "feltgate/axis/three_phase.hpp"
#include "feltgate/while_armed.hpp"
#include "sim/backends/backend.hpp"
#include "sim/plant/three_phase.hpp"
#include "sim/reference/real_chain.hpp"

namespace feltgate::page {

/// What the core of gimbal_motor computes, tick by tick, in its own integers: chain and
/// commutation. Supervisor, self-test and registers are left out.
class KnobCore {
 public:
  static constexpr const char* design_name = "gimbal_motor";

  KnobCore();
  const DesignInfo& design() const { return design_; }
  /// Sets a parameter in its unit. Errors: std::invalid_argument.
  void set(const std::string& parameter, double value);
  void arm(bool wanted) { armed_ = wanted; }
  bool armed() const { return armed_; }
  /// The tick that samples this position, in counts.
  void tick(std::int32_t position);
  /// The words of the last tick.
  const ChainRaw& raw() const { return *chain_->raw(); }
  const ChainOut& out() const { return chain_->out(); }
  /// Clocks of the legs' high switches in the PWM period of the last tick; 0 with the gates closed.
  const std::array<std::int16_t, 3>& on_clocks() const { return on_; }
  bool gates() const { return gates_; }
  /// The electrical angle at which the core takes the rotor to be, turns; and the word in it.
  double electrical_turns(std::int32_t position) const;
  double offset_turns() const;

 private:
  DesignInfo design_;
  std::unique_ptr<RealChain> chain_;
  HostBeside beside_;
  axis::Commutation commutation_;
  int sampling_tick_;  ///< of a PWM period: so late that the on-times are new when the next begins
  std::uint32_t gain_, offset_;
  int scene_;
  bool armed_ = false, sampled_ = false, gates_ = false;
  std::int64_t ticks_ = 0;
  std::array<std::int16_t, 3> next_{}, on_{};
};

/// The knob's values once in a millisecond.
struct KnobSample {
  double on_a = 0, on_b = 0, on_c = 0;  ///< share of the PWM period
  double asked_nm = 0, motor_nm = 0;
};
constexpr std::size_t knob_sample_values = 5;  ///< numbers of a KnobSample

class KnobLoop {
 public:
  static constexpr double most_rad = 40;  ///< to which a hand turns the knob, either way

  /// `plant` has a motor with three phases. The knob rests at 0 in a detent, free, the motor armed.
  explicit KnobLoop(const plant::Parameters& plant);

  /// Detents `pitch_rad` apart whose torque grows to `peak_nm` at a fifth of the pitch. Errors:
  /// std::invalid_argument for what the words do not hold.
  void detents(double pitch_rad, double peak_nm);
  /// The core's word of the electrical angle at count 0, turns; the motor's own is the plant's.
  void offset(double turns);
  void arm(bool wanted) { core_.arm(wanted); }
  void hold(bool held);
  bool held() const { return held_; }
  /// The angle, rad, to which the hand moves evenly during the next advance().
  void lead(double theta_rad);
  /// Errors: plant::MotionError.
  void advance(double seconds);

  const KnobCore& core() const { return core_; }
  const plant::ThreePhasePlant& plant() const { return plant_; }
  double hand_rad() const { return held_ ? hand_rad_ : plant_.observables().theta_rad; }
  double detent_rad() const { return centre_ * core_.design().count_rad; }
  std::int32_t position() const { return position_; }
  /// As the core's word of a count's electrical angle has them.
  int pole_pairs() const;
  double time_s() const { return static_cast<double>(ticks_) * tick_s_; }
  const std::vector<KnobSample>& samples() const { return samples_; }

 private:
  void step();
  void tick(double theta_rad);
  void move_detent();

  KnobCore core_;
  plant::ThreePhasePlant plant_;
  double tick_s_;
  double pitch_ = 1, centre_ = 0;  ///< counts
  bool held_ = false;
  double hand_rad_ = 0, wanted_rad_ = 0;
  double owed_s_ = 0;  ///< of the time of advance()
  std::int64_t ticks_ = 0;
  std::int32_t read_ = 0, position_ = 0;  ///< counts: of the reading under way, and the newest one
  std::vector<KnobSample> samples_;
};

}  // namespace feltgate::page
