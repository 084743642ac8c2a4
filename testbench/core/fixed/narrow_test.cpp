// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// narrow() against exact rational arithmetic on unbounded integers, written from the definitions
// of rounding and overflow by division and remainder.
// Documentation: docs/fixed-point.md
#include <boost/multiprecision/cpp_int.hpp>

#include "cast_matrix.hpp"
#include "catch.hpp"

namespace {

using boost::multiprecision::cpp_int;
using namespace feltgate;
using namespace feltgate::test;

cpp_int power(int k) {
  cpp_int p = 1;
  p <<= k;
  return p;
}

cpp_int exact(int128_t x) {
  const int128_t high = x >> 64;
  return cpp_int(static_cast<std::int64_t>(high)) * power(64) +
         cpp_int(static_cast<std::uint64_t>(x));
}

struct ExactResult {
  cpp_int raw;
  bool outside;
};

/// The definition: the source value as a fraction of the target's last bit, rounded, then limited.
ExactResult exact_narrow(const Cast& cast, int128_t raw) {
  const int drop = cast.from.fraction - cast.to.fraction;
  const cpp_int denominator = drop > 0 ? power(drop) : cpp_int(1);
  const cpp_int numerator = exact(raw) * (drop < 0 ? power(-drop) : cpp_int(1));
  cpp_int quotient;
  cpp_int rest;
  divide_qr(numerator, denominator, quotient, rest);  // truncates toward zero
  cpp_int floor = quotient;
  if (rest < 0) {
    floor -= 1;
    rest += denominator;
  }
  cpp_int y = floor;
  const bool odd = floor % 2 != 0;
  switch (cast.round) {
    case Round::truncate:
      break;
    case Round::half_up:
      if (2 * rest >= denominator) y += 1;
      break;
    case Round::convergent:
      if (2 * rest > denominator || (2 * rest == denominator && odd)) y += 1;
      break;
    case Round::toward_zero:
      y = quotient;
  }
  const cpp_int span = power(cast.to.width());
  const cpp_int low = cast.to.sign == 1 ? cpp_int(-span / 2) : cpp_int(0);
  const cpp_int high = low + span - 1;
  const bool outside = y < low || y > high;
  if (cast.overflow == Overflow::saturate) return {y < low ? low : (y > high ? high : y), outside};
  cpp_int offset = (y - low) % span;
  if (offset < 0) offset += span;
  return {low + offset, outside};
}

struct Tally {
  long casts = 0;
  long outside = 0;
  long mismatches = 0;
  std::string first;

  void check(const Cast& cast, int128_t raw) {
    const CastResult got = cast.run(raw);
    const ExactResult want = exact_narrow(cast, raw);
    const bool flag = cast.overflow == Overflow::saturate && want.outside;
    ++casts;
    outside += want.outside ? 1 : 0;
    if (exact(got.raw) == want.raw && got.saturated == flag) return;
    if (mismatches++ == 0) {
      first = describe(cast, raw) + ": got " + exact(got.raw).str() + ", want " + want.raw.str();
    }
  }
};

}  // namespace

TEST_CASE("narrow equals exact rational arithmetic on every value of the small casts", "[fixed]") {
  Tally tally;
  for (const Cast& cast : small_casts()) {
    for (int128_t raw = lowest_raw(cast.from); raw <= highest_raw(cast.from); ++raw) {
      tally.check(cast, raw);
    }
  }
  INFO(tally.first);
  CHECK(tally.mismatches == 0);
  CHECK(tally.casts == 2L * 17 * 8 * 256);
  CHECK(tally.outside > tally.casts / 10);
  CHECK(tally.outside < tally.casts * 9 / 10);
}

TEST_CASE("narrow equals exact rational arithmetic on random wide casts", "[fixed]") {
  Tally tally;
  Random random(1);
  for (const Cast& cast : wide_casts()) {
    for (int k = 0; k < 2000; ++k) tally.check(cast, biased_raw(random, cast.from, cast.to));
  }
  INFO(tally.first);
  CHECK(tally.mismatches == 0);
  CHECK(tally.casts == 14L * 8 * 2000);
  CHECK(tally.outside > tally.casts / 20);
  CHECK(tally.outside < tally.casts * 9 / 10);
}
