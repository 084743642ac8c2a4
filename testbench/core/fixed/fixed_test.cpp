// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The fixed type: growth rules, exact operators, comparisons, compile-time use, edge formats.
// FELTGATE_DEFECT=6 takes one bit from the product rule, 7 one bit from the sum rule.
// Documentation: docs/fixed-point.md
#include "feltgate/fixed.hpp"

#include <algorithm>
#include <vector>

#include "cast_matrix.hpp"
#include "catch.hpp"

namespace {

using namespace feltgate;
using namespace feltgate::test;

using Binary = Format (*)(Format, Format);

/// Every format of at most `widest` bits with I and F from -2 to 4.
std::vector<Format> small_formats(int widest) {
  std::vector<Format> formats;
  for (int s = 0; s <= 1; ++s) {
    for (int i = -2; i <= 4; ++i) {
      for (int f = -2; f <= 4; ++f) {
        const Format format{s, i, f};
        if (format.width() >= 1 && format.width() <= widest) formats.push_back(format);
      }
    }
  }
  return formats;
}

/// All results of one operation, as integers in units of 2^-fraction.
struct Results {
  std::int64_t low;
  std::int64_t high;
  bool odd;  ///< some result needs the last fraction bit
};

std::int64_t low_of(Format f) { return static_cast<std::int64_t>(lowest_raw(f)); }
std::int64_t high_of(Format f) { return static_cast<std::int64_t>(highest_raw(f)); }

template <class Operation>
Results all_results(Format a, Format b, Operation operation) {
  Results r{0, 0, false};
  bool first = true;
  for (std::int64_t x = low_of(a); x <= high_of(a); ++x) {
    for (std::int64_t y = low_of(b); y <= high_of(b); ++y) {
      const std::int64_t z = operation(x, y);
      r.low = first ? z : std::min(r.low, z);
      r.high = first ? z : std::max(r.high, z);
      r.odd = r.odd || z % 2 != 0;
      first = false;
    }
  }
  return r;
}

bool fits(const Results& r, Format f) {
  return f.width() >= 1 && r.low >= low_of(f) && r.high <= high_of(f);
}

/// No bit of f can go: neither the top integer bit, nor the last fraction bit, nor the sign.
bool is_tight(const Results& r, Format f) {
  return r.odd && !fits(r, {f.sign, f.integer - 1, f.fraction}) && (f.sign == 0 || r.low < 0);
}

/// The documented condition under which a growth rule has no spare bit.
bool well_formed(Format f) { return f.width() >= 2; }
bool overlap(Format a, Format b) {
  return std::min(a.integer, b.integer) + std::min(a.fraction, b.fraction) >= 1;
}

struct GrowthTally {
  int pairs = 0;
  int misfits = 0;
  int spare_bits_promised_away = 0;
  int tight = 0;

  void add(const Results& r, Format f, bool must_be_tight) {
    ++pairs;
    misfits += fits(r, f) ? 0 : 1;
    const bool t = is_tight(r, f);
    tight += t ? 1 : 0;
    spare_bits_promised_away += (must_be_tight && !t) ? 1 : 0;
  }
};

}  // namespace

TEST_CASE("growth rules hold every result and have no spare bit", "[fixed]") {
  GrowthTally sum;
  GrowthTally difference;
  GrowthTally product;
  const std::vector<Format> formats = small_formats(5);
  for (const Format& a : formats) {
    for (const Format& b : formats) {
      const int fraction = std::max(a.fraction, b.fraction);
      const std::int64_t ka = std::int64_t{1} << (fraction - a.fraction);
      const std::int64_t kb = std::int64_t{1} << (fraction - b.fraction);
      const bool good = well_formed(a) && well_formed(b);
      sum.add(all_results(a, b, [=](auto x, auto y) { return x * ka + y * kb; }), growth::sum(a, b),
              good && overlap(a, b));
      difference.add(all_results(a, b, [=](auto x, auto y) { return x * ka - y * kb; }),
                     growth::difference(a, b), good && overlap(a, b));
      product.add(all_results(a, b, [](auto x, auto y) { return x * y; }), growth::product(a, b),
                  good);
    }
  }
  for (const GrowthTally& t : {sum, difference, product}) {
    CHECK(t.pairs == static_cast<int>(formats.size() * formats.size()));
    CHECK(t.misfits == 0);
    CHECK(t.spare_bits_promised_away == 0);
    CHECK(t.tight > t.pairs / 4);
  }
}

TEST_CASE("negation and scaling", "[fixed]") {
  for (const Format& a : small_formats(6)) {
    const Results r = all_results(a, a, [](auto x, auto) { return -x; });
    const Format f = growth::negation(a);
    CHECK(fits(r, f));
    if (well_formed(a)) CHECK(is_tight(r, f));
    CHECK(growth::scaled(a, 3).width() == a.width());
    CHECK(Format::from_key(a.key()) == a);
  }
  constexpr auto x = fixed<1, 3, 4>::from_raw(-5);  // -0.3125
  constexpr auto y = scale_by_power_of_two<-3>(x);
  STATIC_REQUIRE(decltype(y)::format == Format{1, 0, 7});
  CHECK(y.to_double() == -0.3125 / 8);
}

namespace {

/// Every value pair of two types through every operator, against doubles (exact at these widths).
template <class A, class B>
int operator_mismatches() {
  int bad = 0;
  for (auto i = A::min_raw(); i <= A::max_raw(); ++i) {
    for (auto j = B::min_raw(); j <= B::max_raw(); ++j) {
      const A a = A::from_raw(i);
      const B b = B::from_raw(j);
      const double x = a.to_double();
      const double y = b.to_double();
      bad += (a + b).to_double() != x + y;
      bad += (a - b).to_double() != x - y;
      bad += (a * b).to_double() != x * y;
      bad += (-a).to_double() != -x;
      bad += (a == b) != (x == y) || (a != b) != (x != y);
      bad += (a < b) != (x < y) || (a > b) != (x > y);
      bad += (a <= b) != (x <= y) || (a >= b) != (x >= y);
    }
  }
  return bad;
}

template <class A, class... B>
int against_all() {
  return (operator_mismatches<A, B>() + ...);
}

template <class... T>
int every_pair() {
  return (against_all<T, T...>() + ...);
}

}  // namespace

TEST_CASE("operators and comparisons are exact for every value pair of mixed formats", "[fixed]") {
  CHECK(every_pair<fixed<1, 3, 2>, fixed<0, 3, 2>, fixed<1, 0, 0>, fixed<0, 1, 0>, fixed<1, -1, 4>,
                   fixed<0, -2, 6>, fixed<1, 6, -2>, fixed<0, 5, -1>>() == 0);
}

TEST_CASE("everything works at compile time", "[fixed]") {
  using Torque = fixed<1, 4, 16>;
  constexpr Torque half = Torque::from_raw(32768);
  constexpr auto product = half * half;
  STATIC_REQUIRE(decltype(product)::format == Format{1, 9, 32});
  STATIC_REQUIRE(product.to_double() == 0.25);
  STATIC_REQUIRE(narrow<Torque, Round::convergent, Overflow::wrap>(product).raw() == 16384);
  STATIC_REQUIRE(narrow<fixed<1, 0, 3>, Round::half_up, Overflow::saturate>(half + half) ==
                 fixed<1, 0, 3>::max());
  STATIC_REQUIRE((half - half).raw() == 0);
  STATIC_REQUIRE(-Torque::min() > Torque::max());
  STATIC_REQUIRE(Torque().raw() == 0);
  STATIC_REQUIRE(Torque::min().to_double() == -16.0);
  STATIC_REQUIRE(fixed<1, 31, 32>::min_raw() == INT64_MIN);
  STATIC_REQUIRE(fixed<0, 31, 32>::max_raw() == INT64_MAX);
  STATIC_REQUIRE(sizeof(fixed<1, 31, 32>) == 8);
  STATIC_REQUIRE(sizeof(fixed<0, 32, 32>) == 16);
}

TEST_CASE("one-bit formats", "[fixed]") {
  STATIC_REQUIRE(fixed<1, 0, 0>::min_raw() == -1);
  STATIC_REQUIRE(fixed<1, 0, 0>::max_raw() == 0);
  STATIC_REQUIRE(fixed<0, 1, 0>::min_raw() == 0);
  STATIC_REQUIRE(fixed<0, 1, 0>::max_raw() == 1);
  constexpr auto sign = fixed<1, 0, 0>::min();
  STATIC_REQUIRE((sign * sign).to_double() == 1.0);
  STATIC_REQUIRE(
      narrow<fixed<1, 0, 0>, Round::truncate, Overflow::saturate>(fixed<1, 3, 0>::from_raw(5))
          .raw() == 0);
  STATIC_REQUIRE(
      narrow<fixed<1, 0, 0>, Round::truncate, Overflow::wrap>(fixed<1, 3, 0>::from_raw(5)).raw() ==
      -1);
}

TEST_CASE("the widest words neither overflow nor lose a bit", "[fixed]") {
  using Wide = fixed<1, 62, 64>;  // 127 bits
  STATIC_REQUIRE(Wide::min_raw() + Wide::max_raw() == -1);
  CHECK(Wide::min_raw() == -power_of_two<int128_t>(126));
  const auto product = fixed<1, 31, 32>::min() * fixed<1, 30, 32>::min();  // 2^61, 126 + 1 bits
  STATIC_REQUIRE(decltype(product)::width == 127);
  CHECK(product.raw() == power_of_two<int128_t>(125));
  using Same63 = fixed<1, 30, 32>;
  CHECK(narrow<Same63, Round::half_up, Overflow::wrap>(Same63::min()) == Same63::min());
  using Full64 = fixed<1, 31, 32>;
  CHECK(narrow<Full64, Round::half_up, Overflow::wrap>(Full64::max() + Full64::max()).raw() == -2);
  bool saturated = false;
  CHECK(narrow<Full64, Round::half_up, Overflow::saturate>(-Full64::min(), &saturated) ==
        Full64::max());
  CHECK(saturated);
}

TEST_CASE("the saturation flag is set when a value is changed to fit, and never cleared",
          "[fixed]") {
  using From = fixed<1, 4, 2>;
  using To = fixed<1, 2, 0>;
  bool saturated = false;
  narrow<To, Round::half_up, Overflow::saturate>(From::from_raw(13), &saturated);  // 3.25 -> 3
  CHECK_FALSE(saturated);
  narrow<To, Round::half_up, Overflow::saturate>(From::from_raw(14), &saturated);  // 3.5 -> 4 -> 3
  CHECK(saturated);
  narrow<To, Round::half_up, Overflow::saturate>(From::from_raw(0), &saturated);
  CHECK(saturated);
}

TEST_CASE("worked values of the documentation: four roundings to an integer", "[fixed]") {
  struct Row {
    double value;
    int truncate, half_up, convergent, toward_zero;
  };
  const Row rows[] = {{2.5, 2, 3, 2, 2},       {2.25, 2, 2, 2, 2},     {1.5, 1, 2, 2, 1},
                      {0.75, 0, 1, 1, 0},      {0.5, 0, 1, 0, 0},      {-0.25, -1, 0, 0, 0},
                      {-0.5, -1, 0, 0, 0},     {-0.75, -1, -1, -1, 0}, {-1.5, -2, -1, -2, -1},
                      {-2.25, -3, -2, -2, -2}, {-2.5, -3, -2, -2, -2}, {-2.75, -3, -3, -3, -2}};
  using To = fixed<1, 3, 0>;
  for (const Row& row : rows) {
    const auto x = fixed<1, 3, 2>::from_raw(static_cast<std::int64_t>(row.value * 4));
    INFO(row.value);
    CHECK(narrow<To, Round::truncate, Overflow::wrap>(x).raw() == row.truncate);
    CHECK(narrow<To, Round::half_up, Overflow::wrap>(x).raw() == row.half_up);
    CHECK(narrow<To, Round::convergent, Overflow::wrap>(x).raw() == row.convergent);
    CHECK(narrow<To, Round::toward_zero, Overflow::wrap>(x).raw() == row.toward_zero);
  }
  // Round, then limit: 3.75 in [1,3,2] rounds to 4, which [1,2,1] holds as 3.5 (the other order
  // finds 3.75 in range, rounds, and wraps to -4).
  const auto x = fixed<1, 3, 2>::from_raw(15);
  CHECK(narrow<fixed<1, 2, 1>, Round::half_up, Overflow::saturate>(x).raw() == 7);
}
