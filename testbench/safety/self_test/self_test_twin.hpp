// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/safety/self_test.sv, clock by clock, by its law. Documentation:
// docs/blocks/supervisor.md
#pragma once

#include <cstdint>

#include "feltgate/self_test.hpp"

namespace feltgate {

/// Clocked twin; D gives the width of a torque.
template <class D>
class SelfTest {
 public:
  struct In {
    bool armed = false;
    bool direct = false;
    std::uint16_t travel = 0;
    std::uint32_t tick_count = 0;
    std::uint64_t wave = 0;
    std::uint32_t param = 0;
    bool waits = false;
  };
  struct Out {
    bool busy = false;
    std::int64_t early_term = 0;
    std::uint8_t result = 0;
    bool trip = false;
  };

  void reset() { *this = SelfTest{}; }

  void clock(const In& in) {
    last_ = in;
    const auto at = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    using T = Map::T;
    const TestPulse pulse = at(T::scene_rounded) ? law_.pulse(in.armed) : TestPulse::none;
    constexpr std::int64_t most = (std::int64_t{1} << (D::f.scene_torque.width() - 1)) - 1;
    early_ = pulse == TestPulse::up ? most : pulse == TestPulse::down ? -most - 1 : 0;
    if (at(T::sample)) law_.sample(in.travel);
    if (at(T::self_test_quiet)) words_.quiet = in.param;
    if (at(T::self_test_over)) words_.pulse = in.param;
    if (at(T::self_test_turn)) {
      words_.arms = in.param;
      fails_ = law_.turn(in.armed, in.direct, in.tick_count, words_, in.waits);
    }
  }

  /// With the inputs of the last clock, and with others.
  Out out() const { return peek(last_); }
  Out peek(const In& in) const {
    const bool now = ((in.wave >> Map::T::self_test) & 1u) != 0;
    return {law_.busy(in.armed), early_, static_cast<std::uint8_t>(law_.result()), now && fails_};
  }

 private:
  In last_;
  SelfTestLaw law_;
  SelfTestLaw::Words words_;
  std::int64_t early_ = 0;
  bool fails_ = false;
};

}  // namespace feltgate
