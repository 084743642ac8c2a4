// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Torque controllers around the twin's chain, in number policy N: each makes the torque that the
// voltage law is asked for, from the scene's torque, tau_hat and the estimated velocity. They use
// the multiplier's widths and the rounding of the core. Documentation: docs/controllers.md
#pragma once

#include <cmath>

#include "feltgate/chain_tick.hpp"
#include "sim/reference/real_chain.hpp"

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

}  // namespace feltgate::controllers
