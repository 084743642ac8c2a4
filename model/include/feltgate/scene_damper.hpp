// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/scene_damper.sv: tau = -b * velocity. Documentation: docs/blocks/scene_damper.md
#pragma once

#include <cstdint>

#include "feltgate/chain_formats.hpp"
#include "feltgate/words.hpp"

namespace feltgate {

/// The law, in number policy N, for design D.
template <class D, class N>
struct SceneDamperLaw {
  using Torque = typename N::template num<D::f.torque.key()>;
  using Velocity = typename N::template num<D::f.velocity.key()>;
  /// b * velocity in torque steps, before it is saturated.
  static constexpr Format steps = growth::with_fraction(
      growth::sum(growth::product(D::f.velocity, D::P::damper_damping), Format{1, 0, 0}),
      D::f.torque.fraction);

  /// Rounded, then negated, then saturated: no torque below half a step on either side.
  template <class Product>
  static Torque torque(Product damping_times_velocity) {
    return quantise<N, Torque, Round::truncate, Overflow::saturate>(
        -quantise<N, steps.key(), D::rounding, Overflow::wrap>(damping_times_velocity));
  }
  /// One tick.
  template <class W>
  static Torque torque(const W& w, Velocity velocity) {
    return torque(velocity * w.damper_damping());
  }
};

/// Clocked twin. A wave is: start in clock 1, the product of velocity and damping in 14.
template <class D>
class SceneDamper {
 public:
  using Law = SceneDamperLaw<D, Fixed>;

  struct In {
    bool select = false;  ///< stable during a wave
    bool start = false;
    std::int64_t product = 0;
  };
  struct Out {
    std::int64_t tau = 0;
  };

  void reset() { *this = SceneDamper{}; }

  void clock(const In& in) {
    if ((stage_ & stage(18)) != 0) out_.tau = in.select ? torque_.raw() : 0;
    if ((stage_ & stage(14)) != 0) torque_ = Law::torque(Product::from_raw(in.product));
    stage_ = (stage_ << 1) | (in.start ? 1u : 0u);
  }

  /// A whole wave at once.
  void tick(const Words<D, Fixed>& w, bool select, typename Law::Velocity velocity) {
    out_.tau = select ? Law::torque(w, velocity).raw() : 0;
  }

  const Out& out() const { return out_; }

 private:
  using Product = decltype(typename Law::Velocity{} * fixed_of<D::P::damper_damping.key()>{});
  static constexpr std::uint32_t stage(int clock) { return 1u << (clock - 2); }

  std::uint32_t stage_ = 0;
  typename Law::Torque torque_{};
  Out out_;
};

}  // namespace feltgate
