// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A chain with some blocks in fixed point and the others in 113 bits. It shows the effect of one
// block's quantisation alone. Documentation: docs/error-bounds.md
#pragma once

#include "sim/loop/scene_law.hpp"
#include "sim/reference/chain.hpp"

namespace feltgate::bounds {

/// Additional fraction bits of a port from a block in real numbers to one in fixed point. The value
/// is rounded 24 bits finer than in the core, so that the port's rounding counts only in the block
/// that makes it.
constexpr int finer_bits = 24;

constexpr Format finer(Format f) { return {f.sign, f.integer, f.fraction + finer_bits}; }

/// Design D with a finer velocity for the scenes.
template <class D>
struct FineVelocity : D {
  static constexpr Formats formats() {
    Formats f = D::f;
    f.velocity = finer(f.velocity);
    return f;
  }
  static constexpr Formats f = formats();
};

constexpr Quad two_to(int k) {
  Quad x = 1;
  for (; k > 0; --k) x *= 2;
  for (; k < 0; ++k) x /= 2;
  return x;
}

template <int S, int I, int F>
Quad to_quad(fixed<S, I, F> x) {
  constexpr Quad step = two_to(-F);
  return static_cast<Quad>(x.raw()) * step;
}
inline Quad to_quad(Quad x) { return x; }

/// x as a number of format Key: exact from fixed point where it fits, else rounded to nearest.
template <int Key, class X>
fixed_of<Key> to_fixed(X x) {
  using To = fixed_of<Key>;
  if constexpr (std::is_same_v<X, Quad>) {
    constexpr Quad steps = two_to(To::format.fraction);
    const Quad scaled = x * steps;
    if (scaled >= static_cast<Quad>(To::max_raw())) return To::max();
    if (scaled <= static_cast<Quad>(To::min_raw())) return To::min();
    const Quad half = static_cast<Quad>(scaled < 0 ? -0.5 : 0.5);
    return To::from_raw(static_cast<typename To::raw_type>(scaled + half));
  } else {
    return narrow<To, Round::truncate, Overflow::saturate>(x);
  }
}

/// Source of the coefficients of the blocks in real arithmetic.
enum class Coefficients {
  quantised,  ///< the core's integers
  exact,      ///< the design's values, with its 2^n
  exact_gain  ///< the design's values, with 2*pi/(Er*Tp*m1) instead of 2^n
};

/// Runs design D tick by tick; the flags select the blocks in fixed point.
template <class D, bool VelocityN, bool DobBlock, bool ScenesBlock, bool ControlBlock>
class MixedChain {
 public:
  explicit MixedChain(Coefficients coefficients) : coefficients_(coefficients) {
    for (const ParameterInfo& p : D::parameters) set_parameter(p, p.si);
    gain_ = raw_gain();
  }

  void set_parameter(const ParameterInfo& p, double value) {
    const std::int64_t raw = quantise_parameter(p, value);
    fixed_words_.set_raw(p.address, raw);
    const bool quantised = coefficients_ == Coefficients::quantised;
    real_words_.set_value(
        p.address,
        static_cast<Quad>(quantised ? std::ldexp(static_cast<double>(raw), -p.format.fraction)
                                    : value));
  }

  void tick(const ChainIn& in) {
    estimate(in.travel);
    observe(in);
    if (in.restart) scenes_.ramp().restart();
    scenes_.tick(words<ScenesBlock>(), in.armed, in.scene, scene_position(in.position),
                 input<ScenesBlock, finer(D::f.velocity).key()>(velocity_), in.relief);
    control_.tick(words<ControlBlock>(), in.armed, static_cast<Mode>(in.mode),
                  input<ControlBlock, finer(D::f.torque).key()>(scenes_.tau_ref()),
                  input<ControlBlock, finer(D::f.torque).key()>(tau_hat_),
                  input<ControlBlock, finer(D::f.velocity).key()>(velocity_));
  }

  /// Sets the torque that a program asks for [Nm], for the scene law in the following ticks.
  void program(double torque_nm) {
    if constexpr (ScenesBlock) {
      scenes_.program(to_fixed<D::f.torque.key()>(static_cast<Quad>(torque_nm)));
    } else {
      scenes_.program(static_cast<Quad>(torque_nm));
    }
  }
  /// The measurements for a law that runs on this chain. The words have the core's formats.
  LawSample sample() const {
    LawSample s{static_cast<double>(velocity()), static_cast<double>(tau_hat())};
    if constexpr (ScenesBlock) {
      s.velocity = to_fixed<D::f.velocity.key()>(velocity_).raw();
      s.tau_hat = static_cast<std::int32_t>(to_fixed<D::f.torque.key()>(tau_hat_).raw());
    }
    return s;
  }

  Quad velocity() const { return to_quad(velocity_); }
  Quad tau_hat() const { return to_quad(tau_hat_); }
  Quad tau_ref() const { return to_quad(scenes_.tau_ref()); }
  bool ramping() const { return scenes_.limit_ramp(); }
  Quad current() const { return to_quad(control_.current); }

 private:
  template <bool InFixed>
  using Policy = std::conditional_t<InFixed, Fixed, Real<Quad>>;
  using Velocity = VelocityLaw<D, Policy<VelocityN>>;
  using Observer = DobLaw<D, Policy<DobBlock>>;
  using ScenesDesign = std::conditional_t<ScenesBlock, FineVelocity<D>, D>;

  template <bool InFixed>
  const auto& words() const {
    if constexpr (InFixed) {
      return fixed_words_;
    } else {
      return real_words_;
    }
  }
  template <bool InFixed, int Key, class X>
  static auto input(X x) {
    if constexpr (InFixed) {
      return to_fixed<Key>(x);
    } else {
      return to_quad(x);
    }
  }
  /// The scenes' position. Beyond 18 bits no bound holds; both kinds of scenes get the same value.
  static std::int32_t scene_position(std::int32_t position) {
    constexpr std::int32_t end = (1 << (D::f.scene_position.width() - 1)) - 1;
    return std::clamp(position, -end - 1, end);
  }
  Quad raw_gain() const {
    const Quad exact = static_cast<Quad>(D::count_rad) * static_cast<Quad>(D::tick_hz) / D::m1;
    if (coefficients_ == Coefficients::exact_gain) return exact;
    if (D::velocity_gain == 0) return static_cast<Quad>(1 << D::velocity_shift);
    if (coefficients_ == Coefficients::exact) return static_cast<Quad>(D::velocity_gain_rad_s);
    return static_cast<Quad>(
        std::ldexp(static_cast<double>(D::velocity_gain), -D::velocity_gain_f));
  }

  void estimate(std::int16_t travel) {
    const std::int16_t counts = travel_difference(travel, line_.oldest());
    line_.push(travel);
    const auto a1 = words<VelocityN>().velocity_a1();
    if constexpr (VelocityN) {
      bool saturated = false;
      const auto operand = Velocity::Filter::operand(Velocity::raw(counts, &saturated), velocity_);
      velocity_ = Velocity::Filter::next(velocity_, operand * a1);
    } else {
      velocity_ = Velocity::Filter::next(velocity_,
                                         Velocity::Filter::operand(gain_ * counts, velocity_) * a1);
    }
  }
  /// Measured, which is exact, or the reference of the tick before.
  auto current_of(const ChainIn& in) const {
    if constexpr (D::current_loop != 0) {
      return static_cast<Quad>(std::ldexp(motor_current<D>(in.current), -D::f.current.fraction));
    } else {
      return control_.current;
    }
  }
  void observe(const ChainIn& in) {
    const bool armed = in.armed;
    const auto& w = words<DobBlock>();
    const auto current = input<DobBlock, finer(D::f.current).key()>(current_of(in));
    const auto velocity = input<DobBlock, finer(D::f.velocity).key()>(velocity_);
    const auto drive =
        armed ? Observer::drive(current * w.torque_constant()) : typename Observer::Drive{};
    const auto inertia = Observer::inertia(velocity * w.inertia_gain());
    const auto sum = Observer::input(drive, inertia);
    const auto a1 = w.observer_a1();
    observer_ =
        armed ? Observer::Filter::next(observer_, Observer::Filter::operand(sum, observer_) * a1)
              : sum;
    bool saturated = false;
    tau_hat_ = Observer::tau_hat(observer_, inertia, &saturated);
  }

  Coefficients coefficients_;
  Quad gain_ = 0;
  Words<D, Fixed> fixed_words_;
  Words<D, Real<Quad>> real_words_;
  DelayLine<D::m1> line_;
  typename Velocity::Velocity velocity_{};
  typename Observer::State observer_{};
  typename Observer::Torque tau_hat_{};
  ScenesLaw<ScenesDesign, Policy<ScenesBlock>> scenes_;
  TorqueControlStep<D, Policy<ControlBlock>> control_;
};

}  // namespace feltgate::bounds
