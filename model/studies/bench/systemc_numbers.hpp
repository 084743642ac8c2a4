// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A number policy in SystemC's fixed point: the laws of the twin, evaluated by a library that
// shares no code with `fixed`. Only <fx.h> is included: all of <systemc> would tie the program to
// one C++ standard at link time. The library wants a sc_main and is not thread-safe: one thread per
// process uses it. Documentation: docs/bench.md
#pragma once

#include <sysc/datatypes/fx/fx.h>

#include <cstdint>

#include "feltgate/numbers.hpp"

// The library refers to sc_main; programs have their own main() and never call it.
extern "C" [[gnu::used]] inline int sc_main(int /*argc*/, char** /*argv*/) { return 0; }

namespace feltgate {

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

/// An exact intermediate result, as wide as necessary.
struct SystemCValue {
  sc_dt::sc_fxval value;
};

/// A number of format Key, held by SystemC in that format.
template <int Key>
class SystemCNumber {
 public:
  static constexpr Format format = Format::from_key(Key);
  template <sc_dt::sc_q_mode Q, sc_dt::sc_o_mode O>
  using Word =
      std::conditional_t<format.sign == 1,
                         sc_dt::sc_fixed<format.width(), format.sign + format.integer, Q, O>,
                         sc_dt::sc_ufixed<format.width(), format.sign + format.integer, Q, O>>;
  using Plain = Word<sc_dt::SC_TRN, sc_dt::SC_WRAP>;

  SystemCNumber() : word_(0) {}
  explicit SystemCNumber(const Plain& word) : word_(word) {}
  operator SystemCValue() const { return {sc_dt::sc_fxval(word_)}; }
  const Plain& word() const { return word_; }

 private:
  Plain word_;
};

namespace systemc {

inline const sc_dt::sc_fxval& exact(const SystemCValue& x) { return x.value; }
template <int Key>
const typename SystemCNumber<Key>::Plain& exact(const SystemCNumber<Key>& x) {
  return x.word();
}

template <class X>
struct IsNumber : std::false_type {};
template <>
struct IsNumber<SystemCValue> : std::true_type {};
template <int Key>
struct IsNumber<SystemCNumber<Key>> : std::true_type {};
/// Enables an operator for our wrappers only.
template <class A, class B, class Result>
using Operator = std::enable_if_t<IsNumber<A>::value && IsNumber<B>::value, Result>;

}  // namespace systemc

template <class A, class B>
systemc::Operator<A, B, SystemCValue> operator+(const A& a, const B& b) {
  return {systemc::exact(a) + systemc::exact(b)};
}
template <class A, class B>
systemc::Operator<A, B, SystemCValue> operator-(const A& a, const B& b) {
  return {systemc::exact(a) - systemc::exact(b)};
}
template <class A, class B>
systemc::Operator<A, B, SystemCValue> operator*(const A& a, const B& b) {
  return {systemc::exact(a) * systemc::exact(b)};
}
template <class A>
systemc::Operator<A, A, SystemCValue> operator-(const A& a) {
  return {-systemc::exact(a)};
}
template <class A, class B>
systemc::Operator<A, B, bool> operator<(const A& a, const B& b) {
  return systemc::exact(a) < systemc::exact(b);
}
template <class A, class B>
systemc::Operator<A, B, bool> operator>(const A& a, const B& b) {
  return systemc::exact(a) > systemc::exact(b);
}
template <class A, class B>
systemc::Operator<A, B, bool> operator<=(const A& a, const B& b) {
  return systemc::exact(a) <= systemc::exact(b);
}
template <class A, class B>
systemc::Operator<A, B, bool> operator>=(const A& a, const B& b) {
  return systemc::exact(a) >= systemc::exact(b);
}
template <class A, class B>
systemc::Operator<A, B, bool> operator==(const A& a, const B& b) {
  return systemc::exact(a) == systemc::exact(b);
}

/// The number policy. SystemC itself performs every rounding and limiting.
struct SystemC {
  static constexpr bool is_fixed = true;
  template <int Key>
  using num = SystemCNumber<Key>;

  template <int Key>
  static SystemCNumber<Key> from_raw(std::int64_t raw) {
    constexpr int fraction = SystemCNumber<Key>::format.fraction;
    const sc_dt::sc_fxval value(static_cast<sc_dt::int64>(raw));
    return SystemCNumber<Key>(
        typename SystemCNumber<Key>::Plain(fraction >= 0 ? value >> fraction : value << -fraction));
  }
  template <int Key>
  static std::int64_t raw(const SystemCNumber<Key>& x) {
    constexpr int fraction = SystemCNumber<Key>::format.fraction;
    const sc_dt::sc_fxval value(x.word());
    return static_cast<std::int64_t>(
        (fraction >= 0 ? value << fraction : value >> -fraction).to_int64());
  }
  template <int Key, Round R, Overflow O, class X>
  static SystemCNumber<Key> narrowed(const X& x, bool* saturated) {
    using Number = SystemCNumber<Key>;
    const typename Number::template Word<systemc_mode(R), systemc_mode(O)> word(systemc::exact(x));
    if (O == Overflow::saturate && saturated != nullptr && word.overflow_flag()) *saturated = true;
    return Number(typename Number::Plain(word));
  }
  template <int K, class X>
  static SystemCValue scaled(const X& x) {
    const sc_dt::sc_fxval value(systemc::exact(x));
    return {K >= 0 ? value << (K >= 0 ? K : 0) : value >> (K >= 0 ? 0 : -K)};
  }
};

namespace detail {

template <int Key>
struct Negated<SystemCNumber<Key>> {
  static SystemCNumber<Key> of(const SystemCNumber<Key>& x) {
    return SystemCNumber<Key>(typename SystemCNumber<Key>::Plain(-x.word()));
  }
};

}  // namespace detail
}  // namespace feltgate
