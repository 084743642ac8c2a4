// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// mult: RTL against twin on every clock, and both against 128-bit products four clocks late.
// Documentation: docs/architecture.md
#include <Vmult.h>

#include <array>
#include <vector>

#include "catch.hpp"
#include "feltgate/fixed.hpp"
#include "lock_step.hpp"
#include "mult_twin.hpp"
#include "unreset.hpp"

using feltgate::int128_t;
using feltgate::Mult;
using namespace feltgate::test;

namespace {

constexpr std::int64_t kMaxA = (std::int64_t{1} << 34) - 1;
constexpr std::int64_t kMaxB = (std::int64_t{1} << 17) - 1;

using Rtl = Unreset<Vmult>;
using Twin = Filled<Mult, 4>;

struct Adapter {
  static void drive(Rtl& rtl, const Mult::In& in) {
    rtl.a_i = port_bits<35, std::uint64_t>(in.a);
    rtl.b_i = port_bits<18>(in.b);
  }
  template <class Check>
  static void compare(Check& check, const Rtl& rtl, const Twin::Out& out) {
    if (out.known) check("product", sign_extend<53>(rtl.product_o), out.product);
  }
};

using Bench = LockStep<Rtl, Twin, Adapter>;

/// The RTL's product is the 128-bit product of the operands four clocks ago.
struct FourClocksAgo {
  std::int64_t* compared;
  std::array<int128_t, 4> expected{};
  int filled = 0;

  const char* operator()(const Mult::In& in, const Rtl& rtl, const Twin&, bool in_reset) {
    filled = in_reset ? 0 : filled + 1;
    expected = {static_cast<int128_t>(in.a) * in.b, expected[0], expected[1], expected[2]};
    if (filled < 4) return nullptr;
    ++*compared;
    return sign_extend<53>(rtl.product_o) == expected[3]
               ? nullptr
               : "product of the operands four clocks ago";
  }
};

/// Ends of the range, and the neighbourhood of every power of two with either sign.
std::vector<std::int64_t> corners(std::int64_t max) {
  std::vector<std::int64_t> list{0, max, -max - 1};
  for (std::int64_t power = 1; power <= max; power *= 2) {
    for (const std::int64_t x : {power - 1, power, power + 1}) {
      if (x > max) continue;
      list.push_back(x);
      list.push_back(-x);
    }
  }
  return list;
}

}  // namespace

TEST_CASE("mult: every pair of corners, back to back") {
  std::vector<Mult::In> pairs;
  for (const std::int64_t a : corners(kMaxA)) {
    for (const std::int64_t b : corners(kMaxB)) pairs.push_back({a, b});
  }
  std::int64_t compared = 0;
  Bench bench("mult", 1);
  const auto stimulus = [&pairs](std::int64_t clock) {
    return pairs[static_cast<std::size_t>(clock) % pairs.size()];
  };
  const auto size = static_cast<std::int64_t>(pairs.size());
  bench.run(stimulus, size + 20, {}, FourClocksAgo{&compared, {}, 0});
  REQUIRE(compared >= size + 10);
}

TEST_CASE("mult: random operands") {
  struct Stimulus {
    Random random{3};
    Mult::In operator()(std::int64_t) {
      // Every magnitude alike: the random word is cut at a random place.
      const auto a = static_cast<std::int64_t>(random.bits()) >> (29 + random.below(35));
      const auto b = static_cast<std::int64_t>(random.bits()) >> (46 + random.below(18));
      return {a, b};
    }
  };
  std::int64_t compared = 0;
  Bench bench("mult", 2);
  const std::int64_t clocks = scaled_clocks(500000);
  bench.run(Stimulus{}, clocks, {1000}, FourClocksAgo{&compared, {}, 0});
  REQUIRE(compared > clocks * 9 / 10);
}

TEST_CASE("mult: the largest products") {
  Mult mult;
  const auto product = [&mult](std::int64_t a, std::int64_t b) {
    for (int k = 0; k < 4; ++k) mult.clock({a, b});
    return mult.out().product;
  };
  REQUIRE(product(-kMaxA - 1, -kMaxB - 1) == std::int64_t{1} << 51);
  REQUIRE(product(kMaxA, -kMaxB - 1) == -((std::int64_t{1} << 51) - (std::int64_t{1} << 17)));
  REQUIRE(product(-1, -1) == 1);
}
