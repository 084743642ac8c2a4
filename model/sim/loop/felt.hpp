// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Summary of what a run felt like: torque, energy, errors, limits and faults, in a few numbers.
// Documentation: docs/json.md
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "feltgate/largest.hpp"
#include "figures.hpp"

namespace feltgate {

/// Largest magnitude of a signal, with its sign, and the device time at which it occurred.
struct Peak {
  double value = 0, at_s = 0;
};

/// A hand does not feel shorter events apart, s; the plant's torques are averaged over this time.
constexpr double felt_window_s = 1e-3;

/// Torques of a run, Nm.
struct FeltTorque {
  Peak asked;      ///< of the scene, limited and ramped
  Peak commanded;  ///< nominal torque constant times the current reference
  // Only in a closed loop; means over felt_window_s:
  Peak motor;               ///< of the plant's motor
  Peak hand;                ///< of the hand on the lever
  ErrorFigure motor_error;  ///< motor - asked
};

/// Work of the hand on the lever, J. Energy that the hand gives goes into the device.
struct FeltEnergy {
  double taken_from_hand_j = 0;  ///< sum of all that the hand gave
  double given_to_hand_j = 0;    ///< sum of all that the hand received
  double peak_from_hand_j = 0;   ///< maximum of taken - given
  double peak_to_hand_j = 0;     ///< maximum of given - taken: 0 for a passive device
  double net_from_hand_j() const { return taken_from_hand_j - given_to_hand_j; }
};

/// Error of a signal of the core and its proven bound.
struct FeltError {
  std::string signal;  ///< with its unit: "velocity_rad_s", "tau_hat_nm", "torque_nm"
  ErrorFigure error;
  double bound = std::numeric_limits<double>::infinity();  ///< infinite: none is proven
  bool holds() const { return error.max() <= bound; }
};

/// How long a limit or fault acted, and when first.
struct Acted {
  double seconds = 0, first_s = 0;
};

/// The earliest of these faults in words, with its time; empty if there is none.
std::string first_fault(const std::map<std::string, Acted>& faults);

/// Whether an expectation of the scene was kept.
struct Expected {
  std::string figure;
  double value = 0, low = 0, high = 0;  ///< low and high may be infinite
  int line = 0;                         ///< of the scene file
  bool kept() const { return value >= low && value <= high; }
  std::string wanted() const;  ///< "at most 0", "0.1 to 0.2"
};

/// The summary.
struct Felt {
  bool closed_loop = false;  ///< there was a plant with a hand
  FeltTorque torque;
  FeltEnergy energy;                            ///< only in a closed loop
  std::vector<FeltError> errors;                ///< of the core against quad; empty without quad
  std::map<std::string, Acted> limits, faults;  ///< by name; only those that acted
  /// Voltage or duty were at their limit and no current is measured: the motor gave less than the
  /// observer counts on.
  Acted tau_hat_void;
};

/// How long each bit of a word was set, tick by tick.
class BitTimes {
 public:
  void tick(unsigned word) {
    if (word != word_) {
      settle();
      word_ = word;
    }
    ++run_;
  }
  /// Times by bit name, for the bits that were ever set.
  template <std::size_t N>
  std::map<std::string, Acted> times(const std::array<const char*, N>& names, double tick_s) {
    static_assert(N <= kBits, "a name without a bit");
    settle();
    std::map<std::string, Acted> all;
    for (std::size_t bit = 0; bit < N; ++bit) {
      if (ticks_[bit] == 0) continue;
      all[names[bit]] = {static_cast<double>(ticks_[bit]) * tick_s,
                         static_cast<double>(first_[bit]) * tick_s};
    }
    return all;
  }

 private:
  void settle();

  unsigned word_ = 0;
  std::int64_t run_ = 0, ticks_so_far_ = 0;
  static constexpr std::size_t kBits = 16;
  std::array<std::int64_t, kBits> ticks_{}, first_{};
};

/// Follows a run; felt() gives the summary.
class FeltMeter {
 public:
  /// `measures`: the core has a current loop.
  explicit FeltMeter(double tick_s, bool measures = false);
  /// Whether tau_hat is void with these limits, see Felt.
  bool tau_hat_void(unsigned limits) const;

  /// One step of the plant: the hand's torque on the lever and the lever's velocity.
  void step(double dt_s, double hand_nm, double omega_rad_s) {
    const double work_j = hand_nm * omega_rad_s * dt_s;
    (work_j > 0 ? taken_j_ : returned_j_) += work_j;
    const double net_j = taken_j_ + returned_j_;
    highest_j_ = larger(highest_j_, net_j);
    lowest_j_ = smaller(lowest_j_, net_j);
    hand_nm_s_ += hand_nm * dt_s;
  }
  /// One tick of the core; torques in Nm, bits as in a snapshot.
  void tick(double asked_nm, double commanded_nm, unsigned limits, unsigned faults) {
    asked_.add(asked_nm, ticks_);
    commanded_.add(commanded_nm, ticks_);
    limits_.tick(limits);
    faults_.tick(faults);
    void_.tick(tau_hat_void(limits) ? 1 : 0);
    ++ticks_;
  }
  /// The motor's torque in the tick given last to tick(); only in a closed loop.
  void motor(double motor_nm, double asked_nm) {
    motor_sum_nm_ += motor_nm;
    asked_sum_nm_ += asked_nm;
    if (--window_left_ == 0) end_window();
  }

  /// Mean of the hand's torque over the last complete felt_window_s, Nm; 0 before the first.
  double hand_nm() const { return window_hand_nm_; }

  /// The summary; errors are left empty.
  Felt felt();

 private:
  void end_window();
  struct Highest {
    double magnitude = 0, value = 0;
    std::int64_t tick = 0;
    void add(double v, std::int64_t at) {
      const double m = v < 0 ? -v : v;
      if (m > magnitude) *this = {m, v, at};
    }
  };
  Peak peak(const Highest& h) const { return {h.value, static_cast<double>(h.tick) * tick_s_}; }

  double tick_s_;
  bool measures_;
  std::int64_t window_ticks_;
  std::int64_t window_left_;  ///< ticks left in the window
  std::int64_t ticks_ = 0;
  double hand_nm_s_ = 0, motor_sum_nm_ = 0, asked_sum_nm_ = 0;  ///< sums over the present window
  double window_hand_nm_ = 0;
  double taken_j_ = 0, returned_j_ = 0, highest_j_ = 0, lowest_j_ = 0;
  Highest asked_, commanded_, motor_, hand_;
  ErrorFigure motor_error_;
  BitTimes limits_, faults_, void_;
};

}  // namespace feltgate
