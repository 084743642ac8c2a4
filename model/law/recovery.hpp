// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Connects the grammar with error messages and recovery: one statement is parsed at a time.
// Documentation: docs/laws.md
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "law/syntax.hpp"

namespace feltgate::law {

/// Thrown by the grammar for a statement. If `mend` is empty, the message shows the statement's
/// form.
struct SyntaxError {
  const char* at;
  std::string what, mend;
};

/// Parses one statement of `text` from `at` on. Returns the end of the statement and of the blanks
/// and comments after it, or nullptr when no statement begins there. Throws SyntaxError.
const char* parse_statement(std::string_view text, const char* at, Statement& result);

/// Throws SyntaxError when `rest` begins with a word that is neither a unit nor a keyword.
void refuse_word(std::string_view rest);
/// Throws SyntaxError when `e` has the form "1/32 turn", which would mean 1/(32 turn). `at` is the
/// place of `e` in the text that begins at `begin`.
void check_fraction(const Expression& e, const char* at, const char* begin);
/// Throws SyntaxError when an expression is too deep for the later (recursive) passes.
void check_depth(int depth, const char* at);

// Decodes the non-ASCII bytes (UTF-8) of a law file.

inline unsigned char byte_at(std::string_view text, std::size_t at) {
  return static_cast<unsigned char>(text[at]);
}

/// Length in bytes of the UTF-8 character at `at`, and its code point in `code`; 0 when the bytes
/// are no valid character.
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
  // Overlong forms, surrogates and code points beyond the last one are not valid.
  const bool good = *code >= (length == 3   ? 0x800U
                              : length == 4 ? 0x10000U
                                            : 0U) &&
                    (*code < 0xd800 || *code > 0xdfff) && *code <= 0x10ffff;
  return good ? length : 0;
}

}  // namespace feltgate::law
