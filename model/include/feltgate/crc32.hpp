// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The CRC-32 of the host's link, as in zlib and Ethernet: polynomial 0x04c11db7, bits reflected,
// all ones before and inverted after. Documentation: docs/link.md
#pragma once

#include <cstddef>
#include <cstdint>

namespace feltgate {

/// Reflected.
inline constexpr std::uint32_t crc32_polynomial = 0xedb88320U;

/// The register after a bit.
constexpr std::uint32_t crc32_shift(std::uint32_t state, bool bit) {
  return state >> 1 ^ (((state & 1U) != 0) != bit ? crc32_polynomial : 0U);
}

/// The register after a byte; it begins with all ones.
constexpr std::uint32_t crc32_step(std::uint32_t state, std::uint8_t byte) {
  for (int bit = 0; bit < 8; ++bit) state = crc32_shift(state, (byte >> bit & 1) != 0);
  return state;
}

/// The register before the first byte, and after the last of a frame whose CRC holds.
inline constexpr std::uint32_t crc32_start = 0xffffffffU;
inline constexpr std::uint32_t crc32_good = 0xdebb20e3U;

/// Of `size` bytes (char, unsigned char, std::uint8_t).
template <class Byte>
constexpr std::uint32_t crc32(const Byte* bytes, std::size_t size) {
  std::uint32_t state = crc32_start;
  for (std::size_t i = 0; i < size; ++i) {
    state = crc32_step(state, static_cast<std::uint8_t>(bytes[i]));
  }
  return ~state;
}

}  // namespace feltgate
