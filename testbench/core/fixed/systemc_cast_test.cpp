// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// narrow() and the exact operators against SystemC's sc_fix / sc_ufix: every value of the small
// casts, 425 600 random wide casts, and sums, differences and products of wide words.
// Documentation: docs/fixed-point.md
#include <sysc/datatypes/fx/fx.h>

#include <cstdint>

#include "cast_matrix.hpp"
#include "catch.hpp"
#include "feltgate/fixed.hpp"

// The library refers to sc_main; the program has its own main() and never calls it. Only <fx.h> is
// included: all of <systemc> would tie the program to one C++ standard at link time.
extern "C" [[gnu::used]] int sc_main(int /*argc*/, char** /*argv*/) { return 0; }

namespace {

using namespace feltgate;
using namespace feltgate::test;

constexpr sc_dt::sc_q_mode systemc_mode(Round round) {
  switch (round) {
    case Round::truncate:
      return sc_dt::SC_TRN;
    case Round::half_up:
      return sc_dt::SC_RND;
    case Round::convergent:
      return sc_dt::SC_RND_CONV;
    case Round::toward_zero:
      return sc_dt::SC_TRN_ZERO;
  }
  return sc_dt::SC_TRN;
}

constexpr sc_dt::sc_o_mode systemc_mode(Overflow overflow) {
  return overflow == Overflow::saturate ? sc_dt::SC_SAT : sc_dt::SC_WRAP;
}

/// raw * 2^-fraction as SystemC's unbounded fixed-point value, exactly.
sc_dt::sc_fxval systemc_value(int128_t raw, int fraction) {
  const auto high = static_cast<std::int64_t>(raw >> 63);
  const auto low = static_cast<std::int64_t>(raw & ones<int128_t>(63));
  sc_dt::sc_fxval value(static_cast<sc_dt::int64>(high));
  value <<= 63;
  value += sc_dt::sc_fxval(static_cast<sc_dt::int64>(low));
  return fraction >= 0 ? value >> fraction : value << -fraction;
}

/// One SystemC variable of the target's format, reused for every value of a cast.
template <class Number>
class Oracle {
 public:
  explicit Oracle(const Cast& cast)
      // n_bits = 0 is plain two's complement wrap; 1 would keep the sign bit.
      : number_(cast.to.width(), cast.to.sign + cast.to.integer, systemc_mode(cast.round),
                systemc_mode(cast.overflow), 0) {}

  const Number& narrowed(const sc_dt::sc_fxval& value) { return number_ = value; }

 private:
  Number number_;
};

struct Tally {
  long casts = 0;
  long saturated = 0;
  long mismatches = 0;
  std::string first;

  template <class Number>
  void check(const Cast& cast, Oracle<Number>& oracle, int128_t raw) {
    const CastResult got = cast.run(raw);
    const Number& want = oracle.narrowed(systemc_value(raw, cast.from.fraction));
    ++casts;
    saturated += got.saturated ? 1 : 0;
    const bool limited = cast.overflow == Overflow::saturate && want.overflow_flag();
    if (want == systemc_value(got.raw, cast.to.fraction) && got.saturated == limited) return;
    if (mismatches++ == 0) first = describe(cast, raw) + ": SystemC has " + want.to_string();
  }

  template <class Values>
  void check_all(const Cast& cast, Values values) {
    if (cast.to.sign == 1) {
      Oracle<sc_dt::sc_fix> oracle(cast);
      values([&](int128_t raw) { check(cast, oracle, raw); });
    } else {
      Oracle<sc_dt::sc_ufix> oracle(cast);
      values([&](int128_t raw) { check(cast, oracle, raw); });
    }
  }
};

}  // namespace

TEST_CASE("narrow equals SystemC on every value of the small casts", "[fixed][systemc]") {
  Tally tally;
  for (const Cast& cast : small_casts()) {
    tally.check_all(cast, [&](auto check) {
      for (int128_t raw = lowest_raw(cast.from); raw <= highest_raw(cast.from); ++raw) check(raw);
    });
  }
  INFO(tally.first);
  CHECK(tally.mismatches == 0);
  CHECK(tally.casts == 2L * 17 * 8 * 256);
  CHECK(tally.saturated > 0);
}

TEST_CASE("narrow equals SystemC on random wide casts", "[fixed][systemc]") {
  Tally tally;
  Random random(2);
  for (const Cast& cast : wide_casts()) {
    tally.check_all(cast, [&](auto check) {
      for (int k = 0; k < 3800; ++k) check(biased_raw(random, cast.from, cast.to));
    });
  }
  INFO(tally.first);
  WARN(tally.casts << " wide casts, " << tally.saturated << " of them saturated");
  CHECK(tally.mismatches == 0);
  CHECK(tally.casts == 14L * 8 * 3800);
  CHECK(tally.saturated > tally.casts / 40);
  CHECK(tally.saturated < tally.casts / 2);
}

namespace {

/// Random values and the range ends of A and B through + - * and negation.
template <class A, class B>
int operator_mismatches(Random& random) {
  int bad = 0;
  for (int k = 0; k < 3000; ++k) {
    const int128_t i = biased_raw(random, A::format, B::format);
    const int128_t j = biased_raw(random, B::format, A::format);
    const A a = A::from_raw(static_cast<typename A::raw_type>(i));
    const B b = B::from_raw(static_cast<typename B::raw_type>(j));
    const sc_dt::sc_fxval x = systemc_value(i, A::format.fraction);
    const sc_dt::sc_fxval y = systemc_value(j, B::format.fraction);
    const auto differs = [](auto ours, const sc_dt::sc_fxval& theirs) {
      return systemc_value(ours.raw(), decltype(ours)::format.fraction) != theirs ? 1 : 0;
    };
    bad += differs(a + b, x + y) + differs(a - b, x - y) + differs(a * b, x * y) + differs(-a, -x);
    bad += (a < b) != (x < y) || (a == b) != (x == y) ? 1 : 0;
  }
  return bad;
}

}  // namespace

TEST_CASE("sums, differences and products equal SystemC's exact ones", "[fixed][systemc]") {
  Random random(3);
  CHECK(operator_mismatches<fixed<1, 10, 33>, fixed<0, -10, 28>>(random) == 0);
  CHECK(operator_mismatches<fixed<1, 4, 16>, fixed<0, 5, 13>>(random) == 0);
  CHECK(operator_mismatches<fixed<0, 20, 43>, fixed<0, 30, 33>>(random) == 0);
  CHECK(operator_mismatches<fixed<1, 30, 33>, fixed<1, 20, 41>>(random) == 0);
  CHECK(operator_mismatches<fixed<1, 40, -10>, fixed<1, -12, 40>>(random) == 0);
  CHECK(operator_mismatches<fixed<1, 0, 0>, fixed<1, 63, 0>>(random) == 0);
}
