// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/scenes/scene_setpoint.sv, clock by clock. Documentation:
// docs/blocks/scenes.md
#pragma once

#include <cstdint>

#include "feltgate/generated/map.hpp"
#include "feltgate/words.hpp"

namespace feltgate {

/// Clocked twin.
template <class D>
class SceneSetpoint {
 public:
  struct In {
    bool select = false;
    std::uint64_t wave = 0;
    std::uint32_t param = 0;
  };
  struct Out {
    std::int64_t plus = 0;  ///< a torque
  };

  /// No register of it has a reset.
  void reset() {}

  void clock(const In& in) {
    if (!in.select) {
      out_.plus = 0;
    } else if (((in.wave >> Map::W::setpoint_torque) & 1u) != 0) {
      out_.plus = decode_word(D::f.torque, in.param);
    }
  }

  const Out& out() const { return out_; }

 private:
  Out out_;
};

}  // namespace feltgate
