// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Mutants that are compiled once and chosen at run time: `a + b` of a header becomes
// feltgate_mutant::plus<17>(a, b), which is a - b in mutant 17. Constants stay as they are.
// Written into headers by scripts/mutation/twin_source.py. Documentation: docs/testing.md
#pragma once

#include <type_traits>
#include <utility>

namespace feltgate_mutant {

/// By number, from 1: 0 as it was, 1 chosen, 2 to be noted when it is reached.
extern unsigned char state[];
/// Notes it; whether it is the chosen one.
bool reached(int number);

constexpr bool on(int number) {
  if (__builtin_is_constant_evaluated() || number < 0) return false;
  return __builtin_expect(state[number] != 0, 0) && reached(number);
}

template <class T, class = void>
struct HasFormat : std::false_type {};
template <class T>
struct HasFormat<T, std::void_t<decltype(T::format.fraction)>> : std::true_type {};

/// The same for another rounding of x into a To; without bits to round there is no such mutant.
template <class To, class From>
constexpr bool rounds(int number, const From&) {
  if constexpr (HasFormat<To>::value && HasFormat<From>::value) {
    if constexpr (From::format.fraction > To::format.fraction) return on(number);
  }
  return false;
}

/// x as a To, by its raw integer where it is a fixed-point number of another format.
template <class To, class From>
constexpr To as(From x) {
  if constexpr (std::is_same_v<To, From>) {
    return x;
  } else if constexpr (std::is_convertible_v<From, To>) {
    return static_cast<To>(x);
  } else {
    return To::from_raw(static_cast<typename To::raw_type>(x.raw()));
  }
}

/// f(a, b), or f(b, a) where that is a call too.
template <int N, class F, class A, class B>
[[gnu::always_inline]] constexpr decltype(auto) swapped(F&& f, A&& a, B&& b) {
  if constexpr (std::is_invocable_v<F&, B&&, A&&>) {
    if constexpr (std::is_same_v<decltype(f(std::forward<B>(b), std::forward<A>(a))),
                                 decltype(f(std::forward<A>(a), std::forward<B>(b)))>) {
      if (on(N)) return f(std::forward<B>(b), std::forward<A>(a));
    }
  }
  return f(std::forward<A>(a), std::forward<B>(b));
}

#define FELTGATE_MUTANT_OPERATOR(name, was, is)          \
  template <int N, class A, class B>                     \
  [[gnu::always_inline]] constexpr auto name(A a, B b) { \
    if (on(N)) return as<decltype(a was b)>(a is b);     \
    return a was b;                                      \
  }
FELTGATE_MUTANT_OPERATOR(plus, +, -)
FELTGATE_MUTANT_OPERATOR(minus, -, +)
FELTGATE_MUTANT_OPERATOR(times, *, +)
FELTGATE_MUTANT_OPERATOR(over, /, *)
FELTGATE_MUTANT_OPERATOR(modulo, %, *)
FELTGATE_MUTANT_OPERATOR(left, <<, >>)
FELTGATE_MUTANT_OPERATOR(right, >>, <<)
FELTGATE_MUTANT_OPERATOR(bit_and, &, |)
FELTGATE_MUTANT_OPERATOR(bit_or, |, &)
FELTGATE_MUTANT_OPERATOR(bit_xor, ^, &)
#undef FELTGATE_MUTANT_OPERATOR

#define FELTGATE_MUTANT_ORDER(name, was, is, opposite)   \
  template <int N, int M, class A, class B>              \
  [[gnu::always_inline]] constexpr auto name(A a, B b) { \
    if (on(N)) return a is b;                            \
    if (on(M)) return a opposite b;                      \
    return a was b;                                      \
  }
FELTGATE_MUTANT_ORDER(less, <, <=, >=)
FELTGATE_MUTANT_ORDER(less_equal, <=, <, >)
FELTGATE_MUTANT_ORDER(greater, >, >=, <=)
FELTGATE_MUTANT_ORDER(greater_equal, >=, >, <)
#undef FELTGATE_MUTANT_ORDER

// A type may have only one of the two.
template <int N, class A, class B>
[[gnu::always_inline]] constexpr auto equal(A a, B b) {
  if (on(N)) return as<decltype(a == b)>(!(a == b));
  return a == b;
}
template <int N, class A, class B>
[[gnu::always_inline]] constexpr auto unequal(A a, B b) {
  if (on(N)) return as<decltype(a != b)>(!(a != b));
  return a != b;
}
template <int N, class A>
[[gnu::always_inline]] constexpr auto invert(A a) {
  return on(N) != !a;
}
template <int N, class A>
[[gnu::always_inline]] constexpr auto negate(A a) {
  if (on(N)) return as<decltype(-a)>(a);
  return -a;
}
template <int N, class A>
[[gnu::always_inline]] constexpr auto complement(A a) {
  if (on(N)) return as<decltype(~a)>(a);
  return ~a;
}

}  // namespace feltgate_mutant
