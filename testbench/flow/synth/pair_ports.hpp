// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "pair_fields.hpp"

namespace feltgate::test {

/// The field of that name. Throws std::runtime_error with the name where there is none.
template <int N>
const Field& named(const Field (&fields)[N], const char* name) {
  for (const Field& f : fields) {
    if (std::strcmp(f.name, name) == 0) return f;
  }
  throw std::runtime_error(name);
}

/// Bit n of a port. Up to 64 bits it is an integer in Verilator's class, a wider one an array of
/// 32-bit words.
template <class Port>
unsigned port_bit(const Port& port, int n) {
  if constexpr (std::is_integral_v<Port>) {
    return static_cast<unsigned>(port >> n) & 1U;
  } else {
    return (port[static_cast<std::size_t>(n / 32)] >> (n % 32)) & 1U;
  }
}

template <class Port>
void set_port_bit(Port& port, int n, bool value) {
  const auto set = [value](auto& word, int k) {
    using Word = std::remove_reference_t<decltype(word)>;
    const auto mask = static_cast<Word>(Word{1} << k);
    word = static_cast<Word>(value ? word | mask : word & static_cast<Word>(~mask));
  };
  if constexpr (std::is_integral_v<Port>) {
    set(port, n);
  } else {
    set(port[static_cast<std::size_t>(n / 32)], n % 32);
  }
}

/// The low bits of `value` into the input of that name.
template <class Port>
void set_input(Port& inputs, const char* name, std::uint64_t value) {
  const Field& f = named(kInputs, name);
  for (int k = 0; k < f.width; ++k) set_port_bit(inputs, f.first + k, (value >> k & 1U) != 0);
}

/// The output of that name, up to 64 bits.
template <class Port>
std::uint64_t output_of(const Port& outputs, const char* name) {
  const Field& f = named(kFields, name);
  std::uint64_t value = 0;
  for (int k = 0; k < f.width; ++k) {
    value |= std::uint64_t{port_bit(outputs, f.first + k)} << k;
  }
  return value;
}

}  // namespace feltgate::test
