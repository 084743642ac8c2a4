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
#include "feltgate/chain_tick.hpp"
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

/// Formats of the controllers' words; the torques are those of design D.
template <class D, class N>
struct LawNumbers {
  static constexpr Format gain{1, 2, 15};     ///< a coefficient of the multiplier
  static constexpr Format rate{0, -10, 27};   ///< small coefficient, as observer_a1
  static constexpr Format state{1, 4, 30};    ///< Nm, with the fraction of the observer
  static constexpr Format operand{1, 5, 29};  ///< difference of two states on the multiplier
  static constexpr Format filter = Format{0, 0, 17};  ///< a1 of the derivative's filter

  template <const Format& F>
  using Word = typename N::template num<F.key()>;
  using Torque = typename N::template num<D::f.torque.key()>;
  using Velocity = typename N::template num<D::f.velocity.key()>;
  using State = Word<state>;
  using Filter = LowpassLaw<N, state.key(), operand.key(), D::rounding>;

  /// A value as a word, to nearest.
  template <class X>
  static X word(double value) {
    if constexpr (N::is_fixed) {
      return N::template from_raw<X::format.key()>(
          std::llround(std::ldexp(value, X::format.fraction)));
    } else {
      return static_cast<X>(value);
    }
  }
  template <class X>
  static State state_of(X x) {
    return quantise<N, State, D::rounding, Overflow::saturate>(x);
  }
  template <class X>
  static Torque torque_of(X x) {
    return quantise<N, Torque, D::rounding, Overflow::saturate>(x);
  }
  template <class X>
  static X within(X x, X limit) {
    return x > limit ? limit : x < negated(limit) ? negated(limit) : x;
  }
};

/// The chain as it is: the observer is fed back by the word observer_gain, or not at all.
template <class D, class N>
struct AsIs {
  static constexpr int state_bits = 0, multiplications = 0;
  using L = LawNumbers<D, N>;
  explicit AsIs(const Tuning&) {}
  void reset() {}
  typename L::Torque tick(typename L::Torque ref, typename L::Torque, typename L::Velocity) {
    return ref;
  }
};

/// u = P*e + I*sum(e) + D*(e - lowpass(e)), e = tau_ref - tau_hat. Its zeros are the observer's
/// cut-off and, with a derivative, the winding's R/L.
template <class D, class N, bool Derivative>
class PidLaw {
 public:
  using L = LawNumbers<D, N>;
  static constexpr int state_bits = (Derivative ? 2 : 1) * L::state.width();
  static constexpr int multiplications = Derivative ? 4 : 2;

  explicit PidLaw(const Tuning& t) {
    // Share * (s + g)(1 + s*a) / (s*(1 + s*b)) in parts; without a derivative a = b = 0.
    const double a = Derivative ? t.winding_s : 0.0, b = a / derivative_filter;
    const double g = t.cutoff_rad_s, p = t.share * (1 + g * (a - b));
    proportional_ = L::template word<decltype(proportional_)>(p);
    integral_gain_ = L::template word<decltype(integral_gain_)>(t.share * g * t.tick_s);
    limit_ = L::template word<decltype(limit_)>(t.limit_nm);
    if constexpr (Derivative) {
      derivative_ = L::template word<decltype(derivative_)>((t.share * a - p * b) / b);
      filter_ = L::template word<decltype(filter_)>(-std::expm1(-t.tick_s / b));
    }
  }
  void reset() { integral_ = slow_ = {}; }
  typename L::Torque tick(typename L::Torque ref, typename L::Torque hat, typename L::Velocity) {
    const auto error = ref - hat;
    integral_ = L::within(L::state_of(integral_ + error * integral_gain_), limit_);
    if constexpr (!Derivative) return L::torque_of(integral_ + error * proportional_);
    const auto now = L::state_of(error);
    slow_ = L::Filter::template step<L::filter.key()>(now, slow_, filter_);
    const auto fast = L::Filter::operand(now, slow_);
    return L::torque_of(integral_ + error * proportional_ + fast * derivative_);
  }

 private:
  typename L::State integral_{}, slow_{}, limit_{};
  typename L::template Word<L::gain> proportional_{}, derivative_{};
  typename L::template Word<L::rate> integral_gain_{};
  typename L::template Word<L::filter> filter_{};
};

template <class D, class N>
using PiLaw = PidLaw<D, N, false>;
template <class D, class N>
using PidWithDerivative = PidLaw<D, N, true>;

/// u = tau_ref + lowpass(tau_ref) - (tau_hat - friction): the observer without the friction that it
/// sees is the reaction of the hand, which then follows tau_ref. The low-pass is the observer's.
template <class D, class N>
class ReactionLaw {
 public:
  using L = LawNumbers<D, N>;
  static constexpr int state_bits = L::state.width();
  static constexpr int multiplications = 2;

  explicit ReactionLaw(const Tuning& t)
      : filter_(L::template word<decltype(filter_)>(-std::expm1(-t.cutoff_rad_s * t.tick_s))),
        slope_(L::template word<decltype(slope_)>(t.friction_nm / friction_from_rad_s)),
        friction_(L::template word<decltype(friction_)>(t.friction_nm)) {}
  void reset() { slow_ = {}; }
  typename L::Torque tick(typename L::Torque ref, typename L::Torque hat, typename L::Velocity w) {
    slow_ = L::Filter::template step<L::rate.key()>(L::state_of(ref), slow_, filter_);
    const auto friction = L::within(L::torque_of(w * slope_), friction_);
    return L::torque_of(ref + slow_ - hat + friction);
  }

 private:
  typename L::State slow_{};
  typename L::template Word<L::rate> filter_{};
  typename L::template Word<L::gain> slope_{};
  typename L::Torque friction_{};
};

/// The twin's chain with a controller between the scene and the voltage law; a drop-in for
/// ControlChain.
template <class D, class N, template <class, class> class Law>
class ControlledChain : public ChainTick<D, N> {
 public:
  void tune(const Tuning& t) { law_ = Law<D, N>(t); }
  void reset() {
    ChainTick<D, N>::reset();
    this->words().reset();
    law_.reset();
  }
  void tick(const ChainIn& in) {
    if (in.restart) this->restart();
    this->estimate(in.travel);
    this->observe(in.armed);
    this->render(in.armed, in.scene, in.position, in.relief);
    if (!in.armed) law_.reset();
    this->drive(in.armed, static_cast<Mode>(in.mode),
                law_.tick(this->tau_ref(), this->tau_hat(), this->velocity()));
  }

 private:
  Law<D, N> law_{Tuning{1, 1, 1, 1, 0, 0, 1}};  // until tune()
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
