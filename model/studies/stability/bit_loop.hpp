// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The chain in its own bits, or in double, around the plant and a wall, tick by tick: the same
// order of events as in the linear loop, with a host that may compute the wall instead of the core.
// Documentation: docs/speed-for-accuracy.md
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "design/design.hpp"
#include "sim/plant/plant.hpp"
#include "sim/reference/real_chain.hpp"
#include "studies/stability/linear_loop.hpp"

namespace feltgate::stability {

// How fast a swing grows or dies: the slope of the logarithm of its size, taken from one turning
// point to the next.

/// Growth of a swing: slope of the logarithm of its size over time.
struct Growth {
  double rate_1_s = 0;  ///< positive: it grows; +-infinity where too few turning points were seen
  double rad_s = 0;     ///< of the swing
  int swings = 0;       ///< half periods that the slope was taken from
  bool left = false;    ///< it grew until the lever left the wall or the torque met its limit
};

class SwingMeter {
 public:
  /// From `start_rad`; the first three half periods are not counted, `wanted` are; a swing smaller
  /// than `smallest_rad` ends it.
  SwingMeter(double start_rad, double smallest_rad, int wanted)
      : extreme_rad_(start_rad), smallest_rad_(smallest_rad), wanted_(wanted) {}

  /// One look at the lever, often against its period; false when enough was seen.
  bool add(double time_s, double theta_rad, double omega_rad_s);
  /// The lever left the wall: nothing more is to be seen.
  void leave() { left_ = true; }
  Growth growth() const;

 private:
  double extreme_rad_, smallest_rad_;
  int wanted_, seen_ = 0;
  double speed_ = 0;
  bool left_ = false, done_ = false;
  std::vector<double> times_s_, logs_;
};

struct BitLoopSetting {
  std::string chain = "fixed";  ///< kind of make_real_chain()
  /// Makes the chain instead, if given; its design has the addresses of the one that is built in.
  std::function<std::unique_ptr<RealChain>()> made_chain;
  Wall wall;
  plant::Parameters plant;
  plant::Hand hand;
  /// Nothing in the voltage law but gains: dead voltage 0, one region, limits as far as words go.
  bool linear = true;
};

/// The loop; the wall's face is at 0 rad and the wall extends above it.
class BitLoop {
 public:
  /// `design` must be built in. Throws std::invalid_argument for a value that does not fit its
  /// word.
  BitLoop(const design::Elaborated& design, const BitLoopSetting& setting);

  void tick();

  std::int64_t ticks() const { return k_; }
  const plant::Observables& seen() const { return plant_.observables(); }
  double theta_rad() const { return plant_.observables().theta_rad; }
  double omega_rad_s() const { return plant_.observables().omega_rad_s; }
  double motor_torque_nm() const { return plant_.observables().motor_torque_mean_nm; }
  double tau_ref_nm() const { return chain_->out().tau_ref_nm; }
  double tau_hat_nm() const { return chain_->out().tau_hat_nm; }

  /// A host's wall: torque from the position and velocity that the host has read, rad and rad/s.
  /// The default is the law of the core's wall. Only with scene_ticks > 1.
  using HostLaw = std::function<double(double theta_rad, double omega_rad_s)>;
  void set_host(HostLaw law) { host_ = std::move(law); }

 private:
  int address(const char* name) const { return design_.word(name).parameter.address; }

  const design::Elaborated& design_;
  Wall wall_;
  std::unique_ptr<RealChain> chain_;
  plant::Plant plant_;
  HostLaw host_;
  double count_rad_;
  int pwm_ticks_, pwm_clocks_, clocks_per_tick_, setpoint_address_;
  double duty_new_ = 0, duty_ = 0, host_torque_ = 0;
  std::int32_t counts() const;  ///< of the angle now
  std::int32_t position_ = 0;
  std::int32_t reading_ = 0;  ///< of an absolute encoder, under way
  ChainIn in_;
  std::int64_t k_ = 0;
};

/// The hand's press while a border is measured, and the size of the swing around its depth.
constexpr double press_nm = 0.45;
double swing_rad(double stiffness_nm_rad);

/// A hand presses with a constant torque; the lever starts off its resting depth and swings.
Growth swing(const design::Elaborated& design, const plant::Parameters& plant, const Wall& wall,
             const std::string& chain, double expected_rad_s);
/// The same with chain, plant and wall of a setting; its hand is not used.
Growth swing(const design::Elaborated& design, BitLoopSetting setting, double expected_rad_s);

/// Largest stiffness whose swing does not grow, by bisection to 0.5 %, around `near`.
/// NaN where no border was found within a factor 2 of it.
double measured_border(const design::Elaborated& design, const plant::Parameters& plant,
                       double damping_nm_s_rad, int scene_ticks, const Border& near);

}  // namespace feltgate::stability
