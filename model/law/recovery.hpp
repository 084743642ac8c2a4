// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Connects the grammar with error messages and recovery: one statement is parsed at a time.
// Documentation: docs/laws.md
#pragma once

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

}  // namespace feltgate::law
