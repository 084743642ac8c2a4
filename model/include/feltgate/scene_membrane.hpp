// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/scene_membrane.sv: between two faces a constant torque drives the lever back to the
// side from which it came. Documentation: docs/blocks/scene_membrane.md
#pragma once

#include <cstdint>

#include "feltgate/words.hpp"

namespace feltgate {

/// What a membrane remembers: the side on which the lever was last seen.
enum class MembraneSide : std::uint8_t {
  unknown,  ///< nowhere outside yet since the scene was selected: no torque
  below,
  above
};

/// The law, in number policy N, for design D.
template <class D, class N>
struct SceneMembraneLaw {
  using Torque = typename N::template num<D::f.torque.key()>;
  using Offset = typename N::template num<D::f.scene_offset.key()>;

  /// Where the position is: below, above, or unknown for inside. Both faces belong to the inside.
  static MembraneSide where(std::int32_t position, Offset lower, Offset upper) {
    const auto theta = from_integer<N, D::f.scene_position.key()>(position);
    if (theta < lower) return MembraneSide::below;
    if (theta > upper) return MembraneSide::above;
    return MembraneSide::unknown;
  }
  /// Torque inside for a lever that came from `side`. A negative magnitude counts as 0.
  static Torque inside(MembraneSide side, Torque magnitude) {
    if (magnitude < Torque{} || side == MembraneSide::unknown) return Torque{};
    return side == MembraneSide::above ? magnitude : negated(magnitude);
  }
  /// One tick; moves `side` on.
  template <class W>
  static Torque torque(const W& w, std::int32_t position, MembraneSide* side) {
    const MembraneSide now = where(position, w.membrane_lower(), w.membrane_upper());
    if (now != MembraneSide::unknown) {
      *side = now;
      return Torque{};
    }
    return inside(*side, w.membrane_torque());
  }
};

/// Clocked twin. A wave is: start and the lower face in clock 1, the upper face in 2, the torque
/// in 10.
template <class D>
class SceneMembrane {
 public:
  using Law = SceneMembraneLaw<D, Fixed>;

  struct In {
    bool select = false;  ///< stable during a wave
    bool start = false;
    std::int32_t position = 0;  ///< counts, 18 bits, stable during a wave
    std::uint32_t param = 0;
  };
  struct Out {
    std::int64_t tau = 0;
  };

  void reset() { *this = SceneMembrane{}; }

  void clock(const In& in) {
    if ((stage_ & stage(13)) != 0) {
      const bool engaged = in.select && now_ == MembraneSide::unknown;
      out_.tau = engaged ? Law::inside(side_, torque_).raw() : 0;
    }
    if ((stage_ & stage(10)) != 0) {
      torque_ = Law::Torque::from_raw(decode_word(D::f.torque, in.param));
    }
    if ((stage_ & stage(3)) != 0 && now_ != MembraneSide::unknown) side_ = now_;
    if (!in.select) side_ = MembraneSide::unknown;
    if ((stage_ & stage(2)) != 0) now_ = Law::where(in.position, lower_, face(in.param));
    if (in.start) lower_ = face(in.param);
    stage_ = (stage_ << 1) | (in.start ? 1u : 0u);
  }

  /// A whole wave at once.
  void tick(const Words<D, Fixed>& w, bool select, std::int32_t position) {
    if (!select) side_ = MembraneSide::unknown;
    out_.tau = select ? Law::torque(w, position, &side_).raw() : 0;
  }

  const Out& out() const { return out_; }
  MembraneSide side() const { return side_; }
  void set_side(MembraneSide side) { side_ = side; }

 private:
  using Offset = typename Law::Offset;
  static constexpr std::uint32_t stage(int clock) { return 1u << (clock - 2); }
  static Offset face(std::uint32_t word) {
    return Offset::from_raw(decode_word(D::f.scene_offset, word));
  }

  std::uint32_t stage_ = 0;
  MembraneSide side_ = MembraneSide::unknown, now_ = MembraneSide::unknown;
  Offset lower_{};
  typename Law::Torque torque_{};
  Out out_;
};

}  // namespace feltgate
