// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/safety/hold_timer.sv, clock by clock. Documentation: docs/blocks/supervisor.md
#pragma once

#include <cstdint>

#include "feltgate/hold_timer.hpp"

namespace feltgate {

class HoldTimer {
 public:
  struct In {
    bool armed = false;
    std::uint64_t wave = 0;
    std::uint32_t tick_count = 0;
    std::uint32_t param = 0;
    bool moved = false;
    bool over_limit = false;
  };
  struct Out {
    bool derated = false;
  };

  void reset() {
    law_ = {};
    strong_ = false;
    out_ = {};
  }

  void clock(const In& in) {
    const auto at = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    if (at(Map::T::hold)) {
      law_.tick(in.armed, in.moved, strong_, in.tick_count, in.param);
      out_.derated = law_.derated();
    }
    if (at(Map::T::hold_strong)) strong_ = in.over_limit;
  }

  const Out& out() const { return out_; }

 private:
  HoldTimerLaw law_;
  bool strong_ = false;
  Out out_;
};

}  // namespace feltgate
