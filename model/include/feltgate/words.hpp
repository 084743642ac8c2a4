// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The parameter words of a design as numbers, by address: raw integers in fixed point, exact values
// in real arithmetic. A word is decoded once, when it is set. Documentation: docs/registers.md
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "feltgate/numbers.hpp"
#include "feltgate/parameter.hpp"

namespace feltgate {

/// The number in the low bits of a 32-bit word: f.width() bits (at most 32), sign-extended when f
/// has a sign. What lies above them is ignored, as in the RTL.
constexpr std::int64_t decode_word(Format f, std::uint32_t word) {
  return detail::wrapped<std::int64_t>(static_cast<std::int64_t>(word), f.sign,
                                       f.width() < 32 ? f.width() : 32);
}

/// Parameters of design D in number policy N (Fixed or Real<T>); starts with the design's values.
template <class D, class N>
class Words {
 public:
  static constexpr int count = 512;
  /// What is stored: the raw integer in Fixed, the value in the parameter's unit in Real.
  using Stored = typename N::template num<Format{1, 63, 0}.key()>;

  Words() { reset(); }

  /// The design's values: quantised in Fixed, exact in Real. Words without a parameter are 0.
  void reset() {
    stored_.fill(Stored{});
    for (const ParameterInfo& p : D::parameters) {
      if constexpr (N::is_fixed) {
        set_raw(p.address, p.raw);
      } else {
        set_value(p.address, static_cast<Stored>(p.si));
      }
    }
  }

  /// The parameter at `address` in format Key, which must be the parameter's own.
  template <int Key>
  typename N::template num<Key> get(int address) const {
    if constexpr (N::is_fixed) {
      return fixed_of<Key>::from_raw(at(address).raw());
    } else {
      return at(address);
    }
  }

  /// Fixed only: a 32-bit word as the host writes it (its low 32 bits count).
  void set_raw(int address, std::int64_t raw) {
    static_assert(N::is_fixed, "real parameters are set by value");
    at(address) = Stored::from_raw(
        decode_word(formats()[index(address)], static_cast<std::uint32_t>(raw & 0xffffffff)));
  }

  /// Real only: a value in the parameter's unit.
  void set_value(int address, Stored value) {
    static_assert(!N::is_fixed, "fixed-point parameters are set by word");
    at(address) = value;
  }

 private:
  using Formats = std::array<Format, count>;

  static std::size_t index(int address) { return static_cast<std::size_t>(address) % count; }
  Stored& at(int address) { return stored_[index(address)]; }
  const Stored& at(int address) const { return stored_[index(address)]; }

  /// Format of every word; 32 plain bits where there is no parameter.
  static const Formats& formats() {
    static const Formats table = [] {
      Formats f;
      f.fill(Format{0, 32, 0});
      for (const ParameterInfo& p : D::parameters) f[index(p.address)] = p.format;
      return f;
    }();
    return table;
  }

  std::array<Stored, count> stored_;
};

}  // namespace feltgate
