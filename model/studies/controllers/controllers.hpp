// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The disturbance observer beside feed-forward, PI, PID and a reaction-torque observer: the same
// plant, voltage law and experiments for all. Documentation: docs/speed-for-accuracy.md
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "design/design.hpp"
#include "feltgate/axis/design.hpp"
#include "sim/loop/figures.hpp"
#include "sim/plant/parameters.hpp"
#include "sim/reference/real_chain.hpp"
#include "studies/stability/bit_loop.hpp"

namespace feltgate::controllers {

/// What the controllers are tuned to, all for the same pole at stall.
struct Tuning {
  double share = 0.0;         ///< Jn*Kp: of the torque that goes to the motor at once
  double cutoff_rad_s = 0.0;  ///< of the observer
  double tick_s = 0.0;
  double winding_s = 0.0;    ///< L/R, whose pole the PID cancels
  double friction_nm = 0.0;  ///< Coulomb, compensated by the reaction observer
  double limit_nm = 0.0;     ///< of an integral
  double torque_constant_nm_a = 0.0;
};

/// The PID's derivative is filtered at this many times R/L.
constexpr double derivative_filter = 4.0;
/// Below this speed the compensated friction is linear in the speed, so that one count of noise
/// does not switch it.
constexpr double friction_from_rad_s = 1.0;

/// Arithmetic of the controllers. Torques come and go in the design's format; states have the
/// fraction of the observer.
template <class N>
struct Numbers {
  using T = typename N::T;
  static constexpr int gain_f = 15, rate_f = 27, filter_f = 17;  ///< coefficients of 18 bits
  static constexpr int state_f = 30, operand_f = 29;             ///< Nm
  static constexpr int state_bits = 35;

  explicit Numbers(const axis::Design& d)
      : torque_f(d["TORQUE_F"]),
        velocity_f(d["VELOCITY_F"]),
        torque_w(d["TORQUE_W"]),
        rounding(d.rounding()) {}

  T state_of(T torque) const {
    return N::saturate(N::scale(torque, state_f - torque_f), axis::Bits(state_bits));
  }
  /// The state y + x, where x has more fraction bits.
  T added(T y, T x, int fraction) const {
    return N::add_rounded(y, x, axis::Drop(fraction - state_f, rounding));
  }
  T torque_of(T x, int fraction) const {
    return N::saturate(N::add_rounded(0, x, axis::Drop(fraction - torque_f, rounding)), torque_w);
  }
  /// The difference of two states as the multiplier takes it.
  static T operand(T x, T y) { return N::scale(x - y, operand_f - state_f); }

  int torque_f, velocity_f;
  axis::Bits torque_w;
  axis::Rounding rounding;
};

/// u = P*e + I*sum(e) + D*(e - lowpass(e)), e = tau_ref - tau_hat. Its zeros are the observer's
/// cut-off and, with a derivative, the winding's R/L.
template <class N, bool Derivative>
class PidLaw {
 public:
  using L = Numbers<N>;
  using T = typename N::T;
  static constexpr int state_bits = (Derivative ? 2 : 1) * L::state_bits;
  static constexpr int multiplications = Derivative ? 4 : 2;

  PidLaw(const axis::Design& d, const Tuning& t) : n_(d) {
    // Share * (s + g)(1 + s*a) / (s*(1 + s*b)) in parts; without a derivative a = b = 0.
    const double a = Derivative ? t.winding_s : 0.0, b = a / derivative_filter;
    const double g = t.cutoff_rad_s, p = t.share * (1 + g * (a - b));
    proportional_ = N::of(p, L::gain_f);
    integral_gain_ = N::of(t.share * g * t.tick_s, L::rate_f);
    limit_ = N::of(t.limit_nm, L::state_f);
    if constexpr (Derivative) {
      derivative_ = N::of((t.share * a - p * b) / b, L::gain_f);
      filter_ = N::of(-std::expm1(-t.tick_s / b), L::filter_f);
    }
  }
  void reset() { integral_ = slow_ = 0; }
  T tick(T ref, T hat, T) {
    const T error = ref - hat;
    const T sum = n_.added(integral_, error * integral_gain_, n_.torque_f + L::rate_f);
    integral_ = N::limited(N::saturate(sum, axis::Bits(L::state_bits)), limit_);
    const int product_f = n_.torque_f + L::gain_f;
    const T proportional = N::scale(integral_, product_f - L::state_f) + error * proportional_;
    if constexpr (!Derivative) return n_.torque_of(proportional, product_f);
    const T now = n_.state_of(error);
    slow_ = n_.added(slow_, L::operand(now, slow_) * filter_, L::operand_f + L::filter_f);
    constexpr int fast_f = L::operand_f + L::gain_f;
    const T fast = L::operand(now, slow_) * derivative_;
    return n_.torque_of(N::scale(proportional, fast_f - product_f) + fast, fast_f);
  }

 private:
  L n_;
  T integral_ = 0, slow_ = 0, limit_ = 0;
  T proportional_ = 0, derivative_ = 0, integral_gain_ = 0, filter_ = 0;
};

template <class N>
using PiLaw = PidLaw<N, false>;
template <class N>
using PidWithDerivative = PidLaw<N, true>;

/// u = tau_ref + lowpass(tau_ref) - (tau_hat - friction): the observer without the friction that it
/// sees is the reaction of the hand, which then follows tau_ref. The low-pass is the observer's.
template <class N>
class ReactionLaw {
 public:
  using L = Numbers<N>;
  using T = typename N::T;
  static constexpr int state_bits = L::state_bits;
  static constexpr int multiplications = 2;

  ReactionLaw(const axis::Design& d, const Tuning& t)
      : n_(d),
        filter_(N::of(-std::expm1(-t.cutoff_rad_s * t.tick_s), L::rate_f)),
        slope_(N::of(t.friction_nm / friction_from_rad_s, L::gain_f)),
        friction_(N::of(t.friction_nm, n_.torque_f)) {}
  void reset() { slow_ = 0; }
  T tick(T ref, T hat, T w) {
    const T now = n_.state_of(ref);
    slow_ = n_.added(slow_, L::operand(now, slow_) * filter_, L::operand_f + L::rate_f);
    const T friction = N::limited(n_.torque_of(w * slope_, n_.velocity_f + L::gain_f), friction_);
    const axis::Exponent to_state = L::state_f - n_.torque_f;
    return n_.torque_of(
        N::scale(ref, to_state) + slow_ - N::scale(hat, to_state) + N::scale(friction, to_state),
        L::state_f);
  }

 private:
  L n_;
  T slow_ = 0, filter_, slope_, friction_;
};

enum class Kind { observer, feed_forward, pi, pid, reaction };
constexpr std::array<Kind, 5> kinds{Kind::observer, Kind::feed_forward, Kind::pi, Kind::pid,
                                    Kind::reaction};
const char* name_of(Kind kind);

/// Size of a controller: what it needs beside the velocity estimate and the voltage law.
struct Size {
  int multiplications = 0;  ///< a tick, from velocity and tau_ref to the current
  int state_bits = 0;
  int lut4 = 0;      ///< ECP5 LUT4 equivalents, measured and estimated
  int measured = 0;  ///< of it measured by synthesis
};
Size size_of(Kind kind);

/// The paper's Jn*Kp, a share of 1 would be feed-forward.
constexpr double paper_share = 0.78336;

/// Design `lever` with its constants, the two plants, and lines of the encoder other than its own.
struct Bench {
  design::Elaborated design;
  plant::Parameters plant;   ///< with friction, dead voltage and dead time
  plant::Parameters linear;  ///< without: for borders and closed forms
};
/// The friction is that of `plant`, if it has any.
Tuning tuning_of(const Bench& bench, const plant::Parameters& plant);
/// Numbers of lines that a chain exists for; the first is that of `lever`.
constexpr std::array<int, 4> encoder_lines{1024, 500, 2500, 10000};
/// A controller's chain, in fixed point or double. Throws std::invalid_argument for other lines.
std::unique_ptr<RealChain> make_chain(Kind kind, bool fixed, const Tuning& tuning,
                                      int lines = 1024);

/// One experiment: a controller, a plant, a hand.
struct Trial {
  Kind kind = Kind::observer;
  bool fixed = true;
  plant::Parameters plant;
  plant::Hand hand;
  int lines = 1024;
  stability::Wall wall{};  ///< the core's, where no torque is given
};
/// Runs for `seconds`; `reference` gives the torque at a time, empty: the wall does. `look` sees
/// the loop after every tick.
void run(const Bench& bench, const Trial& trial, double seconds,
         const std::function<double(double time_s)>& reference,
         const std::function<void(double time_s, const stability::BitLoop&)>& look);

/// Motor torque after a step of tau_ref to 0.2 Nm with the lever locked.
StepResponse stall_step(const Bench& bench, Kind kind, bool fixed, const plant::Parameters& plant,
                        std::vector<double>* trace_nm = nullptr);
/// Inertia that a hand feels which pushes the free, frictionless lever with a step of 0.02 Nm, as a
/// multiple of the lever's own: push over mean acceleration from 10 to 20 ms.
double felt_inertia(const Bench& bench, Kind kind, bool fixed);

/// What the hand feels of a step of tau_ref to 0.2 Nm, from 10 to 150 ms.
struct Held {
  double error_rms_pct = 0, error_max_pct = 0;  ///< of the torque at the grip, in % of the step
};
/// A hand with its mass and damping and a stiffness; `inertia_ratio` is Jn/J.
Held held_step(const Bench& bench, Kind kind, bool fixed, double stiffness_nm_rad,
               double inertia_ratio = 1.0, std::vector<double>* trace_nm = nullptr);

constexpr double tremor_hz = 8, tremor_rad = 5e-4;
/// Motor torque, rms around its mean, with tau_ref = 0.1 Nm, while a hand at rest trembles over an
/// edge of the encoder.
double tremor_noise_nm(const Bench& bench, Kind kind, bool fixed, int lines);

/// The stiffest wall that is tried, Nm/rad: the wall's word ends at 80.
constexpr double stiffest_nm_rad = 64;
/// Largest wall that does not make the pressed lever swing, Nm/rad; 0: no wall. Damping 0.005
/// Nm s/rad, frictionless. `inertia_ratio` is Jn/J.
double border(const Bench& bench, Kind kind, bool fixed, double inertia_ratio = 1.0);
/// The same while a hand (0.55 kg, 1.35 Nm/rad) leans on the wall, with friction: the swing stays
/// under three counts. `damping` scales that of the hand and its grip.
double held_border(const Bench& bench, Kind kind, bool fixed, double damping = 1.0);

/// A figure in fixed point and in double.
struct Pair {
  double fixed = 0, real = 0;
};
struct Row {
  Kind kind = Kind::observer;
  Pair settling_ms, error_pct, error_r_pct, error_kt_pct;  ///< at stall
  Pair felt_inertia, noise_nm, border_nm_rad, held_border_nm_rad;
  Pair light_border_nm_rad;      ///< held, with `light_damping` of the hand's damping
  std::vector<Held> held;        ///< for each of `stiffness_nm_rad`
  std::vector<Held> inertia;     ///< for each of `inertia_ratios`, at 2 Nm/rad
  std::vector<double> borders;   ///< for each of `inertia_ratios`
  std::vector<double> noise_of;  ///< for each of `noise_lines`
  std::vector<double> stall_trace_nm, held_trace_nm;  ///< motor at stall, grip at 2 Nm/rad
};
constexpr double light_damping = 0.1;
constexpr std::array<double, 6> stiffness_nm_rad{0, 1, 2, 5, 10, 20};
constexpr std::array<double, 4> inertia_ratios{0.5, 1, 2, 4};
constexpr std::array<int, 4> noise_lines{500, 1024, 2500, 10000};
constexpr double stall_trace_s = 1e-4, held_trace_s = 1e-3;  ///< sampling of the traces

struct Report {
  std::vector<Row> rows;
};
/// All experiments with all controllers. `progress` gets the completed share; it may be empty.
Report measure(const Bench& bench, const std::function<void(double)>& progress = {});

/// The tables as Markdown, as they stand in docs/speed-for-accuracy.md.
std::string report_text(const Report& report);
std::string report_json(const Report& report);

}  // namespace feltgate::controllers
