// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "ports/divider.hpp"

using namespace feltgate::test;

namespace {

/// floor(dividend / divisor), saturated to 16 bits, 18 clocks after start; before that anything.
struct Twin : BlockTwin<ports::divider> {
  static constexpr int latency = 18, holds = latency;
  static void strobes(In& in, int clock) { in.start = clock == 0; }
  void clock(const In& in) {
    at = in.start ? 0 : at + 1;
    if (in.start) {
      const bool fits = in.divisor != 0 && in.dividend / in.divisor < 0x10000;
      quotient = fits ? in.dividend / in.divisor : 0xffff;
    }
  }
  Out out(const In&) const { return {at >= latency - 1 ? quotient : any_value, at == latency - 1}; }

  int at = -1'000'000'000;
  std::int64_t quotient = 0;
};

}  // namespace

TEST_CASE("divider: quotients and their clocks") { lock_step(Twin()); }
