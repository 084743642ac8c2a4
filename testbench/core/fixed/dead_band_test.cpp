// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Dead band of the one-pole low-pass y += round(a*(x-y)) per rounding mode and guard bits.
// Documentation: docs/fixed-point.md
#include <algorithm>
#include <cstdint>

#include "../../campaigns/extremes/dead_band.hpp"
#include "catch.hpp"
#include "feltgate/fixed.hpp"

namespace {

using namespace feltgate;

using Sample = fixed<1, 15, 0>;  ///< input and output: 16 bits, one LSB = 1

/// y += round(a*(x-y)) with G guard bits below the sample's LSB.
template <Round R, int G, class Coefficient>
class LowPass {
 public:
  using State = fixed<1, 15, G>;

  LowPass(Coefficient a, State start) : a_(a), state_(start) {}

  /// One sample; true when the state has moved.
  bool step(Sample x) {
    const State before = state_;
    const auto step = narrow<fixed<1, 16, G>, R, Overflow::wrap>(a_ * (x - state_));
    state_ = narrow<State, R, Overflow::saturate>(state_ + step);
    return state_ != before;
  }

  State state() const { return state_; }

 private:
  Coefficient a_;
  State state_;
};

/// Where the state comes to rest relative to a constant input, in state LSB (2^-G).
struct Band {
  std::int64_t low = 0;
  std::int64_t high = 0;
  long longest = 0;  ///< ticks to come to rest
};

template <Round R, int G, class Coefficient>
Band rest_band(Coefficient a, long limit) {
  using Filter = LowPass<R, G, Coefficient>;
  using State = typename Filter::State;
  const std::int64_t lsb = std::int64_t{1} << G;
  Band band;
  bool first = true;
  for (const std::int64_t input : {-32000, -1000, -3, -1, 0, 1, 2, 1000, 31999}) {
    for (const std::int64_t start : {std::int64_t{0}, 1000 * lsb, -1000 * lsb, 30000 * lsb}) {
      Filter filter(a, State::from_raw(start));
      long ticks = 0;
      while (filter.step(Sample::from_raw(input)) && ticks < limit) ++ticks;
      const std::int64_t error = filter.state().raw() - input * lsb;
      band.low = first ? error : std::min(band.low, error);
      band.high = first ? error : std::max(band.high, error);
      band.longest = std::max(band.longest, ticks);
      first = false;
    }
  }
  return band;
}

using extremes::dead_band;
using Expected = extremes::Band;

using Fine = fixed<0, -10, 28>;
constexpr std::int64_t a_500 = 134218;  // 500 rad/s at 1 MHz: 5.0e-4 * 2^28
constexpr long patience = 200000;

template <Round R, int G>
void check_band() {
  const Band band = rest_band<R, G>(Fine::from_raw(a_500), patience);
  const Expected want = dead_band(R, a_500, 28);
  INFO("rounding " << static_cast<int>(R) << ", guard bits " << G);
  CHECK(band.low == want.low);
  CHECK(band.high == want.high);
  CHECK(band.longest < patience);
}

template <Round R>
void check_bands() {
  check_band<R, 4>();
  check_band<R, 8>();
  check_band<R, 10>();
  check_band<R, 11>();
  check_band<R, 12>();
  check_band<R, 13>();
  check_band<R, 16>();
}

}  // namespace

TEST_CASE("the dead band is the computed one, whatever the guard bits", "[fixed]") {
  check_bands<Round::truncate>();
  check_bands<Round::half_up>();
  check_bands<Round::convergent>();
  check_bands<Round::toward_zero>();
}
