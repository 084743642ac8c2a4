// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Outcome of a fault: the classes of the campaign and the rules that select one.
// Documentation: docs/testing.md
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>

#include "feltgate/core_ports.hpp"
#include "feltgate/largest.hpp"

namespace feltgate::faults {

enum class Class {
  masked,     ///< no output ever differed, and the state equals that of the sound core again
  latent,     ///< no torque, position or gate is wrong, but the state still differs at the end
  transient,  ///< outputs differed, by too little or for too short a time, and are right again
  off,        ///< the gates are off and the motor is disarmed; no fault is latched
  detected,   ///< a fault is latched, the gates are off
  silent,     ///< torque or position wrong, unflagged
  unsafe,     ///< both switches of a leg on, or far too much torque
};
constexpr int class_count = 7;
inline const char* name_of(Class c) {
  constexpr const char* names[] = {"masked",   "latent", "transient", "off",
                                   "detected", "silent", "unsafe"};
  return names[static_cast<int>(c)];
}

/// Limits between the classes, for ticks of 1 us.
struct Limits {
  double torque_nm = 0.5;      ///< the design's limit
  double silent_share = 0.05;  ///< share of torque_nm
  double unsafe_share = 1.2;   ///< share of torque_nm
  int ticks = 1000;            ///< longer than this
  int both_clocks = 1;         ///< both switches of a leg: longer than this
};

struct Outcome {
  Class is = Class::masked;
  std::string why;              ///< reason, for silent and unsafe
  unsigned flagged = 0;         ///< latched faults that the sound core does not have
  std::int64_t off_after = -1;  ///< ticks from the fault to the gates off
  double peak_nm = 0;        ///< largest deviation of the torque, from the fault to the gates off
  double integral_nm_s = 0;  ///< integral of the size of that deviation
  int both_clocks = 0;       ///< longest time with both switches of a leg on
  double motor_peak_nm = 0;  ///< largest torque of the motor itself
  double travel_rad = 0;     ///< travel of the lever, from the fault to the flag
  bool count_changed = false;
};

/// What a run of a core beside a sound one has shown.
struct Findings {
  bool unsafe, off, torque_wrong, position_wrong, differed;
};

/// The class of a run, from what it has shown and what was flagged.
inline void settle(const Findings& seen, const Limits& limits, Outcome* o) {
  if (seen.unsafe) {
    o->is = Class::unsafe;
    o->why = o->both_clocks > limits.both_clocks ? "both switches of a leg" : "too much torque";
  } else if (seen.off) {
    o->is = o->flagged != 0 ? Class::detected : Class::off;
  } else if (seen.torque_wrong || seen.position_wrong) {
    o->is = Class::silent;
    o->why = !seen.torque_wrong    ? "position"
             : seen.position_wrong ? "torque and position"
                                   : "torque";
  } else {
    o->is = seen.differed ? Class::transient : Class::masked;
  }
}

/// Takes the faults of a step into the outcome; whether the gates are closed by then, where those
/// of a sound core are open or a fault is flagged: `after` ticks and `travel_rad` from the fault.
inline bool closed(const CoreOut& faulty, unsigned sound_faults, bool sound_opens,
                   std::int64_t after, double travel_rad, Outcome* o) {
  o->flagged |= faulty.faults & ~sound_faults;
  const bool is = !faulty.gates_enable && (sound_opens || o->flagged != 0);
  if (is && o->off_after < 0) o->travel_rad = travel_rad;
  if (!is || o->off_after < 0) o->off_after = is ? after : -1;
  return is;
}

/// Gates of one tick: clocks for which each gate was on, and the longest run of clocks with both
/// gates of a leg on.
struct GateTimes {
  int a_hi = 0, a_lo = 0, b_hi = 0, b_lo = 0, both = 0;
  bool on() const { return (a_hi | a_lo | b_hi | b_lo) != 0; }
  auto all() const { return std::tie(a_hi, a_lo, b_hi, b_lo, both); }
  bool operator==(const GateTimes& o) const { return all() == o.all(); }
};

/// How far a torque is off, and for how long: what makes a run unsafe, or its torque wrong.
class TorqueLimits {
 public:
  explicit TorqueLimits(const Limits& limits) : l_(limits) {}

  /// A step of the faulty core: its torque less the sound one's, the motor's own torque. Once it is
  /// flagged the torque is not wrong any more, and without a gate it is not counted.
  void step(double off_nm, double motor_nm, double step_us, bool on, bool flagged, Outcome* o) {
    const double motor = std::abs(motor_nm), off = std::abs(off_nm);
    o->motor_peak_nm = larger(o->motor_peak_nm, motor);
    // After the gates are off the lever is free: its torque is not judged.
    if (on || !flagged) {
      o->peak_nm = larger(o->peak_nm, off);
      o->integral_nm_s += off * 1e-6 * step_us;
    }
    over_us_ = motor > l_.unsafe_share * l_.torque_nm ? over_us_ + step_us : 0;
    wrong_us_ = off > l_.silent_share * l_.torque_nm && !flagged ? wrong_us_ + step_us : 0;
    too_much_ = too_much_ || over_us_ > l_.ticks;
    torque_wrong_ = torque_wrong_ || wrong_us_ > l_.ticks;
  }
  bool unsafe(const Outcome& o) const { return too_much_ || o.both_clocks > l_.both_clocks; }
  bool torque_wrong() const { return torque_wrong_; }

 private:
  Limits l_;
  double over_us_ = 0, wrong_us_ = 0;
  bool too_much_ = false, torque_wrong_ = false;
};

/// Compares, tick by tick, the torque of a core with a fault with that of a sound core on the same
/// lever. Each torque is computed from the winding's voltage (mean of a PWM period) minus the
/// back-EMF.
class TorqueJudge {
 public:
  struct Motor {
    double supply_v, torque_constant_nm_a, emf_v_s_rad, resistance_ohm;
    int clocks_per_tick, period_ticks;
  };
  TorqueJudge(const Motor& motor, const Limits& limits) : m_(motor), limits_(limits) {}

  /// Takes a tick before the fault, so that the means over a PWM period are already filled.
  void before(const GateTimes& gates, double motor_torque_nm) {
    faulty_.add(share(gates), gates.on(), m_.period_ticks);
    sound_.add(share(gates), gates.on(), m_.period_ticks);
    motor_.add(motor_torque_nm, true, m_.period_ticks);
  }
  void tick(const GateTimes& faulty, const GateTimes& sound, double omega_rad_s,
            double motor_torque_nm, bool flagged, Outcome* o) {
    faulty_.add(share(faulty), faulty.on(), m_.period_ticks);
    sound_.add(share(sound), sound.on(), m_.period_ticks);
    motor_.add(motor_torque_nm, true, m_.period_ticks);
    const double e = torque(faulty_, omega_rad_s) - torque(sound_, omega_rad_s);
    o->both_clocks = std::max(o->both_clocks, faulty.both);
    limits_.step(e, motor_.mean(), 1, faulty_.on(), flagged, o);
  }
  bool unsafe(const Outcome& o) const { return limits_.unsafe(o); }
  bool torque_wrong() const { return limits_.torque_wrong(); }

 private:
  /// Mean of the last ticks of a PWM period.
  class Window {
   public:
    void add(double share, bool on, int ticks) {
      if (filled_ == ticks) {
        sum_ -= shares_[at_];
        on_ -= ons_[at_] ? 1 : 0;
      } else {
        ++filled_;
      }
      shares_[at_] = share;
      ons_[at_] = on;
      sum_ += share;
      on_ += on ? 1 : 0;
      at_ = at_ + 1 == ticks ? 0 : at_ + 1;
      if (at_ == 0) {  // starts a new sum, so that rounding errors do not add up
        sum_ = 0;
        for (int k = 0; k < filled_; ++k) sum_ += shares_[k];
      }
    }
    double mean() const { return filled_ == 0 ? 0 : sum_ / filled_; }
    bool on() const { return on_ > 0; }

   private:
    static constexpr int longest = 64;
    double shares_[longest] = {}, sum_ = 0;
    bool ons_[longest] = {};
    int at_ = 0, filled_ = 0, on_ = 0;
  };
  double share(const GateTimes& g) const {
    return static_cast<double>(g.a_hi - g.b_hi) / m_.clocks_per_tick;
  }
  double torque(const Window& w, double omega_rad_s) const {
    if (!w.on()) return 0;
    return m_.torque_constant_nm_a * (w.mean() * m_.supply_v - m_.emf_v_s_rad * omega_rad_s) /
           m_.resistance_ohm;
  }

  Motor m_;
  TorqueLimits limits_;
  Window faulty_, sound_, motor_;
};

}  // namespace feltgate::faults
