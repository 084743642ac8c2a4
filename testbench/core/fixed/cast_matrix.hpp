// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The casts that every oracle has to agree on: small formats for exhaustive comparison, wide ones
// for random comparison biased to ties and range ends. All four roundings, both overflows.
// Documentation: docs/fixed-point.md
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "feltgate/fixed.hpp"
#include "random.hpp"

namespace feltgate::test {

struct CastResult {
  int128_t raw;
  bool saturated;
};

/// One conversion From -> To in one rounding and overflow mode; run() takes the source's raw value.
struct Cast {
  Format from;
  Format to;
  Round round;
  Overflow overflow;
  CastResult (*run)(int128_t raw);
};

template <class From, class To, Round R, Overflow O>
CastResult run_cast(int128_t raw) {
  CastResult result{0, false};
  const From x = From::from_raw(static_cast<typename From::raw_type>(raw));
  result.raw = narrow<To, R, O>(x, &result.saturated).raw();
  return result;
}

template <class From, class To, Round R>
void add_overflows(std::vector<Cast>& casts) {
  casts.push_back(
      {From::format, To::format, R, Overflow::wrap, run_cast<From, To, R, Overflow::wrap>});
  casts.push_back(
      {From::format, To::format, R, Overflow::saturate, run_cast<From, To, R, Overflow::saturate>});
}

template <class From, class To>
void add_modes(std::vector<Cast>& casts) {
  add_overflows<From, To, Round::truncate>(casts);
  add_overflows<From, To, Round::half_up>(casts);
  add_overflows<From, To, Round::convergent>(casts);
  add_overflows<From, To, Round::toward_zero>(casts);
}

template <class From, class... To>
void add_targets(std::vector<Cast>& casts) {
  (add_modes<From, To>(casts), ...);
}

template <class From>
void add_small_targets(std::vector<Cast>& casts) {
  add_targets<From,                                               //
              fixed<1, 1, 2>, fixed<1, 3, 2>, fixed<1, 5, 2>,     // signed: narrower, wider
              fixed<0, 2, 2>, fixed<0, 4, 1>, fixed<0, 3, 6>,     // unsigned
              fixed<1, 4, 8>, fixed<1, 2, 8>,                     // the fraction grows
              fixed<1, 0, 0>, fixed<0, 1, 0>, fixed<1, 3, -3>,    // one bit
              fixed<1, -1, 4>, fixed<0, -1, 5>, fixed<1, 5, -2>,  // I or F below zero
              fixed<1, 8, -7>, fixed<1, 4, -4>, fixed<0, 9, -5>   // every bit is dropped
              >(casts);
}

/// 8-bit sources, signed and unsigned, into 17 formats each.
inline std::vector<Cast> small_casts() {
  std::vector<Cast> casts;
  add_small_targets<fixed<1, 3, 4>>(casts);
  add_small_targets<fixed<0, 4, 4>>(casts);
  return casts;
}

/// 64 to 110 bits into 33 to 64 bits.
inline std::vector<Cast> wide_casts() {
  std::vector<Cast> casts;
  add_modes<fixed<1, 31, 32>, fixed<1, 16, 16>>(casts);
  add_modes<fixed<0, 32, 32>, fixed<0, 20, 20>>(casts);
  add_modes<fixed<1, 39, 32>, fixed<1, 31, 16>>(casts);
  add_modes<fixed<1, 11, 61>, fixed<1, 10, 33>>(casts);
  add_modes<fixed<1, 47, 32>, fixed<1, 31, 32>>(casts);
  add_modes<fixed<1, 40, 40>, fixed<1, 10, 53>>(casts);
  add_modes<fixed<1, 31, 64>, fixed<1, 31, 32>>(casts);
  add_modes<fixed<0, 48, 48>, fixed<1, 40, 20>>(casts);
  add_modes<fixed<1, 19, 80>, fixed<0, 20, 30>>(casts);
  add_modes<fixed<1, -2, 101>, fixed<1, -3, 50>>(casts);
  add_modes<fixed<1, 55, 54>, fixed<1, 31, 1>>(casts);
  add_modes<fixed<0, 60, 50>, fixed<0, 64, 0>>(casts);
  add_modes<fixed<1, 59, 50>, fixed<1, 63, 0>>(casts);
  add_modes<fixed<1, 10, 93>, fixed<1, 80, -40>>(casts);
  return casts;
}

/// Uniform over all signed values of `bits` bits, 1 <= bits <= 126.
inline int128_t random_word(Random& random, int bits) {
  const int128_t high = static_cast<int128_t>(random.bits() >> 2) * power_of_two<int128_t>(64);
  const int128_t word = high + static_cast<int128_t>(random.bits());
  return (word >> (126 - bits)) - power_of_two<int128_t>(bits - 1);
}

inline int128_t lowest_raw(Format f) {
  return f.sign == 0 ? int128_t{0} : -power_of_two<int128_t>(f.width() - 1);
}
inline int128_t highest_raw(Format f) { return power_of_two<int128_t>(f.width() - f.sign) - 1; }

/// A source value: uniform, or on and beside a tie, an end of the target's range, or zero.
inline int128_t biased_raw(Random& random, Format from, Format to) {
  const int drop = growth::max_of(from.fraction - to.fraction, 0);
  const int above_drop = growth::max_of(1 + from.integer + to.fraction, 1);
  const auto small = [&](int low, int high) { return static_cast<int>(random.between(low, high)); };
  const int128_t nudge = small(-2, 2);
  int128_t raw = 0;
  switch (random.below(4)) {
    case 0:
      raw = random_word(random, from.width());
      break;
    case 1:  // (k + 1/2) of the target's last bit
      if (drop == 0 || drop + above_drop > 120) break;
      raw = random_word(random, small(1, above_drop)) * power_of_two<int128_t>(drop) +
            power_of_two<int128_t>(drop - 1) + nudge;
      break;
    case 2: {  // the target's ends, and half a last bit beyond and within
      if (drop + to.width() > 120) break;
      const int128_t end = random.coin() ? lowest_raw(to) : highest_raw(to) + 1;
      const int128_t half = drop == 0 ? int128_t{1} : power_of_two<int128_t>(drop - 1);
      raw = end * power_of_two<int128_t>(drop) + small(-2, 2) * half + nudge;
      if (to.fraction > from.fraction) raw >>= to.fraction - from.fraction;
      break;
    }
    default:
      raw = random.coin() ? lowest_raw(from) + small(0, 2)
                          : (random.coin() ? highest_raw(from) - small(0, 2) : nudge);
  }
  // Two's complement wrap into the source's range keeps the low bits, hence the tie.
  const int128_t span_mask = ones<int128_t>(from.width());
  raw &= span_mask;
  return raw > highest_raw(from) ? raw | ~span_mask : raw;
}

/// "[1,3,4] raw -7 -> [1,1,2], half_up, saturate" for the report of a mismatch.
inline std::string describe(const Cast& cast, int128_t raw) {
  static const char* const rounds[] = {"truncate", "half_up", "convergent", "toward_zero"};
  const auto text = [](Format f) {
    return "[" + std::to_string(f.sign) + "," + std::to_string(f.integer) + "," +
           std::to_string(f.fraction) + "]";
  };
  const auto low = static_cast<std::int64_t>(raw);
  const std::string number = raw == low
                                 ? std::to_string(low)
                                 : std::to_string(static_cast<std::int64_t>(raw >> 64)) + "*2^64+" +
                                       std::to_string(static_cast<std::uint64_t>(raw));
  return text(cast.from) + " raw " + number + " -> " + text(cast.to) + ", " +
         rounds[static_cast<int>(cast.round)] +
         (cast.overflow == Overflow::wrap ? ", wrap" : ", saturate");
}

}  // namespace feltgate::test
