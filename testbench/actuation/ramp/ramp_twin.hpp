// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/actuation/ramp.sv, clock by clock, by the law of the chain. Documentation:
// docs/blocks/torque_control.md
#pragma once

#include <cstdint>

#include "feltgate/generated/map.hpp"
#include "feltgate/ramp.hpp"
#include "feltgate/words.hpp"

namespace feltgate {

/// Clocked twin.
template <class D>
class Ramp {
 public:
  using Law = RampLaw<D, Fixed>;

  struct In {
    bool armed = false;
    int scene = 0;
    bool restart = false;  ///< in the last clock of a tick
    std::uint64_t wave = 0;
    std::uint32_t param = 0;
    std::int64_t limited = 0;
    bool over_limit = false;
    Relief relief;
  };
  struct Out {
    std::int64_t tau_ref = 0;
    bool limit_torque = false;
    bool limit_ramp = false;
    bool limit_hold = false;
  };

  void reset() { *this = Ramp{}; }

  void clock(const In& in) {
    const auto at = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    using T = Map::T;
    if (at(T::ramp_begin)) {
      law_.begin(in.armed, in.scene, in.relief);
      out_.limit_hold = law_.limit_hold();
    }
    if (at(T::ramp_excess)) {
      // As many bits as a torque has.
      const auto target = static_cast<std::uint32_t>(in.limited & 0xffffffff);
      law_.aim(Fixed::from_raw<D::f.torque.key()>(decode_word(D::f.torque, target)), in.over_limit);
      step_ = Fixed::from_raw<D::P::ramp_step.key()>(decode_word(D::P::ramp_step, in.param));
      out_.limit_torque = law_.limit_torque();
    }
    if (at(T::tau_ref)) {
      law_.move(step_);
      out_.tau_ref = law_.tau_ref().raw();
      out_.limit_ramp = law_.limit_ramp();
    }
    if (in.restart) law_.restart();
  }

  const Out& out() const { return out_; }

 private:
  Law law_;
  fixed_of<D::P::ramp_step.key()> step_{};
  Out out_;
};

}  // namespace feltgate
