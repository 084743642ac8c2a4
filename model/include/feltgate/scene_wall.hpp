// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/scene_wall.sv: a unilateral spring-damper, tau = k * (contact - position) - b *
// velocity above the contact, never a pull. Documentation: docs/blocks/scene_wall.md
#pragma once

#include <cstdint>

#include "feltgate/words.hpp"

namespace feltgate {

/// The law, in number policy N, for design D.
template <class D, class N>
struct SceneWallLaw {
  using Torque = typename N::template num<D::f.torque.key()>;
  using Offset = typename N::template num<D::f.scene_offset.key()>;
  using Velocity = typename N::template num<D::f.velocity.key()>;
  /// Bits that either product keeps below a torque step; one rounding follows their difference.
  static constexpr int guard_bits = D::wall_guard_bits;
  /// k * operand and b * velocity [Nm]; neither can overflow it.
  static constexpr Format part{
      1,
      growth::max_of(growth::product(D::f.scene_offset, D::P::wall_stiffness).integer,
                     growth::product(D::f.velocity, D::P::wall_damping).integer),
      D::f.torque.fraction + guard_bits};
  using Part = typename N::template num<part.key()>;

  /// contact - position [count], saturated; negative inside the wall.
  static Offset operand(std::int32_t position, Offset contact) {
    return quantise<N, Offset, Round::truncate, Overflow::saturate>(
        contact - from_integer<N, D::f.scene_position.key()>(position));
  }
  /// One product, its bits below the guard bits dropped.
  template <class Product>
  static Part cut(Product product) {
    return quantise<N, Part, Round::truncate, Overflow::wrap>(product);
  }
  /// The difference rounded and saturated; 0 outside, and where the wall would pull.
  static Torque torque(Offset operand, Part k_times_operand, Part b_times_velocity) {
    if (!(operand < Offset{})) return Torque{};
    const Torque tau =
        quantise<N, Torque, D::rounding, Overflow::saturate>(k_times_operand - b_times_velocity);
    return tau < Torque{} ? tau : Torque{};
  }
  /// One tick.
  template <class W>
  static Torque torque(const W& w, std::int32_t position, Velocity velocity) {
    const Offset x = operand(position, w.wall_contact());
    return torque(x, cut(x * w.wall_stiffness()), cut(velocity * w.wall_damping()));
  }
};

/// Clocked twin. A wave is: start and the contact in clock 1, the product of operand and stiffness
/// in 7, that of velocity and damping in 14.
template <class D>
class SceneWall {
 public:
  using Law = SceneWallLaw<D, Fixed>;

  struct In {
    bool select = false;  ///< stable during a wave
    bool start = false;
    std::int32_t position = 0;  ///< counts, 18 bits, stable during a wave
    std::uint32_t param = 0;
    std::int64_t product = 0;
  };
  struct Out {
    std::int64_t operand = 0;
    std::int64_t tau = 0;
  };

  void reset() { *this = SceneWall{}; }

  void clock(const In& in) {
    if ((stage_ & stage(18)) != 0) out_.tau = in.select ? torque_.raw() : 0;
    if ((stage_ & stage(14)) != 0) {
      torque_ = Law::torque(Offset::from_raw(out_.operand), spring_,
                            Law::cut(Damping::from_raw(in.product)));
    }
    if ((stage_ & stage(7)) != 0) spring_ = Law::cut(Stiffness::from_raw(in.product));
    if ((stage_ & stage(2)) != 0) out_.operand = Law::operand(in.position, contact_).raw();
    if (in.start) contact_ = Offset::from_raw(decode_word(D::f.scene_offset, in.param));
    stage_ = (stage_ << 1) | (in.start ? 1u : 0u);
  }

  /// A whole wave at once.
  void tick(const Words<D, Fixed>& w, bool select, std::int32_t position,
            typename Law::Velocity velocity) {
    out_.tau = select ? Law::torque(w, position, velocity).raw() : 0;
  }

  const Out& out() const { return out_; }

 private:
  using Offset = typename Law::Offset;
  using Stiffness = decltype(Offset{} * fixed_of<D::P::wall_stiffness.key()>{});
  using Damping = decltype(typename Law::Velocity{} * fixed_of<D::P::wall_damping.key()>{});
  static constexpr std::uint32_t stage(int clock) { return 1u << (clock - 2); }

  std::uint32_t stage_ = 0;
  Offset contact_{};
  typename Law::Part spring_{};
  typename Law::Torque torque_{};
  Out out_;
};

}  // namespace feltgate
