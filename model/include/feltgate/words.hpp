// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The parameter words of a design as numbers, by address: raw integers in fixed point, exact values
// in real arithmetic. A word is decoded when it is read, in the format that the reader names.
// Documentation: docs/registers.md
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "feltgate/generated/reader.hpp"
#include "feltgate/numbers.hpp"
#include "feltgate/parameter.hpp"

namespace feltgate {

/// The number in the low f.width() bits (at most 32) of a 32-bit word, sign-extended when f has a
/// sign. The bits above are ignored, as in the RTL.
constexpr std::int64_t decode_word(Format f, std::uint32_t word) {
  return detail::wrapped<std::int64_t>(static_cast<std::int64_t>(word), f.sign,
                                       f.width() < 32 ? f.width() : 32);
}

/// Parameters of design D in number policy N (Fixed or Real<T>); they start with the design's
/// values. A law reads words.torque_limit(); get() reads a word in a format other than its own.
template <class D, class N>
class Words : public ParameterReader<D, Words<D, N>> {
 public:
  static constexpr int count = 512;
  /// What is stored: the 32-bit word in fixed point, the value in the parameter's unit in Real.
  using Stored = std::conditional_t<N::is_fixed, std::uint32_t,
                                    typename N::template num<Format{1, 31, 0}.key()>>;

  Words() { reset(); }

  /// Restores the design's values: quantised in Fixed, exact in Real. Words without a parameter are
  /// 0.
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

  /// The parameter at `address` in format Key. In fixed point: the low bits of the word, as many as
  /// the format has, as a block takes them off the bus.
  template <int Key>
  typename N::template num<Key> get(int address) const {
    if constexpr (N::is_fixed) {
      return N::template from_raw<Key>(decode_word(Format::from_key(Key), stored_[index(address)]));
    } else {
      return stored_[index(address)];
    }
  }

  /// Fixed only: sets a word as it is stored; only the low 32 bits of `raw` count.
  void set_raw(int address, std::int64_t raw) {
    static_assert(N::is_fixed, "real parameters are set by value");
    stored_[index(address)] = static_cast<Stored>(raw & 0xffffffff);
  }

  /// Real only: sets a value in the parameter's unit.
  void set_value(int address, Stored value) {
    static_assert(!N::is_fixed, "fixed-point parameters are set by word");
    stored_[index(address)] = value;
  }

 private:
  static std::size_t index(int address) { return static_cast<std::size_t>(address) % count; }

  std::array<Stored, count> stored_;
};

}  // namespace feltgate
