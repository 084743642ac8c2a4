// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// lowpass at the velocity's or (FELTGATE_OBSERVER) the observer's widths: adapter, random stimulus,
// and the filter once more in plain integers. Documentation: docs/blocks/lowpass.md
#pragma once

#include <Vlowpass.h>

#include <array>
#include <type_traits>

#include "../../wave/mult/shared_mult.hpp"
#include "exact.hpp"
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

struct Tally {
  std::int64_t samples = 0, followed = 0, growth_bit_used = 0, still = 0, up = 0, down = 0;
  std::array<std::int64_t, 4> ties{};  ///< of state and step, odd or even: bits 1 and 0
};

/// y += a1 * floor(d / 2^k) / 2^drop, rounded, in plain integers, due a clock after update.
struct PlainIntegers {
  Tally* tally;
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
    if (rest == half) ++tally->ties[static_cast<std::size_t>((y & 1) * 2 + (step & 1))];
    const bool to_even = kRound == Round::convergent && rest == half;
    if (to_even ? ((y + step) & 1) != 0 : rest >= half) ++step;
    ++tally->samples;
    if (in.port.follow) ++tally->followed;
    if (difference > kMax || difference < -kMax - 1) ++tally->growth_bit_used;
    (step == 0 ? tally->still : step > 0 ? tally->up : tally->down) += 1;
    y = in.port.follow ? in.port.x : y + step;
  }
};

}  // namespace feltgate::test
