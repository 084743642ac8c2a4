// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The low-pass step that does not look for overflow, against the one that wraps: every state, input
// and coefficient of small formats; and where it comes to rest.
// Documentation: docs/blocks/velocity.md
#include <algorithm>
#include <cstdint>

#include "../../campaigns/extremes/dead_band.hpp"
#include "catch.hpp"
#include "feltgate/fixed.hpp"
#include "feltgate/lowpass.hpp"

namespace {

using namespace feltgate;

struct Counts {
  long cases = 0, wrong = 0, outside = 0;
};

/// All values of three small words; `outside` counts results that leave [min(x, y), max(x, y)].
template <Round R, int StateKey, int OperandKey, int A1Key>
Counts compare() {
  using Law = LowpassLaw<Fixed, StateKey, OperandKey, R>;
  using State = typename Law::State;
  using A1 = fixed_of<A1Key>;
  Counts c;
  for (auto y = State::min_raw(); y <= State::max_raw(); ++y) {
    for (auto x = State::min_raw(); x <= State::max_raw(); ++x) {
      for (auto k = A1::min_raw(); k <= A1::max_raw(); ++k) {
        const State state = State::from_raw(y), input = State::from_raw(x);
        const A1 a1 = A1::from_raw(k);
        const State wraps = Law::next(state, Law::operand(input, state) * a1);
        const State step = Law::template step<A1Key>(input, state, a1);
        const bool between =
            (y <= wraps.raw() && wraps.raw() <= x) || (x <= wraps.raw() && wraps.raw() <= y);
        ++c.cases;
        c.wrong += step.raw() != wraps.raw() ? 1 : 0;
        c.outside += between ? 0 : 1;
      }
    }
  }
  return c;
}

constexpr Format state{1, 2, 3};  // 6 bits
/// The operand when the multiplier lacks `given_up` bits.
constexpr int operand(int given_up) { return Format{1, 3, 3 - given_up}.key(); }

template <Round R, int Operand = operand(0), int A1 = Format{0, 0, 5}.key()>
bool stays_between() {
  return LowpassLaw<Fixed, state.key(), Operand, R>::stays_between(Format::from_key(A1));
}

template <Round R, int GivenUp, int A1Integer>
void check(bool allowed) {
  constexpr int a1 = Format{0, A1Integer, 5 - A1Integer}.key();
  using Law = LowpassLaw<Fixed, state.key(), operand(GivenUp), R>;
  INFO("given up " << GivenUp << ", coefficient below 2^" << A1Integer);
  CHECK(Law::stays_between(Format::from_key(a1)) == allowed);
  const Counts c = compare<R, state.key(), operand(GivenUp), a1>();
  CHECK(c.cases == 64 * 64 * 32);
  CHECK(c.wrong == 0);
  if (allowed) CHECK(c.outside == 0);
}

}  // namespace

TEST_CASE("a coefficient below 1 keeps the state between its old value and the input") {
  check<Round::half_up, 0, 0>(true);
  check<Round::half_up, 0, -3>(true);
  check<Round::convergent, 0, 0>(true);
}

TEST_CASE("bits that the operand gives up ask for a smaller coefficient") {
  check<Round::half_up, 1, -2>(true);
  check<Round::half_up, 2, -3>(true);
  check<Round::convergent, 2, -3>(true);
  check<Round::half_up, 1, -1>(false);
  check<Round::half_up, 1, 0>(false);
  check<Round::half_up, 2, -2>(false);
  check<Round::half_up, 2, 0>(false);
}

TEST_CASE("a coefficient of 1 and more, or truncation, is not allowed") {
  check<Round::half_up, 0, 1>(false);
  check<Round::truncate, 2, -3>(false);
}

TEST_CASE("where it is not allowed the state does leave") {
  CHECK(compare<Round::half_up, state.key(), operand(0), Format{0, 1, 4}.key()>().outside > 0);
  CHECK(compare<Round::half_up, state.key(), operand(2), Format{0, 0, 5}.key()>().outside > 0);
}

TEST_CASE("a narrow operand, one with bits to spare, or a coefficient with a sign: not allowed") {
  CHECK(stays_between<Round::half_up>());
  CHECK_FALSE(stays_between<Round::half_up, Format{1, 2, 3}.key()>());
  CHECK_FALSE(stays_between<Round::half_up, Format{1, 3, 4}.key()>());
  CHECK_FALSE(stays_between<Round::half_up, operand(0), Format{1, 0, 5}.key()>());
}

// Dead band of the one-pole low-pass y += round(a*(x-y)) per rounding mode and guard bits.

namespace {

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
