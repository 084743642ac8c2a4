// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Between the grammar and what becomes of its errors. Documentation: docs/laws.md
#pragma once

#include <string>
#include <string_view>

#include "law/syntax.hpp"

namespace feltgate::law {

/// Thrown by the grammar, one statement at a time. Where `mend` is empty: the statement's form.
struct SyntaxError {
  const char* at;
  std::string what, mend;
};

/// One statement of `text` from `at` on; where it ends and blanks and comments behind it end.
/// nullptr where none begins. Errors: SyntaxError.
const char* parse_statement(std::string_view text, const char* at, Statement& result);

/// SyntaxError where `rest` begins with a word that is neither unit nor keyword.
void refuse_word(std::string_view rest);
/// SyntaxError where `e` is "1/32 turn", which would be 1/(32 turn). It stands at `at` in the text
/// that begins with `begin`.
void check_fraction(const Expression& e, const char* at, const char* begin);
/// SyntaxError where an expression is deeper than what follows it can bear.
void check_depth(int depth, const char* at);

}  // namespace feltgate::law
