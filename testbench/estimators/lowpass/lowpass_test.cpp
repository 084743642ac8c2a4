// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// lowpass: RTL against twin and against plain integers on every clock; pole, dead band and error
// bound against the closed form. Documentation: docs/blocks/dob.md
#include <Vlowpass.h>

#include <array>
#include <cmath>
#include <type_traits>
#include <vector>

#include "../../wave/mult/mult_twin.hpp"
#include "catch.hpp"
#include "exact.hpp"
#include "feltgate/largest.hpp"
#include "lock_step.hpp"
#include "lowpass_twin.hpp"

namespace feltgate::test {

#ifdef FELTGATE_OBSERVER
constexpr Format kState = Paper::f.observer, kOperand = Paper::f.observer_difference;
constexpr Format kA1 = Paper::P::observer_a1;
constexpr std::int64_t kDesignA1 = 67092;  // of a 500 rad/s cut-off at 1 MHz
#else
constexpr Format kState = Paper::f.velocity, kOperand = Paper::f.velocity_difference;
constexpr Format kA1 = Paper::P::velocity_a1;
constexpr std::int64_t kDesignA1 = 67092;
#endif
#ifdef FELTGATE_ROUNDING
constexpr Round kRound = FELTGATE_ROUNDING;
#else
constexpr Round kRound = Round::half_up;
#endif
constexpr int kGivenUp = kState.fraction - kOperand.fraction;  // bits of the difference
constexpr int kDrop = kOperand.fraction + kA1.fraction - kState.fraction;
constexpr std::int64_t kMax = (std::int64_t{1} << (kState.width() - 1)) - 1;

struct Coefficient {
  std::int64_t a1 = kDesignA1;
};
using Twin = Watched<Lowpass<kState.key(), kOperand.key(), kA1.key(), kRound>, Coefficient>;

struct Adapter {
  template <class Port>
  using word = std::remove_reference_t<Port>;

  static void drive(Vlowpass& rtl, const Twin::In& in) {
    rtl.valid_i = in.port.valid;
    rtl.update_i = in.port.update;
    rtl.follow_i = in.port.follow;
    rtl.x_i = port_bits<kState.width(), word<decltype(rtl.x_i)>>(in.port.x);
    rtl.product_i = port_bits<53, std::uint64_t>(in.port.product);
  }
  template <class Check>
  static void compare(Check& check, const Vlowpass& rtl, const Twin::Out& out) {
    if (out.clocked) {
      check("operand", sign_extend<kOperand.width()>(rtl.operand_o), out.port.operand);
    }
    check("y", sign_extend<kState.width()>(rtl.y_o), out.port.y);
  }
};

using Bench = LockStep<Vlowpass, Twin, Adapter>;

/// One sample every few clocks: x, follow and a1 from next(), a function of (state y, sample
/// number).
template <class Next>
struct Samples {
  explicit Samples(std::uint64_t seed, Next n, std::uint32_t more_clocks)
      : next(n), mult(seed), gaps(seed + 1), spread(more_clocks) {}

  Twin::In operator()(std::int64_t, const Twin::Out& out) {
    if (out.resets != resets) {
      resets = out.resets;
      clock = 0;
      sample = 0;
    }
    if (clock == 0) {
      in = next(out.port.y, sample++);
      period = 6 + static_cast<int>(gaps.below(spread));
    }
    in.port.valid = clock == 0;
    in.port.update = clock == kUpdate;
    in.port.product = mult.product();
    if (clock == 1) {
      mult.operands(out.port.operand, in.aside.a1);
    } else {
      mult.others();
    }
    clock = clock + 1 == period ? 0 : clock + 1;
    return in;
  }

  static constexpr int kUpdate = 5;  // the product of the operand that is there from clock 1 on
  Next next;
  SharedMult mult;
  Random gaps;
  std::uint32_t spread;
  Twin::In in;
  std::int64_t resets = 0, sample = 0;
  int clock = 0, period = 6;
};

/// Steps over the whole range, small ones near the state, long constants; sometimes other a1.
struct RandomSamples {
  Random random{7};
  Twin::In in;
  int left = 0;

  Twin::In operator()(std::int64_t y, std::int64_t) {
    if (left-- > 0) return in;
    if (random.one_in(8)) return tie(y);
    left = random.coin() ? 0 : static_cast<int>(random.below(200));
    const auto full = static_cast<std::int64_t>(random.bits()) >> (64 - kState.width());
    switch (random.below(4)) {
      case 0:
        in.port.x = full;
        break;
      case 1:
        in.port.x = random.coin() ? kMax : -kMax - 1;
        break;
      default: {
        const std::int64_t near = y + (full >> random.below(40));
        in.port.x = near > kMax ? kMax : (near < -kMax - 1 ? -kMax - 1 : near);
      }
    }
    in.port.follow = random.one_in(8);
    switch (random.below(8)) {
      case 0:
        in.aside.a1 = random.between(0, 131071);
        break;
      case 1:
        in.aside.a1 = random.coin() ? 131071 : 0;
        break;
      default:
        in.aside.a1 = kDesignA1;
    }
    return in;
  }

  /// A step of half a bit beside whole ones: a1 is a power of two, x - y a multiple of what it
  /// drops.
  Twin::In tie(std::int64_t y) {
    constexpr int power = 16;
    const std::int64_t halves = random.between(-2000, 2000) | 1;
    const std::int64_t x = y + halves * (std::int64_t{1} << (kDrop - 1 - power + kGivenUp));
    if (x > kMax || x < -kMax - 1) return in;
    in.port.x = x;
    in.port.follow = false;
    in.aside.a1 = 1 << power;
    left = 0;
    return in;
  }
};

/// y += a1 * floor(d / 2^k) / 2^drop, rounded, in plain integers, due a clock after update.
struct PlainIntegers {
  std::int64_t y = 0;

  const char* operator()(const Twin::In& in, const Vlowpass& rtl, const Twin&, bool in_reset) {
    if (in_reset) {
      y = 0;
      return nullptr;
    }
    if (in.port.update) sample(in);
    return sign_extend<kState.width()>(rtl.y_o) == y ? nullptr : "y of the law in plain integers";
  }
  void sample(const Twin::In& in) {
    const std::int64_t difference = in.port.x - y;
    const int128_t product = static_cast<int128_t>(difference >> kGivenUp) * in.aside.a1;
    constexpr int128_t half = int128_t{1} << (kDrop - 1);
    auto step = static_cast<std::int64_t>(product >> kDrop);
    const int128_t rest = product - (static_cast<int128_t>(step) << kDrop);
    const bool to_even = kRound == Round::convergent && rest == half;
    if (to_even ? ((y + step) & 1) != 0 : rest >= half) ++step;
    y = in.port.follow ? in.port.x : y + step;
  }
};

}  // namespace feltgate::test

using namespace feltgate;
using namespace feltgate::test;

namespace {

constexpr quad kTick = 1e-6L;
constexpr double kPole = 500.0;

/// The RTL's y after every sample of a fixed x, from reset on.
std::vector<std::int64_t> constant_input(std::int64_t first, std::int64_t then, int samples) {
  const auto next = [first, then](std::int64_t, std::int64_t sample) {
    Twin::In in;
    in.port.x = sample == 0 ? first : then;
    in.port.follow = sample == 0;  // puts y at `first`
    return in;
  };
  std::vector<std::int64_t> y;
  const auto keep = [&y](const Twin::In& in, const Vlowpass& rtl, const Twin&, bool in_reset) {
    if (in.port.valid && !in_reset) y.push_back(sign_extend<kState.width()>(rtl.y_o));
    return static_cast<const char*>(nullptr);
  };
  Bench bench("lowpass", 5);
  bench.run(Samples<decltype(next)>(5, next, 1), 6 * std::int64_t{samples}, {}, keep);
  return y;  // y[1] is first, y[1 + k] follows after k samples of `then`
}

/// Largest distance between state and exact filter: (coefficient error + half an LSB) / a1, and the
/// bits that the difference gives up.
quad error_bound(quad step_size) {
  const quad a1 = static_cast<quad>(kDesignA1) * lsb(kA1.fraction);
  const quad exact_a1 = 1 - static_cast<quad>(std::exp(-kPole * 1e-6));
  const quad given_up = kGivenUp > 0 ? lsb(kOperand.fraction) : quad{0};
  return (magnitude(a1 - exact_a1) * step_size + lsb(kState.fraction) / 2) / a1 + given_up;
}

/// Where y stops: |x - y| with a1*|x - y| rounded to nothing.
quad dead_band() {
  const quad a1 = static_cast<quad>(kDesignA1) * lsb(kA1.fraction);
  return lsb(kState.fraction) / 2 / a1 + (kGivenUp > 0 ? lsb(kOperand.fraction) : quad{0});
}

quad value(std::int64_t raw) { return static_cast<quad>(raw) * lsb(kState.fraction); }

}  // namespace

TEST_CASE("lowpass: random steps, coefficients, gaps and resets") {
  Bench bench("lowpass", 1);
  bench.run(Samples<RandomSamples>(2, {}, 20), scaled_clocks(1500000), {2000}, PlainIntegers{});
  bench.run(Samples<RandomSamples>(4, {}, 1), scaled_clocks(1000000), {50000}, PlainIntegers{});
}

TEST_CASE("lowpass: step response is 1 - exp(-500 t)") {
  constexpr int samples = 30000;
  const std::int64_t x = kMax / 8;
  const std::vector<std::int64_t> y = constant_input(0, x, samples);
  REQUIRE(y.size() > samples - 2);
  const quad bound = error_bound(value(x));
  quad worst = 0;
  for (std::size_t k = 1; k < y.size(); ++k) {
    const double t = static_cast<double>(k - 1) * static_cast<double>(kTick);
    const quad closed_form = value(x) * static_cast<quad>(-std::expm1(-kPole * t));
    const quad error = magnitude(value(y[k]) - closed_form);
    worst = feltgate::larger(worst, error);
  }
  INFO("worst " << static_cast<double>(worst) << ", bound " << static_cast<double>(bound));
  REQUIRE(worst <= bound);
  REQUIRE(worst > bound / 10);         // the bound says something
  REQUIRE(bound < value(x) / 100000);  // and is small beside the step
  // Pole from the sample nearest to one time constant (2000 ticks).
  const quad left = 1 - value(y[2001]) / value(x);  // 2000 samples of x
  const double pole = -std::log(static_cast<double>(left)) / 0.002;
  REQUIRE(std::fabs(pole / kPole - 1) < 1e-5);
}

TEST_CASE("lowpass: dead band, from both sides") {
  const std::int64_t x = kMax / 1000;
  for (const std::int64_t start : {std::int64_t{0}, 2 * x}) {
    const std::vector<std::int64_t> y = constant_input(start, x, 60000);
    REQUIRE(y[1] == start);
    REQUIRE(y.back() == y[y.size() - 1000]);  // it has stopped
    const quad rest = magnitude(value(x - y.back()));
    INFO("rest " << static_cast<double>(rest) << ", dead band "
                 << static_cast<double>(dead_band()));
    REQUIRE(rest <= dead_band());
    REQUIRE(rest > dead_band() * 9 / 10 - lsb(kOperand.fraction));
  }
}

TEST_CASE("lowpass: the longest step there is does not overflow") {
  for (const std::int64_t from : {kMax, -kMax - 1}) {
    const std::int64_t to = -1 - from;
    const std::vector<std::int64_t> y = constant_input(from, to, 40000);
    REQUIRE(y[1] == from);
    for (std::size_t k = 2; k < y.size(); ++k) {
      if (from > to ? y[k] > y[k - 1] || y[k] < to : y[k] < y[k - 1] || y[k] > to) {
        FAIL("not monotone at sample " << k);
      }
    }
    REQUIRE(magnitude(value(y.back() - to)) < value(kMax) / 1000);
  }
}

TEST_CASE("lowpass: ties, and what is just beside them, from states of both signs") {
  std::vector<Twin::In> list(8);
  std::vector<std::int64_t> expected;
  const std::int64_t half = std::int64_t{1} << (kDrop - 1);
  for (const std::int64_t y : {0, 1, 2, 3, -1, -2, -3, -4, 1000, 1001, -1000, -1001}) {
    for (std::int64_t k = -3; k <= 3; ++k) {
      for (const std::int64_t beside : {-1, 0, 1}) {
        const std::int64_t product = k * 2 * half + half + beside;
        Twin::In in;
        in.port.x = y;
        in.port.update = in.port.follow = true;
        list.push_back(in);
        in.port.follow = false;
        in.port.product = product;
        list.push_back(in);
        const bool tie = kRound == Round::convergent && beside == 0;
        expected.push_back(y + (tie ? k + ((y + k) & 1) : (product + half) >> kDrop));
      }
    }
  }
  std::vector<std::int64_t> seen;
  Bench bench("lowpass", 6);
  const auto play = [&list](std::int64_t clock) {
    const std::int64_t k = clock - Bench::kFirstReset;
    return list[k < 0 ? 0 : static_cast<std::size_t>(k)];
  };
  const auto keep = [&seen](const Twin::In& in, const Vlowpass& rtl, const Twin&, bool in_reset) {
    if (in.port.update && !in.port.follow && !in_reset) {
      seen.push_back(sign_extend<kState.width()>(rtl.y_o));
    }
    return static_cast<const char*>(nullptr);
  };
  bench.run(play, static_cast<std::int64_t>(list.size()) + Bench::kFirstReset, {}, keep);
  REQUIRE(seen == expected);
}
