// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The CRC-32 of the host link, as in zlib and Ethernet: polynomial 0x04c11db7, bits reflected,
// start value all ones, result inverted. Documentation: docs/link.md
#pragma once

#include <cstddef>
#include <cstdint>

namespace feltgate {

/// The polynomial, reflected.
inline constexpr std::uint32_t crc32_polynomial = 0xedb88320U;

/// The CRC register after one more bit.
constexpr std::uint32_t crc32_shift(std::uint32_t state, bool bit) {
  return state >> 1 ^ (((state & 1U) != 0) != bit ? crc32_polynomial : 0U);
}

/// The CRC register after one more byte, low bit first; its start value is crc32_start.
constexpr std::uint32_t crc32_step(std::uint32_t state, std::uint8_t byte) {
  for (int bit = 0; bit < 8; ++bit) state = crc32_shift(state, (byte >> bit & 1) != 0);
  return state;
}

/// Values of the CRC register: before the first byte, and after the last byte of a correct frame.
inline constexpr std::uint32_t crc32_start = 0xffffffffU;
inline constexpr std::uint32_t crc32_good = 0xdebb20e3U;

/// The CRC of `size` bytes (char, unsigned char or std::uint8_t).
template <class Byte>
constexpr std::uint32_t crc32(const Byte* bytes, std::size_t size) {
  std::uint32_t state = crc32_start;
  for (std::size_t i = 0; i < size; ++i) {
    state = crc32_step(state, static_cast<std::uint8_t>(bytes[i]));
  }
  return ~state;
}

}  // namespace feltgate
