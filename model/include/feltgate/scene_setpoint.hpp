// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/scene_setpoint.sv: a constant torque. Documentation: docs/blocks/scene_setpoint.md
#pragma once

#include <cstdint>

#include "feltgate/words.hpp"

namespace feltgate {

/// The law, in number policy N, for design D.
template <class D, class N>
struct SceneSetpointLaw {
  using Torque = typename N::template num<D::f.torque.key()>;

  template <class W>
  static Torque torque(const W& w) {
    return w.setpoint_torque();
  }
};

/// Clocked twin. A wave is: start in clock 1, the word in slot 10.
template <class D>
class SceneSetpoint {
 public:
  struct In {
    bool select = false;  ///< stable during a wave
    bool start = false;
    std::uint32_t param = 0;
  };
  struct Out {
    std::int64_t tau = 0;
  };

  void reset() { *this = SceneSetpoint{}; }

  void clock(const In& in) {
    if ((stage_ & stage(11)) != 0) out_.tau = in.select ? word_ : 0;
    if ((stage_ & stage(10)) != 0) word_ = decode_word(D::f.torque, in.param);
    stage_ = (stage_ << 1) | (in.start ? 1u : 0u);
  }

  /// A whole wave at once.
  void tick(const Words<D, Fixed>& w, bool select) {
    out_.tau = select ? SceneSetpointLaw<D, Fixed>::torque(w).raw() : 0;
  }

  const Out& out() const { return out_; }

 private:
  static constexpr std::uint32_t stage(int clock) { return 1u << (clock - 2); }

  std::uint32_t stage_ = 0;
  std::int64_t word_ = 0;
  Out out_;
};

}  // namespace feltgate
