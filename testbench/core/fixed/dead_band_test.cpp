// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Dead band of the one-pole low-pass y += round(a*(x-y)) per rounding mode and guard bits, its
// dyadic trap, slow poles, and the worst-case bound of its rounding error.
// Documentation: docs/fixed-point.md
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "../../campaigns/extremes/dead_band.hpp"
#include "catch.hpp"
#include "feltgate/fixed.hpp"
#include "feltgate/largest.hpp"

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

/// Largest deviation in output LSB at G guard bits.
double worst_lsb(Expected band, int guard_bits) {
  return static_cast<double>(std::max(-band.low, band.high)) / std::exp2(guard_bits);
}

}  // namespace

TEST_CASE("the dead band is the computed one, whatever the guard bits", "[fixed]") {
  check_bands<Round::truncate>();
  check_bands<Round::half_up>();
  check_bands<Round::convergent>();
  check_bands<Round::toward_zero>();
}

TEST_CASE("the dead band table of the documentation", "[fixed]") {
  const Expected truncate = dead_band(Round::truncate, a_500, 28);
  const Expected half_up = dead_band(Round::half_up, a_500, 28);
  const Expected convergent = dead_band(Round::convergent, a_500, 28);
  const Expected toward_zero = dead_band(Round::toward_zero, a_500, 28);
  CHECK((truncate.low == -1999 && truncate.high == 0));
  CHECK((half_up.low == -999 && half_up.high == 999));
  CHECK((convergent.low == -999 && convergent.high == 999));
  CHECK((toward_zero.low == -1999 && toward_zero.high == 1999));
  // Guard bits for less than half an output LSB: 11 when rounding, 12 when not.
  CHECK((worst_lsb(half_up, 11) < 0.5 && worst_lsb(half_up, 10) > 0.5));
  CHECK((worst_lsb(convergent, 11) < 0.5 && worst_lsb(convergent, 10) > 0.5));
  CHECK((worst_lsb(truncate, 12) < 0.5 && worst_lsb(truncate, 11) > 0.5));
  CHECK((worst_lsb(toward_zero, 12) < 0.5 && worst_lsb(toward_zero, 11) > 0.5));
}

namespace {

/// Output LSB by which a constant input is missed after the state has come to rest.
template <Round R, int G, class Coefficient>
std::int64_t output_error(Coefficient a, std::int64_t input, std::int64_t start) {
  using Filter = LowPass<R, G, Coefficient>;
  Filter filter(a, Filter::State::from_raw(start * (std::int64_t{1} << G)));
  for (long k = 0; k < patience && filter.step(Sample::from_raw(input)); ++k) continue;
  return narrow<Sample, Round::half_up, Overflow::saturate>(filter.state()).raw() - input;
}

}  // namespace

TEST_CASE("dyadic trap: a pole of exactly 2^-11 needs one guard bit more", "[fixed]") {
  using Dyadic = fixed<0, -10, 11>;
  const Dyadic a = Dyadic::from_raw(1);
  const Expected want = dead_band(Round::half_up, 1, 11);
  CHECK((want.low == -1023 && want.high == 1024));
  const Band band = rest_band<Round::half_up, 11>(a, patience);
  CHECK(band.low == want.low);
  CHECK(band.high == want.high);
  // 1024 state LSB are half an output LSB: the output itself stays wrong.
  CHECK(output_error<Round::half_up, 11>(a, 5, 100) == 1);
  CHECK(output_error<Round::convergent, 11>(a, 5, 100) == 1);
  CHECK(output_error<Round::half_up, 12>(a, 5, 100) == 0);
  CHECK(output_error<Round::convergent, 12>(a, 5, 100) == 0);
  CHECK(output_error<Round::half_up, 11>(a, 5, -100) == 0);
}

TEST_CASE("too few guard bits: small inputs never arrive", "[fixed]") {
  const Fine a = Fine::from_raw(a_500);
  CHECK(output_error<Round::half_up, 0>(a, 999, 0) == -999);
  CHECK(output_error<Round::half_up, 8>(a, 3, 0) == -3);
  CHECK(output_error<Round::half_up, 12>(a, 3, 0) == 0);
  CHECK(output_error<Round::half_up, 12>(a, 999, 0) == 0);
}

TEST_CASE("a pole of 5 rad/s at 1 MHz: 18 guard bits and a fine coefficient", "[fixed]") {
  CHECK(std::llround(5e-6 * std::exp2(16)) == 0);  // with 16 fraction bits the filter is dead
  const std::int64_t numerator = std::llround(5e-6 * std::exp2(41));
  using Slow = fixed<0, -17, 41>;
  REQUIRE(numerator <= Slow::max_raw());
  const Expected want = dead_band(Round::half_up, numerator, 41);
  CHECK(worst_lsb(want, 17) > 0.5);
  CHECK(worst_lsb(want, 18) < 0.5);
  CHECK(output_error<Round::half_up, 18>(Slow::from_raw(numerator), 1, 1) == 0);
  using Filter = LowPass<Round::half_up, 18, Slow>;
  Filter filter(Slow::from_raw(numerator), Filter::State::from_raw(2L << 18));
  long ticks = 0;
  while (filter.step(Sample::from_raw(1)) && ticks < 3000000) ++ticks;
  CHECK(filter.state().raw() - (1 << 18) == want.high);
}

TEST_CASE("the rounding error stays below its worst-case bound, and comes near it", "[fixed]") {
  // The error obeys e[k+1] = (1-a) e[k] + r[k], |r| <= 1/2: never more than 1/(2a) state LSB.
  using Filter = LowPass<Round::half_up, 11, Fine>;
  Filter filter(Fine::from_raw(a_500), Filter::State::from_raw(0));
  const double a = static_cast<double>(a_500) / std::exp2(28);
  const double bound = 0.5 / a;
  double exact = 0.0;
  double worst = 0.0;
  for (long k = 0; k < 400000; ++k) {
    // Slow, small, constant: white noise would show 9 LSB rms and hide this.
    const std::int64_t x = (k / 50000) % 2 == 0 ? 3 : -3;
    filter.step(Sample::from_raw(x));
    exact += a * (static_cast<double>(x) * 2048.0 - exact);
    worst = feltgate::larger(worst, std::abs(static_cast<double>(filter.state().raw()) - exact));
  }
  INFO("worst " << worst << " of " << bound << " state LSB");
  CHECK(worst <= bound);
  CHECK(worst > 0.95 * bound);
}
