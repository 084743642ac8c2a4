// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// rounding: RTL against twin and against real numbers, all inputs of a small width, in the three
// modes. Documentation: docs/architecture.md
#include <Vrounding.h>

#include <cmath>
#include <cstdint>

#include "catch.hpp"
#include "feltgate/fixed.hpp"
#include "lock_step.hpp"

// Twin of rtl/core/wave/rounding.sv, by the rounding of fixed-point numbers.

namespace feltgate {

/// Combinational twin: whether a number goes up when its lowest Drop bits are dropped.
template <int Drop, Round R>
class Rounding {
 public:
  struct In {
    std::uint32_t low = 0;  ///< Drop + 1 bits: what is dropped and the lowest that is kept
    bool negated = false;
  };
  struct Out {
    bool up = false;
  };

  void reset() {}
  void clock(const In& in) {
    const auto x = fixed<1, 2, Drop>::from_raw(in.low);
    const std::int64_t rounded = in.negated ? -whole<R>(-x) : whole<R>(x);
    out_.up = rounded != whole<Round::truncate>(x);
  }
  const Out& out() const { return out_; }

 private:
  template <Round How, class X>
  static std::int64_t whole(X x) {
    return narrow<fixed<1, 4, 0>, How, Overflow::wrap>(x).raw();
  }

  Out out_;
};

}  // namespace feltgate

using namespace feltgate;
using namespace feltgate::test;

namespace {

constexpr int kDrop = FELTGATE_DROP;
constexpr Round kRound = FELTGATE_ROUNDING;
constexpr std::uint32_t kAll = std::uint32_t{1} << (kDrop + 2);
using Twin = Rounding<kDrop, kRound>;

/// It is combinational; the bench wants to drive a clock and a reset.
struct Rtl : Vrounding {
  using Vrounding::Vrounding;
  int clk_i = 0, rst_ni = 0;
};

struct Adapter {
  static void drive(Rtl& rtl, const Twin::In& in) {
    rtl.low_i = static_cast<std::uint8_t>(in.low);
    rtl.negated_i = in.negated;
  }
  template <class Check>
  static void compare(Check& check, const Rtl& rtl, const Twin::Out& out) {
    check("up", rtl.up_o, out.up);
  }
};

/// x rounded to a whole number, as the page says it.
double rounded(double x) {
  if (kRound == Round::truncate) return std::floor(x);
  if (kRound == Round::half_up) return std::floor(x + 0.5);
  const double down = std::floor(x);
  if (x - down != 0.5) return std::floor(x + 0.5);
  return std::fmod(down, 2) == 0 ? down : down + 1;
}

struct RealNumbers {
  std::int64_t* ups;
  const char* operator()(const Twin::In& in, const Rtl& rtl, const Twin&, bool in_reset) {
    if (in_reset) return nullptr;
    const double x = std::ldexp(in.low, -kDrop);
    const double wanted = in.negated ? -rounded(-x) : rounded(x);
    *ups += rtl.up_o;
    return std::floor(x) + rtl.up_o == wanted ? nullptr : "rounds as the mode says";
  }
};

}  // namespace

TEST_CASE("rounding: every input") {
  const auto all = [](std::int64_t clock) {
    const std::int64_t n = clock - LockStep<Rtl, Twin, Adapter>::kFirstReset - 1;
    const std::uint32_t input = n < 0 ? 0 : static_cast<std::uint32_t>(n) % kAll;
    return Twin::In{input >> 1, (input & 1) != 0};
  };
  std::int64_t ups = 0;
  LockStep<Rtl, Twin, Adapter> bench("rounding", 1);
  bench.run(all, 2 * kAll + 8, {}, RealNumbers{&ups});
  REQUIRE(ups > kAll / 4);
}
