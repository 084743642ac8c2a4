// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Bytes of a law file that are no ASCII. Documentation: docs/laws.md
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace feltgate::law {

inline unsigned char byte_at(std::string_view text, std::size_t at) {
  return static_cast<unsigned char>(text[at]);
}

/// Bytes of the UTF-8 letter at `at`, which has the number `code`; 0 where there is none.
inline std::size_t utf8_letter(std::string_view text, std::size_t at, std::uint32_t* code) {
  const unsigned char first = byte_at(text, at);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xc2 ? 0
                             : first < 0xe0 ? 2
                             : first < 0xf0 ? 3
                             : first < 0xf5 ? 4
                                            : 0;
  if (length == 0 || text.size() - at < length) return 0;
  *code = length == 1 ? first : first & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    const unsigned char next = byte_at(text, at + i);
    if ((next & 0xc0U) != 0x80) return 0;
    *code = *code << 6 | (next & 0x3fU);
  }
  // Longer than it need be, a half of a pair, beyond the last: none of them is a letter.
  const bool good = *code >= (length == 3   ? 0x800U
                              : length == 4 ? 0x10000U
                                            : 0U) &&
                    (*code < 0xd800 || *code > 0xdfff) && *code <= 0x10ffff;
  return good ? length : 0;
}

}  // namespace feltgate::law
