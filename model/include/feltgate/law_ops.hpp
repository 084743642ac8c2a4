// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The engine's instructions as templates over a number policy (numbers.hpp); the C++ of a compiled
// law consists of calls to them. In fixed point each result equals the engine's word bit by bit. In
// real numbers a result is the same multiple of its scale, and nothing is rounded, limited or
// wrapped. Documentation: docs/law-compiler.md
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "feltgate/generated/engine.hpp"
#include "feltgate/numbers.hpp"
#include "feltgate/real_functions.hpp"

namespace feltgate::law {

/// A word of table memory for LRP: the value at the start of a segment, and its change over the
/// segment.
struct LawSegment {
  std::int32_t value;  ///< 20 bits, signed
  std::int32_t slope;  ///< 16 bits, signed
};

/// An input of a law.
struct LawInput {
  const char* name;
  int axis;
  int source;    ///< 0 position, 1 velocity, 2 tau_hat: word 48 + 3 axis + source of the engine
  double scale;  ///< SI value of an input of 1: rad, rad/s, Nm
};

/// A parameter word; the host may write it within its range.
struct LawWord {
  const char* name;
  const char* unit;  ///< unit as in the law's file
  double scale;      ///< SI value of a word of 1
  double to_si;      ///< SI value of 1 `unit`
  std::int32_t lower, upper, initial;
  bool derived;  ///< the host computes it from others
  int number;    ///< word number in parameter memory, 0 to 31
};

/// A torque output of a law.
struct LawOutput {
  const char* name;
  int axis;
  double scale;     ///< Nm for a word of 1
  double bound_nm;  ///< proven distance from the law's torque, outside the strips
};

struct LawEvent {
  const char* name;
  int number;
  double scale;  ///< SI value of a word of 1
};

/// An event that a run gave.
template <class Word>
struct LawHappened {
  bool happened = false;
  Word value{};
};

/// Instructions over the policy N.
template <class N>
struct LawOps {
  static constexpr bool is_fixed = N::is_fixed;
  static constexpr Format word_format{1, EngineMap::data_bits - 1, 0};
  static constexpr Format factor_format{1, EngineMap::factor_bits - 1, 0};
  static constexpr Format value_format{1, EngineMap::value_bits - 1, 0};
  static constexpr Format slope_format{1, EngineMap::slope_bits - 1, 0};
  static constexpr Format within_format{0, 0, EngineMap::fraction_bits};
  /// A data word; in real numbers the number that it stands for, divided by its scale.
  using Word = typename N::template num<word_format.key()>;

  static constexpr Word word(std::int32_t raw) { return from_integer<N, word_format.key()>(raw); }
  /// A constant: rounded in fixed point, exact in real numbers.
  static constexpr Word constant(std::int32_t raw, double exact) {
    if constexpr (is_fixed) {
      (void)exact;
      return word(raw);
    } else {
      (void)raw;
      return static_cast<Word>(exact);
    }
  }
  /// Fixed point: the integer of a word.
  static constexpr std::int32_t raw(const Word& x) { return static_cast<std::int32_t>(N::raw(x)); }

  /// ADD, SUB: saturated to 32 bits, or modulo 2^32 (_wrapped).
  static constexpr Word add(const Word& x, const Word& y) { return saturated(x + y); }
  static constexpr Word add_wrapped(const Word& x, const Word& y) { return wrapped(x + y); }
  static constexpr Word sub(const Word& x, const Word& y) { return saturated(x - y); }
  static constexpr Word sub_wrapped(const Word& x, const Word& y) { return wrapped(x - y); }
  /// MUL: x times the low 18 bits of y, divided by 2^Shift; rounded to nearest, ties up; saturated.
  template <int Shift>
  static constexpr Word mul(const Word& x, const Word& y) {
    return saturated(product<Shift>(x, y));
  }
  /// MAC: the same product added to acc; the sum is saturated once.
  template <int Shift>
  static constexpr Word mac(const Word& acc, const Word& x, const Word& y) {
    return saturated(acc + product<Shift>(x, y));
  }
  /// MLW for an angle: rounded down, modulo 2^32; whole turns do not matter.
  template <int Shift>
  static constexpr Word turn(const Word& x, const Word& y) {
    return wrapped(product<Shift>(x, y));
  }
  /// MLW that rounds down to a whole number.
  template <int Shift>
  static Word floor(const Word& x, const Word& y) {
    if constexpr (is_fixed) {
      return turn<Shift>(x, y);
    } else {
      return floor_of(product<Shift>(x, y));
    }
  }

  static constexpr Word min(const Word& x, const Word& y) { return less(x, y) ? x : y; }
  static constexpr Word max(const Word& x, const Word& y) { return less(x, y) ? y : x; }
  static constexpr bool less(const Word& x, const Word& y) { return x < y; }
  static constexpr Word select(bool flag, const Word& x, const Word& y) { return flag ? x : y; }
  static constexpr Word truth(bool flag) { return word(flag ? 1 : 0); }
  /// ABS: the amount y with the sign of x.
  static constexpr Word with_sign(const Word& x, const Word& y) {
    return x < Word{} ? saturated(-y) : y;
  }

  /// LRP from word `base` on in the table `t`, which begins at word 0 of table memory and is
  /// followed by zeros. In real numbers: exact(x).
  template <std::size_t Size, class Exact>
  static Word lookup(const std::array<LawSegment, Size>& t, const Word& x, int base,
                     const Exact& exact) {
    if constexpr (is_fixed) {
      (void)exact;
      return between(x, segment(t, address(x, base)));
    } else {
      return exact(x);
    }
  }
  /// TAB: the low 32 bits of the table word. In real numbers: exact(x / 4096 as a whole number).
  template <std::size_t Size, class Exact>
  static Word element(const std::array<LawSegment, Size>& t, const Word& x, int base,
                      const Exact& exact) {
    if constexpr (is_fixed) {
      (void)exact;
      const LawSegment s = segment(t, address(x, base));
      const auto low = static_cast<std::uint32_t>(s.slope) << EngineMap::value_bits |
                       (static_cast<std::uint32_t>(s.value) & 0xfffffU);
      return word(static_cast<std::int32_t>(low));
    } else {
      return exact(floor_of(x / (1 << EngineMap::fraction_bits)));
    }
  }

  /// Fixed point: LRP inside a segment.
  static Word between(const Word& x, LawSegment s) {
    constexpr std::int32_t last = (1 << EngineMap::fraction_bits) - 1;
    const auto within = N::template from_raw<within_format.key()>(raw(x) & last);
    return saturated(from_integer<N, value_format.key()>(s.value) +
                     from_integer<N, slope_format.key()>(s.slope) * within);
  }

  /// Address in table memory for x.
  static int address(const Word& x, int base) {
    constexpr int last = EngineMap::table_words - 1;
    if constexpr (is_fixed) {
      return (base + (raw(x) >> EngineMap::fraction_bits)) & last;
    } else {
      return (base + static_cast<int>(floor_of(x / (1 << EngineMap::fraction_bits)))) & last;
    }
  }

 private:
  template <class X>
  static constexpr Word saturated(const X& x) {
    return quantise<N, word_format.key(), Round::half_up, Overflow::saturate>(x);
  }
  template <class X>
  static constexpr Word wrapped(const X& x) {
    return quantise<N, word_format.key(), Round::truncate, Overflow::wrap>(x);
  }
  template <int Shift>
  static constexpr auto product(const Word& x, const Word& y) {
    if constexpr (is_fixed) {
      return N::template scaled<-Shift>(
          x * quantise<N, factor_format.key(), Round::truncate, Overflow::wrap>(y));
    } else {
      return x * y * (static_cast<Word>(1) / static_cast<Word>(1 << Shift));
    }
  }
  template <std::size_t Size>
  static constexpr LawSegment segment(const std::array<LawSegment, Size>& t, int n) {
    const auto i = static_cast<std::size_t>(n);
    return i < Size ? t[i] : LawSegment{0, 0};
  }
};

/// Delay lines: the words of table memory from `Base` on, which runs may write.
template <class N, int Base>
class LawLines {
 public:
  using O = LawOps<N>;
  using Word = typename O::Word;

  void clear() { words_.fill(Word{}); }
  /// TAB and LRP: reads a delay line; outside of the lines, the table.
  template <std::size_t Size, class Exact>
  Word element(const std::array<LawSegment, Size>& t, const Word& x, int base,
               const Exact& exact) const {
    const int n = O::address(x, base);
    return n >= Base ? words_[static_cast<std::size_t>(n - Base)] : O::element(t, x, base, exact);
  }
  template <std::size_t Size, class Exact>
  Word lookup(const std::array<LawSegment, Size>& t, const Word& x, int base,
              const Exact& exact) const {
    if constexpr (O::is_fixed) {
      const int n = O::address(x, base);
      if (n >= Base) {
        const std::int32_t w = O::raw(words_[static_cast<std::size_t>(n - Base)]);
        constexpr int above = EngineMap::data_bits - EngineMap::value_bits;
        const auto value = static_cast<std::uint32_t>(w) << above;
        return O::between(
            x, {static_cast<std::int32_t>(value) >> above, w >> EngineMap::value_bits & 0xfff});
      }
    }
    return O::lookup(t, x, base, exact);
  }
  /// TST: writes a delay line; outside of the lines it writes nothing.
  void write(const Word& x, int base, const Word& acc) {
    const int n = O::address(x, base);
    if (n >= Base) words_[static_cast<std::size_t>(n - Base)] = acc;
  }

 private:
  std::array<Word, static_cast<std::size_t>(EngineMap::table_words - Base)> words_{};
};

/// An angle in rad: 2 pi times the fraction of a turn that x is; a turn has `words_a_turn` words.
template <class T>
T law_angle(T x, double words_a_turn) {
  const T turns = x / static_cast<T>(words_a_turn);
  return 2 * series::pi<T>() * (turns - floor_of(turns));
}

/// The parameter words of a law for values in SI, which are given for the Law::words that are not
/// derived, in their order. Each is rounded to nearest and limited to its range; the derived words
/// are computed from what these words stand for.
template <class Law>
std::array<std::int32_t, Law::words.size()> law_words(std::array<double, Law::parameters> values) {
  constexpr std::size_t count = Law::words.size();
  std::array<std::int32_t, count> words{};
  for (const bool derived : {false, true}) {
    const std::array<double, count> exact = Law::template words_of<double>(values);
    std::size_t parameter = 0;
    for (std::size_t n = 0; n < count; ++n) {
      const LawWord& w = Law::words[n];
      if (w.derived == derived) {
        words[n] = static_cast<std::int32_t>(std::clamp(
            std::nearbyint(exact[n]), static_cast<double>(w.lower), static_cast<double>(w.upper)));
      }
      if (!w.derived) values[parameter++] = words[n] * w.scale;
    }
  }
  return words;
}

}  // namespace feltgate::law
