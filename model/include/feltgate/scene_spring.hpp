// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/scene_spring.sv: tau = k * (reference - position), in tension both ways, in
// compression only below the contact. Documentation: docs/blocks/scene_spring.md
#pragma once

#include <cstdint>

#include "feltgate/words.hpp"

namespace feltgate {

/// The law, in number policy N, for design D.
template <class D, class N>
struct SceneSpringLaw {
  using Torque = typename N::template num<D::f.torque.key()>;
  using Offset = typename N::template num<D::f.scene_offset.key()>;

  /// reference - position [count], saturated.
  static Offset operand(std::int32_t position, Offset reference) {
    return quantise<N, Offset, Round::truncate, Overflow::saturate>(
        reference - from_integer<N, D::f.scene_position.key()>(position));
  }
  /// k * operand, rounded and saturated; a compressed spring only pushes.
  template <class Product>
  static Torque torque(Offset operand, Product k_times_operand, bool tension) {
    if (!tension && operand < Offset{}) return Torque{};
    return quantise<N, Torque, D::rounding, Overflow::saturate>(k_times_operand);
  }
  /// One tick.
  template <class W>
  static Torque torque(const W& w, bool tension, std::int32_t position) {
    const Offset x = operand(position, tension ? w.tension_rest() : w.compression_contact());
    if (tension) return torque(x, x * w.tension_stiffness(), true);
    return torque(x, x * w.compression_stiffness(), false);
  }
};

/// Clocked twin. A wave is: start and the reference in clock 1, the product of operand and
/// stiffness in 7.
template <class D>
class SceneSpring {
 public:
  using Law = SceneSpringLaw<D, Fixed>;

  struct In {
    bool select = false;  ///< stable during a wave, as is tension
    bool tension = false;
    bool start = false;
    std::int32_t position = 0;  ///< counts, 18 bits, stable during a wave
    std::uint32_t param = 0;
    std::int64_t product = 0;
  };
  struct Out {
    std::int64_t operand = 0;
    std::int64_t tau = 0;
  };

  void reset() { *this = SceneSpring{}; }

  void clock(const In& in) {
    if ((stage_ & stage(11)) != 0) out_.tau = in.select ? torque_.raw() : 0;
    if ((stage_ & stage(7)) != 0) {
      const Offset x = Offset::from_raw(out_.operand);
      torque_ = in.tension ? Law::torque(x, Tension::from_raw(in.product), true)
                           : Law::torque(x, Compression::from_raw(in.product), false);
    }
    if ((stage_ & stage(2)) != 0) out_.operand = Law::operand(in.position, reference_).raw();
    if (in.start) reference_ = Offset::from_raw(decode_word(D::f.scene_offset, in.param));
    stage_ = (stage_ << 1) | (in.start ? 1u : 0u);
  }

  /// A whole wave at once.
  void tick(const Words<D, Fixed>& w, bool select, bool tension, std::int32_t position) {
    out_.tau = select ? Law::torque(w, tension, position).raw() : 0;
  }

  const Out& out() const { return out_; }

 private:
  using Offset = typename Law::Offset;
  using Tension = decltype(Offset{} * fixed_of<D::P::tension_stiffness.key()>{});
  using Compression = decltype(Offset{} * fixed_of<D::P::compression_stiffness.key()>{});
  static constexpr std::uint32_t stage(int clock) { return 1u << (clock - 2); }

  std::uint32_t stage_ = 0;
  Offset reference_{};
  typename Law::Torque torque_{};
  Out out_;
};

}  // namespace feltgate
